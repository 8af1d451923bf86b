// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace swept::detail {

/// Up to four points of the Minkowski difference B - A with the points they come from.
struct Simplex {
  struct Vertex {
    Eigen::Vector3d difference;  ///< b - a
    Eigen::Vector3d a;
    Eigen::Vector3d b;
    double weight = 0.0;  ///< barycentric coordinate of the nearest point; the weights sum to 1
  };
  std::array<Vertex, 4> vertices;
  int size = 0;

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
  bool contains(const Eigen::Vector3d& difference) const;
  /// Whether no weight is negative or NaN.
  bool hasShares() const;

  /// Drops the vertices that do not support the point of the simplex nearest to the origin, sets
  /// the weights, which are shares, and returns that point. It examines every feature and measures
  /// it by its weighted sum, so that flat and thin simplices near the origin do not mislead. Four
  /// vertices are left only if the origin is inside.
  Eigen::Vector3d reduceToNearest();

  Eigen::Vector3d nearest() const;  ///< m, the weighted sum of the differences
  Eigen::Vector3d pointA() const;
  Eigen::Vector3d pointB() const;
};

}  // namespace swept::detail
