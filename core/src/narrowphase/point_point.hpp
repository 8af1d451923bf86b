// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// Spheres.
[[gnu::always_inline]] inline bool closedForm(PointCore, PointCore, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  const Eigen::Vector3d offset = a_from_b.translation();
  const double squared = offset.squaredNorm();
  if (!(squared > 1e-280 && squared < 1e280)) return false;
  const double distance = std::sqrt(squared);
  gap = {distance,
         pairRounding(a, b, a_from_b),
         offset * (1.0 / distance),
         Eigen::Vector3d::Zero(),
         offset,
         offset};
  return true;
}

}  // namespace swept::detail
