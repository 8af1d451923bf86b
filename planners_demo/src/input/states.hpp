// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The joints that the group moves, in the order of its values.
std::vector<std::string> variableNames(const Robot& robot, const Group& group);

/// The pieces between commas, without blanks around them.
std::vector<std::string> splitAtCommas(const std::string& text);

/// Takes a line for stderr: `swept: warning: ...`.
using Warn = std::function<void(const std::string& line)>;

/// Comma-separated values, one for each name. Throws UsageError, which starts with `label`, for
/// another number of them and for anything that is not a finite number.
std::vector<double> readValues(const std::string& text, std::span<const std::string> names,
                               const std::string& label);

/// The unit of angles on the command line.
enum class AngleUnit : std::uint8_t { Radian, Degree };

/// A configuration of the group from a named state or comma-separated values. Throws UsageError,
/// which starts with `label`, for an unknown name, a wrong count, anything that is not a finite
/// number, and a value outside its limits. The result is within the limits exactly: takeToLimits()
/// moves values that are a little outside, and `warn` gets a line for each. Values of named states
/// are in rad whatever `unit` is.
std::vector<double> readState(const Robot& robot, const Group& group, const std::string& text,
                              const std::string& label, const Warn& warn,
                              AngleUnit unit = AngleUnit::Radian);

/// For each variable of the group, its place in the problem's joint names. Throws UsageError when
/// those are not exactly the group's variables.
std::vector<std::size_t> problemOrder(const Robot& robot, const Group& group,
                                      const PlanningProblem& problem);

/// The problem's start and goals in the order of the group's variables. Throws UsageError when the
/// problem's joints are not exactly the group's variables, or a value is outside its limits. Limits
/// are kept as readState() does.
struct ProblemStates {
  std::vector<double> start;
  std::vector<std::vector<double>> goals;
};
ProblemStates problemStates(const Robot& robot, const Group& group, const PlanningProblem& problem,
                            const Warn& warn);

}  // namespace swept
