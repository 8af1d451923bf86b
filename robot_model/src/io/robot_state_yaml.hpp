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

/// The pose that a joint with several values gives its child.
struct BasePose {
  std::string joint;
  Eigen::Isometry3d parent_from_child;
};

/// The keys of moveit_msgs/RobotState. Throws InputError for others.
void allowRobotState(const YamlPlace& state);

/// The poses of sensor_msgs/MultiDOFJointState; none when absent. Throws InputError.
std::vector<BasePose> readBasePoses(const YamlPlace& joints);

/// Poses of bases are those of the joint's child in its parent, which is the model frame. MoveIt
/// converts a pose in another frame differently (multiDofJointsToRobotState). Throws InputError for
/// another frame that is named together with a joint.
void requireBasesInModelFrame(const YamlPlace& joints, const SceneFrames& frames);

/// A value for each of the robot's variables: those of a moveit_msgs/RobotState, and the default
/// state for the rest. A value a little beyond a limit is moved to it, with a warning. Empty when
/// the state names no joint. Throws InputError for joints that the robot does not have, and when
/// the numbers of names and positions differ. Throws it as well for a value that a mimic or fixed
/// joint does not have.
std::optional<Eigen::VectorXd> readRobotState(const YamlPlace& state, const Robot& robot);
/// Throws as readRobotState does, and warns of nothing.
void checkRobotState(const YamlPlace& state, const Robot& robot);

}  // namespace swept::detail
