// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "swept/core/eigen_layout.hpp"

namespace swept {

/// Oriented box; a `BoundingVolume`. Overlap after Gottschalk, Lin, Manocha 1996 ("OBBTree"): the
/// 15 axes decide exactly, up to rounding.
struct Obb {
  Eigen::Matrix3d axes;         ///< columns: orthonormal, longest extent first
  Eigen::Vector3d middle;       ///< m
  Eigen::Vector3d halfExtents;  ///< m, along the columns of `axes`

  /// A box around the points. Its axes are those of least surface area among the principal axes of
  /// the points, the axes of the frame and, for few points, those of the first triangle.
  static Obb fit(std::span<const Eigen::Vector3d> points);
  /// A box along the axes of a, of b or the principal axes of the corners, whichever gives less
  /// surface.
  static Obb merge(const Obb& a, const Obb& b);
  Obb inflated(double by) const;  ///< by: m

  ///@{
  /// Tests 15 axes. False only with proof; see `BoundingVolume`.
  bool overlaps(const Obb& other) const;
  bool overlaps(const Obb& other, const Eigen::Isometry3d& a_from_b) const;
  ///@}
  /// The better of two bounds: the gaps along the three axes of one box, combined; the gap along an
  /// edge pair.
  double distanceBound(const Obb& other, const Eigen::Isometry3d& a_from_b) const;  ///< m
  /// See `BoundingVolume`.
  bool contains(const Eigen::Vector3d& p) const;
  const Eigen::Vector3d& center() const { return middle; }         ///< m
  double size() const { return 4.0 * halfExtents.squaredNorm(); }  ///< m^2
};

}  // namespace swept
