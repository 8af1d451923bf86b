// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "io/json_value.hpp"
#include "swept/core/verdict.hpp"

namespace swept {

/// A state of a robot, or the straight motion between two, and what is true about it.
struct RobotQuestion {
  Arguments inputs;                         ///< robot, world, group and rules
  std::vector<std::string> jointNames;      ///< the group's variables; empty: not said
  std::vector<std::vector<double>> states;  ///< one; two for a motion
  std::vector<double> times = {};         ///< s, of each state, where an object of the scene moves
  Verdict expected = Verdict::Undecided;  ///< Undecided: not known, so that all answers are right
  double contactAfter = 0.0;  ///< t, of a motion in collision: its first contact is no earlier
  double contactBy = 1.0;     ///< t, and no later
};

/// Whether readRobotQuestion() knows this query: `state` or `motion`.
bool isRobotQuery(const std::string& query);

/// A case of such a query; planners_demo/README.md has the format. Throws InputError.
RobotQuestion readRobotQuestion(const std::string& query, const JsonValue& entry);

/// A file of one case, as forEachReplayCase() reads it, which will be `file`.
std::string robotCaseText(const std::string& id, const RobotQuestion& question,
                          const std::filesystem::path& file);

}  // namespace swept
