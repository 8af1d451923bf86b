// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/rate_limits.hpp"

namespace swept::detail {

/// What a robot's variables may do per second.
struct RateBounds {
  Eigen::ArrayXd velocity;      ///< rad/s or m/s
  Eigen::ArrayXd acceleration;  ///< rad/s^2 or m/s^2

  /// s. How long a velocity takes to change, at least.
  double change(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
    return ((to - from).array().abs() / acceleration).maxCoeff();
  }
  /// s. The least time of a straight motion that begins and ends at rest.
  double restToRest(const Eigen::VectorXd& way) const;
};

/// A place that a robot passes, but for the blend around it, at a time.
struct TimedKnot {
  Eigen::VectorXd q;  ///< rad or m
  double time = 0.0;  ///< s
};

/// The curve of straight motions at constant speed from knot to knot, with rest before the first
/// and after the last. Around each knot a parabola of just enough time changes the velocity. So the
/// curve has no corner, and its knots keep their times. It begins at `begin` (s), at rest, and ends
/// when the robot has come to rest. Its times are whole nanoseconds. No value: a velocity is too
/// large, or two blends meet, or the first begins before `begin`. (Known as linear segments with
/// parabolic blends: J. Craig, Introduction to Robotics, 2005, section 7.3.)
std::optional<PiecewisePolynomial> blended(std::span<const TimedKnot> knots, double begin,
                                           const RateBounds& bounds);

/// The two knots of a straight motion from rest at one time to rest at another (s), no sooner than
/// RateBounds::restToRest() allows. One, if it does not move.
std::vector<TimedKnot> restToRest(const TimedKnot& from, const TimedKnot& to,
                                  const RateBounds& bounds);

/// Where straight motions between the knots are at a time (s).
Eigen::VectorXd positionAt(std::span<const TimedKnot> knots, double time);

}  // namespace swept::detail
