// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_worlds.hpp"

#include <filesystem>

#include "input/problem_choice.hpp"
#include "input/rules.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {
namespace {

std::string sceneName(const Arguments& args) {
  std::string name = args.scene.empty() ? "" : std::filesystem::path(args.scene).stem().string();
  for (const std::string& cloud : args.clouds)
    name.append(name.empty() ? "" : " + ").append(std::filesystem::path(cloud).stem().string());
  return name.empty() ? "no scene" : name;
}

std::vector<ReportWorld> problemWorlds(const Arguments& args, const Model& model) {
  const ProblemFile file = ProblemFile::load(args.problems);
  const std::vector<ProblemChoice> chosen = chosenProblems(file, args);
  requireBodiesOfRules(args, model, file, chosen);
  std::vector<ReportWorld> worlds;
  for (const auto& [set, index] : chosen)
    worlds.push_back({.name = set + " " + std::to_string(index),
                      .world = std::make_shared<const World>(file.problem(set, index).world)});
  return worlds;
}

}  // namespace

std::vector<ReportWorld> reportWorlds(const Arguments& args, const Model& model) {
  requireOneSource(args);
  if (args.problems.empty()) {
    NamesOfBodies names(rulesOf(args), *model.robot, model.attached);
    names.find(*model.world);
    names.requireFound("the world");
    return {{.name = sceneName(args), .world = model.world}};
  }
  return problemWorlds(args, model);
}

CheckerMaker::CheckerMaker(const Arguments& args, const Model& model, const Group& group,
                           Warnings& warnings)
    : args_(args), model_(model), warnings_(warnings) {
  const auto make = [&](double tolerance) {
    Arguments own = args;
    own.tolerance = tolerance;
    return makeFirstChecker(own, model, group, std::make_shared<const World>(), warnings);
  };
  like_.truth = make(kTruthTolerance);
  for (const double tolerance : args.report.tolerances) like_.certified.push_back(make(tolerance));
  // At a finer tolerance, tubes that touch something by less take a thousand times as long.
  const auto still = make(tolerance::kMotion);
  for (const double tube : kTubes)
    like_.tubes.push_back(std::make_shared<const Checker>(
        still->withTracking({{.rotation = tube, .translation = tube}})));
}

ReportCheckers CheckerMaker::in(const std::shared_ptr<const World>& world) const {
  ReportCheckers checkers;
  checkers.truth = makeNextChecker(args_, model_, *like_.truth, world, warnings_);
  for (const auto& like : like_.certified)
    checkers.certified.push_back(makeNextChecker(args_, model_, *like, world, warnings_));
  for (const auto& like : like_.tubes)
    checkers.tubes.push_back(makeNextChecker(args_, model_, *like, world, warnings_));
  return checkers;
}

}  // namespace swept
