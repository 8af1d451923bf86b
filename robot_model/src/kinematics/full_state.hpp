// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Requires that `state` has a finite value for each variable of the robot, and no zero quaternion.
/// Throws std::invalid_argument, which begins with `who` and calls the state `what`.
void requireFullState(const Robot& robot, const Eigen::Ref<const Eigen::VectorXd>& state,
                      const std::string& who, const std::string& what);

}  // namespace swept::detail
