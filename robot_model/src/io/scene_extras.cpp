// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_extras.hpp"

#include <string>

#include "io/robot_state_yaml.hpp"

namespace swept::detail {

namespace {

void refuseOctomap(const YamlPlace& stamped) {
  if (!stamped.present()) return;
  const YamlPlace map = stamped.allowOnly({"header", "origin", "octomap"}).at("octomap");
  if (!map.present()) return;
  map.allowOnly({"header", "binary", "id", "resolution", "data"});
  const YamlPlace data = map.at("data");  // scenes often carry an empty map
  if (!data.present() || (data.isSequence() && data.elements().empty())) return;
  data.fail("holds an octomap, which is not supported in a scene");
}

/// A list of moveit_msgs/LinkPadding or LinkScale, which often has an entry for each link that says
/// nothing.
void refuseEnlarged(const YamlPlace& list, const char* key, double neutral, const char* instead) {
  for (const YamlPlace& entry : list.elements()) {
    entry.allowOnly({"link_name", key});
    const YamlPlace value = entry.at(key);
    if (value.number() == neutral) continue;
    value.fail("of link '" + entry.at("link_name").text() + "' is " + value.text() +
               ", which is not read from a scene; give it as a rule instead (" + instead + ")");
  }
}

void warnOfState(const YamlPlace& state) {
  if (!state.present()) return;
  allowRobotState(state);
  for (const YamlPlace& attached : state.at("attached_collision_objects").elements()) {
    attached.warn("is ignored: attached objects are not part of the world");
  }
  for (const BasePose& base : readBasePoses(state.at("multi_dof_joint_state"))) {
    if (base.parent_from_child.isApprox(Eigen::Isometry3d::Identity(), 0.0)) continue;
    state.at("multi_dof_joint_state")
        .warn("moves '" + base.joint + "' and is ignored: the robot is not part of the world");
  }
}

void warnOfAllowed(const YamlPlace& matrix) {
  if (!matrix.present()) return;
  matrix.allowOnly({"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
  if (matrix.at("entry_names").elements().empty() &&
      matrix.at("default_entry_names").elements().empty())
    return;
  matrix.warn("is ignored: pairs that may collide are those of the SRDF and of rules");
}

}  // namespace

void checkSceneExtras(const YamlPlace& root) {
  if (const YamlPlace world = root.at("world"); world.present()) refuseOctomap(world.at("octomap"));
  refuseEnlarged(root.at("link_padding"), "padding", 0.0, "CollisionRules::pad, --pad");
  refuseEnlarged(root.at("link_scale"), "scale", 1.0, "CollisionRules::scale, --scale");
  warnOfState(root.at("robot_state"));
  warnOfAllowed(root.at("allowed_collision_matrix"));
}

}  // namespace swept::detail
