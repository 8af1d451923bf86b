// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/inner_ball.hpp"

#include <algorithm>

#include "certify/checker_model.hpp"
#include "swept/core/solid_depth.hpp"

namespace swept::detail {

JointTable::InnerBall innerBall(const LaneNode& node) {
  return {{node.center[0], node.center[1], node.center[2]}, node.inside};
}

// The centre's rounding and those of its pose are far below 1e-6 of its coordinates.
JointTable::InnerBall innerBallAround(const CheckerModel& model, const LaneModel& lanes,
                                      int geometry, const Eigen::Vector3d& center) {
  const RobotGeometry& body = model.robotGeometry[static_cast<std::size_t>(geometry)];
  JointTable::InnerBall ball;
  for (int k = 0; k < 3; ++k) ball.center[k] = static_cast<float>(center[k]);
  const Eigen::Vector3d inShape =
      body.body_from_shape.inverse() *
      (lanes.bodyFromLane[static_cast<std::size_t>(body.body)] * center);
  const double depth = solidDepth(body.shape, inShape);
  const double magnitude = center.norm() + inShape.norm();
  ball.inside = static_cast<float>(std::max(0.0, (depth - 1e-6 * magnitude) * (1.0 - 1e-6)));
  return ball;
}

}  // namespace swept::detail
