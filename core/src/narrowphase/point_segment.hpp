// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// On a segment of the z axis. False close to the segment, where the normal has no digits.
[[gnu::always_inline]] inline bool closestPointOn(SegmentCore, const Convex& segment,
                                                  const Eigen::Vector3d& p, ClosestPoint& closest) {
  closest.point = {0.0, 0.0, std::clamp(p.z(), -segment.size.z(), segment.size.z())};
  const Eigen::Vector3d away = p - closest.point;
  const double squared = away.squaredNorm();
  if (!(squared > 1e-280 && squared < 1e280)) return false;
  closest.distance = std::sqrt(squared);
  closest.normal = moved(Eigen::Vector3d::Zero(), 1.0 / closest.distance, away);
  return true;
}

}  // namespace swept::detail
