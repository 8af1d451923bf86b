// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <variant>

#include "swept/core/bounding_sphere.hpp"
#include "swept/core/bv/aabb.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {

/// @file
/// Shapes are closed sets in a local frame, centred at its origin if that makes sense. They are
/// solid, except for triangles, planes and open meshes. Lengths are in metres. `makeSphere` and the
/// other functions check their arguments.

/// All points at most `radius` from the origin.
struct Sphere {
  double radius;  ///< m
};

/// All points whose coordinates are at most the half extents in magnitude.
struct Box {
  Eigen::Vector3d halfExtents;  ///< m, along the local axes
};

/// A cylinder with flat ends and its axis along local z.
struct Cylinder {
  double radius;      ///< m
  double halfLength;  ///< m, half of the full height
};

/// All points at most `radius` from a segment along local z, centred at the origin.
struct Capsule {
  double radius;      ///< m
  double halfLength;  ///< m, half of the segment between the cap centres
};

/// A cone along local z: the apex at +halfLength, the centre of the flat base at -halfLength.
struct Cone {
  double radius;      ///< m, of the base
  double halfLength;  ///< m, half of the height
};

/// All points with (x / a)^2 + (y / b)^2 + (z / c)^2 <= 1, with a, b, c the semi-axes.
struct Ellipsoid {
  Eigen::Vector3d semiAxes;  ///< m, along the local axes
};

/// A surface without thickness; it may degenerate to a segment or a point.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< m
};

/// The points x with normal . x = offset: a surface without thickness. All queries treat two planes
/// or half-spaces as parallel if they are within tolerance::kParallel, which says how far out their
/// answers then hold.
struct Plane {
  Eigen::Vector3d normal;  ///< unit
  double offset;           ///< m
};

/// The points x with normal . x <= offset.
struct HalfSpace {
  Eigen::Vector3d normal;  ///< unit, points out of the solid
  double offset;           ///< m
};

/// `ConvexHull`, `TriangleMesh` and `PointCloud` hold shared immutable data and are cheap to copy.
using Shape = std::variant<Sphere, Box, Cylinder, Capsule, Cone, Ellipsoid, ConvexHull, Triangle,
                           Plane, HalfSpace, TriangleMesh, PointCloud>;

///@{
/// Make a shape from full lengths (m) and radii or semi-axes (m). Each throws
/// std::invalid_argument, naming the value, unless every size is finite and not negative.
Sphere makeSphere(double radius);
Box makeBox(const Eigen::Vector3d& fullExtents);
Cylinder makeCylinder(double radius, double fullLength);
Capsule makeCapsule(double radius, double segmentLength);
Cone makeCone(double radius, double fullHeight);
Ellipsoid makeEllipsoid(const Eigen::Vector3d& semiAxes);
///@}
/// A triangle with these corners (m). Throws std::invalid_argument, naming the corner, unless all
/// coordinates are finite.
Triangle makeTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
///@{
/// The set { normal . x = offset } (or <=). `normal` may have any length. Throws
/// std::invalid_argument unless all numbers are finite and the normal's length is a normal number.
Plane makePlane(const Eigen::Vector3d& normal, double offset);
HalfSpace makeHalfSpace(const Eigen::Vector3d& normal, double offset);
///@}

/// A ball (m, shape's frame) that contains all of the shape, rounding included; not always the
/// smallest.
BoundingSphere boundingSphere(const Shape& shape);

/// The shape scaled by `factor` in all directions about the centre of its box. Planes and
/// half-spaces stay as they are. Throws std::invalid_argument unless the factor is finite and above
/// zero, and as the shapes' own functions do if sizes get too large.
Shape scaled(const Shape& shape, double factor);

/// Box of the shape (m) in its own frame, rounded outward; unbounded (infinite coordinates) for
/// planes and half-spaces.
Aabb boundingBox(const Shape& shape);

}  // namespace swept
