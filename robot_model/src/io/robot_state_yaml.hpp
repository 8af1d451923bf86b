// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "io/yaml.hpp"

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

}  // namespace swept::detail
