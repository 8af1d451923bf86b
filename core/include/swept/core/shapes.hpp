// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <variant>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {

/// All shapes are solids in a local frame, centred at its origin where that makes sense.
/// Lengths are in metres. `makeSphere` and friends check their arguments.

struct Sphere {
  double radius;  ///< m
};

struct Box {
  Eigen::Vector3d halfExtents;  ///< m, along the local axes
};

/// Flat ends, axis along local z.
struct Cylinder {
  double radius;      ///< m
  double halfLength;  ///< m, half of the full height
};

/// Axis along local z; the caps are outside the segment.
struct Capsule {
  double radius;      ///< m
  double halfLength;  ///< m, half of the segment between the cap centres
};

/// `ConvexHull` and `TriangleMesh` hold shared immutable data and are cheap to copy.
using Shape = std::variant<Sphere, Box, Cylinder, Capsule, ConvexHull, TriangleMesh>;

/// Each throws std::invalid_argument, naming the value, unless every size is finite and not negative.
Sphere makeSphere(double radius);
Box makeBox(const Eigen::Vector3d& fullExtents);
Cylinder makeCylinder(double radius, double fullLength);
Capsule makeCapsule(double radius, double segmentLength);

/// Ball that contains a shape.
struct BoundingSphere {
  Eigen::Vector3d center;  ///< m, in the shape's frame
  double radius;           ///< m, rounded outward
};
BoundingSphere boundingSphere(const Shape& shape);

/// Box of the shape in its own frame, rounded outward.
Aabb boundingBox(const Shape& shape);

}  // namespace swept
