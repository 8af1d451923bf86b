// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "certificate/model_json.hpp"
#include "certificate/summary_output.hpp"
#include "certificate/verify_cover.hpp"
#include "certificate/verify_outcome.hpp"
#include "certificate/verify_task.hpp"
#include "command_line/commands.hpp"
#include "input/inputs.hpp"
#include "input/task.hpp"
#include "io/json_value.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

/// The files that the path file names, or those given instead, read.
struct Files {
  Model model;
  Task task;
};

Files filesOf(const Arguments& args, const Json& path, Warnings& warnings) {
  if (!path.contains("inputs"))
    throw InputError(args.verify.path, 0, "it does not say which files it is for");
  const nlohmann::json recorded(path["inputs"]);
  Arguments inputs = inputsOf(JsonValue(recorded, "inputs", args.verify.path));
  // A path has no times, and so no clock.
  inputs.command = path.contains("trajectory") ? &kTrajectoryCommand : &kPlanCommand;
  inputs.quiet = true;  // verifying has a line of progress
  inputs.verbose = args.verbose;
  if (!args.verify.robot.empty()) inputs.robot = args.verify.robot;
  if (!args.verify.scene.empty()) inputs.scene = args.verify.scene;
  Files files;
  files.model = loadModel(inputs, warnings);
  files.task = loadTask(inputs, files.model, warnings);
  requireModelNames(*files.task.checker, "the files of '" + args.verify.path + "'");
  return files;
}

/// Whether the files are of account, because the path file does not have what is in them, or
/// because the caller wants them to be.
bool needsFiles(const Arguments& args, const Json& path) {
  return !path.contains("model") || args.verify.files || !args.verify.robot.empty() ||
         !args.verify.scene.empty() || !args.page.file.empty();
}

/// Of a path that holds: remarks on what is a little beyond a limit. An orientation has none.
std::vector<std::string> limitRemarks(const Json& path, const Json& model) {
  std::vector<std::string> remarks;
  const Json& variables = model["variables"];
  std::vector<bool> isLimited(variables.size(), true);
  for (const Json& joint : model["joints"])
    if (joint["type"] == "floating" && !joint["variable"].is_null())
      for (std::size_t i = 3; i < 7; ++i)
        isLimited[joint["variable"].get<std::size_t>() + i] = false;
  const auto limitOf = [](const Json& limit, double none) {
    return limit.is_null() ? none : limit.get<double>();
  };
  for (const Json& state : path["states"]) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      Variable variable;
      variable.name = variables[i]["name"];
      variable.lower = limitOf(variables[i]["lower"], -HUGE_VAL);
      variable.upper = limitOf(variables[i]["upper"], HUGE_VAL);
      variable.cyclic = variables[i]["cyclic"];
      const double value = state[i];
      const auto limit = limitNear(variable, value);
      if (limit && isLimited[i])
        remarks.push_back(limitRemark({variable.name, value, *limit, ""}, "proven as it is"));
    }
  }
  return remarks;
}

/// `files`: those of filesOf(), or null.
VerifyOutcome examine(const Json& path, const Files* files, std::vector<std::string>& remarks) {
  const Json model = files == nullptr ? Json() : modelJson(*files->task.checker);
  VerifyOutcome outcome = verified(path, model);
  if (outcome.holds()) remarks = limitRemarks(path, path.contains("model") ? path["model"] : model);
  return outcome;
}

std::string summaryText(const verify::Summary& summary) {
  const std::string what = summary.duration ? "trajectory of " + secondsText(*summary.duration) +
                                                  ", " + countedText(summary.segments, "piece")
                                            : countedText(summary.segments, "segment");
  std::string text = painted(Hue::Good, "verified") + ": " + what + ", " + tubeText(summary) +
                     countedText(summary.pairs, "pair of bodies", "pairs of bodies") + ", " +
                     countedText(summary.intervals, "interval") + ", " +
                     countedText(summary.planes, "plane") + "\n" + keptText(summary) + "\n";
  if (!summary.moving.empty())
    text +=
        escapedLine("beside what moves, from " + shortNumber(summary.clockBegin) + " to " +
                    shortNumber(summary.clockEnd) + " s of its clock: " + joined(summary.moving)) +
        "\n";
  for (const std::string& constraint : summary.constraints)
    text += escapedLine("at every instant: " + constraint) + "\n";
  for (const auto& [reason, pairs] : summary.allowed)
    text += escapedLine("not checked (" + reason + "): " + joined(pairs)) + "\n";
  return text;
}

/// A page has the straight motions between states, which a trajectory does not take.
void requireShown(const Arguments& args, const Json& path) {
  if (!args.page.file.empty() && path.contains("trajectory"))
    throw UsageError("--html shows straight motions, and '" + args.verify.path +
                     "' has a trajectory; swept trajectory --html shows it");
}

}  // namespace

ExitCode runVerify(const Arguments& args) {
  requirePageFile(args);
  const Json path = parseOrderedJson(args.verify.path);
  if (isCoverFile(path)) return verifyCover(args, path);
  if (isTask(path)) return runVerifyTask(args, path);
  requireProof(path, args.verify.path);
  Warnings warnings(args.quiet);
  requireShown(args, path);
  std::optional<Files> files;
  VerifyOutcome outcome;
  std::vector<std::string> remarks;
  {
    Progress progress("verifying", args.quiet);
    if (needsFiles(args, path)) files = filesOf(args, path, warnings);
    outcome = examine(path, files ? &*files : nullptr, remarks);
  }
  for (const std::string& remark : remarks) warnings("swept: warning: " + remark);
  if (!files) repeatWarnings(path, warnings);
  Json json = outcomeJson(outcome);
  json["warnings"] = warnings.unchecked();
  if (args.json)
    std::cout << dumped(json) << '\n';
  else
    printText(outcome.holds()
                  ? summaryText(outcome.summary)
                  : painted(Hue::Bad, "refused") + ": " + escapedLine(outcome.refusal) + "\n");
  if (files) writeVerifyPage(args, files->model, files->task, path, outcome);
  return outcome.holds() ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
