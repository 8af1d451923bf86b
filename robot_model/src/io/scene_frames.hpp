// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>

#include "io/input_source.hpp"
#include "io/yaml.hpp"

namespace swept::detail {

/// The frames that poses of a scene are given in: the `fixed_frame_transforms` of
/// moveit_msgs/PlanningScene. MoveIt has them the other way round than tf: a transform is the pose
/// of the frame `header.frame_id` in the planning frame, which `child_frame_id` names
/// (moveit::core::Transforms::setTransform).
class SceneFrames {
 public:
  explicit SceneFrames(const InputSource& source) : source_(source) {}

  /// Throws InputError for transforms into more than one frame, of no frame, two of one frame, and
  /// one that moves the model frame.
  void read(const YamlPlace& list);
  /// Pose of the frame that a std_msgs/Header names; one that is unknown is taken for the model
  /// frame, with a warning.
  Eigen::Isometry3d model_from(const YamlPlace& header);

 private:
  bool isModel(const std::string& frame) const;
  void readOne(const YamlPlace& entry);
  void setPlanningFrame(const YamlPlace& place, const std::string& name);

  const InputSource& source_;
  std::string planning_;  ///< empty until it is known
  std::map<std::string, Eigen::Isometry3d> model_from_;
  std::set<std::string> unknown_;  ///< warned of
};

}  // namespace swept::detail
