// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "program.hpp"

/// `swept bench planners`, and what tests of it have in common.
namespace swept::test {

using Words = std::vector<std::string>;

/// `bench planners` of the arm rook7 on models/problems.json, and `more`. Its runs are not ended by
/// a time limit, so that they depend on nothing but their seeds.
Words rook7Batch(const Words& more);

/// Where the program is, for other programs that start it.
std::string programFile();

/// The lines, sorted.
std::vector<std::string> sortedLines(const std::string& text);
/// The same with the header in front, as JSON.
std::vector<nlohmann::json> jsonLines(const std::string& text);

/// The program, in a process of its own, while it runs. Its stdout goes nowhere.
class RunningProgram {
 public:
  explicit RunningProgram(const Words& arguments);
  /// Kills it if it still runs.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  pid_t pid() const { return pid_; }
  /// Processes that it has forked and that live.
  std::vector<pid_t> workers() const;
  int threads() const;
  /// It is over, and wait() returns at once.
  bool ended() const;
  /// Its exit code, or minus the signal that ended it.
  int wait();

 private:
  pid_t pid_ = -1;
};

/// Until `condition` holds; false when it does not within half a minute.
template <typename Condition>
bool waitFor(const Condition& condition);

bool waitForTick(int& ticks);

template <typename Condition>
bool waitFor(const Condition& condition) {
  for (int ticks = 0; !condition();)
    if (!waitForTick(ticks)) return false;
  return true;
}

}  // namespace swept::test
