// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "scenario.hpp"

struct Model {
  std::string name, group;
};
inline void PrintTo(const Model& model, std::ostream* out) {
  *out << model.name;
}

/// Between them every joint type: continuous, revolute, prismatic with a follower, planar,
/// floating.
inline auto modelsUnderTest() {
  return testing::Values(Model{"rook7", "arm_with_gripper"}, Model{"rook6", "arm"},
                         Model{"rook6_cart", "whole_body"}, Model{"drifter", "body"});
}

inline std::string modelName(const testing::TestParamInfo<Model>& tested) {
  return tested.param.name;
}

inline ScenarioFiles filesOf(const Model& model) {
  const auto folder = std::filesystem::path(SWEPT_MODELS_DIR) / "robots" / model.name;
  ScenarioFiles files;
  files.robot = folder / (model.name + ".urdf");
  files.srdf = folder / (model.name + ".srdf");
  files.group = model.group;
  return files;
}
