// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/sphere_model.hpp"

namespace swept {

/// What a model of `swept cover` is around: a robot, a mesh (the only link of a robot), or the
/// bodies of a scene.
struct Covered {
  Model model;                         ///< of a robot: of --html
  std::shared_ptr<const Robot> robot;  ///< null: a scene
  std::shared_ptr<const World> world;  ///< of a scene; else null
  std::vector<NamedBody> bodies;       ///< with geometry
  std::string name;
  ExpandedText urdf;  ///< of a robot, with its `<collision>` elements
  std::string srdf;   ///< file; empty: none
  LoadOptions options;
};

bool isMesh(const std::string& file);
/// A .scene, or a .yaml with bodies. A work cell is none.
bool isScene(const std::string& file);

/// Reads `args.robot`; `visual`: with the visual geometry. Throws UsageError and InputError.
Covered loadCovered(const Arguments& args, bool visual, Warnings& warnings);

/// `.json`, in lower case.
std::string endingInLowerCase(const std::string& file);

}  // namespace swept
