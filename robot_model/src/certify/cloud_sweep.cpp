// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "certify/pair_query.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/cloud_parts.hpp"
#include "swept/core/segment_query.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Balls that are tested for one part of a link. A test costs about as much as one of a cover's
/// ball against the cloud; what is left costs the exact tier a hundred times that.
constexpr int kMostTests = 384;
/// Times that an interval is halved.
constexpr int kMostHalvings = 6;

/// Of one part of the motion, in the frame of the link's shape at its middle.
struct PassingBalls {
  Isometry3d shape_from_cloud;
  Vector3d linear;    ///< m, half the way of the frame's origin
  Vector3d angular;   ///< rad, half the turn
  double fixed;       ///< m: what the pair keeps, how its path is curved, rounding
  double spin;        ///< rad
  double translated;  ///< m, 1-norm of shape_from_cloud's translation

  /// How a resting ball passes the link.
  struct Pass {
    LineSegment path;
    double room;  ///< m, between ball and path, besides the ball's radius
  };
  /// Lemma: let p rest, q be a point of the link at the middle m, v and w its velocity field's
  /// value at p and its angular velocity, and abs(s) <= h. By L1 q(m + s) is within A h^2 / 2 of q
  /// + s v(q), and v(q) = v + w x (q - p). With y = p - s v and z = y - q,
  ///   p - q - s v(q) = z + s w x z + s^2 w x v.
  /// As w x z is perpendicular to z, the distance of p from q(m + s) is at least that of y from q,
  /// less h^2 abs(w) abs(v) + A h^2 / 2. All y are on the segment p +- h v.
  Pass of(const Vector3d& center) const {
    Pass pass;
    pass.path.center = shape_from_cloud * center;
    pass.path.half = linear + angular.cross(pass.path.center);
    const double way = pass.path.half.norm();
    const double size = 2.0 * center.lpNorm<1>() + translated + linear.lpNorm<1>() + way;
    pass.room =
        (fixed + spin * way) * (1.0 + kVelocityRounding) + 4.0 * tolerance::kSupportRounding * size;
    return pass;
  }
};

}  // namespace

bool PairQuery::staysApartFrom(const CloudPatch& patch, double t, double half) {
  const GeometryPair& pair = model_.pair(patch.pair);
  const auto* cloud = std::get_if<PointCloud>(&shapeOfB(pair));
  if (cloud == nullptr || pair.self || inTube_) return false;
  const Isometry3d cloud_from_world = poseOfB(pair).inverse();
  const LineSegment near{cloud_from_world * patch.path.center,
                         cloud_from_world.linear() * patch.path.half};
  std::vector<CloudPart>& parts = workspace_.cloudParts;
  parts.clear();
  addPartsNear(*cloud, 0, near, patch.radius, parts);
  int tests = kMostTests;
  return passes(pair, *cloud, near, patch.radius, t, half, 0, kMostHalvings, tests);
}

/// The parts from `first` on, on [t - half, t + half]. Leaves them as they were.
bool PairQuery::passes(const GeometryPair& pair, const PointCloud& cloud, const LineSegment& near,
                       double radius, double t, double half, std::size_t first, int halvings,
                       int& tests) {
  std::vector<CloudPart>& parts = workspace_.cloudParts;
  moveTo(t, half);
  const Shape& link = model_.robotGeometry[static_cast<std::size_t>(pair.a)].shape;
  const Isometry3d& world_from_shape = pose(pair.a);
  const BodyState& own = state(model_.robotGeometry[static_cast<std::size_t>(pair.a)].body);
  const ApproachBound bound = approach(pair, half, pair.margin);
  PassingBalls passing;
  passing.shape_from_cloud = world_from_shape.inverse() * poseOfB(pair);
  const Eigen::Matrix3d shape_from_world = world_from_shape.linear().transpose();
  passing.angular = shape_from_world * (half * own.angular);
  passing.linear =
      shape_from_world * (half * (own.linear + own.angular.cross(world_from_shape.translation())));
  passing.fixed = bound.required + bound.curvature;
  passing.spin = passing.angular.norm();
  passing.translated = passing.shape_from_cloud.translation().lpNorm<1>();

  const std::size_t last = parts.size();
  std::vector<CloudPart>& waiting = workspace_.waitingParts;
  const std::size_t bottom = waiting.size();
  waiting.insert(waiting.end(), parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end());
  const auto giveUp = [&] {
    waiting.resize(bottom);
    parts.resize(last);
    return false;
  };
  while (waiting.size() > bottom) {
    const CloudPart part = waiting.back();
    waiting.pop_back();
    // Larger than the patch, and so than what the link leaves free: hardly ever apart.
    if (!part.isBall() && part.radius > radius) {
      addPartsNear(cloud, part.node, near, radius, waiting);
      continue;
    }
    if (--tests < 0) return giveUp();
    const PassingBalls::Pass way = passing.of(part.center);
    if (isBodyFarther(link, way.path, part.radius + way.room)) continue;
    if (!part.isBall() && part.radius > way.room) {
      addPartsNear(cloud, part.node, near, radius, waiting);
      continue;
    }
    // Shorter intervals do not help where the ball is too near at the middle.
    if (halvings == 0 ||
        (part.isBall() && !isBodyFarther(link, {way.path.center}, part.radius + bound.required)))
      return giveUp();
    parts.push_back(part);  // behind `last`: parts that only shorter intervals can prove
  }
  bool proven = true;
  if (parts.size() > last) {
    const double quarter = 0.5 * half;
    proven = passes(pair, cloud, near, radius, t - quarter, quarter, last, halvings - 1, tests) &&
             passes(pair, cloud, near, radius, t + quarter, quarter, last, halvings - 1, tests);
  }
  parts.resize(last);
  return proven;
}

}  // namespace swept::detail
