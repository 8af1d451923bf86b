// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// What came of a configuration that was read.
struct JudgedState {
  std::string problem;  ///< the first reason to refuse it; empty: it is within the limits
  std::vector<TakenToLimit> taken;
};

/// For values that are read, of the command line as of files, each finite. A quaternion of almost
/// unit norm becomes one of unit norm, an angle without limits that of the turn around zero, and a
/// value a little beyond a limit becomes that limit.
JudgedState judgeState(const Robot& robot, const Group& group, std::span<double> q);

/// Why a joint without a value of its own is not at `value` (rad or m): `does not move`, or
/// `follows 'wheel' to 0.3`, with the master's value by its variable. Empty: it is there, to within
/// a gear's play.
std::string whyElsewhere(const Robot& robot, const Joint& joint, double value,
                         const std::function<double(int variable)>& valueOf);

}  // namespace swept::detail
