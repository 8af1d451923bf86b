// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// A float that is at least `value` >= 0; cheaper to compute than the next float.
inline float aboveInSingle(double value) {
  return static_cast<float>(value * (1.0 + 1.2e-7)) + std::numeric_limits<float>::min();
}

/// Sums that give the second moments of points about their mean. They are additive, so a node's
/// sums need no second pass over its primitives.
struct Moments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();

  void add(const Moments& other) {
    count += other.count;
    sum += other.sum;
    outer += other.outer;
  }
  Eigen::Matrix3d scatter() const { return outer - sum * sum.transpose() / count; }
};

/// Points, each with a ball of `radius` (m) around it, and their box with the balls (m).
struct BallsInBox {
  std::span<const Eigen::Vector3d> points;  ///< m, at least one
  double radius;
  const Aabb& bounds;
};

// Each box has a centre that is a float from `origin`, as WideNode::set needs.

/// Along the principal axes of `scatter`, the same rotated by 45 degrees, or those of the frame:
/// the box of least surface. For three points: along the triangle's axes.
OrientedBox fitOrientedBox(const BallsInBox& balls, const Eigen::Matrix3d& scatter,
                           const Eigen::Vector3d& origin);
/// Along `axes`, orthonormal columns, or those of the frame: the box of less surface.
OrientedBox fitBoxAlong(const BallsInBox& balls, const Eigen::Matrix3d& axes,
                        const Eigen::Vector3d& origin);
/// Along the axes of the frame.
OrientedBox alignedBox(const Aabb& bounds, const Eigen::Vector3d& origin);

/// `box` (m) with a ball of `radius` (m) around each of its points, rounding included.
Aabb withBalls(const Aabb& box, double radius);

}  // namespace swept::detail
