// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/joint_trajectory.hpp"

namespace swept::detail {

/// Throws std::invalid_argument for a trajectory without a point, a size that is wrong, times that
/// do not increase or are negative, and values that are not finite. `caller`: the public function,
/// with which the message begins.
void requireValid(const JointTrajectory& trajectory, const char* caller);

}  // namespace swept::detail
