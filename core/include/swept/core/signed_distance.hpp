// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

/// Signed distance of two solids, as an interval: the Euclidean distance if they are apart, minus
/// the length of the shortest translation that separates them if they overlap, 0 if they touch.
///
/// lower <= signed distance <= upper always holds, rounding included. Between convex shapes upper -
/// lower <= tolerance unless rounding or the cap on iterations prevents it (curved pairs in deep
/// overlap); the interval then shows the accuracy reached. For overlapping meshes `-lower` is the
/// depth of the hulls (translating a hull out translates the mesh out). `-upper` is the largest
/// depth proven for a pair of their closed convex parts, or for a point or ball of one inside the
/// other. The two are equal if each body is one convex solid, and for a half-space. A surface (an
/// open mesh, or one under MeshInterior::Surface) has no inside, and nothing deeper than 0 is
/// proven for it.
struct SignedDistanceResult {
  double lower = -std::numeric_limits<double>::infinity();  ///< m
  double upper = std::numeric_limits<double>::infinity();   ///< m
  /// m, a's frame. Nearest points if the shapes are apart. Deepest points, on the surfaces, if
  /// convex shapes overlap. If meshes overlap, the points at which `upper` was found, or a common
  /// point.
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< likewise, of b
  /// Unit vector in a's frame, from a to b. Moving b along it by -lower ends an overlap of convex
  /// shapes. Zero if no single plane separates (meshes apart).
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int iterations = 0;  ///< support evaluations
};

/// Signed distance of `a` and `b`, where `a_from_b` is the pose of b in a's frame and `tolerance`
/// in m. Never throws on finite input; a non-finite pose gives the widest interval.
SignedDistanceResult signedDistance(const Shape& a, const Shape& b,
                                    const Eigen::Isometry3d& a_from_b,
                                    double tolerance = tolerance::kDistance);

}  // namespace swept
