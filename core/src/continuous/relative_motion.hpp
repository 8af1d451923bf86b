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
  bool finite = false;             ///< otherwise nothing of the above is to be relied on

  double half() const { return 0.5 * (to - from); }
};

/// Two bodies, each in a ball of its own frame, that move on a common clock.
class RelativeMotion {
 public:
  /// Refers to the motions.
  RelativeMotion(const BoundingSphere& ballA, const Motion& a, const BoundingSphere& ballB,
                 const Motion& b);

  /// `margin`: m, what the bodies have to keep.
  MotionSlice over(double from, double to, double margin) const;

 private:
  const Motion& a_;
  const Motion& b_;
  BoundingSphere ballA_;
  BoundingSphere ballB_;
};

}  // namespace swept::detail
