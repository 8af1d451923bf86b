// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/convex.hpp"

#include <algorithm>
#include <cmath>

namespace swept::detail {

Convex Convex::of(const Sphere& sphere) {
  Convex convex;
  convex.core = Core::Point;
  convex.radius = sphere.radius;
  return convex;
}

Convex Convex::of(const Box& box) {
  Convex convex;
  convex.core = Core::Box;
  convex.size = box.halfExtents;
  convex.extent = box.halfExtents.norm();
  return convex;
}

Convex Convex::of(const Cylinder& cylinder) {
  Convex convex;
  convex.core = Core::Cylinder;
  convex.size = {cylinder.radius, 0.0, cylinder.halfLength};
  convex.extent = std::hypot(cylinder.radius, cylinder.halfLength);
  return convex;
}

Convex Convex::of(const Capsule& capsule) {
  Convex convex;
  convex.core = Core::Segment;
  convex.size = {0.0, 0.0, capsule.halfLength};
  convex.radius = capsule.radius;
  convex.extent = capsule.halfLength;
  return convex;
}

Convex Convex::of(const ConvexHull& hull) {
  Convex convex;
  convex.core = Core::Points;
  convex.points = hull.vertices();
  convex.extent = hull.extent();
  convex.error = hull.error();
  return convex;
}

Convex Convex::ofPoints(std::span<const Eigen::Vector3d> points) {
  Convex convex;
  convex.core = Core::Points;
  convex.points = points;
  double squared = 0.0;
  for (const Eigen::Vector3d& p : points) squared = std::max(squared, p.squaredNorm());
  convex.extent = std::sqrt(squared);
  return convex;
}

namespace {

Eigen::Vector3d farthest(std::span<const Eigen::Vector3d> points,
                         const Eigen::Vector3d& direction) {
  std::size_t best = 0;
  double most = points[0].dot(direction);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double along = points[i].dot(direction);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return points[best];
}

}  // namespace

Eigen::Vector3d Convex::support(const Eigen::Vector3d& direction) const {
  switch (core) {
    case Core::Point:
      return Eigen::Vector3d::Zero();
    case Core::Segment:
      return {0.0, 0.0, std::copysign(size.z(), direction.z())};
    case Core::Box:
      return {std::copysign(size.x(), direction.x()), std::copysign(size.y(), direction.y()),
              std::copysign(size.z(), direction.z())};
    case Core::Cylinder: {
      const double z = std::copysign(size.z(), direction.z());
      const double across = std::hypot(direction.x(), direction.y());
      if (!(across > 0.0)) return {0.0, 0.0, z};
      return {size.x() * (direction.x() / across), size.x() * (direction.y() / across), z};
    }
    case Core::Points:
      return farthest(points, direction);
  }
  return Eigen::Vector3d::Zero();
}

}  // namespace swept::detail
