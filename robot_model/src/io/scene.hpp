// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "io/input_source.hpp"
#include "swept/robot_model/planning_scene.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// A scene file of any kind, told apart by its ending. Null robot: the world alone (World::load).
/// Throws InputError.
PlanningScene readScene(const std::filesystem::path& scene, const Robot* robot,
                        const LoadOptions& options);

/// Planning-scene YAML, in the layout of moveit_msgs/PlanningScene. Reads the bodies of `world:
/// collision_objects:` or of a `collision_objects:` at the top. Unless `robot` is null, reads as
/// well what the scene says about the robot. Throws InputError.
PlanningScene readSceneYaml(const std::string& text, const InputSource& source, const Robot* robot);

/// MoveIt's text format, with poses per object (since Noetic) or without. Throws InputError.
World readSceneText(const std::string& text, const InputSource& source);

/// A URDF as obstacles: its links, in their default state, with the root link in the model frame.
/// Throws InputError.
World readSceneUrdf(const std::filesystem::path& scene, const LoadOptions& options);

}  // namespace swept::detail
