// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/solid_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cover/nearest.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {

namespace {

// If no triangle reaches into a ball, the ball is wholly inside exactly if its centre is: winding
// numbers and parities change only at triangles.
double meshDepth(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  if (!mesh.encloses(point)) return 0.0;
  const detail::Nearest nearest(mesh.vertices(), mesh.triangles(), mesh.bvh());
  const detail::Nearest::Found found = nearest.find(point, std::numeric_limits<double>::infinity());
  if (!std::isfinite(found.squared)) return 0.0;  // overflowing squares find nothing
  return std::sqrt(found.squared) * (1.0 - 1e-15) - nearest.error(point);
}

}  // namespace

double solidDepth(const Shape& shape, const Eigen::Vector3d& point) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return solidDepth(shape, point); });
  }
  if (!point.allFinite()) return 0.0;
  double depth = 0.0;
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    depth = meshDepth(*mesh, point);
  } else {
    const Eigen::Isometry3d point_from_shape(Eigen::Translation3d(-point));
    depth = -signedDistance(Sphere{0.0}, shape, point_from_shape).upper;
  }
  return depth > 0.0 ? depth : 0.0;
}

}  // namespace swept
