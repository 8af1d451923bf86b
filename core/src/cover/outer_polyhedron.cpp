// SPDX-License-Identifier: BSD-3-Clause
#include "cover/outer_polyhedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "swept/core/bv/aabb.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

/// Covers the rounding of sines, products and square roots below, a few epsilons each.
constexpr double kRoundUp = 1.0 + 4e-12;

constexpr int kSides = 48;

/// Corners of a regular polygon around the unit circle.
std::vector<Eigen::Vector2d> outerCircle() {
  const double radius = kRoundUp / std::cos(std::numbers::pi / kSides);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return corners;
}
double circleSlack() {
  return kRoundUp / std::cos(std::numbers::pi / kSides) - 1.0 + 1e-12;
}

/// Points whose hull contains the unit ball: the grid points of an octahedron's faces, pushed out
/// to one radius. A polyhedron around the centre contains the ball that touches the nearest plane
/// of its faces.
struct OuterBall {
  std::vector<Vector3d> points;
  double slack = 0.0;
};
OuterBall outerBall() {
  constexpr int kGrid = 14;
  OuterBall ball;
  for (int i = -kGrid; i <= kGrid; ++i) {
    const int rest = kGrid - std::abs(i);
    for (int j = -rest; j <= rest; ++j) {
      const int k = rest - std::abs(j);
      ball.points.push_back(Vector3d(i, j, k).normalized());
      if (k > 0) ball.points.push_back(Vector3d(i, j, -k).normalized());
    }
  }
  const ConvexHull hull = ConvexHull::of(ball.points);
  double nearest = 1.0;
  for (const Eigen::Vector3i& face : hull.faces()) {
    const Vector3d& corner = hull.vertices()[face[0]];
    const Vector3d normal =
        (hull.vertices()[face[1]] - corner).cross(hull.vertices()[face[2]] - corner).normalized();
    nearest = std::min(nearest, normal.dot(corner));
  }
  const double radius = kRoundUp / nearest;
  for (Vector3d& point : ball.points) point *= radius;
  ball.slack = radius - 1.0 + 1e-12;
  return ball;
}

}  // namespace

OuterPoints outerPoints(const Box& box) {
  OuterPoints outer;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    outer.points.push_back(sign.cwiseProduct(box.halfExtents));
  }
  return outer;
}

OuterPoints outerPoints(const Cylinder& cylinder) {
  OuterPoints outer{{}, cylinder.radius * circleSlack()};
  for (const Eigen::Vector2d& corner : outerCircle()) {
    const Eigen::Vector2d xy = cylinder.radius * corner;
    outer.points.emplace_back(xy.x(), xy.y(), cylinder.halfLength);
    outer.points.emplace_back(xy.x(), xy.y(), -cylinder.halfLength);
  }
  return outer;
}

OuterPoints outerPoints(const Cone& cone) {
  OuterPoints outer{{}, cone.radius * circleSlack()};
  outer.points.emplace_back(0.0, 0.0, cone.halfLength);
  for (const Eigen::Vector2d& corner : outerCircle()) {
    const Eigen::Vector2d xy = cone.radius * corner;
    outer.points.emplace_back(xy.x(), xy.y(), -cone.halfLength);
  }
  return outer;
}

OuterPoints outerPoints(const Capsule& capsule) {
  const OuterBall ball = outerBall();
  OuterPoints outer{{}, capsule.radius * ball.slack};
  for (const Vector3d& point : ball.points) {
    Vector3d end = capsule.radius * point;
    // Points of the equator belong to both caps.
    for (const double side : {1.0, -1.0}) {
      if (side * end.z() < 0.0) continue;
      outer.points.emplace_back(end.x(), end.y(), end.z() + side * capsule.halfLength);
    }
  }
  return outer;
}

OuterPoints outerPoints(const Ellipsoid& ellipsoid) {
  const OuterBall ball = outerBall();
  OuterPoints outer{{}, ellipsoid.semiAxes.maxCoeff() * ball.slack};
  for (const Vector3d& point : ball.points) {
    outer.points.push_back(ellipsoid.semiAxes.cwiseProduct(point));
  }
  return outer;
}

OuterPoints outerPoints(const Triangle& triangle) {
  return {{triangle.corners.begin(), triangle.corners.end()}, 0.0};
}

ThickHull thickHull(const ConvexHull& hull) {
  if (!hull.faces().empty()) return {hull, 0.0};
  // Thick enough for rounding to leave a volume, too thin to matter.
  constexpr double kOfSize = 1e-6;
  constexpr double kOfCoordinates = 1e-9;
  const auto [lower, upper] = Aabb::fit(hull.vertices());
  const double size = (upper - lower).maxCoeff();
  if (!(size > 0.0)) return {hull, 0.0};
  const double thickness = std::max(kOfSize * size, kOfCoordinates * hull.extent());
  std::vector<Vector3d> points;
  for (const Vector3d& vertex : hull.vertices()) {
    for (int axis = 0; axis < 3; ++axis) {
      points.push_back(vertex + thickness * Vector3d::Unit(axis));
      points.push_back(vertex - thickness * Vector3d::Unit(axis));
    }
  }
  return {ConvexHull::of(points), thickness * kRoundUp};
}

}  // namespace swept::detail
