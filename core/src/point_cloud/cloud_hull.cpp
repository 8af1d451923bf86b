// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/cloud_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/spread_directions.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Directions along which the farthest points are kept.
constexpr int kDirections = 48;

std::vector<Vector3d> farthestPoints(std::span<const Vector3d> points, const CloudTree& tree) {
  std::vector<std::size_t> found;
  for (int i = 0; i < kDirections; ++i) {
    found.push_back(tree.farthest(spreadDirection(i, kDirections)));
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<Vector3d> kept;
  for (const std::size_t point : found) kept.push_back(points[point]);
  return kept;
}

/// Corners of an octahedron (m, from its middle to a corner) around each point.
std::vector<Vector3d> thickened(const std::vector<Vector3d>& points, double thickness) {
  if (!(thickness > 0.0)) return points;
  std::vector<Vector3d> corners;
  for (const Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      corners.push_back(p + thickness * Vector3d::Unit(axis));
      corners.push_back(p - thickness * Vector3d::Unit(axis));
    }
  }
  return corners;
}

Vector3d meanOf(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p / static_cast<double>(points.size());
  return sum;
}

/// The factor by which the hull must be scaled about `middle` to contain all points; infinite if
/// `middle` is not well inside.
///
/// Lemma: a point beyond no plane of the scaled hull is in it. Scaling moves the plane of a face by
/// that share of its distance from the middle. Normals of unit length, planes and supports round by
/// some epsilons of the coordinates; 1e-14 of the extent is more than that.
double growth(const ConvexHull& hull, const Vector3d& middle, const CloudTree& tree) {
  double most = 0.0;
  for (const Eigen::Vector3i& face : hull.faces()) {
    const Vector3d& corner = hull.vertices()[face[0]];
    const Vector3d across =
        (hull.vertices()[face[1]] - corner).cross(hull.vertices()[face[2]] - corner);
    const Vector3d normal = across / across.norm();
    const double inside = normal.dot(corner - middle);
    const double beyond = tree.support(normal) - normal.dot(corner) + 1e-14 * hull.extent();
    const double share = beyond / inside;
    if (!(inside > 0.0 && std::isfinite(share))) return std::numeric_limits<double>::infinity();
    most = std::max(most, share);
  }
  return most;
}

ConvexHull scaledAbout(const ConvexHull& hull, const Vector3d& middle, double factor) {
  std::vector<Vector3d> vertices;
  for (const Vector3d& vertex : hull.vertices()) {
    vertices.push_back(middle + factor * (vertex - middle));
  }
  return ConvexHull::of(vertices);
}

}  // namespace

ConvexHull cloudHull(std::span<const Vector3d> points, const CloudTree& tree) {
  if (points.size() <= ConvexHull::kFew) return ConvexHull::of(points);
  const std::vector<Vector3d> kept = farthestPoints(points, tree);
  const double size = (tree.bounds().upper - tree.bounds().lower).maxCoeff();
  // Flat sets, and needles, have a hull that can be scaled only if their points are thickened.
  for (const double thickness : {0.0, 1e-6, 1e-3}) {
    const ConvexHull hull = ConvexHull::of(thickened(kept, thickness * size));
    if (hull.faces().empty()) continue;
    const Vector3d middle = meanOf(hull.vertices());
    const double share = growth(hull, middle, tree);
    if (share < 0.5) return scaledAbout(hull, middle, 1.0 + share + 1e-12);
  }
  return ConvexHull::of(cornersOf(tree.bounds()));
}

}  // namespace swept::detail
