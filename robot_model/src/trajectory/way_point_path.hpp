// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "trajectory/straight_profile.hpp"

namespace swept::detail {

/// Limits of each variable, all positive.
struct VariableLimits {
  Eigen::VectorXd speed;         ///< rad/s or m/s
  Eigen::VectorXd acceleration;  ///< rad/s^2 or m/s^2
  Eigen::VectorXd jerk;          ///< rad/s^3 or m/s^3; infinity without `ramps`
  bool ramps = false;            ///< the acceleration is continuous
  /// Share of the limits that is kept for roundings; see withSlack().
  double slack = 0.0;
};

/// VariableLimits::slack. Rounding changes jerks by more.
inline constexpr double kSlack = 1e-6, kRampSlack = 1e-4;

/// The limits that speeds are chosen for: four times the slack below. Times in whole nanoseconds
/// need one of these, and the rounding of positions, velocities and differences of times the rest.
VariableLimits withSlack(const VariableLimits& limits);

/// Straight parts between the way points at which a path turns or stops. Lengths are Euclidean (rad
/// or m).
struct WayPointPath {
  Eigen::MatrixXd points;                ///< a column for each way point that is kept
  std::vector<std::size_t> indices;      ///< of these among all
  std::vector<char> stops;               ///< whether the robot stops at each of these
  Eigen::MatrixXd directions;            ///< of unit length, a column for each straight part
  std::vector<double> lengths;           ///< of the straight parts, positive
  std::vector<StraightLimits> straight;  ///< along each straight part
  VariableLimits variables;

  std::size_t parts() const { return lengths.size(); }
};

/// The way points as a column each: a cyclic variable goes on the shorter way from one to the next.
Eigen::MatrixXd continuousPoints(const ConfigurationList& wayPoints,
                                 const std::vector<char>& cyclic);

/// Leaves out way points that repeat, and those on the line between their neighbours where the
/// robot need not stop. `stops`: whether it must, of each way point. A path that does not move has
/// no parts. Throws std::invalid_argument for a variable of `names` that moves
/// without a limit, and for lengths that are not finite.
WayPointPath straightParts(const Eigen::MatrixXd& points, const std::vector<char>& stops,
                           const VariableLimits& limits, const std::vector<std::string>& names);

}  // namespace swept::detail
