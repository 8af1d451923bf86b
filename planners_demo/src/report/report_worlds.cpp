// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_worlds.hpp"

#include <filesystem>

#include "input/problem_choice.hpp"

namespace swept {
namespace {

std::string sceneName(const Arguments& args) {
  std::string name = args.scene.empty() ? "" : std::filesystem::path(args.scene).stem().string();
  for (const std::string& cloud : args.clouds)
    name.append(name.empty() ? "" : " + ").append(std::filesystem::path(cloud).stem().string());
  return name.empty() ? "no scene" : name;
}

std::vector<ReportWorld> problemWorlds(const Arguments& args) {
  const ProblemFile file = ProblemFile::load(args.problems);
  std::vector<ReportWorld> worlds;
  for (const auto& [set, index] : chosenProblems(file, args))
    worlds.push_back({.name = set + " " + std::to_string(index),
                      .world = std::make_shared<const World>(file.problem(set, index).world)});
  return worlds;
}

}  // namespace

std::vector<ReportWorld> reportWorlds(const Arguments& args, const Model& model) {
  requireOneSource(args);
  if (args.problems.empty()) return {{.name = sceneName(args), .world = model.world}};
  return problemWorlds(args);
}

CheckerMaker::CheckerMaker(const Arguments& args, const Model& model, const Group& group,
                           Warnings& warnings)
    : warnings_(warnings) {
  const auto make = [&](double tolerance) {
    Arguments own = args;
    own.tolerance = tolerance;
    return makeChecker(own, model, group, std::make_shared<const World>(), warnings);
  };
  like_.truth = make(kTruthTolerance);
  for (const double tolerance : args.report.tolerances) like_.certified.push_back(make(tolerance));
}

ReportCheckers CheckerMaker::in(const std::shared_ptr<const World>& world) const {
  ReportCheckers checkers;
  checkers.truth = makeChecker(*like_.truth, world, warnings_);
  for (const auto& like : like_.certified)
    checkers.certified.push_back(makeChecker(*like, world, warnings_));
  return checkers;
}

}  // namespace swept
