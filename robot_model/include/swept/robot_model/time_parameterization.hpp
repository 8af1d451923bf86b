// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// How a path is timed.
struct TimingOptions {
  /// rad or m. How far a blend may leave the path of straight motions, in the Euclidean norm over
  /// all variables, as `path_tolerance` of MoveIt's time-optimal trajectory generation. 0: the
  /// robot stops at every corner.
  double blendDeviation = 0.1;
  double velocityScale = 1.0;      ///< factor of all limits of velocities, above 0 and at most 1
  double accelerationScale = 1.0;  ///< likewise, of accelerations
  /// Whether the acceleration is continuous and limits of jerks hold too. If not, accelerations
  /// jump.
  bool jerkLimited = false;
  /// Indices of way points at which the robot stops, in any order. Such a way point is a corner,
  /// even if it is on the line between its neighbours.
  std::vector<std::size_t> stops = {};
};

/// Whether a blend may be driven: a callback, for example a proof that it is free of collision. The
/// blend at a way point is one piece from one straight part to the next. It takes 1 s here, since
/// its shape does not depend on its speed.
using BlendProver = std::function<bool(std::size_t wayPoint, const PiecewisePolynomial& blend)>;

/// A way point at which the path turns or stops, and what was made of it.
struct TimedCorner {
  std::size_t wayPoint = 0;  ///< its index
  double before = 0.0;     ///< rad or m, from where the blend begins to the way point; 0: no blend
  double after = 0.0;      ///< rad or m, from the way point to where the blend ends; likewise
  double deviation = 0.0;  ///< rad or m, bounds the distance between blend and straight motions
  double begin = 0.0;      ///< s, of the blend
  double end = 0.0;        ///< s, of the blend; equal to `begin` if the robot stops

  bool stops() const { return before == 0.0; }  ///< at the way point
};

/// A path with times.
struct TimedPath {
  JointTrajectory trajectory;        ///< for a controller
  PiecewisePolynomial curve;         ///< controllerCurve() of that trajectory
  std::vector<TimedCorner> corners;  ///< in the order of the path
};

/// The fastest trajectory along the straight motions between way points (rad, m), with their
/// corners blended, that keeps the limits. Cyclic variables take the shorter way, as in Checker;
/// their values go on from the first way point's beyond a turn.
///
/// The curve begins and ends at rest. It keeps to the box around the way points, and to the limits
/// of velocity and acceleration at every instant, roundings of the trajectory's numbers included. A
/// corner where the path turns back, and one where `proves` accepts no blend, is a stop. Way points
/// that repeat or lie on the line between their neighbours (to within 1e-12 of the larger of 1 and
/// the largest value) are left out, but for TimingOptions::stops. A path that does not move stays
/// for a millisecond. All times are whole nanoseconds, as messages of ROS carry them.
///
/// Blends: at each corner the joint acceleration is constant, so the blend is a parabola that
/// touches both straight motions. Its two ends may have different speeds and distances from the way
/// point. The straight parts are run with the largest possible acceleration and deceleration. So
/// the curve is quadratic in time between two points, and the trajectory has positions and
/// velocities: the cubic that a controller makes of these is that curve. For given blends the
/// speeds at the corners are the largest possible, which is optimal (H. Pham and Q.-C. Pham, A New
/// Approach to Time-Optimal Path Parameterization Based on Reachability Analysis, 2018: a pass
/// backwards, then one forwards; exact on these pieces). The blends are found by a local search, no
/// larger than blendDeviation. `proves` is asked about each of them, then about smaller ones, down
/// to a 64th of the deviation, at most ten times for a corner; without it, all are taken.
///
/// With `jerkLimited`, a blend is a polynomial of degree 4 without acceleration at its ends, and a
/// straight part changes its speed by ramps of acceleration. The trajectory has accelerations too,
/// and a controller makes quintics. Each variable's jerk keeps its limit inside each piece; it
/// jumps between pieces. Such a trajectory is not optimal: no ramp reaches into a blend.
///
/// Throws std::invalid_argument, with the variable's name: for no way point; values or limits of
/// the wrong number; values that are not finite; limits that are not above 0; an option that is not
/// as above; a stop that is no way point; a variable that moves and has no limit of velocity or
/// acceleration (or jerk, with `jerkLimited`); an orientation of a floating joint that changes,
/// since a slerp is no polynomial; and a trajectory of 2^31 s or more, which no message carries.
TimedPath timeParameterize(const Robot& robot, const Group& group,
                           const ConfigurationList& wayPoints, const RateLimits& limits,
                           const BlendProver& proves = {}, const TimingOptions& options = {});

}  // namespace swept
