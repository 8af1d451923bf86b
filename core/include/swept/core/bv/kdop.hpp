// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "swept/core/eigen_layout.hpp"

namespace swept {

/// Polytope of K/2 slabs with fixed directions; a `BoundingVolume`. After Klosowski et al. 1998
/// ("Efficient collision detection using bounding volume hierarchies of k-DOPs").
///
/// It uses the first K/2 of these directions: x, y, z, (1,1,0), (1,-1,0), (1,0,1), (1,0,-1),
/// (0,1,1), (0,1,-1), (1,1,-1), (1,-1,1), (-1,1,1). Under a pose, each of the two is bounded again
/// along the directions of the other.
template <int K>
struct KDop {
  static_assert(K == 16 || K == 18 || K == 24);
  static constexpr int kSlabs = K / 2;         ///< pairs of parallel planes
  static constexpr bool kMergeIsTight = true;  ///< a fit to children is as tight as one to points

  std::array<double, kSlabs> lower;  ///< m times the length of the direction
  std::array<double, kSlabs> upper;  ///< m times the length of the direction

  ///@{
  /// See `BoundingVolume`.
  static KDop fit(std::span<const Eigen::Vector3d> points);
  static KDop merge(const KDop& a, const KDop& b);
  ///@}
  KDop inflated(double by) const;  ///< by: m

  /// Exact: true if all slabs overlap or touch. A NaN overlaps everything.
  bool overlaps(const KDop& other) const {
    for (int k = 0; k < kSlabs; ++k) {
      if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
    }
    return true;
  }
  /// See `BoundingVolume`.
  bool overlaps(const KDop& other, const Eigen::Isometry3d& a_from_b) const;
  double distanceBound(const KDop& other, const Eigen::Isometry3d& a_from_b) const;  ///< m
  /// See `BoundingVolume`.
  bool contains(const Eigen::Vector3d& p) const;
  Eigen::Vector3d center() const {  ///< m, of the box
    return 0.5 * Eigen::Vector3d(lower[0] + upper[0], lower[1] + upper[1], lower[2] + upper[2]);
  }
  double size() const {  ///< m^2, squared diagonal of the box
    return Eigen::Vector3d(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2])
        .squaredNorm();
  }
};

extern template struct KDop<16>;
extern template struct KDop<18>;
extern template struct KDop<24>;

}  // namespace swept
