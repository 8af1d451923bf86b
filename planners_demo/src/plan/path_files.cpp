// SPDX-License-Identifier: BSD-3-Clause
#include "plan/path_files.hpp"

#include "command_line/exit_code.hpp"
#include "input/clouds.hpp"
#include "input/states.hpp"
#include "input/unchecked.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

std::string optionText(const std::filesystem::path& file) {
  return "-o '" + file.string() + "'";
}

/// A line for each of what the first two levels hold, and for each pair of a proof: short enough to
/// look at, and to compare.
std::string linesOf(const Json& json) {
  std::string text = "{";
  for (const auto& [key, value] : json.items()) {
    text += (text.size() > 1 ? ",\n " : "\n ") + Json(key).dump() + ": ";
    if (key == "proof" && !value.is_null()) {
      text += "{\n  \"digests\": " + value["digests"].dump() + ",\n  \"segments\": [";
      for (const Json& segment : value["segments"]) {
        text += (text.back() == '[' ? "\n   " : ",\n   ");
        text += "{\"states_digest\": " + segment["states_digest"].dump() + ", \"pairs\": [";
        for (const Json& pair : segment["pairs"])
          text += (text.back() == '[' ? "\n    " : ",\n    ") + pair.dump();
        text += "]}";
      }
      text += "]}";
    } else if (value.is_array()) {
      text += "[";
      for (const Json& item : value) text += (text.back() == '[' ? "\n  " : ",\n  ") + item.dump();
      text += "]";
    } else {
      text += value.dump();
    }
  }
  return text + "\n}\n";
}

std::string jsonText(const Checker& checker, const PlanRequest& request, const PlanOutcome& outcome,
                     const Json& inputs, const Warnings& warnings, const Certificate& certificate,
                     bool embed, const std::string& where) {
  Json json = {{"robot", checker.robot().name()},
               {"group", checker.group().name},
               {"planner", request.planner},
               {"seed", request.seed},
               {"margin", checker.options().margin},
               {"tolerance", checker.options().tolerance},
               {"clouds", cloudsJson(checker.world())},
               {"joint_names", variableNames(checker.robot(), checker.group())}};
  json["states"] = Json::array();
  for (const std::vector<double>& q : outcome.states) json["states"].push_back(toJson(q));
  json["segments"] = Json::array();
  for (const PathSegment& segment : outcome.segments)
    json["segments"].push_back({{"verdict", toString(segment.certificate.verdict)},
                                {"clearance", finiteOrNull(segment.clearance)}});
  addUnchecked(json, checker, warnings);
  json["inputs"] = inputs;
  requireUtf8(json, where);
  if (embed) json["model"] = certificate.model;
  json["proof"] = certificate.proof;
  if (!certificate.proof.is_null()) json["proof"]["digests"]["claims"] = verify::claimDigests(json);
  return linesOf(json);
}

std::string csvText(const Checker& checker, const PlanOutcome& outcome) {
  std::string text;
  for (const std::string& name : variableNames(checker.robot(), checker.group()))
    text.append(text.empty() ? "" : ",").append(csvCell(name));
  text += "\n";
  for (const std::vector<double>& q : outcome.states) {
    for (std::size_t i = 0; i < q.size(); ++i)
      text.append(i == 0 ? "" : ",").append(exactNumber(q[i]));
    text += "\n";
  }
  return text;
}

/// A JSON string is a YAML string too, whatever characters the name has.
std::string quoted(const std::string& name) {
  return Json(name).dump();
}

/// moveit_msgs/RobotTrajectory. A path has no times, so the points have none either.
std::string yamlText(const Checker& checker, const PlanOutcome& outcome) {
  std::string text = "joint_trajectory:\n  joint_names:\n";
  for (const std::string& name : variableNames(checker.robot(), checker.group()))
    text += "    - " + quoted(name) + "\n";
  text += "  points:\n";
  for (const std::vector<double>& q : outcome.states) {
    text += "    - positions: [";
    for (std::size_t i = 0; i < q.size(); ++i)
      text.append(i == 0 ? "" : ", ").append(exactNumber(q[i]));
    text += "]\n";
  }
  return text;
}

bool isYaml(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

void requireOneValuePerJoint(const std::filesystem::path& file, const Robot& robot,
                             const Group& group) {
  for (const int j : group.joints) {
    const JointType type = robot.joints()[j].type;
    if (type == JointType::Planar || type == JointType::Floating)
      throw UsageError("'" + file.string() +
                       "': a joint trajectory has one value per joint, and joint " +
                       robot.joints()[j].name + " has several; use .json or .csv");
  }
}

}  // namespace

PathFile::PathFile(const std::string& file, const Robot& robot, const Group& group) : file_(file) {
  const std::filesystem::path ending = file_.extension();
  if (ending != ".json" && ending != ".csv" && !isYaml(file_))
    throw UsageError("'" + file + "': a path file ends in .json, .csv or .yaml");
  requireWritable(file_);
  if (isYaml(file_)) requireOneValuePerJoint(file_, robot, group);
  if (ending != ".csv") requireUtf8(variableNames(robot, group), optionText(file_));
  if (!holdsProof()) return;
  requireUtf8({robot.name(), group.name}, optionText(file_));
  for (const Link& link : robot.links()) requireUtf8(link.name, optionText(file_));
}

bool PathFile::holdsProof() const {
  return file_.extension() == ".json";
}

void PathFile::write(const Checker& checker, const PlanRequest& request, const PlanOutcome& outcome,
                     const Json& inputs, const Warnings& warnings, const Certificate& certificate,
                     bool embed) const {
  if (holdsProof())
    writeWholeFile(file_, jsonText(checker, request, outcome, inputs, warnings, certificate, embed,
                                   optionText(file_)));
  else if (file_.extension() == ".csv")
    writeWholeFile(file_, csvText(checker, outcome));
  else
    writeWholeFile(file_, yamlText(checker, outcome));
}

}  // namespace swept
