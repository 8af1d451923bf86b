// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>

#include "bv/box_pair.hpp"

namespace swept::detail {

/// m^2, half the surface of a box with edges of these lengths (m). It compares boxes around the
/// same points.
inline double halfSurface(const Eigen::Vector3d& edges) {
  return edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0];
}

/// Box of points along given axes.
struct Extents {
  Eigen::Vector3d lower;  ///< m, along the axes, from the first point
  Eigen::Vector3d upper;  ///< m
  bool finite = true;     ///< so are all coordinates of the points

  Eigen::Vector3d half() const { return 0.5 * (upper - lower); }
  double area() const { return halfSurface(upper - lower); }  ///< m^2
};

/// `points` is not empty.
inline Extents extentsAlong(std::span<const Eigen::Vector3d> points, const Eigen::Matrix3d& axes) {
  const Eigen::Vector3d origin = points.front();
  Extents e{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  double zero = 0.0;  // a product with zero keeps non-finite values
  for (const Eigen::Vector3d& p : points) {
    const double x = p[0] - origin[0];
    const double y = p[1] - origin[1];
    const double z = p[2] - origin[2];
    zero += 0.0 * (x + y + z);
    for (int k = 0; k < 3; ++k) {
      const double along = axes(0, k) * x + axes(1, k) * y + axes(2, k) * z;
      e.lower[k] = along < e.lower[k] ? along : e.lower[k];
      e.upper[k] = along > e.upper[k] ? along : e.upper[k];
    }
  }
  e.finite = zero == 0.0;
  return e;
}

/// Columns and extents reordered: longest first.
inline void sortLongestFirst(Eigen::Matrix3d& axes, Extents& extents) {
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    if (extents.upper[i] - extents.lower[i] >= extents.upper[j] - extents.lower[j]) continue;
    axes.col(i).swap(axes.col(j));
    std::swap(extents.lower[i], extents.lower[j]);
    std::swap(extents.upper[i], extents.upper[j]);
  }
}

}  // namespace swept::detail
