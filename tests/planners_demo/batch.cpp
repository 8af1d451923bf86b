// SPDX-License-Identifier: BSD-3-Clause
#include "batch.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace swept::test {

Words rook7Batch(const Words& more) {
  Words all{"bench",
            "planners",
            "models/robots/rook7/rook7.urdf",
            "--group",
            "arm",
            "--problems",
            "models/problems.json"};
  if (std::ranges::find(more, "--time") == more.end()) all.insert(all.end(), {"--time", "60"});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string programFile() {
  return SWEPT_PROGRAM;
}

std::vector<std::string> sortedLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

std::vector<nlohmann::json> jsonLines(const std::string& text) {
  std::vector<nlohmann::json> all;
  for (const std::string& line : sortedLines(text)) all.push_back(nlohmann::json::parse(line));
  return all;
}

RunningProgram::RunningProgram(const Words& arguments) {
  Words words{SWEPT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ > 0) return;
  const int nowhere = open("/dev/null", O_RDWR);
  if (chdir(SWEPT_SOURCE_DIR) != 0 || dup2(nowhere, STDIN_FILENO) < 0 ||
      dup2(nowhere, STDOUT_FILENO) < 0)
    _exit(126);
  // Test runners may have them ignored, which the program would go by.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  execv(argv[0], argv.data());
  _exit(127);
}

RunningProgram::~RunningProgram() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  wait();
}

std::vector<pid_t> RunningProgram::workers() const {
  const std::string id = std::to_string(pid_);
  std::ifstream stream("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> children;
  for (pid_t child = 0; stream >> child;) children.push_back(child);
  return children;
}

int RunningProgram::threads() const {
  int count = 0;
  for ([[maybe_unused]] const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/task"))
    ++count;
  return count;
}

bool RunningProgram::ended() const {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid != 0;
}

int RunningProgram::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool waitForTick(int& ticks) {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return ++ticks < 6000;
}

}  // namespace swept::test
