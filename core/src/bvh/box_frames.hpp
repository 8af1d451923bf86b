// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "bvh/wide_bvh.hpp"
#include "geometry/error_model.hpp"

namespace swept::detail {

/// The pose of boxes of one frame relative to boxes of another, and the rounding of a gap.
class BoxFrames {
 public:
  BoxFrames() = default;  ///< not usable
  /// `first_from_second` between the frames in which the boxes are given; `reach`: m, the sum of
  /// the largest 1-norms of the points of both sides' primitives.
  BoxFrames(const Eigen::Isometry3d& first_from_second, double reach);

  /// False if single precision is not enough: coordinates outside [1e-12, 1e12] m, or a linear part
  /// that is not a rotation. Gaps are then not reliable.
  bool usable() const { return usable_; }
  BoxFrames inverse() const;

  Eigen::Matrix3d linear;
  Eigen::Vector3d translation;  ///< m, of the second frame's origin in the first
  /// m; a computed gap may exceed the true one by this plus `perMetre` times the sizes of the two
  /// boxes and their distance.
  double rounding = 0.0;
  double perMetre = 0.0;

 private:
  bool usable_ = false;
};

/// The separation of a pair of boxes along a direction.
struct BoxGap {
  double value = 0.0;  ///< m, proven separation along `direction`; not positive: none found
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, first frame, towards `other`
};
/// The best of the fifteen axes of the separating axis test, with the three face axes of a box
/// combined.
BoxGap boxGap(const OrientedBox& box, const BoxFrames& frames, const OrientedBox& other);
/// `along`: in the first frame, of any length and either sense.
BoxGap boxGap(const OrientedBox& box, const BoxFrames& frames, const OrientedBox& other,
              const Eigen::Vector3d& along);

}  // namespace swept::detail
