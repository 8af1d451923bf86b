// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/continuous/motion.hpp"
#include "swept/core/separation.hpp"

namespace swept::detail {

/// One interval of a relative motion.
struct MotionSlice {
  double from = 0.0;
  double to = 0.0;
  double middle = 0.0;
  Eigen::Isometry3d world_from_a;  ///< at the middle
  Eigen::Isometry3d a_from_b;      ///< at the middle
  ApproachBound approach;          ///< around the middle; `required` is the margin and roundings
  bool finite = false;             ///< otherwise the other members are invalid

  double half() const { return 0.5 * (to - from); }
};

/// Relative pose and motion of two bodies at one t.
struct RelativeState {
  Eigen::Isometry3d world_from_a;
  Eigen::Isometry3d a_from_b;
  Eigen::Vector3d velocity;  ///< m per unit of t, a's frame: of b past a's origin
  Eigen::Vector3d spin;      ///< rad per unit of t, a's frame: of b about a

  /// m per unit of t. Speed at which b approaches a against `normal` (from a to b), at a point of
  /// both (a's frame).
  double closing(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) const {
    return -normal.dot(velocity + spin.cross(point));
  }
};

/// Two bodies, each in a ball of its own frame, that move on a common clock.
class RelativeMotion {
 public:
  /// Refers to the motions.
  RelativeMotion(const BoundingSphere& ballA, const Motion& a, const BoundingSphere& ballB,
                 const Motion& b);

  /// `margin`: m, which the bodies must keep.
  MotionSlice over(double from, double to, double margin) const;
  RelativeState at(double t) const;

 private:
  const Motion& a_;
  const Motion& b_;
  BoundingSphere ballA_;
  BoundingSphere ballB_;
};

}  // namespace swept::detail
