// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "box_worlds.hpp"
#include "mesh_files.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

/// Robots from files, in the worlds that come with them.
namespace swept::benchmark {

struct RobotCase {
  std::string name;
  bool needsData = false;
  std::filesystem::path urdf, srdf;
  std::string group;
  std::string worlds;  ///< a file of problems, a folder of scenes, or empty: twelve boxes, raised
};

/// Where the project's own robots are.
inline std::filesystem::path modelsFolder() {
  return modelsDir();
}

inline std::vector<RobotCase> robotCases(const std::filesystem::path& data) {
  const std::filesystem::path ours = modelsFolder() / "robots", theirs = data / "robots";
  const std::string scenes = (modelsFolder() / "scenes").string();
  const std::string panda = (data / "mbm" / "panda.json").string();
  const std::string ur5 = (data / "mbm" / "ur5.json").string();
  const auto own = [&](const std::string& name, const std::string& group) {
    return RobotCase{name,  false, ours / name / (name + ".urdf"), ours / name / (name + ".srdf"),
                     group, scenes};
  };
  return {
      own("rook7", "arm"),
      own("rook6", "arm"),
      own("rook6_cart", "whole_body"),
      {"Panda", true, theirs / "panda" / "panda.urdf", theirs / "panda" / "panda.srdf", "panda_arm",
       panda},
      {"Panda, spheres", true, theirs / "panda" / "panda_spherized.urdf",
       theirs / "panda" / "panda.srdf", "panda_arm", panda},
      {"UR5", true, theirs / "ur5" / "ur5.urdf", theirs / "ur5" / "ur5.srdf", "manipulator", ur5},
      {"PR2, both arms", true, theirs / "pr2" / "pr2.urdf", theirs / "pr2" / "pr2.srdf", "arms",
       ""}};
}

inline std::shared_ptr<const Robot> loadRobot(const RobotCase& which) {
  LoadOptions options;
  const std::filesystem::path folder = which.urdf.parent_path();
  options.packages = {{"moveit_resources_pr2_description/urdf", folder}};
  return Robot::load(which.urdf, which.srdf, options);
}

/// The first two problems of each set, or every scene but the empty one.
inline std::vector<std::shared_ptr<const World>> loadWorlds(const RobotCase& which) {
  std::vector<std::shared_ptr<const World>> worlds;
  if (which.worlds.empty()) {
    // A PR2's shoulders are as high as the arms in the other tables stand on the floor.
    worlds.push_back(
        std::make_shared<const World>(worldOf(twelveBoxes(), Eigen::Vector3d(0.1, 0.0, 0.8))));
  } else if (which.worlds.ends_with(".json")) {
    const ProblemFile problems = ProblemFile::load(which.worlds);
    for (const std::string& set : problems.sets()) {
      const std::vector<int> indices = problems.indices(set);
      for (std::size_t i = 0; i < std::min<std::size_t>(2, indices.size()); ++i)
        worlds.push_back(std::make_shared<const World>(problems.problem(set, indices[i]).world));
    }
  } else {
    for (const char* scene :
         {"table_objects", "shelf", "bin", "cage", "narrow_slot", "tunnel_trap"})
      worlds.push_back(std::make_shared<const World>(
          World::load(std::filesystem::path(which.worlds) / (std::string(scene) + ".yaml"))));
  }
  return worlds;
}

}  // namespace swept::benchmark
