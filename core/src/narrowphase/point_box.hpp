// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// On a box: outside, the clamped point; inside, the nearest face.
[[gnu::always_inline]] inline bool footOn(BoxCore, const Convex& box, const Eigen::Vector3d& p,
                                          Foot& foot) {
  foot.point = p.cwiseMax(-box.size).cwiseMin(box.size);
  const Eigen::Vector3d away = p - foot.point;
  const double squared = away.squaredNorm();
  if (squared > 0.0) {
    if (!(squared > 1e-280 && squared < 1e280)) return false;
    foot.distance = std::sqrt(squared);
    foot.normal = moved(Eigen::Vector3d::Zero(), 1.0 / foot.distance, away);
    return true;
  }
  if (away != Eigen::Vector3d::Zero()) return false;  // squares that underflow
  int axis = 0;
  const double depth = (box.size - p.cwiseAbs()).minCoeff(&axis);
  const double side = std::copysign(1.0, p[axis]);
  foot.distance = -depth;
  foot.normal = side * Eigen::Vector3d::Unit(axis);
  foot.point[axis] = side * box.size[axis];
  return true;
}

}  // namespace swept::detail
