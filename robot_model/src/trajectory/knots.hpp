// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/time_parameterization.hpp"
#include "trajectory/corner_speeds.hpp"
#include "trajectory/way_point_path.hpp"
#include "trajectory/whole_times.hpp"

namespace swept::detail {

/// The points between the pieces of a path, and its corners.
struct Knots {
  std::vector<TrajectoryPoint> points;
  std::vector<TimedCorner> corners;
};

/// Of a path with at least one straight part. All velocities follow from lengths and from the
/// differences of the times as numbers, so that each piece is quadratic in time (or, with ramps, of
/// the degrees that it should have) but for the rounding of positions and velocities.
Knots knotsOf(const WayPointPath& path, const CornerSpeeds& speeds, const WholeTimes& times);

}  // namespace swept::detail
