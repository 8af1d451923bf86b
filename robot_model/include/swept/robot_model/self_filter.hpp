// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "swept/core/sensed_space.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The `points` (m, model frame), in their order, that are not the robot itself: those farther than
/// `margin` (m) from the collision geometry of all its links at `state` (a value for each of
/// Robot::variables()). Otherwise the robot would always be in contact with the points that a
/// camera sees of it. The margin covers the errors of the sensor, its calibration and the state. An
/// obstacle that is as near is removed, too.
///
/// A point whose distance is within rounding of the margin (1e-9 m, or 1e-6 of a mesh's size) may
/// be kept or not; a non-finite point is kept. Throws std::invalid_argument for a margin that is
/// negative or not finite, a state of another size or with a non-finite value, and a zero
/// quaternion.
std::vector<Eigen::Vector3d> withoutRobot(std::span<const Eigen::Vector3d> points,
                                          const Robot& robot, ConfigurationView state,
                                          double margin);

/// The `balls` (m, model frame), in their order, that keep more than `margin` (m) from the robot,
/// with the same rules as for points. Use it for the space that the robot hides from a sensor
/// (occludedBalls() of the points that withoutRobot() removes): the result does not touch the robot
/// at `state`. Throws likewise, and std::invalid_argument unless each ball has a radius.
Balls ballsWithoutRobot(const Balls& balls, const Robot& robot, ConfigurationView state,
                        double margin);

/// The map without its smallest cubes whose centres are within `margin` (m) of the robot, with the
/// same rules as for points. Of a larger cube that comes as near, the part farther away stays, as
/// smaller cubes. Throws likewise, and std::invalid_argument for a map whose resolution is not
/// above zero, and if more than 10 million parts would have to be tested.
OccupancyMap mapWithoutRobot(const OccupancyMap& map, const Eigen::Isometry3d& world_from_map,
                             const Robot& robot, ConfigurationView state, double margin);

}  // namespace swept
