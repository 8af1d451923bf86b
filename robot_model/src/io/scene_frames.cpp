// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_frames.hpp"

#include "kinematics/motion_model.hpp"

namespace swept::detail {

namespace {

constexpr double kSame = 1e-6;  // m, and of an axis: rounding of what a program has written

std::string nameOf(const YamlPlace& frame) {
  const std::string name = frame.text();
  return name.starts_with('/') ? name.substr(1) : name;
}

bool isSame(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() <= kSame;
}

}  // namespace

std::string frameName(const YamlPlace& header) {
  if (!header.present()) return {};
  header.allowOnly({"seq", "stamp", "frame_id"});
  const YamlPlace frame = header.at("frame_id");
  return frame.present() ? nameOf(frame) : "";
}

void SceneFrames::addLinks(const Robot& robot, const Eigen::VectorXd& state) {
  knowsRobot_ = true;
  // Without a group nothing moves: every frame is folded at the state.
  const KinematicModel still = compileKinematics(robot, Group{}, state);
  for (std::size_t i = 0; i < robot.links().size(); ++i)
    links_.emplace(robot.links()[i].name, still.body_from_link[i]);
}

void SceneFrames::addStillLinks(const Robot& robot) {
  knowsRobot_ = true;
  const KinematicModel still = compileKinematics(robot, Group{}, robot.defaultState());
  std::vector<bool> moves(robot.links().size(), false);
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    if (const int parent = robot.links()[i].parentJoint; parent >= 0) {
      const Joint& joint = robot.joints()[static_cast<std::size_t>(parent)];
      moves[i] = joint.type != JointType::Fixed ||
                 (joint.parentLink >= 0 && moves[static_cast<std::size_t>(joint.parentLink)]);
    }
    if (!moves[i]) links_.emplace(robot.links()[i].name, still.body_from_link[i]);
  }
}

void SceneFrames::add(const std::string& name, const Eigen::Isometry3d& model_from_frame) {
  objects_.emplace(name, model_from_frame);
}

void SceneFrames::addMoving(const std::string& name) {
  moving_.insert(name);
}

bool SceneFrames::isModel(const std::string& frame) const {
  return frame.empty() || frame == "world" || frame == source_.options().modelFrame ||
         frame == planning_;
}

void SceneFrames::read(const YamlPlace& list) {
  for (const YamlPlace& entry : list.elements()) readOne(entry);
}

void SceneFrames::readOne(const YamlPlace& entry) {
  entry.allowOnly({"header", "child_frame_id", "transform"});
  const std::string frame = frameName(entry.at("header"));
  const std::string child = nameOf(entry.at("child_frame_id"));
  const YamlPlace transform = entry.at("transform");
  if (!transform.present()) transform.fail("is missing");
  const Eigen::Isometry3d pose = transform.pose("translation", "rotation");
  if (const auto link = links_.find(frame); link != links_.end()) {
    // MoveIt looks a link up in the robot, whatever the scene says.
    if (isSame(pose, link->second)) return;
    entry.fail("moves '" + frame + "', which is a link of the robot: robot_state says where it is");
  }
  const bool itself = frame.empty() || frame == child || frame == source_.options().modelFrame;
  if (itself) {
    // Scenes often give this transform for the planning frame, by one of its names or without a
    // name.
    if (pose.matrix() == Eigen::Matrix4d::Identity()) return;
    entry.fail(
        "moves the planning frame: child_frame_id has to name that one, header.frame_id "
        "another, whose pose in it the transform is");
  }
  setPlanningFrame(entry.at("child_frame_id"), child);
  if (!fixed_.emplace(frame, pose).second)
    entry.fail("is a second transform of frame '" + frame + "'");
}

void SceneFrames::setPlanningFrame(const YamlPlace& place, const std::string& name) {
  if (!planning_.empty() && name != planning_) {
    place.fail("is '" + name + "'; it must be '" + planning_ +
               "', the planning frame, as in the first transform");
  }
  if (const auto link = links_.find(name); link != links_.end()) {
    if (!isSame(link->second, Eigen::Isometry3d::Identity()))
      place.fail("is '" + name + "', a link that is not where the robot's model frame is");
  } else if (!isModel(name)) {
    if (knowsRobot_)
      place.fail("is '" + name + "', which is not the robot's model frame '" +
                 source_.options().modelFrame + "'");
    place.warn("'" + name + "' is taken for the robot's model frame");
  }
  planning_ = name;
}

Eigen::Isometry3d SceneFrames::model_from(const YamlPlace& header) const {
  const std::string frame = frameName(header);
  // Whatever else may have its name.
  if (!frame.empty() && frame == source_.options().modelFrame) return Eigen::Isometry3d::Identity();
  if (moving_.contains(frame) && !links_.contains(frame))
    header.at("frame_id").fail("is '" + frame + "', an object that moves; a frame has to stand");
  for (const auto* frames : {&links_, &objects_, &fixed_})
    if (const auto found = frames->find(frame); found != frames->end()) return found->second;
  if (isModel(frame)) return Eigen::Isometry3d::Identity();
  const std::string& model = source_.options().modelFrame;
  const std::string known = knowsRobot_ ? "no frame of the robot or of the file"
                                        : "no frame of the file; those of a robot's links need " +
                                              std::string(withRobot_);
  header.at("frame_id")
      .fail("is '" + frame + "', which is " + known + "; the model frame is '" +
            (model.empty() ? "world" : model) + "'");
}

const Eigen::Isometry3d& SceneFrames::model_from_link(const std::string& link) const {
  return links_.at(link);
}

bool SceneFrames::isModelFrame(const YamlPlace& header) const {
  return isSame(model_from(header), Eigen::Isometry3d::Identity());
}

}  // namespace swept::detail
