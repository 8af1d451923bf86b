// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
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

/// What a program's streams are, and what it finds in its environment.
struct Place {
  int terminal = -1;  ///< STDOUT_FILENO, STDERR_FILENO or none
  int columns = 0;    ///< of the terminal; 0: it has no width
  std::vector<std::string> environment = {};
};

/// As wide as is wanted, and bytes come through as they are.
void prepare(int terminal, int columns) {
  winsize size{};
  size.ws_col = static_cast<unsigned short>(columns);
  ioctl(terminal, TIOCSWINSZ, &size);
  termios settings{};
  tcgetattr(terminal, &settings);
  cfmakeraw(&settings);
  tcsetattr(terminal, TCSANOW, &settings);
}

/// What the person who runs the tests wants of a terminal, and of a cache, is of no account.
void setEnvironment(const std::vector<std::string>& variables) {
  unsetenv("COLUMNS");
  unsetenv("NO_COLOR");
  unsetenv("SWEPT_CACHE");
  for (const std::string& variable : variables) {
    const std::size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.c_str() + equals + 1, 1);
  }
}

Outcome runArgv(const std::vector<std::string>& words, const Place& place) {
  const TemporaryFolder folder;
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  std::optional<Terminal> terminal;
  int keepOpen = -1;
  if (place.terminal >= 0) {
    terminal.emplace();
    // Open already here: reading ends when all writers have closed, not before the first opens.
    keepOpen = open(terminal->name().c_str(), O_RDWR | O_NOCTTY);
    prepare(keepOpen, place.columns);
  }
  const std::string out = folder.path("out"), err = folder.path("err");

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    if (chdir(SWEPT_SOURCE_DIR) != 0) _exit(126);
    setEnvironment(place.environment);
    redirect("/dev/null", STDIN_FILENO);
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (place.terminal >= 0) dup2(keepOpen, place.terminal);
    execv(argv[0], argv.data());
    _exit(127);
  }
  Outcome run;
  std::string shown;
  if (terminal) {
    close(keepOpen);
    shown = terminal->readToEnd();
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) run.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  run.out = place.terminal == STDOUT_FILENO ? shown : contents(out);
  run.err = place.terminal == STDERR_FILENO ? shown : contents(err);
  return run;
}

}  // namespace

Outcome runSwept(const std::vector<std::string>& arguments, Stderr where) {
  std::vector<std::string> words{SWEPT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const bool terminal = where == Stderr::Terminal;
  return runArgv(
      words, terminal
                 ? Place{.terminal = STDERR_FILENO, .columns = 400, .environment = {"TERM=xterm"}}
                 : Place{});
}

Outcome runOnTerminal(const std::vector<std::string>& arguments, int columns,
                      const std::vector<std::string>& environment) {
  std::vector<std::string> words{SWEPT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Place place{.terminal = STDOUT_FILENO, .columns = columns, .environment = {"TERM=xterm"}};
  place.environment.insert(place.environment.end(), environment.begin(), environment.end());
  return runArgv(words, place);
}

Outcome runShell(const std::string& commandLine) {
  const std::string function = std::string("swept() { exec '") + SWEPT_PROGRAM + "' \"$@\"; }; ";
  return runArgv({"/bin/sh", "-c", function + commandLine}, {});
}

Outcome runCommands(const std::string& commands, const std::string& folder) {
  const std::string path = std::filesystem::path(SWEPT_PROGRAM).parent_path().string();
  return runArgv({"/bin/sh", "-c", "PATH='" + path + "':$PATH; cd '" + folder + "'; " + commands},
                 {});
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
