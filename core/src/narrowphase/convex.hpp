// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "geometry/support_points.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// A convex body as the pair queries see it: a core, grown by a ball. Refers to the shape's data
/// and must not outlive it.
struct Convex {
  /// HalfSpace must stay the last: it gives the size of tables of pairs.
  enum class Core : std::uint8_t {
    Point,
    Segment,
    Box,
    Cylinder,
    Cone,
    Ellipsoid,
    Points,
    Plane,
    HalfSpace,
  };
  Core core = Core::Point;
  /// m: box half extents; (radius, 0, half length); semi-axes. Planes and half-spaces: the normal.
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  double offset = 0.0;  ///< m, of planes and half-spaces
  double radius = 0.0;  ///< m, of the ball that grows the core
  double extent = 0.0;  ///< m, no point of the core is farther from the local origin
  double inset =
      0.0;  ///< m, for an ellipsoid: distance of its core inside the surface that `size` gives
  double error = 0.0;    ///< m, the shape may reach this far beyond the core grown by `radius`
  double omitted = 0.0;  ///< m, the part of `error` from vertices that a hull leaves out
  std::span<const Eigen::Vector3d> points;
  const SupportPoints* vertices =
      nullptr;  ///< `points` in the form that support queries read, or null

  static Convex of(const Sphere& sphere);
  static Convex of(const Box& box);
  static Convex of(const Cylinder& cylinder);
  static Convex of(const Capsule& capsule);
  static Convex of(const Cone& cone);
  static Convex of(const Ellipsoid& ellipsoid);
  static Convex of(const ConvexHull& hull);
  static Convex of(const Triangle& triangle);
  static Convex of(const Plane& plane);
  static Convex of(const HalfSpace& halfSpace);
  static Convex ofPoints(std::span<const Eigen::Vector3d> points);

  /// Planes and half-spaces: unbounded, and without a support mapping.
  static constexpr bool isFlat(Core core);
  bool isFlat() const { return isFlat(core); }
  /// Point of a bounded core farthest along `direction`, of a length in [1e-100, 1e100] or zero.
  /// For planes and half-spaces: their point nearest to the origin, for any direction.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
};

constexpr bool Convex::isFlat(Core core) {
  switch (core) {
    case Core::Plane:
    case Core::HalfSpace:
      return true;
    case Core::Point:
    case Core::Segment:
    case Core::Box:
    case Core::Cylinder:
    case Core::Cone:
    case Core::Ellipsoid:
    case Core::Points:
      return false;
  }
  return false;
}

namespace support {

/// Lemma: if the squares of the components across the axis underflow, dropping them costs less than
/// 1e-50 of the direction's length, far below the rounding of a support evaluation.
inline double across(const Eigen::Vector3d& d) {
  return std::sqrt(d.x() * d.x() + d.y() * d.y());
}

inline Eigen::Vector3d box(const Eigen::Vector3d& half, const Eigen::Vector3d& d) {
  return {std::copysign(half.x(), d.x()), std::copysign(half.y(), d.y()),
          std::copysign(half.z(), d.z())};
}

inline Eigen::Vector3d cylinder(const Eigen::Vector3d& size, const Eigen::Vector3d& d) {
  const double z = std::copysign(size.z(), d.z());
  const double length = across(d);
  if (!(length > 0.0)) return {0.0, 0.0, z};
  const double scale = size.x() / length;
  return {scale * d.x(), scale * d.y(), z};
}

inline Eigen::Vector3d cone(const Eigen::Vector3d& size, const Eigen::Vector3d& d) {
  const double length = across(d);
  if (2.0 * size.z() * d.z() > size.x() * length) return {0.0, 0.0, size.z()};
  if (!(length > 0.0)) return {0.0, 0.0, -size.z()};
  const double scale = size.x() / length;
  return {scale * d.x(), scale * d.y(), -size.z()};
}

/// The gradient of the support function |S d| - inset |d|, S = diag(semiAxes).
inline Eigen::Vector3d ellipsoid(const Eigen::Vector3d& semiAxes, double inset,
                                 const Eigen::Vector3d& d) {
  const Eigen::Vector3d stretched = semiAxes.cwiseProduct(d);
  const double squared = stretched.squaredNorm();
  if (squared > 1e-280) {
    Eigen::Vector3d onSurface = semiAxes.cwiseProduct(stretched) * (1.0 / std::sqrt(squared));
    if (!(inset > 0.0)) return onSurface;
    return onSurface - (inset / std::sqrt(d.squaredNorm())) * d;
  }
  // Scaled by the largest component, so that no square leaves the range of doubles.
  const double most = stretched.cwiseAbs().maxCoeff();
  if (!(most > 0.0)) return Eigen::Vector3d::Zero();
  return semiAxes.cwiseProduct((stretched / most).normalized()) - inset * d.stableNormalized();
}

Eigen::Vector3d ofPoints(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& d);

}  // namespace support

