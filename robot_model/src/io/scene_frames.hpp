// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>

#include "io/input_source.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// The frames in which a file gives poses. As in MoveIt (PlanningScene::getFrameTransform) a name
/// is looked up in this order: the model frame, links of the robot, attached bodies, objects of the
/// world, the scene's `fixed_frame_transforms`, the model frame's other names.
///
/// MoveIt reads fixed transforms in the direction opposite to tf: a transform is the pose of the
/// frame `header.frame_id` in the planning frame, which `child_frame_id` names
/// (moveit::core::Transforms::setTransform).
class SceneFrames {
 public:
  /// `withRobot`: the function that knows the frames of a robot's links, for messages.
  SceneFrames(const InputSource& source, const char* withRobot)
      : source_(source), withRobot_(withRobot) {}

  /// Poses of all links at a state of the robot: a value for each variable.
  void addLinks(const Robot& robot, const Eigen::VectorXd& state);
  /// Likewise, only for links that no joint moves.
  void addStillLinks(const Robot& robot);
  /// Adds a frame that the file defines: an object, or `object/subframe`. The first with a name
  /// counts.
  void add(const std::string& name, const Eigen::Isometry3d& model_from_frame);
  /// Adds an object that moves: no pose can be in its frame.
  void addMoving(const std::string& name);

  /// Reads `fixed_frame_transforms`. Throws InputError for transforms into more than one frame, a
  /// transform of no frame, two of one frame, and one that moves the model frame or a link.
  void read(const YamlPlace& list);
  /// The pose of the frame that a std_msgs/Header names. Throws InputError for an unknown frame,
  /// and for that of an object that moves.
  Eigen::Isometry3d model_from(const YamlPlace& header) const;
  /// The pose of a link that was added.
  const Eigen::Isometry3d& model_from_link(const std::string& link) const;
  /// Whether the header names the model frame, or a frame at the same pose. Throws likewise.
  bool isModelFrame(const YamlPlace& header) const;

 private:
  bool isModel(const std::string& frame) const;
  void readOne(const YamlPlace& entry);
  void setPlanningFrame(const YamlPlace& place, const std::string& name);

  const InputSource& source_;
  const char* withRobot_;
  std::string planning_;  ///< empty until it is known
  bool knowsRobot_ = false;
  ///@{
  /// By name, poses in the model frame.
  std::map<std::string, Eigen::Isometry3d> links_, objects_, fixed_;
  ///@}
  std::set<std::string> moving_;  ///< objects
};

/// The frame's name in a std_msgs/Header; empty when it names none. MoveIt lets a name begin with a
/// slash, as tf did.
std::string frameName(const YamlPlace& header);

}  // namespace swept::detail
