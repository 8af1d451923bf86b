// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Where a joint of several values puts its child.
struct BasePose {
  std::string joint;
  Eigen::Isometry3d parent_from_child;
};

/// The keys of moveit_msgs/RobotState. Throws InputError for others.
void allowRobotState(const YamlPlace& state);

/// Of sensor_msgs/MultiDOFJointState; none when absent. Throws InputError.
std::vector<BasePose> readBasePoses(const YamlPlace& joints);

/// Poses of bases are those of the joint's child in its parent: the model frame. MoveIt makes
/// something else of another frame than its pose (multiDofJointsToRobotState). Throws InputError
/// for any that is named together with a joint.
void requireBasesInModelFrame(const YamlPlace& joints, const SceneFrames& frames);

/// A value for each of the robot's variables: those of a moveit_msgs/RobotState, over the default
/// state. Values that are a little beyond a limit are taken to it, with a warning. Empty when the
/// state names no joint. Throws InputError for joints that the robot does not have, numbers of
/// names and positions that differ, and a value of a joint that mimics another or does not move
/// which is not the one that it has.
std::optional<Eigen::VectorXd> readRobotState(const YamlPlace& state, const Robot& robot);
/// Throws as readRobotState does, and warns of nothing.
void checkRobotState(const YamlPlace& state, const Robot& robot);

}  // namespace swept::detail
