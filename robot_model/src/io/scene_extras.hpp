// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/scene_matrix.hpp"
#include "io/yaml.hpp"

namespace swept::detail {

/// Throws InputError for what a planning scene may hold and is not read, with or without a robot:
/// an octomap, padded or scaled links.
void refuseUnread(const YamlPlace& root);

/// Throws InputError for what a planning scene says of a robot that makes more to collide with,
/// where the world alone is read: attached objects, a moved base, a collision matrix.
void refuseRobot(const YamlPlace& root);

/// Warns of the name of another robot, as MoveIt does.
void compareRobotName(const YamlPlace& name, const Robot& robot);

/// The scene's matrix. Throws InputError for one that is wrong (SceneMatrix), and for defaults
/// without entries in a scene that is a diff, which MoveIt does not read
/// (PlanningScene::setPlanningSceneDiffMsg).
SceneMatrix readMatrix(const YamlPlace& root);

}  // namespace swept::detail
