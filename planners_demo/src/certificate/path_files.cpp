// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/path_files.hpp"

#include "certificate/model_json.hpp"
#include "certificate/path_json.hpp"
#include "command_line/exit_code.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/trajectory_file.hpp"

namespace swept {
namespace {

std::string optionText(const std::filesystem::path& file) {
  return "-o '" + file.string() + "'";
}

std::string csvText(const Checker& checker, const PathRecord& record) {
  std::string text;
  for (const std::string& name : variableNames(checker.robot(), checker.group()))
    text.append(text.empty() ? "" : ",").append(csvCell(name));
  text += "\n";
  for (const std::vector<double>& q : record.states) {
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
std::string yamlText(const Checker& checker, const PathRecord& record) {
  std::string text = "joint_trajectory:\n  joint_names:\n";
  for (const std::string& name : variableNames(checker.robot(), checker.group()))
    text += "    - " + quoted(name) + "\n";
  text += "  points:\n";
  for (const std::vector<double>& q : record.states) {
    text += "    - positions: [";
    for (std::size_t i = 0; i < q.size(); ++i)
      text.append(i == 0 ? "" : ", ").append(exactNumber(q[i]));
    text += "]\n";
  }
  return text;
}

void requireOneValuePerJoint(const std::filesystem::path& file, const Robot& robot,
                             const Group& group) {
  for (const int j : group.joints) {
    if (detail::valueCount(robot.joints()[j].type) > 1)
      throw UsageError("'" + file.string() +
                       "': a joint trajectory has one value per joint, and joint " +
                       robot.joints()[j].name + " has several; use .json or .csv");
  }
}

}  // namespace

bool isYaml(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

PathFile::PathFile(const std::string& file, const Robot& robot, const Group& group, Content content)
    : file_(file) {
  const std::filesystem::path ending = file_.extension();
  if (ending != ".json" && ending != ".csv" && !isYaml(file_))
    throw UsageError("'" + file + "': a path file ends in .json, .csv or .yaml");
  requireWritable(file_);
  if (isYaml(file_) && content == Content::Path) requireOneValuePerJoint(file_, robot, group);
  if (ending != ".csv") requireUtf8(variableNames(robot, group), optionText(file_));
  if (!holdsProof()) return;
  requireUtf8({robot.name(), group.name}, optionText(file_));
  for (const Link& link : robot.links()) requireUtf8(link.name, optionText(file_));
}

bool PathFile::holdsProof() const {
  return file_.extension() == ".json";
}

void PathFile::requireNames(const Json& inputs, const Checker& checker) const {
  if (!holdsProof()) return;
  requireUtf8(inputs, optionText(file_));
  requireModelNames(checker, optionText(file_));
}

void PathFile::write(const Checker& checker, const PathRecord& record,
                     const Certificate& certificate, bool embed) const {
  if (holdsProof())
    writeWholeFile(file_, pathText(pathJson(checker, record, certificate, embed, optionText(file_)),
                                   optionText(file_)));
  else if (record.trajectory != nullptr)
    writeTrajectory(file_, *record.trajectory, checker.robot(), TrajectoryMessage::Joint);
  else if (file_.extension() == ".csv")
    writeWholeFile(file_, csvText(checker, record));
  else
    writeWholeFile(file_, yamlText(checker, record));
}

PathProof proofOf(const Checker& checker, const JointTrajectory& trajectory,
                  const TrajectoryCertificate& certificate, double clock) {
  PathProof proof{.path = provenPath(trajectory, certificate), .certificate = {}};
  proof.certificate =
      certificateOf(checker, trajectory, proof.path.segments.front().clearance, clock);
  return proof;
}

}  // namespace swept
