// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/trajectory_json.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "robot/joint_types.hpp"

namespace swept {
namespace {

std::vector<double> numbersOf(const JsonValue& point, const char* key, std::size_t count) {
  std::vector<double> numbers;
  if (!point.has(key)) return numbers;
  for (const JsonValue& number : point.at(key).elements(count)) numbers.push_back(number.number());
  return numbers;
}

}  // namespace

Json trajectoryJson(const JointTrajectory& trajectory) {
  Json json = {{"variables", trajectory.variables}, {"points", Json::array()}};
  for (const TrajectoryPoint& point : trajectory.points) {
    Json own = {{"time", point.time}, {"positions", toJson(point.positions)}};
    if (!point.velocities.empty()) own["velocities"] = toJson(point.velocities);
    if (!point.accelerations.empty()) own["accelerations"] = toJson(point.accelerations);
    json["points"].push_back(std::move(own));
  }
  return json;
}

Json trackingJson(const Checker& checker) {
  const TrackingTolerance& tracking = checker.options().tracking;
  Json json = Json::object();
  for (const int index : checker.group().joints) {
    const Joint& joint = checker.robot().joints()[static_cast<std::size_t>(index)];
    const auto own = tracking.joints.find(joint.name);
    const JointTolerance& tolerance = own == tracking.joints.end() ? tracking : own->second;
    Json entry = Json::object();
    if (!detail::slidesWithinLimits(joint.type) && tolerance.rotation > 0.0)
      entry["rotation"] = tolerance.rotation;
    if (!detail::turns(joint.type) && tolerance.translation > 0.0)
      entry["translation"] = tolerance.translation;
    if (!entry.empty()) json[joint.name] = std::move(entry);
  }
  return json;
}

JointTrajectory trajectoryOf(const JsonValue& json) {
  JointTrajectory trajectory;
  for (const JsonValue& name : json.at("variables").elements())
    trajectory.variables.push_back(name.text());
  const std::size_t count = trajectory.variables.size();
  for (const JsonValue& point : json.at("points").elements())
    trajectory.points.push_back({.time = point.at("time").number(),
                                 .positions = numbersOf(point, "positions", count),
                                 .velocities = numbersOf(point, "velocities", count),
                                 .accelerations = numbersOf(point, "accelerations", count)});
  try {
    static_cast<void>(controllerCurve(trajectory));
  } catch (const std::invalid_argument& error) {
    json.fail(std::string("is no trajectory: ") + error.what());
  }
  return trajectory;
}

}  // namespace swept
