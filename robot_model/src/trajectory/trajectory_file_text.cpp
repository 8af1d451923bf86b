// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <span>
#include <vector>

#include "swept/robot_model/usage_error.hpp"
#include "trajectory/trajectory_text.hpp"

namespace swept::detail {

namespace {

using Rates = std::vector<double> TrajectoryPoint::*;

bool anyHas(const JointTrajectory& trajectory, Rates rates) {
  return std::ranges::any_of(
      trajectory.points, [rates](const TrajectoryPoint& point) { return !(point.*rates).empty(); });
}

/// The columns' names, each once and on one line.
std::vector<std::string> csvHeader(const JointTrajectory& trajectory, const std::string& where) {
  std::vector<std::string> names{"time"};
  const auto add = [&](const char* ending) {
    for (const std::string& name : trajectory.variables) names.push_back(name + ending);
  };
  add("");
  if (anyHas(trajectory, &TrajectoryPoint::velocities)) add("_velocity");
  if (anyHas(trajectory, &TrajectoryPoint::accelerations)) add("_acceleration");
  std::set<std::string> known;
  for (const std::string& name : names) {
    if (!known.insert(name).second)
      throw UsageError(where + ": two columns would have the name '" + name +
                       "'; use .json or .yaml");
    if (name.find('\n') != std::string::npos)
      throw UsageError(where + ": a name has a line end, which a .csv file cannot have; use .json");
  }
  return names;
}

}  // namespace

std::string csvTrajectory(const JointTrajectory& trajectory, const std::string& where) {
  std::string text;
  for (const std::string& name : csvHeader(trajectory, where))
    text.append(text.empty() ? "" : ",").append(csvCell(name));
  const bool velocities = anyHas(trajectory, &TrajectoryPoint::velocities);
  const bool accelerations = anyHas(trajectory, &TrajectoryPoint::accelerations);
  const auto add = [&](const std::vector<double>& values) {
    for (const double value : values) text.append(",").append(exactNumber(value));
    // Of a point that has none, all cells are empty.
    if (values.empty()) text.append(trajectory.variables.size(), ',');
  };
  for (const TrajectoryPoint& point : trajectory.points) {
    text.append("\n").append(exactNumber(point.time));
    add(point.positions);
    if (velocities) add(point.velocities);
    if (accelerations) add(point.accelerations);
  }
  return text + "\n";
}

Json trajectoryJson(const JointTrajectory& trajectory) {
  Json json{{"variables", trajectory.variables}, {"points", Json::array()}};
  for (const TrajectoryPoint& point : trajectory.points) {
    Json entry{{"time", point.time}, {"positions", toJson(std::span(point.positions))}};
    if (!point.velocities.empty()) entry["velocities"] = toJson(std::span(point.velocities));
    if (!point.accelerations.empty())
      entry["accelerations"] = toJson(std::span(point.accelerations));
    json["points"].push_back(std::move(entry));
  }
  return json;
}

std::string jsonTrajectory(const JointTrajectory& trajectory) {
  const Json json = trajectoryJson(trajectory);
  std::string text =
      "{\"trajectory\": {\n \"variables\": " + lineOf(json["variables"]) + ",\n \"points\": [";
  for (const Json& point : json["points"])
    text += (text.back() == '[' ? "\n  " : ",\n  ") + lineOf(point);
  return text + "\n ]}}\n";
}

}  // namespace swept::detail
