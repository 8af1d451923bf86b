// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/task_proof.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "certificate/checked_proof.hpp"
#include "certificate/model_json.hpp"
#include "certificate/path_json.hpp"
#include "certificate/stopping.hpp"
#include "certificate/trajectory_json.hpp"
#include "certificate/trajectory_proof.hpp"
#include "io/json_value.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "verify/check.hpp"
#include "verify/task.hpp"

namespace swept {
namespace {

constexpr std::array<std::pair<TaskChange::Kind, const char*>, 3> kChanges = {
    {{TaskChange::Kind::Attached, "attached"},
     {TaskChange::Kind::Placed, "placed"},
     {TaskChange::Kind::Sensed, "sensed"}}};

Json changesJson(const std::vector<TaskChange>& changes) {
  Json json = Json::array();
  for (const TaskChange& change : changes)
    for (const auto& [kind, name] : kChanges)
      if (kind == change.kind) json.push_back({{"body", change.body}, {"change", name}});
  return json;
}

Json phaseJson(const TaskPhase& phase, Json path) {
  Json json = {{"phase", phase.name}, {"changes", changesJson(phase.changes)}};
  json["path"] = std::move(path);
  json["digest"] = verify::phaseDigest(json);
  return json;
}

/// Each path in the lines that it has in a file of its own.
std::string taskText(const Json& task, const std::string& where) {
  std::string text = "{\n\"robot\": " + task["robot"].dump() + ",\n\"phases\": [";
  for (const Json& phase : task["phases"]) {
    text += text.back() == '[' ? "\n" : ",\n";
    text += "{\"phase\": " + phase["phase"].dump() + ",\n\"changes\": " + phase["changes"].dump() +
            ",\n\"path\": " + pathLines(phase["path"]);
    text += ",\"digest\": " + phase["digest"].dump() + "}";
  }
  text += "],\n\"digest\": " + task["digest"].dump() + "\n}\n";
  if (text.size() > kMaxTextBytes)
    throw UsageError(where + ": with its proofs the task takes " + std::to_string(text.size()) +
                     " bytes, and files of more than " + std::to_string(kMaxTextBytes) +
                     " are not read; tasks of fewer phases are smaller");
  return text;
}

TaskChange changeOf(const JsonValue& json) {
  const std::string name = json.at("change").text();
  for (const auto& [kind, own] : kChanges)
    if (name == own) return {.kind = kind, .body = json.at("body").text()};
  json.at("change").refuse("attached, placed or sensed");
}

Json taskOf(const std::filesystem::path& file) {
  Json task = parseOrderedJson(file.string());
  if (!task.is_object() || !task.contains("phases"))
    throw InputError(file.string(), 0, "it is no task: there are no phases");
  return task;
}

}  // namespace

JointTrajectory delayed(JointTrajectory trajectory, double seconds) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return delayed(std::move(trajectory), seconds); });
  for (TrajectoryPoint& point : trajectory.points) point.time += seconds;
  return trajectory;
}

WrittenProof writeTask(const std::filesystem::path& file, std::span<const TaskPhase> phases,
                       const std::stop_token& stop) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&, phases] { return writeTask(file, phases, stop); });
  const std::string where = "'" + file.string() + "'";
  if (file.extension() != ".json") throw UsageError(where + ": a file with a proof ends in .json");
  if (phases.empty()) throw UsageError(where + ": a task has one phase or more");
  requireWritable(file);
  Json task = {{"robot", nullptr}, {"phases", Json::array()}};
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const TaskPhase& phase = phases[i];
    const std::string number = "phase " + std::to_string(i + 1) + " (" + phase.name + ")";
    if (phase.checker == nullptr) throw std::invalid_argument(number + " has no checker");
    std::string missing;
    Json path = trajectoryProof(*phase.checker, phase.trajectory, phase.certificate, phase.warnings,
                                0.0, where + ", " + number, missing, stop);
    if (!missing.empty()) return {.missing = number + ", " + missing};
    requireUtf8({phase.name, changesJson(phase.changes)}, where);
    if (i == 0) task["robot"] = path["robot"];
    task["phases"].push_back(phaseJson(phase, std::move(path)));
  }
  throwIfStopped(stop);
  task["digest"] = verify::taskDigest(task);
  try {
    verify::checkTask(task, pauseOf(stop));
  } catch (const verify::Refusal& refusal) {
    throw UsageError(where + ": " + refusal.what());
  }
  writeWholeFile(file, taskText(task, where));
  return {};
}

CheckedTask verifyTask(const std::filesystem::path& file, const std::stop_token& stop) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return verifyTask(file, stop); });
  const Json task = taskOf(file);
  CheckedTask checked;
  try {
    for (const verify::PhaseSummary& phase : verify::checkTask(task, pauseOf(stop)))
      checked.phases.push_back({.name = phase.name,
                                .group = phase.group,
                                .begin = phase.begin,
                                .end = phase.end,
                                .changes = phase.changes,
                                .proof = checkedProof(phase.proof)});
  } catch (const verify::Refusal& refusal) {
    checked = {.refusal = refusal.what(), .phases = {}};
  }
  return checked;
}

std::vector<TaskStep> readTask(const std::filesystem::path& file) {
  if (detail::inForeignEnvironment()) return inDefaultEnvironment([&] { return readTask(file); });
  const std::string name = file.string();
  const nlohmann::json json(taskOf(file));
  std::vector<TaskStep> steps;
  for (const JsonValue& phase : JsonValue(json["phases"], "phases", name).elements()) {
    const JsonValue path = phase.at("path");
    TaskStep step{.name = phase.at("phase").text(),
                  .group = path.at("group").text(),
                  .trajectory = trajectoryOf(path.at("trajectory")),
                  .changes = {}};
    for (const JsonValue& change : phase.at("changes").elements())
      step.changes.push_back(changeOf(change));
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace swept
