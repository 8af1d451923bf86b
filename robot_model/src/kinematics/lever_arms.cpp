// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/lever_arms.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/nested_travels.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Bounds are computed in doubles; this covers the roundings of their few operations.
constexpr double kOutward = 1.0 + 1e-12;

/// Where a point can be while the joints beyond vary: within `radius` of an axis through the
/// frame's origin and between `low` and `high` along it, and within `ball` of the origin.
struct ReachableSet {
  Vector3d axis;
  double radius;
  double low;
  double high;
  double ball;

  void addOrigin() {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }

  void tighten() {
    ball = std::min(ball, std::hypot(radius, std::max(std::abs(low), std::abs(high))));
    radius = std::min(radius, ball);
    low = std::max(low, -ball);
    high = std::min(high, ball);
  }
};

Vector3d axisOf(const MovingBody& body) {
  return body.type == JointType::Planar ? Vector3d(body.planarBasis.col(2)) : body.axis;
}

/// The set in the parent's frame, as a set of revolution about that frame's own axis. A disc of the
/// old set with centre c is within |c across| + radius of the new axis; both coordinates are convex
/// in c, so the two end discs decide.
ReachableSet inParent(const ReachableSet& set, const Eigen::Isometry3d& parent_from_joint,
                      const Vector3d& parentAxis) {
  const Vector3d direction = parent_from_joint.linear() * set.axis;
  // Of nearly parallel axes the cosine says next to nothing.
  const double tilt = parentAxis.cross(direction).norm() * kOutward;
  ReachableSet result;
  result.axis = parentAxis;
  result.ball = parent_from_joint.translation().norm() + set.ball;
  result.radius = 0.0;
  result.low = std::numeric_limits<double>::infinity();
  result.high = -std::numeric_limits<double>::infinity();
  for (const double z : {set.low, set.high}) {
    const Vector3d center = parent_from_joint.translation() + z * direction;
    const double along = parentAxis.dot(center);
    result.radius = std::max(result.radius, (center - along * parentAxis).norm() + set.radius);
    result.low = std::min(result.low, along - set.radius * tilt);
    result.high = std::max(result.high, along + set.radius * tilt);
  }
  result.tighten();
  return result;
}

/// Lets the body's own joint move; the set stays in the joint frame.
void sweepByJoint(const MovingBody& body, ReachableSet& set) {
  switch (body.type) {
    case JointType::Prismatic:
      set.low += body.lower;
      set.high += body.upper;
      set.ball += std::max(std::abs(body.lower), std::abs(body.upper));
      set.tighten();
      break;
    case JointType::Floating:
      set.radius = set.ball;
      set.low = -set.ball;
      set.high = set.ball;
      break;
    default:
      break;  // a rotation about the axis of revolution changes nothing
  }
}

/// m; see LeverArms::span. The set of the points goes inwards with the frames that are passed.
double spanOf(const KinematicModel& model, int body, ReachableSet set) {
  double span = set.ball;
  double detours = 0.0;
  for (int i = body; i > 0; i = model.bodies[i].parent) {
    const MovingBody& current = model.bodies[i];
    set.addOrigin();
    sweepByJoint(current, set);
    set.addOrigin();
    span = std::max(span, set.ball);
    set = inParent(set, current.parent_from_joint, axisOf(model.bodies[current.parent]));
    span = std::max(span, set.ball);
    detours += current.fold.detour(current.parent_from_joint);
  }
  return (span + detours) * kOutward;
}

}  // namespace

LeverArms leverArms(const KinematicModel& model, int body, const Vector3d& center, double radius) {
  LeverArms result;
  const Vector3d first = axisOf(model.bodies[body]);
  const double along = first.dot(center);
  ReachableSet set{first, (center - along * first).norm(), along, along, center.norm()};
  result.span = spanOf(model, body, set) + radius;
  for (int i = body; i > 0; i = model.bodies[i].parent) {
    const MovingBody& current = model.bodies[i];
    const double arm = current.type == JointType::Floating ? set.ball : set.radius;
    result.path.push_back(i);
    result.transforms += 1.0 + current.fold.transforms;
    result.arms.push_back(arm * kOutward + radius);
    sweepByJoint(current, set);
    result.reachFromBase = set.ball * kOutward + radius;
    set = inParent(set, current.parent_from_joint, axisOf(model.bodies[current.parent]));
  }
  std::reverse(result.path.begin(), result.path.end());
  std::reverse(result.arms.begin(), result.arms.end());
  return result;
}

TravelBound travelBound(const KinematicModel& model, const LeverArms& levers, std::size_t first,
                        std::span<const JointMotion> motion) {
  // Lemma (DESIGN of a motion certificate): with joint rates r_k constant and W_k a bound on the
  // angular velocity of body k relative to the reference,
  //   p'' = sum_k r_k [ 2 w_{k-1} x dp/dq_k + r_k d2p/dq_k2 ],
  // hence |p''| <= sum_k |r_k| rho_k (2 W_{k-1} + |r_k|) for rotations and 2 |r_k| W_{k-1} for
  // translations. A joint with both translates first, then rotates about its moved origin.
  double wander = 0.0;
  for (std::size_t i = first; i < levers.path.size(); ++i) wander += motion[levers.path[i]].wander;

  TravelBound bound;
  double turning = 0.0;        // W_k
  double turningBefore = 0.0;  // W_{k-1}
  double previousRate = 0.0;
  bool previousTurns = false;
  for (std::size_t i = first; i < levers.path.size(); ++i) {
    const MovingBody& body = model.bodies[levers.path[i]];
    const JointMotion& joint = motion[levers.path[i]];
    // Planar and floating joints farther out carry the ball away from this axis.
    wander -= joint.wander;
    const double arm = levers.arms[i] + std::max(0.0, wander) * kOutward;
    bound.speed += joint.speed + joint.spinSpeed * arm;
    bound.acceleration += 2.0 * joint.speed * turning;
    bound.acceleration += joint.spinSpeed * arm * (2.0 * turning + joint.spinSpeed);

    double next = turning + joint.spinSpeed;
    const bool turnsToo = turns(body.type);
    if (turnsToo && previousTurns) {
      const double together = boundTogether(model, body, previousRate, joint.spinSpeed);
      next = std::min(next, turningBefore + together);
    }
    turningBefore = turning;
    turning = next;
    previousRate = joint.spinSpeed;
    previousTurns = turnsToo;
  }
  bound.speed *= kOutward;
  bound.acceleration *= kOutward;
  return bound;
}

}  // namespace swept::detail
