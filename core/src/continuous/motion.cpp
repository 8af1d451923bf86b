// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/motion.hpp"

#include <algorithm>
#include <cmath>

#include "continuous/moving_ball.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

using Eigen::Vector3d;

namespace {

/// Relative: fewer than twenty products and sums of lengths, each within a few ulps.
constexpr double kBoundUp = 1.0 + 1e-14;

}  // namespace

double MotionBound::along(const Vector3d& n) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return along(n); });
  }
  const double directed =
      std::abs(n.dot(linear)) + detail::times(n.cross(spin).norm(), radius) + curvature;
  return std::min(travel, directed * kBoundUp);
}

double MotionBound::most() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return most(); });
  }
  return std::min(travel,
                  (linear.norm() + detail::times(spin.norm(), radius) + curvature) * kBoundUp);
}

MotionBound Motion::bound(const BoundingSphere& ball, double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return bound(ball, from, to); });
  }
  const double middle = 0.5 * (from + to);
  const double half = std::max(middle - from, to - middle);
  const detail::MovingBall moving(*this, ball, from, to, middle);
  MotionBound bound;
  bound.linear = half * moving.velocityAt(moving.center);
  bound.spin = half * moving.twist.angular;
  bound.radius = ball.radius;
  // Acceleration of the velocity at the middle. All points of a body of infinite size that does not
  // turn have the same velocity.
  const double reach = std::isfinite(ball.radius) ? ball.radius : 0.0;
  const double rounded = half * rounding(ball.center.norm() + reach);
  bound.curvature = (0.5 * half * half * moving.acceleration + rounded) * kBoundUp;
  bound.travel = half * moving.speed * kBoundUp;
  return bound;
}

}  // namespace swept
