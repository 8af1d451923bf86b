// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "swept/core/eigen_layout.hpp"

namespace swept {

/// Axis-aligned box; a `BoundingVolume`. Under a pose, each box is bounded again along the axes of
/// the other, so two boxes count as disjoint if one of these six axes separates them.
struct Aabb {
  Eigen::Vector3d lower;  ///< m
  Eigen::Vector3d upper;  ///< m

  static constexpr bool kMergeIsTight = true;  ///< a fit to children is as tight as one to points

  ///@{
  /// See `BoundingVolume`.
  static Aabb fit(std::span<const Eigen::Vector3d> points);
  static Aabb merge(const Aabb& a, const Aabb& b);
  ///@}
  Aabb inflated(double by) const;  ///< by: m

  /// Whether the boxes (in one frame) share a point. Exact; touching counts. A NaN coordinate
  /// overlaps everything.
  bool overlaps(const Aabb& other) const {
    for (int k = 0; k < 3; ++k) {
      if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
    }
    return true;
  }
  /// See `BoundingVolume`; six axes are tried.
  bool overlaps(const Aabb& other, const Eigen::Isometry3d& a_from_b) const;
  double distanceBound(const Aabb& other, const Eigen::Isometry3d& a_from_b) const;  ///< m
  /// Whether the box contains p (m). Exact; a NaN coordinate contains everything.
  bool contains(const Eigen::Vector3d& p) const {
    for (int k = 0; k < 3; ++k) {
      if (p[k] < lower[k] || p[k] > upper[k]) return false;
    }
    return true;
  }
  Eigen::Vector3d center() const { return 0.5 * lower + 0.5 * upper; }  ///< m
  double size() const { return (upper - lower).squaredNorm(); }         ///< m^2
};

}  // namespace swept
