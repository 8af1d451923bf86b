// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/convex_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Cap on the number of points times planes tested for one component.
constexpr std::size_t kMostWork = 20'000'000;

/// Six times the volume that outward-oriented triangles enclose.
template <typename Triangles>
double sixVolumes(const Triangles& triangles, std::span<const Vector3d> points,
                  const Vector3d& origin) {
  double sum = 0.0;
  for (const Vector3i& t : triangles) {
    sum += (points[t[0]] - origin).cross(points[t[1]] - origin).dot(points[t[2]] - origin);
  }
  return sum;
}

/// No vertex of the hull is ahead of the plane of any triangle (or none is behind it).
bool allSupport(std::span<const Vector3i> triangles, std::span<const Vector3d> vertices,
                const ConvexHull& hull, double slack) {
  for (const Vector3i& t : triangles) {
    const Vector3d& a = vertices[t[0]];
    const Vector3d normal = (vertices[t[1]] - a).cross(vertices[t[2]] - a);
    const double length = normal.norm();
    if (!(length > 0.0)) continue;
    double ahead = 0.0;
    double behind = 0.0;
    for (const Vector3d& p : hull.vertices()) {
      const double height = normal.dot(p - a);
      ahead = std::max(ahead, height);
      behind = std::max(behind, -height);
    }
    if (std::min(ahead, behind) > slack * length) return false;
  }
  return true;
}

/// A closed oriented surface on the boundary of its hull covers that boundary k times, and encloses
/// k times the hull's volume. If k is one, it is the boundary of a convex solid.
bool isConvex(std::span<const Vector3i> triangles, std::span<const Vector3d> vertices,
              const ConvexHull& hull) {
  if (hull.faces().empty() || triangles.size() * hull.vertices().size() > kMostWork) return false;
  const Vector3d& origin = hull.vertices().front();
  double size = 0.0;
  for (const Vector3d& p : hull.vertices()) size = std::max(size, (p - origin).norm());
  const double volume = std::abs(sixVolumes(triangles, vertices, origin));
  const double whole = sixVolumes(hull.faces(), hull.vertices(), origin);
  if (!(std::abs(volume - whole) <= 1e-6 * whole)) return false;
  return allSupport(triangles, vertices, hull, kConvexPart * size);
}

/// False if, for a few of the triangles, some corners are clearly ahead of the triangle's plane and
/// others behind it. Then isConvex() is false too, and no hull is needed. "Clearly" is a thousand
/// times the distance that allSupport() accepts, and that a hull may leave points outside.
bool mayBeConvex(std::span<const Vector3i> triangles, std::span<const Vector3d> vertices,
                 std::span<const Vector3d> corners) {
  constexpr std::size_t kLooks = 8;
  Vector3d lower = corners.front();
  Vector3d upper = lower;
  for (const Vector3d& p : corners) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double size =
      (upper - lower).norm() + upper.cwiseAbs().maxCoeff() + lower.cwiseAbs().maxCoeff();
  const double clearly = 1e3 * std::max(kConvexPart, tolerance::kHull) * size;
  for (std::size_t look = 0; look < kLooks; ++look) {
    const Vector3i& t = triangles[look * (triangles.size() - 1) / (kLooks - 1)];
    const Vector3d& a = vertices[t[0]];
    const Vector3d normal = (vertices[t[1]] - a).cross(vertices[t[2]] - a);
    const double least = clearly * normal.norm();
    if (!(least > 0.0)) continue;
    bool isAhead = false;
    bool isBehind = false;
    for (const Vector3d& p : corners) {
      const double height = normal.dot(p - a);
      isAhead = isAhead || height > least;
      isBehind = isBehind || height < -least;
    }
    if (isAhead && isBehind) return false;
  }
  return true;
}

}  // namespace

std::vector<ConvexHull> convexParts(std::span<const Vector3d> vertices,
                                    std::span<const Vector3i> triangles,
                                    std::span<const int> componentOf,
                                    const std::vector<bool>& oriented) {
  std::vector<std::vector<Vector3i>> components(oriented.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (componentOf[i] >= 0 && oriented[componentOf[i]]) {
      components[componentOf[i]].push_back(triangles[i]);
    }
  }
  std::vector<ConvexHull> parts;
  std::vector<Vector3d> corners;
  for (const std::vector<Vector3i>& component : components) {
    if (component.empty()) continue;
    corners.clear();
    for (const Vector3i& t : component) {
      for (const int corner : t) corners.push_back(vertices[corner]);
    }
    if (!mayBeConvex(component, vertices, corners)) continue;
    ConvexHull hull = ConvexHull::of(corners);
    if (isConvex(component, vertices, hull)) parts.push_back(std::move(hull));
  }
  return parts;
}

}  // namespace swept::detail
