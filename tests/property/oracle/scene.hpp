// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "piece.hpp"

namespace oracle {

/// Planning-scene YAML: objects of primitives and inline or named meshes. `pieces` are in the model
/// frame.
std::vector<Body> readScene(const std::filesystem::path& yaml);

struct Problem {
  std::vector<Body> world;
  std::vector<std::string> joints;
  std::vector<double> start, goal;  ///< rad or m, in the order of `joints`
};
/// One MotionBenchMaker problem.
Problem readProblem(const std::filesystem::path& json, const std::string& set, int index);
std::vector<int> problemIndices(const std::filesystem::path& json, const std::string& set);

}  // namespace oracle
