// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>

#include "certificate/model_json.hpp"
#include "command_line/commands.hpp"
#include "input/inputs.hpp"
#include "input/json_value.hpp"
#include "input/task.hpp"
#include "output/progress.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/input.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

/// The robot and world of the files that the path file names, or of those given instead.
Json modelOfFiles(const Arguments& args, const Json& path, Warnings& warnings) {
  if (!path.contains("inputs"))
    throw InputError(args.verify.path, 0, "it does not say which files it is for");
  const nlohmann::json recorded(path["inputs"]);
  Arguments inputs = inputsOf(JsonValue(recorded, "inputs", args.verify.path));
  inputs.command = &kPlanCommand;
  if (!args.verify.robot.empty()) inputs.robot = args.verify.robot;
  if (!args.verify.scene.empty()) inputs.scene = args.verify.scene;
  const Model model = loadModel(inputs, warnings);
  return modelJson(*loadTask(inputs, model, warnings).checker);
}

verify::Summary examine(const Arguments& args, const Json& path, Warnings& warnings) {
  if (!path.contains("model")) return verify::checkProof(path, modelOfFiles(args, path, warnings));
  const verify::Summary summary = verify::checkProof(path, path["model"]);
  if (args.verify.files || !args.verify.robot.empty() || !args.verify.scene.empty())
    verify::requireSameModel(path["proof"], modelOfFiles(args, path, warnings));
  return summary;
}

std::string clearanceText(double clearance) {
  return std::isinf(clearance) ? "there is no pair to check"
                               : "every pair keeps more than " + shortNumber(clearance) + " m";
}

std::string summaryText(const verify::Summary& summary) {
  std::string text = "verified: " + std::to_string(summary.segments) + " segments, " +
                     std::to_string(summary.pairs) + " pairs of bodies, " +
                     std::to_string(summary.intervals) + " intervals, " +
                     std::to_string(summary.planes) + " planes\n" +
                     clearanceText(summary.clearance) + "\n";
  for (const auto& [reason, pairs] : summary.allowed)
    text += "not checked (" + reason + "): " + joined(pairs) + "\n";
  return text;
}

Json summaryJson(const verify::Summary& summary) {
  Json json = {{"verified", true},
               {"refusal", nullptr},
               {"segments", summary.segments},
               {"pairs", summary.pairs},
               {"intervals", summary.intervals},
               {"planes", summary.planes},
               {"clearance", finiteOrNull(summary.clearance)}};
  json["not_checked"] = Json::object();
  for (const auto& [reason, pairs] : summary.allowed) json["not_checked"][reason] = pairs;
  return json;
}

}  // namespace

ExitCode runVerify(const Arguments& args) {
  Warnings warnings(args.quiet);
  const Json path = parseOrderedJson(args.verify.path);
  if (!path.is_object() || !path.contains("proof") || path["proof"].is_null())
    throw InputError(args.verify.path, 0, "there is no proof in it");
  try {
    verify::Summary summary;
    {
      Progress progress("verifying", args.quiet);
      summary = examine(args, path, warnings);
    }
    if (args.json)
      std::cout << summaryJson(summary).dump(2) << '\n';
    else
      std::cout << summaryText(summary);
    return ExitCode::Free;
  } catch (const verify::Refusal& refusal) {
    if (args.json)
      std::cout << Json{{"verified", false}, {"refusal", refusal.what()}}.dump(2) << '\n';
    else
      std::cout << "refused: " << refusal.what() << '\n';
    return ExitCode::Collision;
  }
}

}  // namespace swept
