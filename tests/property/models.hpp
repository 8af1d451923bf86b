// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "models_dir.hpp"
#include "scenario.hpp"

/// Robots of models/ that refuters ask about.
struct Model {
  std::string name, group;
};

/// Between them every joint type: continuous, revolute, prismatic with a follower, planar,
/// floating.
inline const std::array kModels{Model{"rook7", "arm_with_gripper"}, Model{"rook6", "arm"},
                                Model{"rook6_cart", "whole_body"}, Model{"drifter", "body"}};

inline ScenarioFiles filesOf(const Model& model) {
  const auto folder = std::filesystem::path(modelsDir()) / "robots" / model.name;
  ScenarioFiles files;
  files.robot = folder / (model.name + ".urdf");
  files.srdf = folder / (model.name + ".srdf");
  files.group = model.group;
  return files;
}
