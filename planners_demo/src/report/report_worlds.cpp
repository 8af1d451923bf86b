// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_worlds.hpp"

#include <filesystem>

#include "command_line/exit_code.hpp"

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
  int place = 0;
  for (const std::string& set : file.sets()) {
    if (!args.set.empty() && set != args.set) continue;
    for (const int index : file.indices(set)) {
      if (place++ % args.report.every != 0) continue;
      if (args.limit && worlds.size() >= static_cast<std::size_t>(*args.limit)) return worlds;
      worlds.push_back({.name = set + " " + std::to_string(index),
                        .world = std::make_shared<const World>(file.problem(set, index).world)});
    }
  }
  // The file's own message names the sets it has.
  if (worlds.empty() && !args.set.empty()) file.problem(args.set, 0);
  if (worlds.empty()) throw UsageError("'" + args.problems + "' has no problems");
  return worlds;
}

}  // namespace

std::vector<ReportWorld> reportWorlds(const Arguments& args, const Model& model) {
  if (args.problems.empty()) return {{.name = sceneName(args), .world = model.world}};
  if (!args.scene.empty())
    throw UsageError("--scene and --problems cannot be combined: the problem has its own world");
  if (!args.clouds.empty())
    throw UsageError("--cloud and --problems cannot be combined: the problem has its own world");
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
