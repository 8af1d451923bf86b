// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "swept/robot_model/sphere_model.hpp"
#include "swept/robot_model/world.hpp"

/// Files of models whose shapes contain the bodies of a scene (bodiesOf(World)).
namespace swept {

/// Reads shapes for the bodies of a world from a `.json` of sceneModelJson(), or from a scene that
/// World::load() reads, whose bodies have the same names: also one of sceneModelYaml() or
/// sceneModelText(). A cylinder with two spheres of its radius at its ends is read as a capsule. An
/// object that moves has to move there, too. Throws InputError.
ShapeModel readSceneModel(const std::filesystem::path& file, const World& world,
                          const LoadOptions& options = {});

/// `scene`, and `bodies`, each with `body`, the figures of its report, and `shapes` as
/// shapeModelJson() writes them; if all shapes of the model are spheres, `spheres` of
/// `[x, y, z, radius]` (m). They are in the model frame, those of an object that moves in its own.
/// `reports`: for each body of the model.
std::string sceneModelJson(const ShapeModel& model, const std::string& scene,
                           const std::vector<LinkSphereReport>& reports);

///@{
/// A planning scene with the shapes of the model: YAML in the layout of moveit_msgs/PlanningScene,
/// or MoveIt's text. A capsule is a cylinder and two spheres, a hull a mesh. Objects of `world`
/// that move have the same motion; the text cannot say that. Throws UsageError for such an object
/// and for a name that the text cannot have, and std::invalid_argument for a shape that is neither
/// sphere, box, cylinder, capsule nor hull.
std::string sceneModelYaml(const ShapeModel& model, const World& world, const std::string& scene);
std::string sceneModelText(const ShapeModel& model, const World& world, const std::string& scene);
///@}

}  // namespace swept
