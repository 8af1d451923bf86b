// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/motion.hpp"

#include <algorithm>
#include <cmath>

namespace swept {

using Eigen::Vector3d;

namespace {

/// Lemma: the sums and products below are of fewer than twenty non-negative terms, each within a
/// few ulps.
constexpr double kUp = 1.0 + 1e-14;

/// 0 where either is, even if the other is infinite: a ball of any size that does not turn.
double times(double a, double b) {
  return a > 0.0 && b > 0.0 ? a * b : 0.0;
}

}  // namespace

double MotionBound::along(const Vector3d& n) const {
  const double directed = std::abs(n.dot(linear)) + times(n.cross(spin).norm(), radius) + curvature;
  return std::min(travel, directed * kUp);
}

double MotionBound::most() const {
  return std::min(travel, (linear.norm() + times(spin.norm(), radius) + curvature) * kUp);
}

// A point at the distance d from the reference point has at most the speed |v| + |w| d and the
// acceleration |v'| + (|w'| + |w|^2) d.
MotionBound Motion::bound(const BoundingSphere& ball, double from, double to) const {
  const double middle = 0.5 * (from + to);
  const double half = std::max(middle - from, to - middle);
  const Twist twist = velocity(middle);
  const MotionRates most = rates(from, to);
  const Vector3d arm = at(middle).linear() * (ball.center - reference_);
  const double reach = ball.radius + arm.norm();
  MotionBound bound;
  bound.linear = half * (twist.linear + twist.angular.cross(arm));
  bound.spin = half * twist.angular;
  bound.radius = ball.radius;
  const double turning = most.angularAcceleration + most.angularSpeed * most.angularSpeed;
  // Of the velocity at the middle. All of a body of infinite size that does not turn has the same.
  const double reachOfBall = std::isfinite(ball.radius) ? ball.radius : 0.0;
  const double rounded = half * rounding(ball.center.norm() + reachOfBall);
  bound.curvature =
      (0.5 * half * half * (most.acceleration + times(turning, reach)) + rounded) * kUp;
  bound.travel = half * (most.speed + times(most.angularSpeed, reach)) * kUp;
  return bound;
}

}  // namespace swept
