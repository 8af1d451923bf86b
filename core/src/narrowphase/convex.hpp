// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "swept/core/shapes.hpp"

namespace swept::detail {

/// A convex body as GJK sees it: a core with a support mapping, grown by a ball. Refers to the
/// shape's data and must not outlive it.
struct Convex {
  enum class Core : std::uint8_t { Point, Segment, Box, Cylinder, Points };
  Core core = Core::Point;
  Eigen::Vector3d size =
      Eigen::Vector3d::Zero();  ///< m: box half extents; (radius, 0, half length)
  double radius = 0.0;          ///< m, of the ball that grows the core
  double extent = 0.0;          ///< m, no point of the core is farther from the local origin
  double error = 0.0;  ///< m, the shape may reach this far beyond the core grown by `radius`
  std::span<const Eigen::Vector3d> points;

  static Convex of(const Sphere& sphere);
  static Convex of(const Box& box);
  static Convex of(const Cylinder& cylinder);
  static Convex of(const Capsule& capsule);
  static Convex of(const ConvexHull& hull);
  static Convex ofPoints(std::span<const Eigen::Vector3d> points);

  /// Point of the core farthest along `direction` (any length, zero allowed).
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
};

}  // namespace swept::detail
