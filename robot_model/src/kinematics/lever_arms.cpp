// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/lever_arms.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/nested_motion_bounds.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// The possible positions of a point while the joints beyond vary: within `radius` of an axis
/// through the frame's origin and between `low` and `high` along it, and within `ball` of the
/// origin.
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
/// old set with centre c is within |c across| + radius of the new axis. Both coordinates are convex
/// in c, so the two end discs decide.
ReachableSet inParent(const ReachableSet& set, const Eigen::Isometry3d& parent_from_joint,
                      const Vector3d& parentAxis) {
  const Vector3d direction = parent_from_joint.linear() * set.axis;
  // For nearly parallel axes the cosine has hardly any digits.
  const double tilt = parentAxis.cross(direction).norm() * kArithmeticOutward;
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

/// m, of a prismatic joint's value.
struct Range {
  double low;
  double high;
};

/// Lets the body's own joint move; the set stays in the joint frame.
void sweepByJoint(const MovingBody& body, const Range& range, ReachableSet& set) {
  switch (body.type) {
    case JointType::Prismatic:
      set.low += range.low;
      set.high += range.high;
      set.ball += std::max(std::abs(range.low), std::abs(range.high));
      set.tighten();
      break;
    case JointType::Floating:
      set.radius = set.ball;
      set.low = -set.ball;
      set.high = set.ball;
      break;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Planar:
      break;  // a rotation about the axis of revolution changes nothing
  }
}

ReachableSet setOf(const MovingBody& body, const Vector3d& center) {
  const Vector3d first = axisOf(body);
  const double along = first.dot(center);
  return {first, (center - along * first).norm(), along, along, center.norm()};
}

/// m; see LeverArms::span. The set of the points moves inwards with the frames that are passed.
template <typename RangeOf>
double spanOf(const KinematicModel& model, int body, ReachableSet set, const RangeOf& rangeOf) {
  double span = set.ball;
  double detours = 0.0;
  for (int i = body; i > 0; i = model.bodies[i].parent) {
    const MovingBody& current = model.bodies[i];
    set.addOrigin();
    sweepByJoint(current, rangeOf(i), set);
    set.addOrigin();
    span = std::max(span, set.ball);
    set = inParent(set, current.parent_from_joint, axisOf(model.bodies[current.parent]));
    span = std::max(span, set.ball);
    detours += current.fixedChain.detour(current.parent_from_joint);
  }
  return (span + detours) * kArithmeticOutward;
}

/// Walks inwards and passes on each joint's body, the lever arm of the ball's points (m) about its
/// axis, and their largest distance (m) from the origin of its joint frame.
template <typename RangeOf, typename Visit>
void visitArms(const KinematicModel& model, int body, const Vector3d& center, double radius,
               const RangeOf& rangeOf, const Visit& visit) {
  ReachableSet set = setOf(model.bodies[body], center);
  for (int i = body; i > 0; i = model.bodies[i].parent) {
    const MovingBody& current = model.bodies[i];
    const double arm = current.type == JointType::Floating ? set.ball : set.radius;
    sweepByJoint(current, rangeOf(i), set);
    visit(i, arm * kArithmeticOutward + radius, set.ball * kArithmeticOutward + radius);
    set = inParent(set, current.parent_from_joint, axisOf(model.bodies[current.parent]));
  }
}

Range atRest(int /*body*/) {
  return {0.0, 0.0};
}

/// Lemma: a slide by s along u adds to a point s times the component of u orthogonal to an axis,
/// orthogonally to that axis. In the frame of the axis, u is in the set of its rotations by the
/// joints between the two: a vector is placed like a point, without the translations.
void addGrowths(const KinematicModel& model, int slide, std::span<const int> path,
                std::vector<RestArms::Growth>& growths) {
  ReachableSet set{axisOf(model.bodies[slide]), 0.0, 1.0, 1.0, 1.0};
  auto joint = static_cast<std::size_t>(std::ranges::find(path, slide) - path.begin());
  for (int i = slide; joint-- > 0;) {
    Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
    turned.linear() = model.bodies[i].parent_from_joint.linear();
    i = model.bodies[i].parent;
    set = inParent(set, turned, axisOf(model.bodies[i]));
    const MovingBody& body = model.bodies[i];
    const double share = body.type == JointType::Floating ? 1.0 : set.radius;
    if (turns(body.type) || slidesFreely(body.type))
      growths.push_back({joint, slide, share * kArithmeticOutward + kParallelShare});
    sweepByJoint(body, atRest(i), set);
  }
}

}  // namespace

