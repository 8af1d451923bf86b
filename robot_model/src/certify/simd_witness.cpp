// SPDX-License-Identifier: BSD-3-Clause
#include "certify/simd_witness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "swept/core/distance.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// m, model frame: the point of the geometry nearest to this one, which is itself if it is in the
/// geometry. NaN if no distance is known.
Vector3d nearestOf(const CheckerModel& model, PairQuery& query, int geometry,
                   const Vector3d& point) {
  const Eigen::Isometry3d point_from_world(Eigen::Translation3d(-point));
  const DistanceResult found = distance(Sphere{0.0}, model.robotGeometry[geometry].shape,
                                        point_from_world * query.pose(geometry));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(found.upper)) return Vector3d::Constant(kNone);
  return found.upper > 0.0 ? Vector3d(point + found.pointB) : point;
}

/// Whether a ball that is proven to be inside the geometry contains the point (m, model frame).
bool isInInnerBall(const CheckerModel& model, PairQuery& query, int geometry,
                   const Vector3d& point) {
  const std::shared_ptr<const SphereCover>& cover = model.robotGeometry[geometry].cover;
  if (cover == nullptr) return false;
  const Eigen::Isometry3d& world_from_shape = query.pose(geometry);
  const Vector3d local =
      world_from_shape.linear().transpose() * (point - world_from_shape.translation());
  const auto holds = [&local](const CoverBall& ball, float radius) {
    const auto inside = static_cast<double>(radius);
    return inside > 0.0 && (ball.center.cast<double>() - local).squaredNorm() <= inside * inside;
  };
  return std::ranges::any_of(cover->inner,
                             [&](const CoverBall& ball) { return holds(ball, ball.radius); }) ||
         std::ranges::any_of(cover->nodes, [&](const SphereCover::Node& node) {
           return holds(node.ball, node.inside);
         });
}

/// The single-precision point is in both links, or in one and by a rounding off the surface of the
/// other. So the point of either that is nearest to it may be in the other.
std::optional<ContactPoints> pointsOfLinks(const CheckerModel& model, PairQuery& query,
                                           const GeometryPair& pair, const Vector3d& point) {
  const auto near = [&pair](const ContactPoints& points) {
    return (points.b - points.a).norm() <= pair.margin;
  };
  if (isInInnerBall(model, query, pair.a, point) && isInInnerBall(model, query, pair.b, point))
    return ContactPoints{point, point};
  ContactPoints points;
  points.a = nearestOf(model, query, pair.a, point);
  points.b = nearestOf(model, query, pair.b, points.a);
  if (near(points)) return points;
  points.a = nearestOf(model, query, pair.a, points.b);
  if (near(points)) return points;
  return std::nullopt;
}

}  // namespace

std::optional<ContactPoints> contactPoints(const CheckerModel& model, PairQuery& query,
                                           const GeometryPair& pair, const SimdContact& contact) {
  const Vector3d point(contact.point[0], contact.point[1], contact.point[2]);
  if (pair.self) return pointsOfLinks(model, query, pair, point);
  // The link holds everything within `inside` of the point, whatever rounding there was.
  const WorldGeometry& world = model.worldGeometry[pair.b];
  DistanceOptions options;
  options.contact = static_cast<double>(contact.inside);
  const Eigen::Isometry3d point_from_world(Eigen::Translation3d(-point));
  const DistanceResult found =
      distance(Sphere{0.0}, world.shape, point_from_world * world.world_from_shape, options);
  if (!(found.upper <= options.contact)) return std::nullopt;
  const Vector3d common = found.upper > 0.0 ? Vector3d(point + found.pointB) : point;
  return ContactPoints{common, common};
}

std::optional<Witness> pointWitness(const CheckerModel& model, std::uint32_t index,
                                    const Eigen::Vector3d& point, double t) {
  const GeometryPair& pair = model.pair(index);
  const WorldGeometry& world = model.worldGeometry[pair.b];
  const Eigen::Isometry3d point_from_world(Eigen::Translation3d(-point));
  DistanceOptions options;
  options.contact = pair.margin;
  const DistanceResult found =
      distance(Sphere{0.0}, world.shape, point_from_world * world.world_from_shape, options);
  if (!(found.upper <= pair.margin)) return std::nullopt;
  Witness witness;
  witness.t = t;
  witness.bodyA = model.nameOfA(pair);
  witness.bodyB = model.nameOfB(pair);
  witness.selfPair = model.isSelfPair(pair);
  witness.pointA = point;
  witness.pointB = point + found.pointB;
  witness.distance = found.upper;
  witness.margin = pair.margin;
  return witness;
}

std::optional<Witness> simdWitness(const CheckerModel& model, PairQuery& query,
                                   const GeometryPair& pair, const SimdContact& contact, double t) {
  const std::optional<ContactPoints> points = contactPoints(model, query, pair, contact);
  if (!points) return std::nullopt;
  Witness witness;
  witness.t = t;
  witness.bodyA = model.nameOfA(pair);
  witness.bodyB = model.nameOfB(pair);
  witness.selfPair = model.isSelfPair(pair);
  witness.pointA = points->a;
  witness.pointB = points->b;
  witness.distance = (points->b - points->a).norm();
  witness.margin = pair.margin;
  return witness;
}

}  // namespace swept::detail
