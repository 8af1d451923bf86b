// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/model_json.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "certificate/shape_json.hpp"
#include "certificate/trajectory_json.hpp"
#include "output/robot_json.hpp"
#include "robot/joint_types.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;

using Names = std::map<std::string, std::string>;

/// Names of the world's bodies in a proof, by their own names, which may be those of links.
Names proofNamesInWorld(const Checker& checker) {
  std::set<std::string> taken;
  for (const Link& link : checker.robot().links()) taken.insert(link.name);
  for (const AttachedBody& body : checker.options().attached) taken.insert(body.name);
  for (const WorldBody& body : checker.world().bodies()) taken.insert(body.name);
  Names names;
  for (const MovingObstacle& body : checker.world().obstacles()) {
    taken.insert(body.name);  // it is no link's
    names[body.name] = body.name;
  }
  for (const WorldBody& body : checker.world().bodies()) {
    std::string name = body.name;
    if (checker.robot().findLink(name))
      while (!taken.insert(name).second) name += " (world)";
    names[body.name] = name;
  }
  return names;
}

/// Where the joint's values come from: the group's variables, or those that stay as they are.
void addValues(const Checker& checker, const Joint& joint, Json& json) {
  const Robot& robot = checker.robot();
  const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
  const std::vector<int>& variables = checker.group().variables;
  const auto found = std::ranges::find(variables, source.firstVariable);
  const double multiplier = joint.mimic ? joint.mimic->multiplier : 1.0;
  const double offset = joint.mimic ? joint.mimic->offset : 0.0;
  if (joint.type != JointType::Fixed && found != variables.end()) {
    json["variable"] = static_cast<std::size_t>(found - variables.begin());
    json["multiplier"] = multiplier;
    json["offset"] = offset;
    return;
  }
  const Eigen::VectorXd reference = checker.options().reference.value_or(robot.defaultState());
  json["variable"] = nullptr;
  json["values"] = Json::array();
  for (int i = 0; i < detail::valueCount(joint.type); ++i)
    json["values"].push_back(multiplier * reference[source.firstVariable + i] + offset);
}

Json jointJson(const Checker& checker, const Joint& joint) {
  const std::vector<Link>& links = checker.robot().links();
  Json json = {{"name", joint.name}, {"type", toString(joint.type)}};
  json["parent"] = joint.parentLink < 0 ? Json(nullptr) : Json(links[joint.parentLink].name);
  json["child"] = links[joint.childLink].name;
  json["pose"] = poseJson(joint.parent_from_joint);
  json["axis"] = toJson(joint.axis);
  if (joint.type == JointType::Planar)
    json["planar_x"] = toJson(Eigen::Vector3d(axisFrame(joint.axis).col(0)));
  addValues(checker, joint, json);
  return json;
}

Json waypointJson(double time, const Isometry3d& world_from_body) {
  const Eigen::Quaterniond turn(world_from_body.linear());
  return {{"time", time},
          {"position", toJson(Eigen::Vector3d(world_from_body.translation()))},
          {"orientation", {turn.x(), turn.y(), turn.z(), turn.w()}}};
}

/// s. In the middle of the turn from one waypoint to the next, if that is by about half a turn: its
/// ends do not tell the verifier which way round. The checker divides such a turn there, too.
std::optional<double> middleOfHalfTurn(const MovingObstacle::Waypoint& from,
                                       const MovingObstacle::Waypoint& to) {
  constexpr double kWidest = 3.0;  // rad; the verifier takes a little more
  const Eigen::Quaterniond turn(from.world_from_body.linear());
  if (turn.angularDistance(Eigen::Quaterniond(to.world_from_body.linear())) <= kWidest)
    return std::nullopt;
  return 0.5 * from.time + 0.5 * to.time;
}

/// The orientations that the checker interpolates between.
Json waypointsJson(const MovingObstacle& obstacle) {
  const std::vector<MovingObstacle::Waypoint>& waypoints = obstacle.waypoints;
  Json list = Json::array();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const std::optional<double> middle =
        i == 0 ? std::nullopt : middleOfHalfTurn(waypoints[i - 1], waypoints[i]);
    if (middle) list.push_back(waypointJson(*middle, obstacle.poseAt(*middle)));
    list.push_back(waypointJson(waypoints[i].time, waypoints[i].world_from_body));
  }
  return list;
}

Json bodyJson(const Checker& checker, const CertifiedBody& body) {
  Json json = {{"name", body.proofName}};
  if (body.moving != nullptr)
    json["waypoints"] = waypointsJson(*body.moving);
  else
    json["link"] = body.link < 0 ? Json(nullptr) : Json(checker.robot().links()[body.link].name);
  json["shapes"] = Json::array();
  for (const CertifiedBody::Part& part : body.parts) {
    json["shapes"].push_back(exactShapeJson(part.shape));
    json["shapes"].back()["pose"] = poseJson(part.body_from_shape);
  }
  return json;
}

/// Joints and links that the group does not move need no rule: the verifier leaves them out by
/// itself.
bool isAllowed(const Checker::Pair& pair) {
  for (const char* word : {"allowed", "SRDF", "touch link", "attached to"})
    if (pair.reason.starts_with(word)) return true;
  return false;
}

Json allowedJson(const Checker& checker) {
  const Names namesInWorld = proofNamesInWorld(checker);
  Json allowed = Json::array();
  for (const Checker::Pair& pair : checker.skippedPairs()) {
    if (!isAllowed(pair)) continue;
    allowed.push_back(
        {pair.bodyA, pair.selfPair ? pair.bodyB : namesInWorld.at(pair.bodyB), pair.reason});
  }
  return allowed;
}

