// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <vector>

#include "io/trajectory_formats.hpp"

namespace swept::detail {

namespace {

/// Values that a point may leave out, by the list or by an empty one.
std::vector<double> optionalNumbers(const JsonPlace& point, const std::string& key,
                                    std::size_t count) {
  if (!point.value.contains(key)) return {};
  const JsonPlace list = point.at(key);
  return list.elements().empty() ? std::vector<double>() : list.numbers(count);
}

TrajectoryPoint pointOf(const JsonPlace& point, std::size_t count) {
  if (!point.value.is_object()) point.fail("must be an object");
  point.allowOnly({"time", "positions", "velocities", "accelerations"});
  return {.time = point.at("time").number(),
          .positions = point.at("positions").numbers(count),
          .velocities = optionalNumbers(point, "velocities", count),
          .accelerations = optionalNumbers(point, "accelerations", count)};
}

}  // namespace

void readJsonTrajectory(const JsonPlace& trajectory, TrajectoryRows& rows) {
  if (!trajectory.value.is_object()) trajectory.fail("must be an object");
  trajectory.allowOnly({"variables", "points"});
  const std::vector<JsonPlace> variables = trajectory.at("variables").elements();
  std::vector<std::string> names;
  for (const JsonPlace& variable : variables) names.push_back(variable.text());
  const auto failAt = [](const JsonPlace& place) {
    return [&place](const std::string& message) {
      throw InputError(place.file, 0, place.name + ": " + message);
    };
  };
  rows.begin(
      names, [&](std::size_t i, const std::string& message) { variables[i].fail(message); },
      failAt(trajectory));
  const std::vector<JsonPlace> points = trajectory.at("points").elements();
  if (points.empty()) trajectory.at("points").fail("has no point; one is needed");
  for (const JsonPlace& point : points) rows.add(pointOf(point, names.size()), 0, failAt(point));
}

void readJsonTrajectory(const std::string& text, const InputSource& source, TrajectoryRows& rows) {
  const nlohmann::json parsed = parseJson(text, source.name());
  if (!parsed.is_object())
    throw InputError(source.name(), 0, "a file with a trajectory must be an object");
  JsonPlace{parsed, "the file", source.name()}.allowOnly({"trajectory",
                                                          "robot",
                                                          "group",
                                                          "planner",
                                                          "seed",
                                                          "margin",
                                                          "margin_self",
                                                          "margin_world",
                                                          "tolerance",
                                                          "clouds",
                                                          "joint_names",
                                                          "constraints",
                                                          "clock",
                                                          "states",
                                                          "segments",
                                                          "nothing_checked",
                                                          "links_without_geometry",
                                                          "warnings",
                                                          "inputs",
                                                          "model",
                                                          "proof"});
  readJsonTrajectory(JsonPlace{parsed, "", source.name()}.at("trajectory"), rows);
}

}  // namespace swept::detail
