// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swept/core/tolerances.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

/// A value beyond a limit means the same everywhere. Up to tolerance::kLimit beyond, it stands for
/// the limit: files and messages round. What reads values (files, the command line, start and goal
/// of a planner) takes it to the limit and says so, by takeToLimits() and limitRemark(). What is
/// asked about a configuration (Checker, LinkMotion, InverseKinematics::pose) accepts it, and
/// answers for the configuration as it is given: all bounds hold that far beyond the limits.
/// Farther beyond, it is outside.
namespace swept {

/// Between two limits, or at most tolerance::kLimit beyond one. False for NaN.
constexpr bool isWithin(double value, double lower, double upper) {
  return value >= lower - tolerance::kLimit && value <= upper + tolerance::kLimit;
}

/// The limit that a value is taken to. None where the value stays as it is: within the limits,
/// outside by more than tolerance::kLimit, or no number; or of a cyclic variable, which has none.
std::optional<double> limitNear(const Variable& variable, double value);

/// Whether the variable is a component of an orientation, which has no limits.
bool isOrientation(const Robot& robot, const Variable& variable);

/// A value that was taken to a limit.
struct TakenToLimit {
  std::string variable;  ///< its name
  double value = 0.0;    ///< rad or m, as it was given
  double limit = 0.0;    ///< rad or m, in its place now
  std::string unit;      ///< see unitOf()
};

/// Takes the values of a group's configuration to their limits (limitNear()), and tells which. An
/// orientation has none. Throws std::invalid_argument unless there is a value for each variable.
std::vector<TakenToLimit> takeToLimits(const Robot& robot, const Group& group, ConfigurationSpan q);

/// `elbow is 2.000002 rad, 2e-06 beyond its limit 2: taken to the limit`, or what else was done.
std::string limitRemark(const TakenToLimit& taken, const std::string& done = "taken to the limit");

/// Of a value outside: `elbow is 2.1, allowed is -2 to 2 rad`; where that is by less than 1e-3, how
/// far, too: `elbow is 2.00002, allowed is -2 to 2 rad (2e-05 beyond)`.
std::string outsideText(const std::string& name, double value, double lower, double upper,
                        const std::string& unit);

/// Six significant digits of each, or as many more as show how far they are apart.
std::vector<std::string> distinctNumbers(std::span<const double> values);

/// `rad` or `m`; empty for the components of a quaternion. `place`: of the variable among the
/// joint's.
std::string unitOf(const Joint& joint, int place);
/// The same for one of the robot's variables.
std::string unitOf(const Robot& robot, const Variable& variable);

}  // namespace swept
