// SPDX-License-Identifier: BSD-3-Clause
#include "input/xacro.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "command_line/exit_code.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

/// A file of the system's that is closed with the object.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// Until it ends. Empty: it is longer than a text may be.
std::string allOf(const Descriptor& from) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t count = read(from.number(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.size() > kMaxTextBytes) return {};
  }
}

pid_t start(std::vector<std::string>& words, int output) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw UsageError("--xacro: the program xacro cannot be run (" +
                     std::string(std::strerror(error)) + "); it is part of ROS, and 'xacro " +
                     words[1] + " > robot.urdf' does the same where it is installed");
  return child;
}

std::string expanded(const Arguments& args) {
  std::vector<std::string> words{"xacro", args.robot};
  words.insert(words.end(), args.xacroArguments.begin(), args.xacroArguments.end());
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw UsageError("--xacro: " + std::string(std::strerror(errno)));
  pid_t child = 0;
  std::string text;
  {
    const Descriptor from(ends[0]);
    {
      const Descriptor to(ends[1]);
      child = start(words, to.number());
    }
    text = allOf(from);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || text.empty())
    throw UsageError(
        "--xacro: xacro has made no URDF of '" + args.robot + "'" +
        (WIFEXITED(status) ? " (exit code " + std::to_string(WEXITSTATUS(status)) + ")" : ""));
  return text;
}

}  // namespace

ExpandedText expandedText(const Arguments& args) {
  return {.text = expanded(args), .name = args.robot + " (expanded)"};
}

}  // namespace swept
