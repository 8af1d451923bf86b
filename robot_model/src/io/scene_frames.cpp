// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_frames.hpp"

namespace swept::detail {

namespace {

/// As tf did once, MoveIt lets a frame begin with a slash.
std::string nameOf(const YamlPlace& frame) {
  const std::string name = frame.text();
  return name.starts_with('/') ? name.substr(1) : name;
}

std::string frameName(const YamlPlace& header) {
  if (!header.present()) return {};
  header.allowOnly({"seq", "stamp", "frame_id"});
  const YamlPlace frame = header.at("frame_id");
  return frame.present() ? nameOf(frame) : "";
}

}  // namespace

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
  const bool itself = frame.empty() || frame == child || frame == source_.options().modelFrame;
  if (itself) {
    // Scenes often say so of the planning frame, by one name or another, or by none.
    if (pose.matrix() == Eigen::Matrix4d::Identity()) return;
    entry.fail(
        "moves the planning frame: child_frame_id has to name that one, header.frame_id "
        "another, whose pose in it the transform is");
  }
  setPlanningFrame(entry.at("child_frame_id"), child);
  if (!model_from_.emplace(frame, pose).second)
    entry.fail("is a second transform of frame '" + frame + "'");
}

void SceneFrames::setPlanningFrame(const YamlPlace& place, const std::string& name) {
  if (!planning_.empty() && name != planning_) {
    place.fail("is '" + name + "'; it must be '" + planning_ +
               "', the planning frame, as in the first transform");
  }
  if (!isModel(name)) place.warn("'" + name + "' is taken for the robot's model frame");
  planning_ = name;
}

Eigen::Isometry3d SceneFrames::model_from(const YamlPlace& header) {
  const std::string frame = frameName(header);
  if (const auto found = model_from_.find(frame); found != model_from_.end()) return found->second;
  if (!isModel(frame) && unknown_.insert(frame).second) {
    header.at("frame_id").warn("'" + frame + "' is taken for the robot's model frame");
  }
  return Eigen::Isometry3d::Identity();
}

}  // namespace swept::detail
