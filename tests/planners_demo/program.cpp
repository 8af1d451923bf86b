// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace swept::test {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void redirect(const std::string& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

/// The terminal's other end, as a program's user sees it.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0)
      throw std::runtime_error("no pseudo terminal");
  }
  ~Terminal() { close(master_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  std::string name() const { return ptsname(master_); }
  /// Until the last writer is gone, which reads as an error.
  std::string readToEnd() const {
    std::string text;
    char buffer[4096];
    for (ssize_t count; (count = read(master_, buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(count));
    return text;
  }

 private:
  int master_;
};

Outcome runArgv(const std::vector<std::string>& words, Stderr where) {
  const TemporaryFolder folder;
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  std::optional<Terminal> terminal;
  int keepOpen = -1;
  if (where == Stderr::Terminal) {
    terminal.emplace();
    // Open already here: reading ends when all writers have closed, not before the first opens.
    keepOpen = open(terminal->name().c_str(), O_RDWR | O_NOCTTY);
  }
  const std::string out = folder.path("out"), err = folder.path("err");

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    if (chdir(SWEPT_SOURCE_DIR) != 0) _exit(126);
    // That of whoever runs the tests; those of the cache name their own.
    unsetenv("SWEPT_CACHE");
    redirect("/dev/null", STDIN_FILENO);
    redirect(out, STDOUT_FILENO);
    if (where == Stderr::Terminal)
      dup2(keepOpen, STDERR_FILENO);
    else
      redirect(err, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  Outcome run;
  if (terminal) {
    close(keepOpen);
    run.err = terminal->readToEnd();
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) run.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  run.out = contents(out);
  if (where == Stderr::File) run.err = contents(err);
  return run;
}

}  // namespace

Outcome runSwept(const std::vector<std::string>& arguments, Stderr where) {
  std::vector<std::string> words{SWEPT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return runArgv(words, where);
}

Outcome runShell(const std::string& commandLine) {
  const std::string function = std::string("swept() { exec '") + SWEPT_PROGRAM + "' \"$@\"; }; ";
  return runArgv({"/bin/sh", "-c", function + commandLine}, Stderr::File);
}

Outcome runCommands(const std::string& commands, const std::string& folder) {
  const std::string path = std::filesystem::path(SWEPT_PROGRAM).parent_path().string();
  return runArgv({"/bin/sh", "-c", "PATH='" + path + "':$PATH; cd '" + folder + "'; " + commands},
                 Stderr::File);
}

nlohmann::json jsonOf(const Outcome& run) {
  nlohmann::json json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_TRUE(json.is_object()) << "not one JSON object:\n" << run.out << run.err;
  return json;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "swept-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a test's verdict does not depend on its rubbish
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path(name);
}

std::string TemporaryFolder::read(const std::string& name) const {
  return contents(path_ / name);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace swept::test
