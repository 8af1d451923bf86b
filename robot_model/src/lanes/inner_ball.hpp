// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lanes/joint_table.hpp"

namespace swept::detail {

struct CheckerModel;
struct LaneModel;
struct LaneNode;

JointTable::InnerBall innerBall(const LaneNode& node);

/// The largest around `center` (m, frame of LaneNode::center) that is proven to lie in the solid of
/// a piece of the robot's geometry; a radius of 0 where none is.
JointTable::InnerBall innerBallAround(const CheckerModel& model, const LaneModel& lanes,
                                      int geometry, const Eigen::Vector3d& center);

}  // namespace swept::detail
