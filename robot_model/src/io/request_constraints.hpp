// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/task_constraint.hpp"

namespace swept::detail {

/// Fails for a key that moveit_msgs/Constraints lacks.
void allowConstraints(const YamlPlace& place);

/// Whether it constrains anything.
bool constrainsAnything(const YamlPlace& place);

/// moveit_msgs/Constraints that hold along a whole path. A frame may be a link, moving or not, one
/// of these attached bodies, or one that `frames` has. Throws InputError for what the robot lacks,
/// for what cannot be kept (visibility, regions of meshes and cones), and for values that make no
/// sense.
TaskConstraint readConstraints(const YamlPlace& place, const Robot& robot,
                               const SceneFrames& frames,
                               const std::vector<AttachedBody>& attached);

}  // namespace swept::detail
