// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// How boxes of one frame relate to boxes of another, prepared for the vector kernels: the rotation
/// and what the rounding of single precision can do to a gap.
class BoxFrames {
 public:
  BoxFrames() = default;  ///< not usable
  /// `first_from_second` between the frames in which the boxes are given; `reach`: m, the sum of
  /// the largest 1-norms of both sides' boxes.
  BoxFrames(const Eigen::Isometry3d& first_from_second, double reach);

  /// False where single precision cannot tell: coordinates outside [1e-12, 1e12] m, or a linear
  /// part that is not a rotation. No gap is to be relied on then.
  bool usable() const { return usable_; }
  BoxFrames inverse() const;

  /// [i][j]: component i, in the first frame, of axis j of the second.
  std::array<std::array<float, 3>, 3> axes{};
  std::array<std::array<float, 3>, 3> absAxes{};
  /// [i][j]: 1 / |axis i x axis j|, 0 where the two are too close to parallel to be worth it.
  std::array<std::array<float, 3>, 3> edgeScale{};
  std::array<float, 3> translation{};  ///< m, of the second frame's origin in the first
  float rounding = 0.0F;               ///< m, a computed gap may exceed the true one by this

 private:
  void finish(const Eigen::Matrix3d& rotation);
  bool usable_ = false;
};

/// Lower bounds on the distance between each of the node's boxes (in the first frame) and `other`
/// (in the second): the largest that the fifteen axes of the separating axis test give (Gottschalk,
/// Lin, Manocha 1996), the three face axes of a box taken together. Not positive where no axis
/// separates. May stop early, with smaller bounds that are larger than `enough`. Lanes not in use
/// hold anything.
void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const BoxF& other, float enough,
                    std::array<float, WideNode::kLanes>& lower);

/// The best of the same axes for one pair of boxes, as a direction.
struct BoxGap {
  double value = 0.0;  ///< m, proven separation along `direction`; not positive: none found
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, first frame, towards `other`
};
BoxGap boxGap(const BoxF& box, const BoxFrames& frames, const BoxF& other);

}  // namespace swept::detail
