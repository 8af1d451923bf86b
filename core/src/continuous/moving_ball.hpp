// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/continuous/motion.hpp"

namespace swept::detail {

/// The product, but 0 if either factor is 0, even if the other is infinite: a body of any size that
/// does not turn. A NaN stays NaN.
inline double times(double a, double b) {
  return a == 0.0 || b == 0.0 ? 0.0 : a * b;
}

/// A ball that moves with a body during an interval [from, to], in the world frame.
struct MovingBall {
  MovingBall(const Motion& motion, const BoundingSphere& ball, double from, double to,
             double middle);

  Eigen::Isometry3d pose;     ///< of the body at the middle
  Twist twist;                ///< at the middle
  MotionRates rates;          ///< over the interval
  Eigen::Vector3d reference;  ///< m, at the middle
  Eigen::Vector3d center;     ///< m, at the middle
  double radius;              ///< m
  double speed;               ///< m per unit of t, upper bound over the points of the ball
  double acceleration;        ///< m per unit of t squared, upper bound over the points of the ball

  bool isStill() const { return rates.speed == 0.0 && rates.angularSpeed == 0.0; }
  /// Velocity of a point of the world if it moved with the body, at the middle.
  Eigen::Vector3d velocityAt(const Eigen::Vector3d& point) const {
    return twist.linear + twist.angular.cross(point - reference);
  }
};

}  // namespace swept::detail
