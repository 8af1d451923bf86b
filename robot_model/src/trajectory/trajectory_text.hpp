// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "output/text_output.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/trajectory_file.hpp"

/// What writeTrajectory() writes, of valid trajectories. `where` begins the messages of
/// UsageErrors.
namespace swept::detail {

std::string csvTrajectory(const JointTrajectory& trajectory, const std::string& where);
/// The object `trajectory` of a JSON file.
Json trajectoryJson(const JointTrajectory& trajectory);
/// A file with this object alone, and a line for each point.
std::string jsonTrajectory(const JointTrajectory& trajectory);
/// trajectory_msgs/JointTrajectory.
std::string yamlTrajectory(const JointTrajectory& trajectory, const std::string& where);
/// Throws std::invalid_argument, too.
std::string yamlTrajectory(const JointTrajectory& trajectory, const Robot& robot,
                           TrajectoryMessage message, const std::string& where);

}  // namespace swept::detail
