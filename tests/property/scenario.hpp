// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "swept/robot_model/checker.hpp"

/// One robot, group and world seen twice: by the checker and by the oracle.
struct Scenario {
  std::filesystem::path robot, srdf;
  std::string group;
  std::string worldArguments;  ///< what names the world on a command line
  bool onlyHere = false;       ///< no file has the world: only `refute` can build it
  std::unique_ptr<swept::Checker> checker;
  std::unique_ptr<oracle::Oracle> oracle;
  /// For each value of a group's configuration, its place among the oracle's variables.
  std::vector<int> place;

  /// All of the oracle's variables, those outside the group at home. std::invalid_argument unless
  /// there is a value for each of the group's.
  std::vector<double> full(const std::vector<double>& groupValues) const;
  std::vector<double> groupOf(const std::vector<double>& full) const;
};

struct ScenarioFiles {
  std::filesystem::path robot, srdf;
  std::string group;
  std::filesystem::path scene;     ///< planning-scene YAML; empty for a problem or no world
  std::filesystem::path problems;  ///< MotionBenchMaker JSON
  std::string set;
  int index = 1;
};

Scenario loadScenario(const ScenarioFiles& files, const swept::CheckerOptions& options = {});

/// A world of random solids of every shape, the same for both, some of them compound. The names do
/// not depend on the seed: `clutter0`, `clutter1`, ...
struct Clutter {
  swept::World world;
  std::vector<oracle::Body> twins;
};
Clutter makeClutter(std::uint64_t seed);

Scenario clutterScenario(const ScenarioFiles& files, std::uint64_t seed,
                         const swept::CheckerOptions& options = {});