inline Eigen::Vector3d Convex::support(const Eigen::Vector3d& direction) const {
  switch (core) {
    case Core::Point:
      return Eigen::Vector3d::Zero();
    case Core::Segment:
      return {0.0, 0.0, std::copysign(size.z(), direction.z())};
    case Core::Box:
      return support::box(size, direction);
    case Core::Cylinder:
      return support::cylinder(size, direction);
    case Core::Cone:
      return support::cone(size, direction);
    case Core::Ellipsoid:
      return support::ellipsoid(size, inset, direction);
    case Core::Points:
      return vertices != nullptr ? vertices->farthest(direction)
                                 : support::ofPoints(points, direction);
    case Core::Plane:
    case Core::HalfSpace:
      return offset * size;
  }
  return Eigen::Vector3d::Zero();
}

[[gnu::always_inline]] inline Convex Convex::of(const Sphere& sphere) {
  Convex convex;
  convex.core = Core::Point;
  convex.radius = sphere.radius;
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Box& box) {
  Convex convex;
  convex.core = Core::Box;
  convex.size = box.halfExtents;
  convex.extent = box.halfExtents.sum();  // at least the norm, and cheaper
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Cylinder& cylinder) {
  Convex convex;
  convex.core = Core::Cylinder;
  convex.size = {cylinder.radius, 0.0, cylinder.halfLength};
  convex.extent = cylinder.radius + cylinder.halfLength;
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Capsule& capsule) {
  Convex convex;
  convex.core = Core::Segment;
  convex.size = {0.0, 0.0, capsule.halfLength};
  convex.radius = capsule.radius;
  convex.extent = capsule.halfLength;
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Cone& cone) {
  Convex convex;
  convex.core = Core::Cone;
  convex.size = {cone.radius, 0.0, cone.halfLength};
  convex.extent = cone.radius + cone.halfLength;
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Ellipsoid& ellipsoid) {
  Convex convex;
  convex.core = Core::Ellipsoid;
  convex.size = ellipsoid.semiAxes;
  convex.extent = ellipsoid.semiAxes.maxCoeff();
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Plane& plane) {
  Convex convex;
  convex.core = Core::Plane;
  convex.size = plane.normal;
  convex.offset = plane.offset;
  convex.extent = std::abs(plane.offset);
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const HalfSpace& halfSpace) {
  Convex convex = of(Plane{halfSpace.normal, halfSpace.offset});
  convex.core = Core::HalfSpace;
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const ConvexHull& hull) {
  Convex convex;
  convex.core = Core::Points;
  convex.points = hull.vertices();
  convex.vertices = &hull.supportPoints();
  convex.extent = hull.extent();
  convex.error = convex.omitted = hull.error();
  return convex;
}

inline Convex Convex::ofPoints(std::span<const Eigen::Vector3d> points) {
  Convex convex;
  convex.core = Core::Points;
  convex.points = points;
  // At least the norm, cheaper, and correct at any scale.
  for (const Eigen::Vector3d& p : points) {
    convex.extent = std::max(convex.extent, p.cwiseAbs().sum());
  }
  return convex;
}

[[gnu::always_inline]] inline Convex Convex::of(const Triangle& triangle) {
  return ofPoints(triangle.corners);
}

}  // namespace swept::detail
