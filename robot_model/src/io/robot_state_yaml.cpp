// SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_state_yaml.hpp"

#include <cstddef>

namespace swept::detail {

void allowRobotState(const YamlPlace& state) {
  state.allowOnly(
      {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
  if (!state.isMap()) state.fail("must be a mapping");
  state.at("joint_state").allowOnly({"header", "name", "position", "velocity", "effort"});
}

std::vector<BasePose> readBasePoses(const YamlPlace& joints) {
  if (!joints.present()) return {};
  joints.allowOnly({"header", "joint_names", "transforms", "twist", "wrench"});
  const std::vector<YamlPlace> names = joints.at("joint_names").elements();
  const std::vector<YamlPlace> transforms = joints.at("transforms").elements();
  if (names.size() != transforms.size()) {
    joints.fail("has " + std::to_string(names.size()) + " names and " +
                std::to_string(transforms.size()) + " transforms");
  }
  std::vector<BasePose> poses;
  for (std::size_t i = 0; i < names.size(); ++i)
    poses.push_back({names[i].text(), transforms[i].pose("translation", "rotation")});
  return poses;
}

}  // namespace swept::detail
