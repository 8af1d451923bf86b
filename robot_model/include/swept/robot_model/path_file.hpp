// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Reads the configurations of a path from any planner, in the order of the group's variables (rad,
/// m). The file's extension gives the format:
///
/// * `.csv`: a line with the names of the joints, in any order, then a line for each configuration;
/// * `.yaml`, `.yml`: trajectory_msgs/JointTrajectory, moveit_msgs/RobotTrajectory or
///   moveit_msgs/DisplayTrajectory as ROS prints them;
/// * `.json`: the path file of `swept plan` and `swept certify`.
///
/// robot_model/FORMATS.md says how each key is treated. A path is the straight motions between its
/// configurations: times, velocities and accelerations are ignored. Configurations are exactly
/// within the limits: values up to tolerance::kLimit beyond are moved to them, with a remark for
/// each variable. Angles of joints without limits are wrapped to the turn around zero.
///
/// The file may name joints outside the group. Their values must equal those in `reference` (a
/// value for each of the robot's variables; default Robot::defaultState()), to within
/// tolerance::kLimit, and mimicking joints must follow their masters: a proof is about no other
/// posture.
///
/// LoadOptions::warnOfUnchecked receives two kinds of remarks: about points with velocities or
/// accelerations, between which a controller makes a curve that is not checked; and about joints
/// without limits that turn by more than half a turn between two points, which take the shorter way
/// here.
///
/// There is at least one configuration. Throws InputError, with file, line, the value and what is
/// allowed, also for values that are not finite or beyond a limit, and for joints of the group that
/// the file lacks. Throws std::invalid_argument for a reference of another size.
std::vector<std::vector<double>> readPath(const std::filesystem::path& file, const Robot& robot,
                                          const Group& group,
                                          const std::optional<Eigen::VectorXd>& reference = {},
                                          const LoadOptions& options = {});

/// Whether readPath() knows a file's extension.
bool isPathFile(const std::filesystem::path& file);

}  // namespace swept
