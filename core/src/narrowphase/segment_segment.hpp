// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// Capsules: the nearest points of two segments (after Lumelsky 1985), proven by the slab between
/// them. False if the two meet or are so nearly parallel that rounding spoils the answer.
[[gnu::always_inline]] inline bool closedForm(SegmentCore, SegmentCore, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  const Eigen::Vector3d d = a_from_b.linear().col(2);
  const Eigen::Vector3d t = a_from_b.translation();
  const double halfA = a.size.z();
  const double halfB = b.size.z();
  const double length = d.squaredNorm();
  const double determinant = d.x() * d.x() + d.y() * d.y();  // |e_z x d|^2
  const double along = t.dot(d);
  // Minimise |t + v d - u e_z|^2 over both parameters, then clamp one after the other.
  double u = 0.0;
  if (determinant > 1e-12 * length) {
    u = std::clamp((t.z() * length - along * d.z()) / determinant, -halfA, halfA);
  }
  const double v = std::clamp((u * d.z() - along) / length, -halfB, halfB);
  u = std::clamp(t.z() + v * d.z(), -halfA, halfA);
  const Eigen::Vector3d apart = t + v * d - Eigen::Vector3d(0.0, 0.0, u);
  const double squared = apart.squaredNorm();
  gap.rounding = pairRounding(a, b, a_from_b);
  if (!(squared > gap.rounding * gap.rounding && squared > 1e-280 && squared < 1e280)) return false;
  gap.distance = std::sqrt(squared);
  gap.normal = apart * (1.0 / gap.distance);
  // Lemma: along any unit normal, the least of b's coordinates minus the greatest of a's bounds the
  // distance from below.
  const double separation =
      gap.normal.dot(t) - halfB * std::abs(gap.normal.dot(d)) - halfA * std::abs(gap.normal.z());
  if (!(gap.distance - separation <= gap.rounding)) return false;
  gap.rounding *= 2.0;
  gap.pointA = {0.0, 0.0, u};
  gap.common = gap.pointA;
  gap.pointB = t + v * d;
  return true;
}

}  // namespace swept::detail
