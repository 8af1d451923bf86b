// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Runs the real program and keeps what it said.
namespace swept::test {

struct Outcome {
  int exitCode = -1;  ///< -1 when a signal ended it
  int signal = 0;
  std::string out;
  std::string err;
};

/// Where the program's stderr goes.
enum class Stderr { File, Terminal };

/// `arguments` after the program's name; run from the folder that holds `models`.
Outcome runSwept(const std::vector<std::string>& arguments, Stderr where = Stderr::File);

/// With stdout being a terminal of so many columns and TERM=xterm, and `environment` (NAME=VALUE)
/// over what is set. What the program wrote is in `out`, byte for byte.
Outcome runOnTerminal(const std::vector<std::string>& arguments, int columns,
                      const std::vector<std::string>& environment = {});

/// A shell command line, with `swept` being the program. Nothing runs after it in the foreground.
Outcome runShell(const std::string& commandLine);

/// Shell commands in a folder, with the program on the path: several in a row, or other shells.
Outcome runCommands(const std::string& commands, const std::string& folder);

/// stdout as JSON; fails the test when it is not one object.
nlohmann::json jsonOf(const Outcome& run);

/// A folder that is removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path(const std::string& name = {}) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

}  // namespace swept::test
