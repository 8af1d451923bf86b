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

/// Those of `points` (m, model frame), in their order, that are not the robot itself: neither in
/// the collision geometry of one of its links, nor within `margin` (m) of it, at `state` (a value
/// for each of Robot::variables()). What a camera sees of the robot would else be an obstacle that
/// the robot is always in contact with. The margin is what the sensor, its calibration and the
/// state may be off by; an obstacle that is as near is left out, too.
///
/// A point whose distance is within rounding of the margin (1e-9 m, or 1e-6 of a mesh's size) may
/// be kept or not; one that is not finite is kept. Throws std::invalid_argument for a margin that
/// is negative or not finite, a state of another size or with a value that is not finite, and a
/// quaternion without direction.
std::vector<Eigen::Vector3d> withoutRobot(std::span<const Eigen::Vector3d> points,
                                          const Robot& robot, ConfigurationView state,
                                          double margin);

/// Those of `balls` (m, model frame), in their order, that keep more than `margin` (m) from the
/// robot; what else is as for points. Of the space that the robot hides from a sensor
/// (occludedBalls() of the points that withoutRobot() leaves out) they are what the robot is not in
/// contact with at `state`. Throws likewise, and std::invalid_argument unless each ball has a
/// radius.
Balls ballsWithoutRobot(const Balls& balls, const Robot& robot, ConfigurationView state,
                        double margin);

/// The map without its smallest cubes whose middles are within `margin` (m) of the robot; what else
/// is as for points. Of a larger cube that comes as near, the part that does not is left, in
/// smaller ones. Throws likewise, and std::invalid_argument for a map whose resolution is not above
/// zero, and one of which more than 10 million parts would have to be looked at.
OccupancyMap mapWithoutRobot(const OccupancyMap& map, const Eigen::Isometry3d& world_from_map,
                             const Robot& robot, ConfigurationView state, double margin);

}  // namespace swept
