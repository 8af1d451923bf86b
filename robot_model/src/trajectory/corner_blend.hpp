// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "trajectory/way_point_path.hpp"

namespace swept::detail {

/// A curve that cuts a corner. It begins `before` the way point on one straight part and ends
/// `after` it on the next. In the time T, the velocity goes from 2 before / T along the first part
/// to 2 after / T along the second, in proportion to u = t / T, or with ramps to 3 u^2 - 2 u^3,
/// whose derivative is 0 at both ends. Without lengths there is no blend: the robot stops.
///
/// Lemma: the blend is w - before f(1 - u) d1 + after f(u) d2, where w is the way point, d1 and d2
/// are the directions, and f(u) = u^2, or with ramps 2 u^3 - u^4.
struct CornerBlend {
  double before = 0.0;  ///< rad or m
  double after = 0.0;   ///< rad or m

  bool stops() const { return before == 0.0; }
};

/// The blend between the straight parts `corner` - 1 and `corner` of the path.
class CornerShape {
 public:
  CornerShape(const WayPointPath& path, std::size_t corner);

  /// Whether the robot must stop: where it is told to, or the path turns back.
  bool mustStop() const { return mustStop_; }
  /// rad or m. Bounds the distance of each point of the blend from the straight parts, and of each
  /// point of these from blend and straight parts that are left.
  double deviation(const CornerBlend& blend) const;
  /// s. The least time of a blend.
  double leastTime(const CornerBlend& blend) const;
  /// The lengths, equal on both sides, that a blend needs so that its acceleration does not slow
  /// down the robot, whose speed is at most `speed`.
  double lengthFor(double speed) const;
  /// Bernstein coefficients, a column each.
  Eigen::MatrixXd coefficients(const CornerBlend& blend) const;

 private:
  const WayPointPath* path_;
  Eigen::Index corner_;
  double turn_;  ///< length of the difference of the directions
  bool mustStop_;
};

}  // namespace swept::detail
