// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

/// Two features, a vertex and a face or two edges, as the set of differences between points of the
/// one and points of the other: a triangle, or a parallelogram. The distance of the features is
/// that of this set from the origin.
namespace swept::detail {

/// Corners of the set at one time, m. A triangle's fourth corner is its first again. By
/// coordinates, so that loops over the corners become vector instructions.
struct Corners {
  alignas(32) std::array<double, 4> x;
  alignas(32) std::array<double, 4> y;
  alignas(32) std::array<double, 4> z;

  Eigen::Vector3d corner(int k) const { return {x[k], y[k], z[k]}; }
  Eigen::Vector3d combination(const std::array<double, 4>& weights) const;
  /// n . corner for each.
  std::array<double, 4> heights(const Eigen::Vector3d& n) const;
};

inline std::array<double, 4> Corners::heights(const Eigen::Vector3d& n) const {
  std::array<double, 4> h;
  for (int k = 0; k < 4; ++k) h[k] = n.x() * x[k] + n.y() * y[k] + n.z() * z[k];
  return h;
}

inline Eigen::Vector3d Corners::combination(const std::array<double, 4>& weights) const {
  Eigen::Vector3d sum = weights[0] * corner(0);
  for (int k = 1; k < 4; ++k) sum += weights[k] * corner(k);
  return sum;
}

inline double lowest(const std::array<double, 4>& h) {
  const double first = h[0] < h[1] ? h[0] : h[1];
  const double second = h[2] < h[3] ? h[2] : h[3];
  return first < second ? first : second;
}

/// Distance of the set from the origin: at most `distance`, at least the lowest of `heights` (both
/// up to rounding).
struct Nearness {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, or zero where none is known
  double distance = 0.0;            ///< m, of a point of the set: upper bound on its distance
  std::array<double, 4> weights{};  ///< of that point: a convex combination of the corners
  std::array<double, 4> heights{};  ///< m, of the corners along the normal
};

/// Corner i is vertex - face[i].
struct VertexFace {
  /// Ericson 2005, section 5.1.5, of the origin, for the weights. Of little use for slivers.
  static Nearness nearest(const Corners& corners);
  /// Within some ten roundings of the coordinates, both ways, slivers and points included.
  static Nearness nearestOfAnyShape(const Corners& corners);
};

/// Corner i + 2 j is first[i] - second[j].
struct EdgeEdge {
  /// Ericson 2005, section 5.1.9. Of little use for nearly parallel edges.
  static Nearness nearest(const Corners& corners);
  /// As for a vertex and a face; parallel edges and points included.
  static Nearness nearestOfAnyShape(const Corners& corners);
};

}  // namespace swept::detail
