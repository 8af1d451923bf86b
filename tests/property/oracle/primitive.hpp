// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <variant>

/// A second opinion on collisions, written to share nothing with the library it judges: own file
/// readers, own kinematics, own overlap tests. It knows states only; a motion is many states.
namespace oracle {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Sphere {
  double radius;  ///< m
};
struct Box {
  Vector3d half;  ///< m
};
/// Flat ends, axis along z.
struct Cylinder {
  double radius;  ///< m
  double half;    ///< m, half of the full length
};
/// Axis along z.
struct Capsule {
  double radius;  ///< m
  double half;    ///< m, half of the segment between the cap centres
};
/// A convex solid centred at its origin.
using Primitive = std::variant<Sphere, Box, Cylinder, Capsule>;
using Triangle = std::array<Vector3d, 3>;

/// Point of the solid closest to p; p itself when inside.
Vector3d closestPoint(const Primitive& solid, const Vector3d& p);
double distanceTo(const Primitive& solid, const Vector3d& p);
/// Largest value of direction . x over the solid.
double support(const Primitive& solid, const Vector3d& direction);
/// Half extents of the solid's bounding box.
Vector3d bounds(const Primitive& solid);

Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p);
Vector3d closestPoint(const Triangle& triangle, const Vector3d& p);
/// m, length of the common perpendicular of two segments; infinity when a foot lies outside.
double perpendicular(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d);
/// m, between two closed segments.
double segmentDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d);
/// m, between a triangle and a segment that does not pierce it.
double segmentDistance(const Triangle& t, const Vector3d& a, const Vector3d& b);
Triangle moved(const Isometry3d& pose, const Triangle& triangle);

}  // namespace oracle
