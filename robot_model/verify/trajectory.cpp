// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "encoding.hpp"

namespace swept::verify {
namespace {

/// A list of a point, and the name of one of its numbers.
struct PointList {
  const char* key;
  const char* one;
};
constexpr std::array<PointList, 3> kLists = {
    {{"positions", "position"}, {"velocities", "velocity"}, {"accelerations", "acceleration"}}};

std::string pointNumber(std::size_t i) {
  return "point " + std::to_string(i + 1);
}

/// Few digits: one of four billion changes would not be named.
std::string shortDigest(const Json& number) {
  return digestOf(number.dump()).substr(0, 8);
}

Json digestsOfPoint(const Json& point) {
  Json digests = Json::object();
  for (const auto& [key, value] : point.items()) {
    if (!value.is_array()) {
      digests[key] = shortDigest(value);
      continue;
    }
    digests[key] = Json::array();
    for (const Json& number : value) digests[key].push_back(shortDigest(number));
  }
  return digests;
}

/// Names the first of a list's numbers that differs, or the list itself.
void requireSameList(const Json& claimed, const Json& actual, const PointList& list,
                     const Model& model, const std::string& where) {
  const bool was = claimed.contains(list.key), is = actual.contains(list.key);
  if (was != is)
    throw Refusal(where + ", " + list.key +
                  (is ? ": were not there when the path was certified"
                      : ": are not there, and were when the path was certified"));
  if (!was || claimed[list.key] == actual[list.key]) return;
  const Json &before = claimed[list.key], &now = actual[list.key];
  const std::size_t count = model.variables.size();
  if (before.is_array() && now.is_array() && before.size() == count && now.size() == count)
    for (std::size_t i = 0; i < count; ++i)
      if (before[i] != now[i])
        throw Refusal(where + ", " + model.variables[i].name + ", " + list.one + kChanged);
  throw Refusal(where + ", " + list.key + kChanged);
}

/// What is not read has no digest, and seems to mean something.
void requireOnly(const Json& json, const std::vector<std::string>& keys, const std::string& where) {
  if (!json.is_object()) throw Refusal(where + ": not an object");
  for (const auto& [key, value] : json.items())
    if (std::ranges::find(keys, key) == keys.end()) throw Refusal(where + ": it has no " + key);
}

std::vector<double> readValues(const Json& point, const PointList& list, const Model& model,
                               const std::string& where) {
  const Json& json = readList(point, list.key, where);
  if (json.size() != model.variables.size())
    throw Refusal(where + ", " + list.key + ": not one for each of " +
                  std::to_string(model.variables.size()) + " variables");
  std::vector<double> values;
  for (std::size_t i = 0; i < json.size(); ++i)
    values.push_back(readNumber(json[i], where + ", " + model.variables[i].name + ", " + list.one));
  return values;
}

Point readPoint(const Json& json, const Model& model, const std::string& where) {
  requireOnly(json, {"time", "positions", "velocities", "accelerations"}, where);
  Point point;
  point.time = readNumber(at(json, "time", where), where + ", time");
  point.positions = readValues(json, kLists[0], model, where);
  if (json.contains("velocities")) point.velocities = readValues(json, kLists[1], model, where);
  if (json.contains("accelerations"))
    point.accelerations = readValues(json, kLists[2], model, where);
  return point;
}

void requireNames(const Json& names, const Model& model) {
  if (names.size() != model.variables.size())
    throw Refusal("trajectory, variables: not the " + std::to_string(model.variables.size()) +
                  " of the group");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] != model.variables[i].name)
      throw Refusal("trajectory, variables: " + names[i].dump() + " is not " +
                    model.variables[i].name + ", which the group has there");
}

/// At all times between two points, or at one point alone.
void requireWithinLimits(const Point& from, const Point& to, const Model& model,
                         const std::string& where) {
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const Variable& variable = model.variables[i];
    if (!variable.cyclic &&
        !staysWithin(courseOf(from, to, i), variable.lower - kLimit, variable.upper + kLimit))
      throw Refusal(where + ", " + variable.name + ": beyond its limits");
  }
}

}  // namespace

Json pointDigests(const Json& trajectory) {
  Json digests = Json::array();
  for (const Json& point : readList(trajectory, "points", "trajectory"))
    digests.push_back(digestsOfPoint(point));
  return digests;
}

void requireSamePoints(const Json& claimed, const Json& trajectory, const Model& model) {
  const Json actual = pointDigests(trajectory);
  if (!claimed.is_array() || claimed.size() != actual.size())
    throw Refusal("trajectory: it has " + std::to_string(actual.size()) + " points, and " +
                  std::to_string(claimed.size()) + " when the path was certified");
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const std::string where = pointNumber(i);
    if (!claimed[i].is_object()) throw Refusal(where + ": there are no digests of it");
    if (claimed[i].value("time", Json()) != actual[i].value("time", Json()))
      throw Refusal(where + ", time" + kChanged);
    for (const PointList& list : kLists) requireSameList(claimed[i], actual[i], list, model, where);
  }
}

std::vector<Point> readPoints(const Json& trajectory, const Model& model) {
  requireOnly(trajectory, {"variables", "points"}, "trajectory");
  requireNames(readList(trajectory, "variables", "trajectory"), model);
  std::vector<Point> points;
  for (const Json& json : readList(trajectory, "points", "trajectory")) {
    const std::string where = pointNumber(points.size());
    points.push_back(readPoint(json, model, where));
    const Point& own = points.back();
    requireWithinLimits(own, own, model, where);
    if (points.size() == 1) continue;
    const Point& before = points[points.size() - 2];
    if (!(own.time > before.time)) throw Refusal(where + ", time: it is not after the one before");
    requireWithinLimits(before, own, model, pointNumber(points.size() - 2) + " to " + where);
  }
  if (points.size() < 2) throw Refusal("trajectory, points: fewer than two");
  return points;
}

}  // namespace swept::verify
