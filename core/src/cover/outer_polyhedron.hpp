// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "swept/core/shapes.hpp"

namespace swept::detail {

/// Points whose hull contains a convex shape.
struct OuterPoints {
  std::vector<Eigen::Vector3d> points;  ///< m
  double slack = 0.0;                   ///< m, proven: the hull is within the shape grown by this
};

OuterPoints outerPoints(const Box& box);
OuterPoints outerPoints(const Cylinder& cylinder);
OuterPoints outerPoints(const Capsule& capsule);
OuterPoints outerPoints(const Cone& cone);
OuterPoints outerPoints(const Ellipsoid& ellipsoid);
OuterPoints outerPoints(const Triangle& triangle);

/// A hull with a volume that contains the points and stays within `slack` of their hull: the hull
/// itself if it has a volume, else that of a small octahedron around each point. No faces if all
/// points coincide.
struct ThickHull {
  ConvexHull hull;
  double slack = 0.0;  ///< m
};
ThickHull thickHull(const ConvexHull& hull);

}  // namespace swept::detail
