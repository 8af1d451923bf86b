// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh_files.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"
#include "workloads.hpp"

/// Robots that are checked against themselves alone.
namespace swept::benchmark {

struct SelfCase {
  std::string name;
  bool needsData = false;
  std::filesystem::path files;      ///< URDF and SRDF, without their endings
  std::vector<std::string> groups;  ///< of the SRDF; moved together
  /// Pairs of links that are not checked either, besides the SRDF's.
  std::vector<std::pair<std::string, std::string>> apart = {};
};

inline std::vector<SelfCase> selfCases(const std::filesystem::path& data) {
  const std::filesystem::path ours = std::filesystem::path(modelsDir()) / "robots";
  const std::filesystem::path theirs = data / "robots";
  return {{"rook7", false, ours / "rook7" / "rook7", {"arm"}},
          {"rook6", false, ours / "rook6" / "rook6", {"arm"}},
          // The fingers of these two are fixed: the arms carry them.
          {"Panda", true, theirs / "panda" / "panda", {"panda_arm"}},
          {"UR5", true, theirs / "ur5" / "ur5", {"manipulator"}},
          // No group of the SRDF has all of these. Its bellow is modelled as a rigid tube around
          // the torso, in contact in most states, and the SRDF does not know it.
          {"PR2, whole body",
           true,
           theirs / "pr2" / "pr2",
           {"arms", "torso", "head", "right_gripper", "left_gripper"},
           {{"base_bellow_link", "torso_lift_link"}}},
          {"PR2, whole body and bellow",
           true,
           theirs / "pr2" / "pr2",
           {"arms", "torso", "head", "right_gripper", "left_gripper"}}};
}

inline std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream = openFile(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// With the group that selfChecker asks for.
inline std::shared_ptr<const Robot> loadSelf(const SelfCase& which) {
  const std::string files = which.files.string();
  std::string srdf = textOf(files + ".srdf");
  std::string extra = "<group name=\"checked alone\">";
  for (const std::string& part : which.groups) extra += "<group name=\"" + part + "\"/>";
  extra += "</group>";
  for (const auto& [a, b] : which.apart)
    extra += "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"Default\"/>";
  const std::size_t end = srdf.rfind("</robot>");
  if (end == std::string::npos) throw std::runtime_error(files + ".srdf: no </robot>");
  srdf.insert(end, extra);
  LoadOptions options;
  options.packages = {{"moveit_resources_pr2_description/urdf", which.files.parent_path()}};
  return Robot::parse(textOf(files + ".urdf"), files + ".urdf", srdf, files + ".srdf", options);
}

inline Checker selfChecker(const std::shared_ptr<const Robot>& robot) {
  return Checker(robot, "checked alone", std::make_shared<const World>());
}

/// Uniform within the limits, a turn where there are none; one after the other.
inline std::vector<double> randomStates(const Checker& checker, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> states;
  for (int i = 0; i < count; ++i) {
    for (const int v : checker.group().variables) {
      const Variable& variable = checker.robot().variables()[v];
      const bool bounded = std::isfinite(variable.lower) && std::isfinite(variable.upper);
      states.push_back(bounded ? uniform(random, variable.lower, variable.upper)
                               : uniform(random, -std::numbers::pi, std::numbers::pi));
    }
  }
  return states;
}

}  // namespace swept::benchmark
