// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "swept/core/bv/obb.hpp"

namespace swept {

/// Rectangle swept by a sphere; a `BoundingVolume`. After Larsen, Gottschalk, Lin, Manocha 2000
/// ("Fast distance queries with rectangular swept sphere volumes"). GJK finds the distance of the
/// rectangles, and the separation along the direction found certifies it.
struct Rss {
  Eigen::Matrix3d axes;         ///< columns: orthonormal; the rectangle spans the first two
  Eigen::Vector3d middle;       ///< m, of the rectangle
  Eigen::Vector2d halfLengths;  ///< m
  double radius;                ///< m

  /// A volume around the points, along the axes that Obb::fit finds.
  static Rss fit(std::span<const Eigen::Vector3d> points);
  /// A volume along the axes of a box that contains the points; the box's last axis becomes the
  /// rectangle's normal.
  static Rss fitWithin(std::span<const Eigen::Vector3d> points, const Obb& box);
  /// See `BoundingVolume`.
  static Rss merge(const Rss& a, const Rss& b);
  Rss inflated(double by) const;  ///< by: m

  ///@{
  /// False only if the volumes are proven to share no point.
  bool overlaps(const Rss& other) const;
  bool overlaps(const Rss& other, const Eigen::Isometry3d& a_from_b) const;
  ///@}
  /// Never more than the distance of the two volumes, and less by at most a thousandth of it and
  /// rounding.
  double distanceBound(const Rss& other, const Eigen::Isometry3d& a_from_b) const;  ///< m
  /// See `BoundingVolume`.
  bool contains(const Eigen::Vector3d& p) const;
  const Eigen::Vector3d& center() const { return middle; }  ///< m
  /// m^2, squared diagonal of the box around it.
  double size() const {
    const Eigen::Vector3d half(halfLengths.x() + radius, halfLengths.y() + radius, radius);
    return 4.0 * half.squaredNorm();
  }
};

}  // namespace swept
