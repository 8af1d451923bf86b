// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/robot.hpp"

/// The curves that are executed in place of a path of straight motions. Way points are the columns
/// of a matrix (rad, m); lengths are Euclidean. At least two of the way points have to differ,
/// otherwise these functions throw std::invalid_argument. Way points nearer than 1e-9 to the one
/// before are left out.
namespace swept {

/// The way points of a path as columns. A cyclic variable goes on the shorter way from one to the
/// next, as in Checker. Throws std::invalid_argument, with the variable's name, where an
/// orientation of a floating joint changes: it turns by a slerp, which no polynomial follows.
Eigen::MatrixXd continuousWayPoints(const Robot& robot, const Group& group,
                                    const ConfigurationList& path);

/// The straight motions themselves; t is the length from the first way point.
PiecewisePolynomial polyline(const Eigen::MatrixXd& points);

/// How far a piece of circularBlends() may be from its arc (rad, m).
inline constexpr double kArcError = 1e-9;

/// The path with a circular arc at each corner, in the space of configurations, as MoveIt's
/// time-optimal trajectory generation makes it (T. Kunz and M. Stilman, Time-Optimal Trajectory
/// Generation for Path Following with Bounded Acceleration and Velocity, RSS 2012, section III). An
/// arc is tangent to both straight motions, takes at most half of each, and leaves its way point by
/// at most `deviation` (rad, m; above 0, which is MoveIt's `path_tolerance`). A corner that turns
/// by less than 1.4e-3 rad, or turns back to within as much, stays as it is, as in MoveIt.
///
/// t is the length along the path. An arc is made of cubics that are at most kArcError from it.
/// Throws std::invalid_argument for a deviation that is not above 0.
PiecewisePolynomial circularBlends(const Eigen::MatrixXd& points, double deviation);

/// The cubic spline through the way points with continuous accelerations, at rest at both ends. The
/// time between two way points is the length of the straight motion.
PiecewisePolynomial cubicSpline(const Eigen::MatrixXd& points);

}  // namespace swept
