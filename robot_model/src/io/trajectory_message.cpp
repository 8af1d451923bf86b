// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory_message.hpp"

#include <stdexcept>

#include "swept/robot_model/planning_request.hpp"

namespace swept::detail {

namespace {

std::vector<YamlPlace> jointNamesIn(const YamlPlace& trajectory) {
  if (!trajectory.present()) return {};
  if (!trajectory.isMap()) trajectory.fail("must be a mapping");
  trajectory.allowOnly({"header", "joint_names", "points"});
  return trajectory.at("joint_names").elements();
}

std::vector<YamlPlace> pointsIn(const YamlPlace& trajectory) {
  if (!trajectory.present()) return {};
  return trajectory.at("points").elements();
}

}  // namespace

void requireAsMany(const YamlPlace& place, std::size_t count, const std::string& what,
                   std::size_t wanted, const std::string& of) {
  if (count != wanted)
    place.fail("has " + std::to_string(count) + " " + what + " and " + std::to_string(wanted) +
               " " + of);
}

void failWithoutPoint(const YamlPlace& place) {
  place.fail(std::string(place.name().empty() ? "there is" : "has") + " no point; one is needed");
}

FailAt MessagePart::failAtPoint(std::size_t i) const {
  return [place = point(i)](const std::string& message) {
    place.called(place.name() + ":").fail(message);
  };
}

MessageReader::MessageReader(const InputSource& source, const Robot& robot, const char* reader)
    : robot_(robot), frames_(source, reader) {
  frames_.addStillLinks(robot);
}

MessageParts MessageReader::message(const YamlPlace& root) const {
  if (!root.isMap()) root.fail("a trajectory must be a mapping");
  if (root.at("trajectory").present() || root.at("trajectory_start").present())
    return displayOf(root);
  MessageParts message;
  if (root.at("points").present() || root.at("joint_names").present())
    message.parts.push_back(partOf(root, root, root.at("multi_dof_joint_trajectory")));
  else
    message.parts.push_back(robotPart(root));
  return message;
}

MessageParts MessageReader::displayOf(const YamlPlace& root) const {
  root.allowOnly({"model_id", "trajectory", "trajectory_start"});
  MessageParts message{.parts = {}, .start = {}, .displayed = root.at("trajectory")};
  for (const YamlPlace& part : message.displayed->elements())
    message.parts.push_back(robotPart(part));
  if (const YamlPlace start = root.at("trajectory_start"); start.present())
    message.start.emplace(start);
  return message;
}

MessagePart MessageReader::robotPart(const YamlPlace& robot) const {
  if (!robot.isMap()) robot.fail("must be a mapping");
  robot.allowOnly({"joint_trajectory", "multi_dof_joint_trajectory"});
  return partOf(robot, robot.at("joint_trajectory"), robot.at("multi_dof_joint_trajectory"));
}

MessagePart MessageReader::partOf(const YamlPlace& whole, const YamlPlace& joints,
                                  const YamlPlace& bases) const {
  MessagePart part{.whole = whole,
                   .names = jointNamesIn(joints),
                   .points = pointsIn(joints),
                   .bases = bases,
                   .poses = {}};
  if (!jointNamesIn(bases).empty()) {
    requireBasesInModelFrame(bases, frames_);
    part.poses = pointsIn(bases);
  }
  if (!part.points.empty() && !part.poses.empty())
    requireAsMany(bases, part.poses.size(), "points", part.points.size(),
                  "are those of joint_trajectory");
  return part;
}

std::vector<double> MessageReader::positions(const MessagePart& part, std::size_t i) const {
  std::vector<double> values;
  if (!part.points.empty()) {
    const YamlPlace& point = part.points[i];
    if (!point.isMap()) point.fail("must be a mapping");
    point.allowOnly({"positions", "velocities", "accelerations", "effort", "time_from_start"});
    const std::vector<YamlPlace> positions = point.at("positions").elements();
    requireAsMany(point, positions.size(), "positions", part.names.size(), "joint_names");
    for (const YamlPlace& position : positions) values.push_back(position.number());
  }
  for (const auto& [name, value] : baseValues(part, i)) values.push_back(value);
  return values;
}

std::vector<std::string> MessageReader::columnNames(const MessagePart& part) const {
  std::vector<std::string> names;
  if (!part.points.empty())
    for (const YamlPlace& name : part.names) names.push_back(name.text());
  if (part.size() > 0)
    for (const auto& [name, value] : baseValues(part, 0)) names.push_back(name);
  return names;
}

FailAtColumn MessageReader::failAtColumn(const MessagePart& part) {
  return [&part](std::size_t i, const std::string& message) {
    const bool isJoint = !part.points.empty() && i < part.names.size();
    (isJoint ? part.names[i] : part.bases).fail(message);
  };
}

MessageReader::Values MessageReader::baseValues(const MessagePart& part, std::size_t i) const {
  if (part.poses.empty()) return {};
  const YamlPlace& point = part.poses[i];
  if (!point.isMap()) point.fail("must be a mapping");
  point.allowOnly({"transforms", "velocities", "accelerations", "time_from_start"});
  const std::vector<YamlPlace> names = part.bases.at("joint_names").elements();
  const std::vector<YamlPlace> transforms = point.at("transforms").elements();
  requireAsMany(point, transforms.size(), "transforms", names.size(), "joint_names");
  std::vector<BasePose> poses;
  for (std::size_t k = 0; k < names.size(); ++k)
    poses.push_back({names[k].text(), transforms[k].pose("translation", "rotation")});
  return valuesOf(point, poses);
}

MessageReader::Values MessageReader::valuesOf(const YamlPlace& place,
                                              const std::vector<BasePose>& poses) const {
  PlanningRequest request;
  for (const BasePose& base : poses) request.bases.push_back({base.joint, base.parent_from_child});
  try {
    return request.startOf(robot_);
  } catch (const std::invalid_argument& error) {
    place.called(place.name() + ":").fail(error.what());
  }
}

void MessageReader::requireStart(const YamlPlace& start, GroupColumns columns,
                                 const std::vector<double>& first) const {
  allowRobotState(start);
  if (const auto held = start.at("attached_collision_objects").elements(); !held.empty())
    held[0].fail("is not taken from a path; attached objects are those of the scene");
  const YamlPlace joints = start.at("joint_state");
  std::vector<YamlPlace> given, positions;
  if (joints.present()) {
    given = joints.at("name").elements();
    positions = joints.at("position").elements();
    requireAsMany(joints, given.size(), "names", positions.size(), "positions");
  }
  std::vector<std::string> names;
  std::vector<double> values;
  for (const YamlPlace& name : given) names.push_back(name.text());
  for (const YamlPlace& position : positions) values.push_back(position.number());
  const YamlPlace bases = start.at("multi_dof_joint_state");
  requireBasesInModelFrame(bases, frames_);
  for (const auto& [name, value] : valuesOf(bases, readBasePoses(bases))) {
    names.push_back(name);
    values.push_back(value);
  }
  columns.set(names, [&](std::size_t i, const std::string& message) {
    (i < given.size() ? given[i] : bases).fail(message);
  });
  columns.requireLike(values, first, "the first point has it", [&](const std::string& message) {
    start.called("trajectory_start:").fail(message);
  });
}

void MessageReader::requireGoesOn(const MessagePart& part, const GroupColumns& columns,
                                  const std::vector<double>& end,
                                  const std::vector<double>& begin) {
  if (!columns.areAlike(end, begin))
    part.whole.fail("begins elsewhere than the one before it ends; a path goes on where it is");
}

}  // namespace swept::detail
