// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swept/core/tolerances.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

/// A value beyond a limit is treated the same way everywhere. Up to tolerance::kLimit beyond, it
/// stands for the limit, since files and messages round. Readers of values (files, the command
/// line, start and goal of a planner) move it to the limit and say so, with takeToLimits() and
/// limitRemark(). Queries about a configuration (Checker, LinkMotion, InverseKinematics::pose)
/// accept it and answer for the configuration as given: all bounds hold that far beyond the limits.
/// Farther beyond, it is outside.
namespace swept {

/// Whether a value is between two limits, or at most tolerance::kLimit beyond one. False for NaN.
constexpr bool isWithin(double value, double lower, double upper) {
  return value >= lower - tolerance::kLimit && value <= upper + tolerance::kLimit;
}

/// The limit that a value is moved to. No value if it stays as it is: within the limits, outside by
/// more than tolerance::kLimit, NaN, or a value of a cyclic variable, which has no limits.
std::optional<double> limitNear(const Variable& variable, double value);

/// Whether the variable is a component of an orientation, which has no limits.
bool isOrientation(const Robot& robot, const Variable& variable);

/// A value that was moved to a limit.
struct TakenToLimit {
  std::string variable;  ///< its name
  double value = 0.0;    ///< rad or m, as given
  double limit = 0.0;    ///< rad or m, which replaces it
  std::string unit;      ///< see unitOf()
};

/// Moves the values of a group's configuration to their limits (limitNear()), and returns which. An
/// orientation has no limits. Throws std::invalid_argument unless there is a value for each
/// variable.
std::vector<TakenToLimit> takeToLimits(const Robot& robot, const Group& group, ConfigurationSpan q);

/// Returns `elbow is 2.000002 rad, 2e-06 beyond its limit 2: taken to the limit`, with `done` at
/// the end.
std::string limitRemark(const TakenToLimit& taken, const std::string& done = "taken to the limit");

/// Text about a value outside its limits: `elbow is 2.1, allowed is -2 to 2 rad`. If it is outside
/// by less than 1e-3, the text says by how much: `elbow is 2.00002, allowed is -2 to 2 rad (2e-05
/// beyond)`.
std::string outsideText(const std::string& name, double value, double lower, double upper,
                        const std::string& unit);

/// The values as text with six significant digits, or as many more as show their difference.
std::vector<std::string> distinctNumbers(std::span<const double> values);

/// `rad` or `m`; empty for the components of a quaternion. `place`: index of the variable in the
/// joint.
std::string unitOf(const Joint& joint, int place);
/// The same for one of the robot's variables.
std::string unitOf(const Robot& robot, const Variable& variable);

}  // namespace swept
