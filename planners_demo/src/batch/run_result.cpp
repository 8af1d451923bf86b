// SPDX-License-Identifier: BSD-3-Clause
#include "batch/run_result.hpp"

#include <limits>

#include "output/clearance_text.hpp"

namespace swept {
namespace {

constexpr std::int64_t kLargestCount = std::numeric_limits<int>::max();

Json countJson(const std::optional<std::uint64_t>& count) {
  return count ? Json(*count) : Json(nullptr);
}

std::optional<std::uint64_t> countOf(const JsonValue& json) {
  if (json.isNull()) return {};
  return static_cast<std::uint64_t>(json.whole(0, std::numeric_limits<std::int64_t>::max()));
}

void addNearest(Json& json, const std::string& kind, const std::optional<NearestPair>& pair) {
  json["certified_clearance_" + kind] = pair ? Json(pair->clearance) : Json(nullptr);
  json["nearest_" + kind] = pair ? nearestJson(pair->bodyA, pair->bodyB) : Json(nullptr);
}

/// Files from before the two kinds of pairs were told apart lack these fields.
std::optional<NearestPair> nearestOf(const JsonValue& json, const std::string& kind) {
  const std::string clearance = "certified_clearance_" + kind, nearest = "nearest_" + kind;
  if (!json.has(clearance) || json.at(clearance).isNull()) return {};
  NearestPair pair;
  pair.clearance = json.at(clearance).number();
  if (!json.has(nearest) || json.at(nearest).isNull()) return pair;
  const std::vector<JsonValue> names = json.at(nearest).elements(2);
  pair.bodyA = BodyName(names[0].text());
  pair.bodyB = BodyName(names[1].text());
  return pair;
}

void addPath(Json& json, const PathFacts& path) {
  json["path_length"] = path.length;
  json["segments"] = path.segments;
  json["certified"] = path.certified;
  json["certified_clearance"] = path.clearance ? Json(*path.clearance) : Json(nullptr);
  addNearest(json, "world", path.world);
  addNearest(json, "self", path.self);
  json["missed_collisions"] = path.missedCollisions;
  json["undecided"] = path.undecided;
  json["path"] = path.digest;
  if (path.states.empty()) return;
  json["states"] = Json::array();
  for (const std::vector<double>& q : path.states) json["states"].push_back(toJson(q));
}

void addNoPath(Json& json) {
  for (const char* key : {"path_length", "segments", "certified", "certified_clearance",
                          "certified_clearance_world", "nearest_world", "certified_clearance_self",
                          "nearest_self", "missed_collisions", "undecided", "path"})
    json[key] = nullptr;
}

PathFacts pathOf(const JsonValue& json) {
  PathFacts path;
  path.length = json.at("path_length").notNegative();
  path.segments = static_cast<int>(json.at("segments").whole(0, kLargestCount));
  path.certified = json.at("certified").boolean();
  if (const JsonValue clearance = json.at("certified_clearance"); !clearance.isNull())
    path.clearance = clearance.number();
  path.world = nearestOf(json, "world");
  path.self = nearestOf(json, "self");
  path.missedCollisions = static_cast<int>(json.at("missed_collisions").whole(0, kLargestCount));
  path.undecided = static_cast<int>(json.at("undecided").whole(0, kLargestCount));
  path.digest = json.at("path").text();
  if (!json.has("states")) return path;
  for (const JsonValue& state : json.at("states").elements()) {
    path.states.emplace_back();
    for (const JsonValue& value : state.elements()) path.states.back().push_back(value.number());
  }
  return path;
}

}  // namespace

RunResult stoppedRun(const RunKey& key, const std::string& failure) {
  RunResult result;
  result.key = key;
  result.status = kStopped;
  result.failure = failure;
  return result;
}

Json resultJson(const RunResult& result) {
  Json json = keyJson(result.key);
  json["solved"] = result.solved();
  json["status"] = result.status.empty() ? Json(nullptr) : Json(result.status);
  json["failure"] = result.solved() ? Json(nullptr) : Json(result.failure);
  json["states_checked"] = countJson(result.statesChecked);
  json["motions_checked"] = countJson(result.motionsChecked);
  if (result.path)
    addPath(json, *result.path);
  else
    addNoPath(json);
  if (result.times)
    json["time"] = {{"planning", result.times->planning},
                    {"simplification", result.times->simplification},
                    {"certification", result.times->certification}};
  return json;
}

RunResult resultOf(const JsonValue& json) {
  RunResult result;
  result.key = keyOf(json);
  const bool solved = json.at("solved").boolean();
  if (const JsonValue status = json.at("status"); !status.isNull()) result.status = status.text();
  if (!solved) result.failure = json.at("failure").text();
  result.statesChecked = countOf(json.at("states_checked"));
  result.motionsChecked = countOf(json.at("motions_checked"));
  if (solved) result.path = pathOf(json);
  if (json.has("time")) {
    const JsonValue time = json.at("time");
    result.times = RunTimes{.planning = time.at("planning").notNegative(),
                            .simplification = time.at("simplification").notNegative(),
                            .certification = time.at("certification").notNegative()};
  }
  return result;
}

RunResult resultOfLine(const std::string& line) {
  const std::string source = "a worker's result";
  const nlohmann::json json = parseJsonLine(line, source, 0);
  return resultOf(JsonValue(json, "", source));
}

}  // namespace swept
