// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/segment_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

#include "bvh/any_near.hpp"
#include "geometry/error_model.hpp"
#include "narrowphase/convex_pair.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

namespace {

using detail::anyNear;
using detail::kSegmentRounding;
using Eigen::Vector3d;

Vector3d nearestOnEdge(const Vector3d& p, const Vector3d& from, const Vector3d& edge) {
  const double length = edge.squaredNorm();
  const double along = length > 0.0 ? (p - from).dot(edge) / length : 0.0;
  return from + std::clamp(along, 0.0, 1.0) * edge;
}

using Corners = std::array<Vector3d, 3>;

/// By the regions of corners, edges and face (Ericson 2005, section 5.1.5). closestPointOn() in
/// point_triangle.hpp proves its distance or gives up. Here the point need not be the nearest, as
/// for a triangle without an area: it belongs to the triangle in any case, and the first region
/// that contains it ends the search.
Vector3d nearestOn(const Corners& corners, const Vector3d& p) {
  const auto& [a, b, c] = corners;
  const Vector3d e = b - a;
  const Vector3d f = c - a;
  const Vector3d toA = p - a;
  const double d1 = e.dot(toA);
  const double d2 = f.dot(toA);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double ef = e.dot(f);
  const double d3 = d1 - e.squaredNorm();  // e . (p - b)
  const double d4 = d2 - ef;               // f . (p - b)
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double d5 = d1 - ef;               // e . (p - c)
  const double d6 = d2 - f.squaredNorm();  // f . (p - c)
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double areaC = d1 * d4 - d3 * d2;
  if (areaC <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return nearestOnEdge(p, a, e);
  const double areaB = d5 * d2 - d1 * d6;
  if (areaB <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return nearestOnEdge(p, a, f);
  const double areaA = d3 * d6 - d5 * d4;
  const double area = areaA + areaB + areaC;
  if (areaA <= 0.0 || !(area > 0.0)) return nearestOnEdge(p, b, c - b);
  return a + (std::clamp(areaB / area, 0.0, 1.0) * e + std::clamp(areaC / area, 0.0, 1.0) * f);
}

/// Alternating projections (Cheney, Goldstein 1959): the point of the segment nearest to a point of
/// the triangle and vice versa. Lemma: for the direction n between any two points, the distance of
/// the segment from the triangle is at least n . (center - corner) - |n . half| over |n|, at the
/// corner where that is least.
bool isTriangleFarther(const Corners& corners, const LineSegment& segment, double radius) {
  constexpr int kMostRounds = 4;
  const double squaredLength = segment.half.squaredNorm();
  double size = segment.center.lpNorm<1>() + segment.half.lpNorm<1>() + radius;
  for (const Vector3d& corner : corners) size = std::max(size, corner.lpNorm<1>());
  const double beyond = radius + 2.0 * kSegmentRounding * size;
  Vector3d p = segment.center;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vector3d q = nearestOn(corners, p);
    const Vector3d n = p - q;
    const double length = n.norm();
    if (!(length > radius)) return false;
    const double least =
        std::min({n.dot(segment.center - corners[0]), n.dot(segment.center - corners[1]),
                  n.dot(segment.center - corners[2])});
    if (least - std::abs(n.dot(segment.half)) > beyond * length) return true;
    if (!(squaredLength > 0.0)) break;
    const double along = (q - segment.center).dot(segment.half) / squaredLength;
    p = segment.center + std::clamp(along, -1.0, 1.0) * segment.half;
  }
  // Slivers, and edges that the segment passes at a small angle.
  const Vector3d from = segment.center - segment.half;
  const Vector3d to = segment.center + segment.half;
  return triangleDistance(corners, {from, to, to}, beyond).lower > beyond;
}

Corners cornersOf(const TriangleMesh& mesh, int triangle) {
  const TriangleMesh::Triangle& corner = mesh.triangles()[static_cast<std::size_t>(triangle)];
  return {mesh.vertices()[corner[0]], mesh.vertices()[corner[1]], mesh.vertices()[corner[2]]};
}

bool isFinite(const LineSegment& segment, double radius) {
  return segment.center.allFinite() && segment.half.allFinite() && std::isfinite(radius);
}

}  // namespace

bool isFarther(const TriangleMesh& mesh, const LineSegment& segment, double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return isFarther(mesh, segment, radius); });
  }
  if (!isFinite(segment, radius)) return false;
  return !anyNear(mesh.bvh(), segment, radius, [&](int triangle) {
    return !isTriangleFarther(cornersOf(mesh, triangle), segment, radius);
  });
}