/// Links that a joint connects and that are checked all the same. The verifier would leave them out
/// by itself.
Json askedJson(const Checker& checker) {
  std::set<std::pair<std::string, std::string>> connected;
  for (const Joint& joint : checker.robot().joints()) {
    if (joint.parentLink < 0) continue;
    const std::string& parent = checker.robot().links()[joint.parentLink].name;
    const std::string& child = checker.robot().links()[joint.childLink].name;
    connected.insert({parent, child});
    connected.insert({child, parent});
  }
  Json asked = Json::array();
  for (const Checker::Pair& pair : checker.checkedPairs())
    if (pair.selfPair && connected.contains({pair.bodyA, pair.bodyB}))
      asked.push_back({pair.bodyA, pair.bodyB});
  return asked;
}

}  // namespace

Json poseJson(const Isometry3d& pose) {
  Json numbers = Json::array();
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      numbers.push_back(pose.linear()(row, column));
  for (Eigen::Index row = 0; row < 3; ++row) numbers.push_back(pose.translation()[row]);
  return numbers;
}

std::vector<CertifiedBody> certifiedBodies(const Checker& checker) {
  const CollisionRules& rules = checker.options().rules;
  const Names namesInWorld = proofNamesInWorld(checker);
  std::vector<CertifiedBody> bodies;
  const auto add = [&](const std::string& name, int link, const auto& parts, auto&& poseOf,
                       const MovingObstacle* moving = nullptr) {
    if (parts.empty()) return;
    CertifiedBody body{.name = name,
                       .proofName = link < 0 ? namesInWorld.at(name) : name,
                       .link = link,
                       .parts = {},
                       .moving = moving};
    for (const auto& part : parts) {
      const double factor = rules.scale(name);
      body.parts.push_back({factor == 1.0 ? part.shape : scaled(part.shape, factor), poseOf(part)});
    }
    bodies.push_back(std::move(body));
  };
  const std::vector<Link>& links = checker.robot().links();
  for (std::size_t i = 0; i < links.size(); ++i)
    add(links[i].name, static_cast<int>(i), links[i].collision,
        [](const CollisionGeometry& part) { return part.link_from_shape; });
  for (const AttachedBody& body : checker.options().attached)
    add(body.name, *checker.robot().findLink(body.link), body.parts,
        [](const AttachedBody::Part& part) { return part.link_from_shape; });
  for (const WorldBody& body : checker.world().bodies())
    add(body.name, -1, body.parts,
        [](const WorldBody::Part& part) { return part.world_from_shape; });
  for (const MovingObstacle& body : checker.world().obstacles())
    add(
        body.name, -1, body.parts,
        [](const MovingObstacle::Part& part) { return part.body_from_shape; }, &body);
  return bodies;
}

Json modelJson(const Checker& checker) {
  const Robot& robot = checker.robot();
  Json json = {{"links", Json::array()}, {"variables", Json::array()}, {"joints", Json::array()}};
  for (const Link& link : robot.links()) json["links"].push_back(link.name);
  for (const int v : checker.group().variables)
    json["variables"].push_back(variableJson(robot.variables()[v]));
  for (const Joint& joint : robot.joints()) json["joints"].push_back(jointJson(checker, joint));
  json["bodies"] = Json::array();
  json["margin"] = checker.options().margin;
  if (checker.options().selfMargin) json["margin_self"] = *checker.options().selfMargin;
  if (checker.options().worldMargin) json["margin_world"] = *checker.options().worldMargin;
  json["paddings"] = Json::object();
  for (const CertifiedBody& body : certifiedBodies(checker)) {
    json["bodies"].push_back(bodyJson(checker, body));
    const double padding = checker.options().rules.padding(body.name);
    if (padding != 0.0) json["paddings"][body.proofName] = padding;
  }
  json["allowed"] = allowedJson(checker);
  Json asked = askedJson(checker);
  if (!asked.empty()) json["asked"] = std::move(asked);
  Json tracking = trackingJson(checker);
  if (!tracking.empty()) json["tracking"] = std::move(tracking);
  return json;
}

void requireTimesOfTurns(const Checker& checker) {
  for (const MovingObstacle& obstacle : checker.world().obstacles())
    for (std::size_t i = 1; i < obstacle.waypoints.size(); ++i) {
      const MovingObstacle::Waypoint &from = obstacle.waypoints[i - 1], &to = obstacle.waypoints[i];
      const std::optional<double> middle = middleOfHalfTurn(from, to);
      if (!middle || (from.time < *middle && *middle < to.time)) continue;
      throw UsageError("'" + obstacle.name + "' turns by about half a turn from waypoint " +
                       std::to_string(i) + " to the next, and no time is between the two");
    }
}

void requireStanding(const Checker& checker, const std::string& what) {
  const std::vector<MovingObstacle>& moving = checker.world().obstacles();
  if (moving.empty()) return;
  throw UsageError("there is no proof of " + what + " beside '" + moving.front().name +
                   "', which moves");
}

void requireModelNames(const Checker& checker, const std::string& where) {
  for (const Link& link : checker.robot().links()) requireUtf8(link.name, where);
  for (const Joint& joint : checker.robot().joints()) requireUtf8(joint.name, where);
  for (const AttachedBody& body : checker.options().attached) requireUtf8(body.name, where);
  for (const WorldBody& body : checker.world().bodies()) requireUtf8(body.name, where);
  for (const MovingObstacle& body : checker.world().obstacles()) requireUtf8(body.name, where);
  requireUtf8(allowedJson(checker), where);
}

}  // namespace swept
