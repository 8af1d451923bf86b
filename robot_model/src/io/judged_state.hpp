// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// The result of reading a configuration.
struct JudgedState {
  std::string problem;  ///< the first reason to refuse it; empty: it is within the limits
  std::vector<TakenToLimit> taken;
};

/// Judges values of the command line or a file, each finite. Normalizes a quaternion whose norm is
/// almost 1, replaces an angle without limits by the same turn around zero, and moves a value a
/// little beyond a limit to the limit.
JudgedState judgeState(const Robot& robot, const Group& group, std::span<double> q);

/// Normalizes the quaternions of a group's configuration, except those whose norm is 1 to within
/// rounding: what was normalized once stays the same. Returns why one is no orientation; empty: all
/// are.
std::string normalizeOrientations(const Robot& robot, const Group& group, std::span<double> q);

/// Says why a joint without a value of its own is not at `value` (rad or m): `does not move`, or
/// `follows 'wheel' to 0.3`, with the value that follows from its master's variable. Empty: the
/// joint is there, to within the play of a gear.
std::string whyElsewhere(const Robot& robot, const Joint& joint, double value,
                         const std::function<double(int variable)>& valueOf);

}  // namespace swept::detail
