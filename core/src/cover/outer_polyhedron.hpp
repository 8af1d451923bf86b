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

/// Hull with a volume that contains the points and keeps within `slack` of their hull: the hull
/// itself where it has a volume, else of a small octahedron around each point. No faces when all
/// points are one.
struct ThickHull {
  ConvexHull hull;
  double slack = 0.0;  ///< m
};
ThickHull thickHull(const ConvexHull& hull);

}  // namespace swept::detail
