// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The configurations of a path that any planner has made, in the order of the group's variables
/// (rad, m), by the file's ending:
///
/// * `.csv`: a line with the names of the joints, in any order, then a line for each configuration;
/// * `.yaml`, `.yml`: trajectory_msgs/JointTrajectory, moveit_msgs/RobotTrajectory or
///   moveit_msgs/DisplayTrajectory as ROS prints them;
/// * `.json`: the path file of `swept plan` and `swept certify`.
///
/// robot_model/FORMATS.md has what becomes of each key. A path is the straight motions between its
/// configurations: times, velocities and accelerations have no part in it. Configurations are
/// within the limits exactly: values up to tolerance::kLimit beyond are taken to them, with a
/// remark for each variable; angles of joints without limits are those in the turn around zero.
///
/// Joints outside of the group may be named. They have to stay where `reference` (a value for each
/// of the robot's variables; none: Robot::defaultState()) has them, to within tolerance::kLimit,
/// and joints that mimic others where these take them: a proof is about no other posture.
///
/// LoadOptions::warnOfUnchecked is told of points with velocities or accelerations, between which a
/// controller makes a curve that nothing is said about; and of joints without limits that turn by
/// more than half a turn between two points, whose motion here is the shorter way.
///
/// There is one configuration at least. Throws InputError, with file, line, the value and what is
/// allowed: also for values that are not finite or beyond a limit, and for joints of the group that
/// the file lacks. Throws std::invalid_argument for a reference of another size.
std::vector<std::vector<double>> readPath(const std::filesystem::path& file, const Robot& robot,
                                          const Group& group,
                                          const std::optional<Eigen::VectorXd>& reference = {},
                                          const LoadOptions& options = {});

/// Whether readPath() knows a file's ending.
bool isPathFile(const std::filesystem::path& file);

}  // namespace swept
