// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/scene_matrix.hpp"
#include "io/yaml.hpp"

namespace swept::detail {

/// Throws InputError for content of a planning scene that is not supported, with or without a
/// robot: an octomap, padded or scaled links.
void refuseUnread(const YamlPlace& root);

/// Where only the world is read, throws InputError for content about a robot that adds collisions:
/// attached objects, a moved base, a collision matrix.
void refuseRobot(const YamlPlace& root);

/// Warns of the name of another robot, as MoveIt does.
void compareRobotName(const YamlPlace& name, const Robot& robot);

/// The scene's matrix. Throws InputError for an invalid one (SceneMatrix). Throws it as well for
/// defaults without entries in a scene that is a diff, which MoveIt does not read
/// (PlanningScene::setPlanningSceneDiffMsg).
SceneMatrix readMatrix(const YamlPlace& root);

}  // namespace swept::detail
