// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/world.hpp"

namespace swept::detail {

struct ObstaclePose {
  Eigen::Isometry3d world_from_body = Eigen::Isometry3d::Identity();
  /// m. Upper bound on the terms of the translation's coordinates, however small their sums are.
  double magnitude = 0.0;
};

/// See MovingObstacle::poseAt. `time` is finite.
ObstaclePose obstaclePose(const MovingObstacle& obstacle, double time);

}  // namespace swept::detail
