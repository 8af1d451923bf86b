// SPDX-License-Identifier: BSD-3-Clause
#include "site.hpp"

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>
#include <utility>

#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/planning_scene.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/sensed_world.hpp"

namespace swept::answers {
namespace {

namespace fs = std::filesystem;
using Remark = std::function<void(const std::string&)>;

std::vector<fs::path> filesBelow(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (std::ranges::find(endings, entry.path().extension().string()) != endings.end())
      found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The packages of a robot whose meshes lie below its own folder, wherever it was taken from.
std::vector<PackageFolder> packagesOf(const fs::path& urdf) {
  std::vector<PackageFolder> packages;
  const std::string text = textOf(urdf);
  const std::string mark = "package://";
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const auto begin = at + mark.size();
    const std::string path = text.substr(begin, text.find_first_of("\"'", begin) - begin);
    for (auto slash = path.find('/'); slash != std::string::npos;
         slash = path.find('/', slash + 1)) {
      const std::string name = path.substr(0, slash);
      if (!fs::exists(urdf.parent_path() / path.substr(slash + 1))) continue;
      if (!std::ranges::count(packages, name, &PackageFolder::name))
        packages.push_back({name, urdf.parent_path()});
    }
  }
  return packages;
}

/// The one beside the URDF, or the one whose name the URDF's begins with.
fs::path srdfOf(const fs::path& urdf) {
  if (fs::path own = Robot::srdfBeside(urdf); !own.empty()) return own;
  for (const fs::path& file : filesBelow(urdf.parent_path(), {".srdf"}))
    if (urdf.stem().string().starts_with(file.stem().string())) return file;
  return {};
}

struct Problem {
  std::string name;
  PlanningProblem problem;
};

/// From each set of each file the first problems.
std::vector<Problem> problemsIn(const fs::path& folder, std::size_t ofEach, const Remark& remark) {
  std::vector<Problem> all;
  for (const fs::path& json : filesBelow(folder, {".json"})) {
    const std::string file = json.filename().string();
    if (file == "cases.json" || file.ends_with("_meta.json")) continue;
    try {
      const ProblemFile problems = ProblemFile::load(json);
      for (const std::string& set : problems.sets()) {
        std::vector<int> indices = problems.indices(set);
        if (indices.size() > ofEach) indices.resize(ofEach);
        for (const int index : indices)
          all.push_back(
              {file + ":" + set + ":" + std::to_string(index), problems.problem(set, index)});
      }
    } catch (const std::exception& error) {
      remark(error.what());
    }
  }
  return all;
}

/// Those that the robot's states name, and those in the middle of everything.
std::vector<Values> anchorsOf(const Robot& robot, const Group& group) {
  const Eigen::VectorXd reference = robot.defaultState();
  Values begin;
  for (const int i : group.variables) begin.push_back(reference[i]);
  std::vector<Values> anchors{begin};
  for (const NamedState& state : robot.namedStates()) {
    Values q = begin;
    for (const auto& [variable, value] : state.values) {
      const auto place = std::ranges::find(group.variables, variable);
      if (place != group.variables.end())
        q[static_cast<std::size_t>(place - group.variables.begin())] = value;
    }
    anchors.push_back(q);
  }
  return anchors;
}

/// The problem's configuration as one of the group; none where the problem has other joints.
std::optional<Values> valuesOf(const Robot& robot, const Group& group,
                               const PlanningProblem& problem, const Values& values) {
  const Eigen::VectorXd reference = robot.defaultState();
  Values q;
  for (const int i : group.variables) q.push_back(reference[i]);
  for (std::size_t i = 0; i < problem.jointNames.size(); ++i) {
    const auto variable = robot.findVariable(problem.jointNames[i]);
    if (!variable) return std::nullopt;
    const auto place = std::ranges::find(group.variables, *variable);
    if (place == group.variables.end()) return std::nullopt;
    q[static_cast<std::size_t>(place - group.variables.begin())] = values[i];
  }
  return q;
}

/// A robot's group, to be put into scenes.
struct Actor {
  std::string name;
  std::shared_ptr<const Robot> robot;
  std::string group;
  std::shared_ptr<const Checker> base;  ///< in some world, with the usual options
  Site in(const std::string& scene, Checker checker) const {
    return {name, scene, robot, std::move(checker), anchorsOf(*robot, *robot->findGroup(group))};
  }
  Checker checkerOf(World world) const {
    return base->withWorld(std::make_shared<const World>(std::move(world)));
  }
};

std::vector<Actor> actorsOf(const fs::path& urdf, const std::regex& wanted, const Remark& remark) {
  std::vector<Actor> actors;
  try {
    const std::string stem = urdf.stem().string();
    LoadOptions options;
    options.packages = packagesOf(urdf);
    const auto robot = Robot::load(urdf, srdfOf(urdf), options);
    for (const Group& group : robot->groups()) {
      Actor actor{stem + ":" + group.name, robot, group.name, nullptr};
      if (!std::regex_search(stem, wanted) && !std::regex_search(actor.name, wanted)) continue;
      auto world = std::make_shared<World>();
      world->add("probe", makeSphere(0.1), Eigen::Isometry3d::Identity());
      actor.base = std::make_shared<const Checker>(robot, group.name, world);
      if (group.variables.empty() || actor.base->checksNothing()) {
        remark(actor.name + ": nothing to check");
      } else {
        actors.push_back(actor);
      }
    }
  } catch (const std::exception& error) {
    remark(error.what());
  }
  return actors;
}

Site inSceneFile(const Actor& actor, const fs::path& file, const std::string& name) {
  std::optional<PlanningScene> scene;
  try {
    scene = PlanningScene::load(file, *actor.robot);
  } catch (const InputError&) {
    // It is of another robot: its world will do.
    return actor.in(name, actor.checkerOf(World::load(file)));
  }
  return actor.in(name,
                  {actor.robot, actor.group, std::make_shared<const World>(std::move(scene->world)),
                   scene->checkerOptions()});
}

Site inCloudFile(const Actor& actor, const fs::path& file, const std::string& name) {
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  World world;
  if (file.extension() == ".bt" || file.extension() == ".ot") {
    world.add(occupiedBody("map", loadOctomap(file), still));
  } else {
    world.add("cloud", PointCloud::build(loadPoints(file), 0.015), still);
  }
  return actor.in(name, actor.checkerOf(std::move(world)));
}

Site inProblem(const Actor& actor, const Problem& problem) {
  Site site = actor.in(problem.name, actor.checkerOf(problem.problem.world));
  const Group& group = *actor.robot->findGroup(actor.group);
  std::vector<Values> ends = problem.problem.goals;
  ends.push_back(problem.problem.start);
  for (const Values& values : ends)
    if (auto q = valuesOf(*actor.robot, group, problem.problem, values)) site.anchors.push_back(*q);
  return site;
}

void addFiles(const Actor& actor, const fs::path& folder, std::vector<Place>& places) {
  for (const fs::path& file : filesBelow(folder, {".yaml", ".yml", ".scene"})) {
    const std::string name = file.filename().string();
    // Starts and goals, trajectories and work cells are no scenes.
    const fs::path kind = file.parent_path().filename();
    if (name == "queries.yaml" || kind == "trajectories" || kind == "cells") continue;
    places.push_back({actor.name, name, [=] { return inSceneFile(actor, file, name); }});
  }
  for (const fs::path& file : filesBelow(folder, {".pcd", ".ply", ".xyz", ".bt", ".ot"})) {
    const std::string name = file.filename().string();
    places.push_back({actor.name, name, [=] { return inCloudFile(actor, file, name); }});
  }
}

}  // namespace

std::vector<Place> makePlaces(const Folders& folders, std::uint64_t seed, const std::regex& robots,
                              const Remark& remark) {
  std::vector<fs::path> urdfs = filesBelow(folders.models / "robots", {".urdf"});
  std::vector<fs::path> sceneFolders{folders.models};
  std::vector<Problem> problems = problemsIn(folders.models, 2, remark);
  const auto more = [&](const fs::path& robotFolder, const fs::path& problemFolder) {
    for (const fs::path& urdf : filesBelow(robotFolder, {".urdf"})) urdfs.push_back(urdf);
    for (Problem& problem : problemsIn(problemFolder, 3, remark))
      problems.push_back(std::move(problem));
  };
  if (folders.data) more(*folders.data / "robots", *folders.data / "mbm");
  if (folders.extra) {
    more(*folders.extra, *folders.extra);
    sceneFolders.push_back(*folders.extra);
  }
  std::vector<Place> places;
  for (const fs::path& urdf : urdfs) {
    const std::vector<Actor> actors = actorsOf(urdf, robots, remark);
    if (actors.empty()) continue;
    const std::string alone = urdf.stem().string() + ":-";
    places.push_back({alone, "-", [alone, robot = actors.front().robot] {
                        return Site{alone, "-", robot, std::nullopt, {}};
                      }});
    for (const Actor& actor : actors) {
      for (const fs::path& folder : sceneFolders) addFiles(actor, folder, places);
      for (const Problem& problem : problems) {
        const Group& group = *actor.robot->findGroup(actor.group);
        if (valuesOf(*actor.robot, group, problem.problem, problem.problem.start))
          places.push_back({actor.name, problem.name, [=] { return inProblem(actor, problem); }});
      }
      for (const std::string& scene : randomScenes()) {
        places.push_back({actor.name, scene, [=] {
                            return actor.in(scene,
                                            makeRandomScene(scene, actor.robot, actor.group,
                                                            Random::of(seed, {actor.name, scene})));
                          }});
      }
    }
  }
  return places;
}

}  // namespace swept::answers
