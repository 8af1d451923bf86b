// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// By index of Robot::joints(): how far a joint of the checker's group moves the robot and what it
/// carries per rad (m): the root mean square, over configurations within the limits, of the
/// distance of its farthest point from the axis, mimicking joints included. Joints that slide,
/// planar and floating joints have 1, joints of no variable of the group 0. An estimate: bodies are
/// taken as balls, and the configurations are few.
std::vector<double> jointReach(const Checker& checker);

}  // namespace swept::detail
