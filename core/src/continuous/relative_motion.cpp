// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/relative_motion.hpp"

#include <algorithm>
#include <cmath>

#include "continuous/moving_ball.hpp"
#include "geometry/nearest_rotation.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Relative: the sums and products of norms below are of fewer than fifty terms, none negative.
constexpr double kUp = 1.0 + 1e-13;
/// Relative: velocities and vectors computed from them are sums of fewer than fifty products; half
/// an interval, which multiplies them, is rounded up by kUp.
constexpr double kVelocityRounding = 2e-13;
/// m. Squares of lengths below 1e-154 m underflow: quantities made of norms may be too small by a
/// few times that.
constexpr double kUnderflow = 1e-150;

/// The approach of the two for some observer, in the world frame; see ApproachBound.
struct Approach {
  Vector3d linear = Vector3d::Zero();
  Vector3d spinA = Vector3d::Zero();
  Vector3d spinB = Vector3d::Zero();
  double curvature = 0.0;
  double travel = 0.0;

  double most(const MovingBall& a, const MovingBall& b) const {
    return std::min(travel, linear.norm() + times(spinA.norm(), a.radius) +
                                times(spinB.norm(), b.radius) + curvature);
  }
};

Approach forTheWorld(const MovingBall& a, const MovingBall& b, double half) {
  Approach seen;
  seen.linear = half * (b.velocityAt(b.center) - a.velocityAt(a.center));
  seen.spinA = half * a.twist.angular;
  seen.spinB = half * b.twist.angular;
  seen.curvature = 0.5 * half * half * (a.acceleration + b.acceleration) * kUp;
  seen.travel = half * (a.speed + b.speed) * kUp;
  return seen;
}

/// Motion of the other's ball for an observer who moves with one body.
///
/// Lemma: a point P of the other has, for the observer, the velocity u = v(P) - f(P), with f the
/// observer's own velocity taken on to P, and, written in the observer's frame, the acceleration
/// u' - w x u. There u' is the difference of v'(P) and of the derivative of f along P's way,
///   x'' + w' x (P - x) + w x (v(P) - x'),
/// x the observer's reference point. The vectors' lengths follow from those at the middle by what
/// their derivatives allow in half an interval.
struct Passing {
  Vector3d linear;  ///< m, of the ball's centre
  Vector3d spin;    ///< rad
  double curvature;
  double travel;
};
Passing passing(const MovingBall& observer, const MovingBall& other, double half) {
  const MotionRates& own = observer.rates;
  const Vector3d u = other.velocityAt(other.center) - observer.velocityAt(other.center);
  const Vector3d spin = other.twist.angular - observer.twist.angular;
  const Vector3d drift = other.velocityAt(other.center) - observer.twist.linear;
  const double distance =
      (other.center - observer.reference).norm() + other.radius + half * (other.speed + own.speed);
  const double fastest = drift.norm() + times(other.twist.angular.norm(), other.radius) +
                         half * (other.acceleration + own.acceleration);
  const double change = other.acceleration + own.acceleration +
                        times(own.angularAcceleration, distance) + times(own.angularSpeed, fastest);
  const double speed = u.norm() + times(spin.norm(), other.radius) + half * change;
  const double acceleration = change + times(own.angularSpeed, speed);
  return {half * u, half * spin, 0.5 * half * half * acceleration * kUp, half * speed * kUp};
}

/// The observer who sees the least motion proves the most: one body may carry the other, and a
/// large body that turns beside a small one sees that move slowly. A body that stands still sees
/// what the world sees.
Approach least(const MovingBall& a, const MovingBall& b, double half) {
  Approach best = forTheWorld(a, b, half);
  const auto keepBetter = [&](const Approach& seen) {
    if (seen.most(a, b) < best.most(a, b)) best = seen;
  };
  if (!a.isStill()) {
    const Passing ofB = passing(a, b, half);
    keepBetter({ofB.linear, Vector3d::Zero(), ofB.spin, ofB.curvature, ofB.travel});
  }
  if (!b.isStill()) {
    const Passing ofA = passing(b, a, half);
    keepBetter({-ofA.linear, ofA.spin, Vector3d::Zero(), ofA.curvature, ofA.travel});
  }
  return best;
}

/// m. How far from a body's origin its rounding matters: as far as the body reaches, or, if that is
/// infinite, as far as the other does.
double reachOf(const BoundingSphere& ball, const MovingBall& body, const MovingBall& other) {
  if (std::isfinite(ball.radius)) return ball.center.norm() + ball.radius;
  if (!std::isfinite(other.radius)) return ball.center.norm();
  return (other.center - body.pose.translation()).norm() + other.radius;
}

}  // namespace

RelativeMotion::RelativeMotion(const BoundingSphere& ballA, const Motion& a,
                               const BoundingSphere& ballB, const Motion& b)
    : a_(a), b_(b), ballA_(ballA), ballB_(ballB) {}

MotionSlice RelativeMotion::over(double from, double to, double margin) const {
  MotionSlice slice;
  slice.from = from;
  slice.to = to;
  slice.middle = from + 0.5 * (to - from);
  const double half = std::max(slice.middle - from, to - slice.middle) * kUp;
  const MovingBall a(a_, ballA_, from, to, slice.middle);
  const MovingBall b(b_, ballB_, from, to, slice.middle);
  slice.world_from_a = a.pose;
  slice.a_from_b = a.pose.inverse() * b.pose;
  slice.finite = slice.world_from_a.matrix().allFinite() && slice.a_from_b.matrix().allFinite();

  const Approach seen = least(a, b, half);
  const Eigen::Matrix3d a_from_world = a.pose.linear().transpose();
  ApproachBound& bound = slice.approach;
  bound.travel = seen.travel;
  bound.curvature = seen.curvature;
  bound.linear = a_from_world * seen.linear;
  bound.spinA = a_from_world * seen.spinA;
  bound.spinB = a_from_world * seen.spinB;
  bound.ballA = {ballA_.center, bound.spinA.isZero(0.0) ? 0.0 : a.radius};
  bound.ballB = {slice.a_from_b * ballB_.center, bound.spinB.isZero(0.0) ? 0.0 : b.radius};
  const double moved = bound.most();
  // Each motion rounds its poses and velocities, and so does expressing one pose relative to the
  // other.
  const double poses = a_.rounding(reachOf(ballA_, a, b)) + b_.rounding(reachOf(ballB_, b, a));
  const double product =
      tolerance::kRoundingPerJoint * (a.pose.translation().norm() + b.pose.translation().norm());
  bound.required = margin + kUnderflow + (1.0 + half) * poses + product +
                   (std::isfinite(moved) ? kVelocityRounding * moved : 0.0);
  return slice;
}

RelativeState RelativeMotion::at(double t) const {
  MotionState a = a_.state(t), b = b_.state(t);
  a.pose = rigidPose(a.pose);
  b.pose = rigidPose(b.pose);
  const Eigen::Matrix3d a_from_world = a.pose.linear().transpose();
  const Vector3d origin = a.pose.translation();
  const auto atOrigin = [&](const MotionState& body, const Vector3d& reference) {
    return Vector3d(body.twist.linear + body.twist.angular.cross(origin - body.pose * reference));
  };
  RelativeState state;
  state.world_from_a = a.pose;
  state.a_from_b = a.pose.inverse() * b.pose;
  state.velocity = a_from_world * (atOrigin(b, b_.reference()) - atOrigin(a, a_.reference()));
  state.spin = a_from_world * (b.twist.angular - a.twist.angular);
  return state;
}

}  // namespace swept::detail
