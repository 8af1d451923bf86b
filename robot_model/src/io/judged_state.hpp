// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace swept::detail
