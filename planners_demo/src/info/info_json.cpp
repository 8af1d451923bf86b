// SPDX-License-Identifier: BSD-3-Clause
#include "info/info.hpp"
#include "input/states.hpp"
#include "output/robot_json.hpp"
#include "output/shape_summary.hpp"

namespace swept {
namespace {

Json coverJson(const CollisionGeometry& geometry) {
  if (geometry.cover == nullptr) return nullptr;
  const SphereCover::Level& finest = geometry.cover->levels.back();
  return {{"balls", finest.ballCount},
          {"overhang", finiteOrNull(finest.largestOverhang)},
          {"inner_balls", geometry.cover->inner.size()},
          {"seconds", geometry.coverSeconds}};
}

Json coverTotalsJson(const Robot& robot) {
  int balls = 0;
  std::size_t inner = 0;
  double seconds = 0.0;
  for (const Link& link : robot.links())
    for (const CollisionGeometry& geometry : link.collision) {
      if (geometry.cover == nullptr) continue;
      balls += geometry.cover->levels.back().ballCount;
      inner += geometry.cover->inner.size();
      seconds += geometry.coverSeconds;
    }
  return {{"balls", balls}, {"inner_balls", inner}, {"seconds", seconds}};
}

Json linksJson(const Robot& robot) {
  Json links = Json::array();
  for (const Link& link : robot.links()) {
    Json collision = Json::array();
    for (const CollisionGeometry& geometry : link.collision) {
      Json shape = shapeJson(geometry.shape);
      shape["source"] = geometry.source;
      shape["cover"] = coverJson(geometry);
      collision.push_back(std::move(shape));
    }
    links.push_back({{"name", link.name}, {"collision", std::move(collision)}});
  }
  return links;
}

Json jointsJson(const Robot& robot) {
  Json joints = Json::array();
  for (std::size_t j = 0; j < robot.joints().size(); ++j) {
    const Joint& joint = robot.joints()[j];
    Json entry = {{"name", joint.name}, {"type", toString(joint.type)}};
    entry["parent"] =
        joint.parentLink < 0 ? Json(nullptr) : Json(robot.links()[joint.parentLink].name);
    entry["child"] = robot.links()[joint.childLink].name;
    entry["variables"] = Json::array();
    for (const Variable& variable : robot.variables())
      if (variable.joint == static_cast<int>(j))
        entry["variables"].push_back(variableJson(variable));
    if (joint.mimic)
      entry["mimic"] = {{"joint", robot.joints()[joint.mimic->master].name},
                        {"multiplier", joint.mimic->multiplier},
                        {"offset", joint.mimic->offset}};
    joints.push_back(std::move(entry));
  }
  return joints;
}

Json groupsJson(const Robot& robot) {
  Json groups = Json::array();
  for (const Group& group : robot.groups()) {
    Json states = Json::object();
    for (const NamedState& state : robot.namedStates()) {
      if (state.group != group.name) continue;
      Json values = Json::object();
      for (const auto& [variable, value] : state.values)
        values[robot.variables()[variable].name] = finiteOrNull(value);
      states[state.name] = std::move(values);
    }
    groups.push_back(
        {{"name", group.name},
         {"tip", group.tipLink < 0 ? Json(nullptr) : Json(robot.links()[group.tipLink].name)},
         {"variables", variableNames(robot, group)},
         {"named_states", std::move(states)}});
  }
  return groups;
}

Json disabledPairsJson(const Robot& robot) {
  Json pairs = Json::array();
  for (const DisabledPair& pair : robot.disabledPairs())
    pairs.push_back({{"link_a", robot.links()[pair.linkA].name},
                     {"link_b", robot.links()[pair.linkB].name},
                     {"reason", pair.reason}});
  return pairs;
}

Json worldJson(const World& world) {
  Json bodies = Json::array();
  for (const WorldBody& body : world.bodies()) {
    Json parts = Json::array();
    for (const WorldBody::Part& part : body.parts) parts.push_back(shapeJson(part.shape));
    bodies.push_back({{"name", body.name}, {"parts", std::move(parts)}});
  }
  for (const MovingObstacle& body : world.obstacles()) {
    Json parts = Json::array();
    for (const MovingObstacle::Part& part : body.parts) parts.push_back(shapeJson(part.shape));
    bodies.push_back({{"name", body.name},
                      {"parts", std::move(parts)},
                      {"moves_from", body.waypoints.front().time},
                      {"moves_until", body.waypoints.back().time}});
  }
  return bodies;
}

Json pairsJson(const std::vector<Checker::Pair>& pairs) {
  Json array = Json::array();
  for (const Checker::Pair& pair : pairs) {
    Json entry = {{"body_a", pair.bodyA},
                  {"body_b", pair.bodyB},
                  {"self", pair.selfPair},
                  {"margin", pair.margin}};
    if (!pair.reason.empty()) entry["reason"] = pair.reason;
    array.push_back(std::move(entry));
  }
  return array;
}

}  // namespace

Json infoJson(const Arguments& args, const Model& model, const Checker* checker) {
  Json json = {{"robot", model.robot->name()}, {"urdf", args.robot}};
  json["srdf"] = model.srdf.file.empty() ? Json(nullptr) : Json(model.srdf.file);
  json["srdf_found_beside_urdf"] = model.srdf.foundBesideUrdf;
  json["links"] = linksJson(*model.robot);
  json["covers"] = coverTotalsJson(*model.robot);
  json["joints"] = jointsJson(*model.robot);
  json["groups"] = groupsJson(*model.robot);
  json["disabled_pairs"] = disabledPairsJson(*model.robot);
  if (!args.scene.empty()) json["scene"] = args.scene;
  if (!args.scene.empty() || !args.clouds.empty()) json["world"] = worldJson(*model.world);
  if (checker != nullptr)
    json["group"] = {{"name", checker->group().name},
                     {"checked_pairs", pairsJson(checker->checkedPairs())},
                     {"skipped_pairs", pairsJson(checker->skippedPairs())},
                     {"standing_contacts", pairsJson(checker->staticContacts())},
                     {"explained", explanations(args, *checker)}};
  return json;
}

}  // namespace swept
