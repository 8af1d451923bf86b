// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_extras.hpp"

#include <string>

#include "io/robot_state_yaml.hpp"

namespace swept::detail {

namespace {

const std::string kInstead = "PlanningScene::load reads it, World::load reads the world alone";

void refuseOctomap(const YamlPlace& stamped) {
  if (!stamped.present()) return;
  const YamlPlace map = stamped.allowOnly({"header", "origin", "octomap"}).at("octomap");
  if (!map.present()) return;
  map.allowOnly({"header", "binary", "id", "resolution", "data"});
  const YamlPlace data = map.at("data");  // scenes often carry an empty map
  if (!data.present() || (data.isSequence() && data.elements().empty())) return;
  data.fail("holds an octomap, which is not supported in a scene");
}

/// A list of moveit_msgs/LinkPadding or LinkScale. It often has an entry without effect for each
/// link.
void refuseEnlarged(const YamlPlace& list, const char* key, double neutral, const char* instead) {
  for (const YamlPlace& entry : list.elements()) {
    entry.allowOnly({"link_name", key});
    const YamlPlace value = entry.at(key);
    if (value.number() == neutral) continue;
    value.fail("of link '" + entry.at("link_name").text() + "' is " + value.text() +
               ", which is not read from a scene; give it as a rule instead (" + instead + ")");
  }
}

void refuseState(const YamlPlace& state) {
  if (!state.present()) return;
  allowRobotState(state);
  if (const YamlPlace attached = state.at("attached_collision_objects");
      !attached.elements().empty())
    attached.elements()[0].fail("is carried by a link: " + kInstead);
  const YamlPlace bases = state.at("multi_dof_joint_state");
  for (const BasePose& base : readBasePoses(bases))
    if (!base.parent_from_child.isApprox(Eigen::Isometry3d::Identity(), 0.0))
      bases.fail("moves '" + base.joint + "': " + kInstead);
}

}  // namespace

void refuseUnread(const YamlPlace& root) {
  if (const YamlPlace world = root.at("world"); world.present()) refuseOctomap(world.at("octomap"));
  refuseEnlarged(root.at("link_padding"), "padding", 0.0, "CollisionRules::pad, --pad");
  refuseEnlarged(root.at("link_scale"), "scale", 1.0, "CollisionRules::scale, --scale");
}

void refuseRobot(const YamlPlace& root) {
  refuseState(root.at("robot_state"));
  // Even a matrix that allows all of its pairs checks others that the SRDF disables.
  if (!readMatrix(root).isEmpty())
    root.at("allowed_collision_matrix").fail("stands in place of the SRDF's: " + kInstead);
}

void compareRobotName(const YamlPlace& name, const Robot& robot) {
  if (!name.present() || name.text().empty() || name.text() == robot.name()) return;
  name.warn("is '" + name.text() + "'; the robot is '" + robot.name() + "'");
}

SceneMatrix readMatrix(const YamlPlace& root) {
  const YamlPlace place = root.at("allowed_collision_matrix");
  SceneMatrix matrix(place);
  const YamlPlace diff = root.at("is_diff");
  const bool isDiff = diff.present() && diff.boolean();
  if (!matrix.isEmpty() && !matrix.hasEntries() && isDiff)
    place.fail("has default_entry_names and no entry_names, which a diff does not apply");
  return matrix;
}

}  // namespace swept::detail