LeverArms leverArms(const KinematicModel& model, int body, const Vector3d& center, double radius) {
  LeverArms result;
  const auto withinLimits = [&](int i) {
    const MovingBody& slide = model.bodies[i];
    return Range{slide.lower - slide.valueRounding, slide.upper + slide.valueRounding};
  };
  const ReachableSet set = setOf(model.bodies[body], center);
  result.spanAtRest = spanOf(model, body, set, atRest) + radius;
  bool slides = false;
  visitArms(model, body, center, radius, withinLimits, [&](int i, double arm, double reach) {
    const MovingBody& current = model.bodies[i];
    result.path.push_back(i);
    result.transforms += 1.0 + current.fixedChain.transforms;
    result.arms.push_back(arm);
    result.reachFromBase = reach;
    result.vary = result.vary || (slides && (turns(current.type) || slidesFreely(current.type)));
    slides = slides || current.type == JointType::Prismatic;
  });
  result.span = slides ? spanOf(model, body, set, withinLimits) + radius : result.spanAtRest;
  std::reverse(result.path.begin(), result.path.end());
  std::reverse(result.arms.begin(), result.arms.end());
  return result;
}

void motionArms(const KinematicModel& model, int body, const Vector3d& center, double radius,
                std::span<const JointMotion> motion, std::span<double> arms) {
  const auto used = [&](int i) { return Range{motion[i].low, motion[i].high}; };
  std::size_t joint = arms.size();
  visitArms(model, body, center, radius, used,
            [&](int /*i*/, double arm, double /*reach*/) { arms[--joint] = arm; });
}

std::vector<double> armsAtRest(const KinematicModel& model, int body, const Vector3d& center,
                               double radius) {
  std::vector<double> arms;
  visitArms(model, body, center, radius, atRest,
            [&](int /*i*/, double arm, double /*reach*/) { arms.push_back(arm); });
  std::reverse(arms.begin(), arms.end());
  return arms;
}

RestArms restArms(const KinematicModel& model, int body, const Vector3d& center, double radius) {
  RestArms result{armsAtRest(model, body, center, radius), {}};
  std::vector<int> path;
  for (int i = body; i > 0; i = model.bodies[i].parent) path.push_back(i);
  std::reverse(path.begin(), path.end());
  for (const int i : path)
    if (model.bodies[i].type == JointType::Prismatic) addGrowths(model, i, path, result.growths);
  return result;
}

PointMotionBound pointMotionBound(const KinematicModel& model, std::span<const int> path,
                                  std::span<const double> arms, std::size_t first,
                                  std::span<const JointMotion> motion) {
  // L3 of ERROR_MODEL.md. A joint that both slides and turns slides first, then turns about its
  // moved origin.
  //
  // Planar and floating joints beyond path[i] carry the ball away from its axis. Each sum is
  // computed anew: a difference of large sums would lose small terms.
  const auto slidBeyond = [&](std::size_t i) {
    double slid = 0.0;
    for (std::size_t k = path.size(); --k > i;) slid += motion[path[k]].maxTranslation;
    return slid;
  };

  PointMotionBound bound;
  double maxTranslation = 0.0;
  TurningBound turning;
  for (std::size_t i = first; i < path.size(); ++i) {
    const MovingBody& body = model.bodies[path[i]];
    const JointMotion& joint = motion[path[i]];
    if (i == first || joint.maxTranslation != 0.0) maxTranslation = slidBeyond(i);
    const double arm = arms[i] + maxTranslation * kArithmeticOutward;
    bound.speed += joint.speed + joint.spinSpeed * arm;
    bound.acceleration += 2.0 * joint.speed * turning.now() + joint.acceleration;
    bound.acceleration += joint.spinSpeed * arm * (2.0 * turning.now() + joint.spinSpeed) +
                          joint.spinAcceleration * arm;
    turning.pass(model, body, joint.spinSpeed);
  }
  bound.speed *= kArithmeticOutward;
  bound.acceleration *= kArithmeticOutward;
  return bound;
}

}  // namespace swept::detail
