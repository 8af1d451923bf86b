// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/moving_ball.hpp"

#include "geometry/nearest_rotation.hpp"

namespace swept::detail {

namespace {

/// Relative: the sums and products of lengths below are of fewer than fifty terms, none negative.
constexpr double kBallUp = 1.0 + 1e-13;

}  // namespace

// A point at distance d from the reference point has at most the speed |v| + |w| d and the
// acceleration |v'| + (|w'| + |w|^2) d.
MovingBall::MovingBall(const Motion& motion, const BoundingSphere& ball, double from, double to,
                       double middle)
    : rates(motion.rates(from, to)), radius(ball.radius) {
  const MotionState state = motion.state(middle);
  pose = rigidPose(state.pose);
  twist = state.twist;
  reference = pose * motion.reference();
  center = pose * ball.center;
  const double arm = (center - reference).norm() + radius;
  const double turning = rates.angularAcceleration + rates.angularSpeed * rates.angularSpeed;
  speed = (rates.speed + times(rates.angularSpeed, arm)) * kBallUp;
  acceleration = (rates.acceleration + times(turning, arm)) * kBallUp;
}

}  // namespace swept::detail
