// SPDX-License-Identifier: BSD-3-Clause
#include "page/file_page.hpp"

#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "certificate/read_checker.hpp"
#include "certificate/trajectory_json.hpp"
#include "certificate/verify_outcome.hpp"
#include "input/task.hpp"
#include "io/json_value.hpp"
#include "output/progress.hpp"
#include "page/path_page.hpp"
#include "swept/pages/page.hpp"
#include "swept/pages/task_page.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "verify/task.hpp"

namespace swept {
namespace {

PageOptions optionsOf(const Arguments& args, const std::string& proof) {
  PageOptions options;
  options.title = "swept view, " + std::filesystem::path(args.robot).filename().string();
  options.facts = {{"proof", proof}, {"command", args.page.commandLine}};
  return options;
}

std::string keptText(double clearance) {
  return std::isinf(clearance) ? std::string("there is no pair to check")
                               : "every pair keeps more than " + shortNumber(clearance) + " m";
}

/// What a path says that it is not about, where no files say it again.
void sayWarningsOf(const Json& path, Warnings& warnings) {
  if (!path.contains("warnings") || !path["warnings"].is_array()) return;
  for (const Json& line : path["warnings"])
    if (line.is_string()) warnings.ofUnchecked(line.get<std::string>());
}

[[noreturn]] void refuse(const Arguments& args, const std::string& refusal) {
  throw InputError(args.robot, 0, "its proof does not hold: " + refusal);
}

JointTrajectory trajectoryIn(const Json& path, const std::string& file) {
  const nlohmann::json own(path["trajectory"]);
  return trajectoryOf(JsonValue(own, "trajectory", file));
}

/// Phases, each with the checker that the file has for it.
std::function<std::string()> taskPage(const Arguments& args, const Json& task) {
  const std::vector<verify::PhaseSummary> phases = verify::checkTask(task);
  const auto page = std::make_shared<TaskPage>(
      optionsOf(args, "verified: task of " + countedText(phases.size(), "phase")));
  CheckerReader reader;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const Json& path = task["phases"][i]["path"];
    const JointTrajectory trajectory = trajectoryIn(path, args.robot);
    page->addPhase(phases[i].name, reader.read(path), controllerCurve(trajectory), {},
                   phases[i].changes);
  }
  return [page] { return page->html(); };
}

std::function<std::string()> pathPage(const Arguments& args, const Json& path) {
  requireProof(path, args.robot);
  if (!path.contains("model"))
    throw InputError(args.robot, 0,
                     "it does not hold its robot and world; swept view ROBOT.urdf " + args.robot +
                         " reads them from the files that it names");
  const VerifyOutcome outcome = verified(path, Json());
  if (!outcome.holds()) refuse(args, outcome.refusal);
  CheckerReader reader;
  const auto checker = reader.read(path);
  PageOptions options = optionsOf(args, "verified: " + keptText(outcome.summary.clearance));
  // The page itself has the checker's constraints; a line that a tool follows is none of them.
  const std::vector<std::string>& kept = outcome.summary.constraints;
  for (std::size_t i = checker->options().constraints.size(); i < kept.size(); ++i)
    options.facts.emplace_back("at every instant", kept[i]);
  const auto page = std::make_shared<Page>(checker, std::move(options));
  const std::string label = std::filesystem::path(args.robot).filename().string();
  if (path.contains("trajectory")) {
    const JointTrajectory trajectory = trajectoryIn(path, args.robot);
    TrajectoryQuery query;
    query.clock = path.value("clock", 0.0);
    page->addTrajectory(label, controllerCurve(trajectory), query);
  } else {
    page->addPath(label, pathStates(path, *checker, args.robot));
  }
  return [page] { return page->html(); };
}

}  // namespace

bool namesProof(const Arguments& args) {
  return std::filesystem::path(args.robot).extension() == ".json";
}

std::function<std::string()> pageOfProof(const Arguments& args, Warnings& warnings) {
  const std::string why = ": '" + args.robot + "' is shown with what it says";
  if (!args.states.empty()) throw UsageError(args.states.front() + why);
  if (!args.scene.empty()) throw UsageError("--scene" + why);
  refuseRules(args, why);
  const Json file = parseOrderedJson(args.robot);
  Progress progress("verifying", args.quiet);
  try {
    if (!file.is_object() || !file.contains("phases")) {
      sayWarningsOf(file, warnings);
      return pathPage(args, file);
    }
    for (const Json& phase : file["phases"])
      if (phase.contains("path")) sayWarningsOf(phase["path"], warnings);
    return taskPage(args, file);
  } catch (const verify::Refusal& refusal) {
    refuse(args, refusal.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(args.robot, 0, error.what());
  }
}

}  // namespace swept
