// SPDX-License-Identifier: BSD-3-Clause
// The program itself: its command line, and what becomes of a signal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <regex>
#include <string>
#include <vector>

#include "models_dir.hpp"

namespace {

using testing::HasSubstr;

/// The program with both its outputs in one pipe.
class Program {
 public:
  explicit Program(std::vector<std::string> words) {
    std::string program = SOAK_PROGRAM;
    std::vector<char*> arguments{program.data()};
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::array<int, 2> ends = {};
    if (pipe(ends.data()) != 0) ADD_FAILURE() << "no pipe";
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
    close(ends[1]);
    out_ = ends[0];
  }
  ~Program() { close(out_); }
  Program(const Program&) = delete;

  /// What it says up to the end of a line, or of everything.
  std::string read(bool line) const {
    std::string text;
    for (char c = 0; ::read(out_, &c, 1) == 1;) {
      text += c;
      if (line && c == '\n') break;
    }
    return text;
  }
  void interrupt() const { kill(child_, SIGINT); }
  /// Exit code; minus the signal that ended it.
  int wait() const {
    int status = 0;
    waitpid(child_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t child_ = -1;
  int out_ = -1;
};

const std::string kRobot = modelsDir() + "/robots/rook6/rook6.urdf";
const std::string kSrdf = modelsDir() + "/robots/rook6/rook6.srdf";

TEST(SoakProgram, SigintEndsItEarlyWithWhatWasDone) {
  const Program program({"--robot", kRobot, "--srdf", kSrdf, "--group", "arm"});
  EXPECT_THAT(program.read(true), HasSubstr("soak: 100000000 states, 10000000 motions, 8 threads"));
  program.interrupt();
  const std::string said = program.read(false);
  EXPECT_EQ(program.wait(), 130) << said;
  EXPECT_THAT(said, HasSubstr("all states: "));
  EXPECT_THAT(said, HasSubstr("0 failures; ended early"));
}

TEST(SoakProgram, AsksOneQueryAgain) {
  const Program program({"--robot", kRobot, "--srdf", kSrdf, "--group", "arm", "--world", "3a.0c",
                         "--from=0,-1,0.5,0,0,0", "--to=0.2,-1,0.5,0,0,0"});
  const std::string said = program.read(false);
  EXPECT_EQ(program.wait(), 0) << said;
  EXPECT_THAT(said, HasSubstr("--world 3a.0c --from=0,-1,0.5,0,0,0 --to="));
  EXPECT_THAT(said, HasSubstr("0 failures"));
}

struct BadInput {
  std::vector<std::string> words;
  const char* message;
};

/// CLI11 writes a range as `0.000000 to 1000000.000000`, and since 2.4 as `[0 - 1e+06]`.
std::string inOneForm(const std::string& text) {
  const std::string old =
      std::regex_replace(text, std::regex(R"(range \[(\S+) - (\S+)\])"), "range $1 to $2");
  return std::regex_replace(old, std::regex("0\\.000000 to 1000000\\.000000"), "0 to 1e+06");
}

TEST(SoakProgram, BadInputIsNamed) {
  const BadInput all[] = {
      {{"--states", "-1"}, "--states: Value -1 not in range 0 to 100000000000"},
      {{"--states", "0", "--motions", "0"}, "0 and 0: there is nothing to check"},
      {{"--threads", "0"}, "--threads: Value 0 not in range 1 to 1024"},
      {{"--updates", "x"}, "--updates: Value x not in range 0 to 100000000000"},
      {{"--growth", "-2"}, "--growth: Value -2 not in range 0 to 1e+06"},
      {{"--robot", "none.urdf", "--group", "arm"}, "--robot: File does not exist: none.urdf"},
      {{"--robot", kRobot}, "--robot requires --group"},
      {{"--margin", "0.1"}, "--margin requires --robot"},
      {{"--robot", kRobot, "--group", "leg"},
       "robot 'rook6' has no group 'leg'; its groups are: all"},
      {{"--robot", kRobot, "--group", "all", "--world", "99z", "--from=0"},
       "soak: --world: a body of a world is a place, 0 to 19, and a form, a to d, not '99z'"},
      {{"--robot", kRobot, "--group", "all", "--world", "none", "--from=0,1"},
       "soak: --from has 2 values, and the group 6"},
      {{"--robot", kRobot, "--group", "all", "--world", "none", "--from=0,0,0,0,0,0", "--to=1"},
       "soak: --to has 1 values, and the group 6"},
  };
  for (const auto& [words, message] : all) {
    const Program program(words);
    const std::string said = inOneForm(program.read(false));
    EXPECT_EQ(program.wait(), 3) << said;
    EXPECT_THAT(said, HasSubstr(message));
  }
}

}  // namespace
