// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// On a box: outside, the clamped point; inside, the nearest face.
[[gnu::always_inline]] inline bool closestPointOn(BoxCore, const Convex& box,
                                                  const Eigen::Vector3d& p, ClosestPoint& closest) {
  closest.point = p.cwiseMax(-box.size).cwiseMin(box.size);
  const Eigen::Vector3d away = p - closest.point;
  const double squared = away.squaredNorm();
  if (squared > 0.0) {
    if (!(squared > 1e-280 && squared < 1e280)) return false;
    closest.distance = std::sqrt(squared);
    closest.normal = moved(Eigen::Vector3d::Zero(), 1.0 / closest.distance, away);
    return true;
  }
  if (away != Eigen::Vector3d::Zero()) return false;  // squares that underflow
  int axis = 0;
  const double depth = (box.size - p.cwiseAbs()).minCoeff(&axis);
  const double side = std::copysign(1.0, p[axis]);
  closest.distance = -depth;
  closest.normal = side * Eigen::Vector3d::Unit(axis);
  closest.point[axis] = side * box.size[axis];
  return true;
}

}  // namespace swept::detail
