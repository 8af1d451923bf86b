// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "swept/robot_model/world.hpp"

namespace swept {

/// A start, goals and a world for some joints of a robot.
struct PlanningProblem {
  std::string set;                         ///< its name in the file
  int index = 0;                           ///< its number in the file
  World world;                             ///< around the robot, model frame
  std::vector<std::string> jointNames;     ///< joints of start and goals
  std::vector<double> start;               ///< rad or m, in the order of jointNames
  std::vector<std::vector<double>> goals;  ///< likewise
  /// Bodies with a size of 0, which are checked as points, segments and surfaces.
  std::vector<std::string> withZeroSize;
};

/// MotionBenchMaker problems in one JSON file:
/// `{ SET: [ { "index", "world": {"sphere": [...], "cylinder": [...], "box": [...]}, "start",
/// "goals", "joint_names" } ] }`. Orientations are x, y, z, w; boxes have half extents; cylinders a
/// full length.
class ProblemFile {
 public:
  /// Reads a file. Throws InputError.
  static ProblemFile load(const std::filesystem::path& json);

  /// Names of the sets that have problems.
  std::vector<std::string> sets() const;
  /// Indices of the problems of a set, in the order of the file; none for an unknown set.
  std::vector<int> indices(const std::string& set) const;
  /// A problem. Throws InputError if there is no such set or index, and lists those there are; for
  /// more than ten, their number and the nearest ones.
  PlanningProblem problem(const std::string& set, int index) const;

 private:
  struct Set {
    std::vector<int> indices;  ///< in the order of the file
    std::map<int, PlanningProblem> problems;
  };
  std::string file_;
  std::map<std::string, Set> sets_;
};

}  // namespace swept
