// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/attached_objects.hpp"
#include "io/robot_state_yaml.hpp"
#include "io/scene.hpp"
#include "io/scene_extras.hpp"
#include "io/scene_frames.hpp"
#include "io/scene_objects.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

/// In the order of MoveIt's PlanningScene::setPlanningSceneMsg: the robot's state, what it carries,
/// then the world.
class SceneReader {
 public:
  SceneReader(const InputSource& source, const Robot* robot)
      : robot_(robot), frames_(source, "PlanningScene::load"), objects_(source) {
    if (robot_ != nullptr) attached_.emplace(*robot_, frames_, objects_);
  }
  PlanningScene read(const YamlPlace& root);

 private:
  void readRobot(const YamlPlace& root);
  void readObject(const YamlPlace& unnamed);
  void addMoving(const YamlPlace& place, const SceneObject& object,
                 const Eigen::Isometry3d& model_from_header);
  void addRules(const YamlPlace& root);

  const Robot* robot_;  ///< null: the world alone is read
  SceneFrames frames_;
  SceneObjects objects_;
  std::optional<AttachedObjects> attached_;  ///< with a robot
  PlanningScene scene_;
};

PlanningScene SceneReader::read(const YamlPlace& root) {
  if (!root.isMap()) root.fail("a planning scene must be a mapping");
  root.allowOnly({"name", "robot_state", "robot_model_name", "fixed_frame_transforms",
                  "allowed_collision_matrix", "link_padding", "link_scale", "object_colors",
                  "world", "collision_objects", "is_diff"});
  const YamlPlace world = root.at("world");
  const YamlPlace outer = root.at("collision_objects");
  world.allowOnly({"collision_objects", "octomap"});
  const YamlPlace inner = world.present() ? world.at("collision_objects") : world;
  if (inner.present() && outer.present()) {
    outer.fail("stand at the top and in 'world' too; one place is allowed");
  }
  if (!world.present() && !outer.present()) {
    root.fail("a planning scene needs 'world' or 'collision_objects'");
  }
  refuseUnread(root);
  if (robot_ != nullptr) {
    readRobot(root);
  } else {
    refuseRobot(root);
    frames_.read(root.at("fixed_frame_transforms"));
  }
  for (const YamlPlace& object :
       (inner.present() ? inner.called("collision_objects") : outer).elements()) {
    readObject(object);
  }
  objects_.flushWarnings();
  if (robot_ != nullptr) {
    attached_->takeFrom(scene_.world);
    scene_.attached = attached_->bodies();
    addRules(root);
  }
  return std::move(scene_);
}

void SceneReader::readRobot(const YamlPlace& root) {
  compareRobotName(root.at("robot_model_name"), *robot_);
  const YamlPlace state = root.at("robot_state");
  scene_.state = readRobotState(state, *robot_);
  frames_.addLinks(*robot_, scene_.state.value_or(robot_->defaultState()));
  frames_.read(root.at("fixed_frame_transforms"));
  if (!state.present()) return;
  requireBasesInModelFrame(state.at("multi_dof_joint_state"), frames_);
  attached_->read(state.at("attached_collision_objects"));
}

void SceneReader::readObject(const YamlPlace& unnamed) {
  const std::string id = idOf(unnamed);
  const YamlPlace place = unnamed.called("object '" + id + "':");
  if (scene_.world.find(id) != nullptr || scene_.world.findObstacle(id) != nullptr)
    place.fail("a second object has this id");
  if (attached_ && attached_->has(id)) place.fail("an attached object has this id");
  const SceneObject object = objects_.read(place, id);
  const Eigen::Isometry3d model_from_header = frames_.model_from(place.at("header"));
  if (object.parts.empty()) place.fail("it has no primitives, no meshes and no planes");
  if (!object.motion.empty()) {
    addMoving(place, object, model_from_header);
    return;
  }
  WorldBody body{.name = id, .parts = {}};
  for (const SceneObject::Part& part : object.parts)
    body.parts.push_back({part.shape, model_from_header * part.header_from_shape});
  for (const auto& [name, header_from_frame] : object.header_from_frame)
    frames_.add(name, model_from_header * header_from_frame);
  try {
    scene_.world.add(std::move(body));
  } catch (const std::invalid_argument& error) {
    place.fail(error.what());
  }
}

void SceneReader::addMoving(const YamlPlace& place, const SceneObject& object,
                            const Eigen::Isometry3d& model_from_header) {
  if (robot_ != nullptr && robot_->findLink(object.id))
    place.fail("a link of the robot has this name, which an object that moves cannot have");
  MovingObstacle obstacle{.name = object.id, .parts = {}, .waypoints = object.motion};
  for (const SceneObject::Part& part : object.parts)
    obstacle.parts.push_back({part.shape, part.header_from_shape});
  for (MovingObstacle::Waypoint& waypoint : obstacle.waypoints)
    waypoint.world_from_body = model_from_header * waypoint.world_from_body;
  frames_.addMoving(object.id);
  try {
    scene_.world.add(std::move(obstacle));
  } catch (const std::invalid_argument& error) {
    place.fail(error.what());
  }
}

void SceneReader::addRules(const YamlPlace& root) {
  const SceneMatrix matrix = readMatrix(root);
  scene_.hasMatrix = !matrix.isEmpty();
  try {
    scene_.rules =
        rulesOf(matrix, *robot_, scene_.attached, scene_.world, attached_->touchingBodies());
  } catch (const std::invalid_argument& error) {
    root.at("allowed_collision_matrix").fail(error.what());
  }
}

}  // namespace

PlanningScene readSceneYaml(const std::string& text, const InputSource& source,
                            const Robot* robot) {
  const YamlPlace root = YamlPlace::parse(text, source);
  try {
    return SceneReader(source, robot).read(root);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace swept::detail