/// Lemma: the parameter of the nearest point of the segment is off by a few roundings of |y| /
/// |half|, which changes the distance by far less than the roundings of y itself.
bool isFarther(const PointCloud& cloud, const LineSegment& segment, double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return isFarther(cloud, segment, radius); });
  }
  if (!isFinite(segment, radius)) return false;
  const double squaredLength = segment.half.squaredNorm();
  const double inverse = squaredLength > 0.0 ? 1.0 / squaredLength : 0.0;
  const double size = segment.center.lpNorm<1>() + segment.half.lpNorm<1>();
  return !anyNear(cloud.bvh(), segment, radius, [&](int index) {
    const Vector3d& point = cloud.points()[static_cast<std::size_t>(index)];
    const double grown = radius + cloud.radius(static_cast<std::size_t>(index));
    const Vector3d y = segment.center - point;
    const double along = std::clamp(-y.dot(segment.half) * inverse, -1.0, 1.0);
    const double most = grown + kSegmentRounding * (size + point.lpNorm<1>() + radius);
    return !((y + along * segment.half).squaredNorm() > most * most);
  });
}

namespace {

/// About the segment's middle, so that its ends round little.
bool isConvexFarther(const detail::Convex& body, const LineSegment& segment, double radius) {
  const std::array<Vector3d, 2> ends{-segment.half, segment.half};
  Eigen::Isometry3d body_from_segment = Eigen::Isometry3d::Identity();
  body_from_segment.translation() = segment.center;
  const detail::GjkResult found = detail::convexPair(
      body, detail::Convex::ofPoints(ends), body_from_segment, Vector3d::Zero(),
      detail::Goal(radius), 0.0, tolerance::kDistance, detail::GjkMode::BoundOnly);
  return found.satisfied && found.lower > radius;
}

}  // namespace

bool isBodyFarther(const Shape& body, const LineSegment& segment, double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return isBodyFarther(body, segment, radius); });
  }
  if (!isFinite(segment, radius)) return false;
  return std::visit(
      [&](const auto& own) {
        using Body = std::decay_t<decltype(own)>;
        if constexpr (std::is_same_v<Body, TriangleMesh>)
          return isFarther(own, segment, radius) && !own.encloses(segment.center);
        else if constexpr (std::is_same_v<Body, PointCloud>)
          return isFarther(own, segment, radius);
        else
          return isConvexFarther(detail::Convex::of(own), segment, radius);
      },
      body);
}

std::optional<Vector3d> pointWithin(const TriangleMesh& mesh, const Vector3d& point,
                                    double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return pointWithin(mesh, point, radius); });
  }
  std::optional<Vector3d> found;
  if (!isFinite({point}, radius)) return found;
  anyNear(mesh.bvh(), {point}, radius, [&](int triangle) {
    const Vector3d nearest = nearestOn(cornersOf(mesh, triangle), point);
    if ((point - nearest).squaredNorm() <= radius * radius) found = nearest;
    return found.has_value();
  });
  return found;
}

std::optional<Vector3d> pointWithin(const PointCloud& cloud, const Vector3d& point, double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return pointWithin(cloud, point, radius); });
  }
  std::optional<Vector3d> found;
  if (!isFinite({point}, radius)) return found;
  anyNear(cloud.bvh(), {point}, radius, [&](int index) {
    const Vector3d& center = cloud.points()[static_cast<std::size_t>(index)];
    const double own = cloud.radius(static_cast<std::size_t>(index));
    const Vector3d off = point - center;
    const double distance = off.norm();
    if (!(distance <= radius + own)) return false;
    found = distance <= own ? point : Vector3d(center + own / distance * off);
    return true;
  });
  return found;
}

}  // namespace swept
