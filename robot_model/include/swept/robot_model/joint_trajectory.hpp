// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"

namespace swept {

/// A knot of a trajectory: trajectory_msgs/JointTrajectoryPoint.
struct TrajectoryPoint {
  double time = 0.0;                  ///< s, after the start of the trajectory
  std::vector<double> positions;      ///< rad or m, one per name
  std::vector<double> velocities;     ///< rad/s or m/s, likewise; empty: not given
  std::vector<double> accelerations;  ///< rad/s^2 or m/s^2, likewise; empty: not given
};

/// What a trajectory controller is given: trajectory_msgs/JointTrajectory.
struct JointTrajectory {
  std::vector<std::string> variables;   ///< names, see Variable::name
  std::vector<TrajectoryPoint> points;  ///< ascending in time
};

/// The curve that ros2_control's joint_trajectory_controller makes of a trajectory
/// (`interpolation_method: splines`). Between two points each value is the polynomial through what
/// both of them have: positions, a straight line; velocities besides, the cubic with these ends;
/// accelerations besides, the quintic. Its values are in the order of JointTrajectory::variables.
///
/// `start`: where the robot is at time 0, at rest. If the first point is later, the curve begins
/// there; without it, at the first point. Throws std::invalid_argument for a trajectory without a
/// point, a size that is wrong, times that do not increase or are negative, and values that are not
/// finite.
PiecewisePolynomial controllerCurve(const JointTrajectory& trajectory,
                                    ConfigurationView start = {});

}  // namespace swept
