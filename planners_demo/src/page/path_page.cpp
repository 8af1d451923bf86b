// SPDX-License-Identifier: BSD-3-Clause
#include "page/path_page.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "certificate/model_json.hpp"
#include "command_line/commands.hpp"
#include "command_line/exit_code.hpp"
#include "input/inputs.hpp"
#include "io/json_value.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/limits.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

std::string endingOf(const std::string& name) {
  return std::filesystem::path(name).extension().string();
}

/// The first value that is outside; empty: none is.
std::string outsideOf(const Checker& checker, const std::vector<double>& q) {
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = checker.robot().variables()[checker.group().variables[i]];
    if (!isWithin(q[i], variable.lower, variable.upper) && !variable.cyclic)
      return outsideText(variable.name, q[i], variable.lower, variable.upper,
                         unitOf(checker.robot(), variable));
  }
  return {};
}

}  // namespace

void refuseRules(const Arguments& args, const std::string& why) {
  const Arguments none;
  const std::pair<const char*, bool> given[] = {
      {"--srdf", !args.srdf.empty()},
      {"--cloud", !args.clouds.empty()},
      {"--point-radius", args.pointRadius.has_value()},
      {"--cloud-pose", !args.cloudPose.empty()},
      {"--self-filter", args.selfFilter.has_value()},
      {"--occluded", args.occluded.has_value()},
      {"--group", !args.group.empty()},
      {"--joints", !args.joints.empty()},
      {"--chain", !args.chain.empty()},
      {"--keep-default-contacts", args.keepDefaultContacts},
      {"--xacro", args.xacro},
      {"--package", !args.packages.empty()},
      {"--pad", !args.pads.empty()},
      {"--scale", !args.scales.empty()},
      {"--allow", !args.allowed.empty()},
      {"--attach", !args.attached.empty()},
      {"--stand", !args.standing.empty()},
      {"--margin", args.margin != none.margin},
      {"--margin-self", args.selfMargin.has_value()},
      {"--margin-world", args.worldMargin.has_value()},
      {"--tolerance", args.tolerance != none.tolerance},
      {"--problems", !args.problems.empty()},
      {"--time", args.clock.time.has_value()}};
  for (const auto& [name, isGiven] : given)
    if (isGiven) throw UsageError(name + why);
}

namespace {

/// A path file and the files that it names, read.
struct ReadPath {
  Model model;
  Task task;
  std::vector<std::vector<double>> states;
};

void requireProvenModel(const Json& path, const Json& model, const std::string& file) {
  if (!path.contains("proof") || path["proof"].is_null()) return;
  try {
    verify::requireSameModel(path["proof"], model);
  } catch (const verify::Refusal& refusal) {
    throw InputError(
        file, 0, std::string("not the robot and world that it was planned for: ") + refusal.what());
  }
}

/// `model`: becomes what it is checked against.
ReadPath readPath(const Arguments& args, const std::string& file, Json& model, Warnings& warnings) {
  const Json path = parseOrderedJson(file);
  if (!path.is_object() || !path.contains("inputs"))
    throw InputError(file, 0, "no path of swept plan: it does not say which files it is for");
  if (path.contains("trajectory"))
    throw UsageError("'" + file +
                     "' has a trajectory, and paths are shown as straight motions; swept "
                     "trajectory --html shows it");
  const nlohmann::json recorded(path["inputs"]);
  Arguments inputs = inputsOf(JsonValue(recorded, "inputs", file));
  inputs.command = &kPlanCommand;
  inputs.quiet = args.quiet;
  inputs.robot = args.robot;
  if (!args.scene.empty()) inputs.scene = args.scene;
  ReadPath read;
  read.model = loadModel(inputs, warnings);
  read.task = loadTask(inputs, read.model, warnings);
  model = modelJson(*read.task.checker);
  requireProvenModel(path, model, file);
  read.states = pathStates(path, *read.task.checker, file);
  // What proves a path of one state is that the motion which stays there is free.
  if (read.states.size() == 1) read.states.push_back(read.states.front());
  return read;
}

/// Where two models differ, in words.
std::string differenceOf(const Json& a, const Json& b) {
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || b[key] != value) return key;
  return "what is checked";
}

void addPath(PageContent& content, const Checker& checker, const ReadPath& path,
             const std::string& file, std::vector<Finding>& findings) {
  const std::string label = std::filesystem::path(file).filename().string();
  Workspace workspace(checker);
  std::vector<Finding> segments;
  for (std::size_t i = 0; i + 1 < path.states.size(); ++i) {
    content.motions.push_back(
        {.label = "segment " + std::to_string(i + 1),
         .from = path.states[i],
         .to = path.states[i + 1],
         .certificate = checker.certifyMotion(path.states[i], path.states[i + 1], workspace),
         .path = static_cast<int>(content.paths.size())});
    segments.push_back(findingOf(content.motions.back().certificate));
  }
  findings.push_back(worst(segments));
  content.paths.push_back({.label = label, .tone = toneOf(findings.back().verdict)});
}

}  // namespace

std::vector<std::vector<double>> pathStates(const Json& path, const Checker& checker,
                                            const std::string& file) {
  const nlohmann::json plain(path.contains("states") ? path["states"] : Json());
  std::vector<std::vector<double>> states;
  for (const JsonValue& place : JsonValue(plain, "states", file).elements()) {
    std::vector<double> q;
    for (const JsonValue& value : place.elements(checker.group().variables.size()))
      q.push_back(value.number());
    const std::string outside = outsideOf(checker, q);
    if (!outside.empty()) place.fail("holds a value outside its limits: " + outside);
    states.push_back(std::move(q));
  }
  if (states.empty()) throw InputError(file, 0, "states must hold one or more");
  return states;
}

bool namesPaths(const Arguments& args) {
  std::size_t paths = 0;
  for (const std::string& name : args.states) {
    const std::string ending = endingOf(name);
    if (ending == ".csv" || ending == ".yaml" || ending == ".yml")
      throw UsageError("'" + name + "': a path that is shown is a .json file of swept plan");
    paths += ending == ".json";
  }
  if (paths != 0 && paths != args.states.size())
    throw UsageError("paths and states: a page shows either files of paths or states");
  return paths != 0;
}

PathsToView pathsToView(const Arguments& args, Warnings& warnings) {
  refuseRules(args,
              ": a path is shown with what its file says; only --scene may be another file of the "
              "same scene");
  PathsToView view;
  Json first;
  std::vector<Finding> findings;
  for (const std::string& file : args.states) {
    Json model;
    ReadPath path = readPath(args, file, model, warnings);
    if (view.checker == nullptr) {
      first = std::move(model);
      view.model = std::move(path.model);
      view.checker = path.task.checker;
    } else if (model != first) {
      throw InputError(file, 0,
                       "not for the same robot, world and rules as '" + args.states.front() +
                           "': " + differenceOf(first, model) + " differ");
    }
    addPath(view.content, *view.checker, path, file, findings);
  }
  view.content.tone = toneOf(worst(findings).verdict);
  view.content.headline = countsText("path", findings);
  sayIfNothingIsChecked(view.content, *view.checker);
  return view;
}

}  // namespace swept
