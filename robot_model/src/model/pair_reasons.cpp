// SPDX-License-Identifier: BSD-3-Clause
#include "model/pair_reasons.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

using CollisionBodyPair = std::pair<int, int>;

/// Pairs with reasons; the first reason counts. Without the pairs that the SRDF enables.
std::map<CollisionBodyPair, std::string> disabledReasons(const PairModel& model) {
  std::map<CollisionBodyPair, std::string> reasons;
  const Robot& robot = *model.robot;
  for (const Joint& joint : robot.joints()) {
    if (joint.parentLink < 0) continue;
    reasons.emplace(std::minmax(joint.parentLink, joint.childLink),
                    "adjacent: joint " + joint.name);
  }
  for (const DisabledPair& pair : robot.disabledPairs())
    reasons.emplace(std::minmax(pair.linkA, pair.linkB),
                    pair.reason.empty() ? "SRDF" : "SRDF: " + pair.reason);
  for (std::size_t i = 0; i < model.options.attached.size(); ++i) {
    const AttachedBody& body = model.options.attached[i];
    const auto collisionBody = static_cast<int>(robot.links().size() + i);
    reasons.emplace(CollisionBodyPair(*robot.findLink(body.link), collisionBody),
                    "attached to " + body.link);
    for (const std::string& touch : body.touchLinks)
      for (std::size_t link = 0; link < robot.links().size(); ++link)
        if (matches(touch, robot.links()[link].name))
          reasons.emplace(CollisionBodyPair(static_cast<int>(link), collisionBody),
                          "touch link of " + body.name);
  }
  for (const EnabledPair& pair : robot.enabledPairs())
    reasons.erase(std::minmax(pair.linkA, pair.linkB));
  return reasons;
}

const std::string& nameOfB(const PairModel& model, const BodyPair& pair) {
  return pair.ofRobot ? model.collisionBodies[pair.b].name : model.world->bodies()[pair.b].name;
}

std::string reasonOf(const PairModel& model, const BodyPair& pair,
                     const std::map<CollisionBodyPair, std::string>& disabled) {
  switch (pair.reason) {
    case PairReason::Checked:
      return pair.never ? "never: proven apart within the joints' limits" : "";
    case PairReason::Allowed: {
      const auto* rule = model.options.rules.find(
          CollisionRules::Kind::Allow, model.collisionBodies[pair.a].name, nameOfB(model, pair));
      return rule->reason.empty() ? "allowed" : "allowed: " + rule->reason;
    }
    case PairReason::Disabled:
      return disabled.at({pair.a, pair.b});
    case PairReason::Unmoved:
      return "not moved by the group";
    case PairReason::Rigid:
      return "rigid: the group does not change their relative pose";
    case PairReason::OutOfReach:
      return "out of reach";
  }
  return {};
}

Checker::Pair listed(const PairModel& model, const BodyPair& pair,
                     const std::map<CollisionBodyPair, std::string>& disabled) {
  Checker::Pair result;
  result.bodyA = model.collisionBodies[pair.a].name;
  result.bodyB = nameOfB(model, pair);
  result.selfPair =
      pair.ofRobot && model.collisionBodies[pair.b].kind != CollisionBody::Kind::Obstacle;
  result.margin = pair.margin;
  result.reason = reasonOf(model, pair, disabled);
  return result;
}

std::string metres(double value) {
  std::ostringstream text;
  text << value << " m";
  return text.str();
}

/// The terms of the margin.
std::string marginText(const PairModel& model, const Checker::Pair& pair) {
  const CollisionRules& rules = model.options.rules;
  std::string text = metres(pair.margin);
  if (rules.find(CollisionRules::Kind::Margin, pair.bodyA, pair.bodyB) != nullptr)
    return text + " (a rule about the pair)";
  std::string parts;
  for (const std::string* name : {&pair.bodyA, &pair.bodyB})
    if (const double padding = rules.padding(*name); padding > 0.0)
      parts += ", padding of " + *name + " " + metres(padding);
  return parts.empty()
             ? text
             : text + " (margin " + metres(model.options.marginOf(pair.selfPair)) + parts + ")";
}

/// Says which rule checks the pair, if it is not only the default.
std::string asked(const PairModel& model, std::string_view bodyA, std::string_view bodyB) {
  if (const auto* rule = model.options.rules.decisive(bodyA, bodyB))
    return rule->reason.empty() ? " (a rule asks for it)" : " (" + rule->reason + ")";
  const Robot& robot = *model.robot;
  const bool enabled = std::ranges::any_of(robot.enabledPairs(), [&](const EnabledPair& pair) {
    const std::string_view a = robot.links()[pair.linkA].name;
    const std::string_view b = robot.links()[pair.linkB].name;
    return (a == bodyA && b == bodyB) || (a == bodyB && b == bodyA);
  });
  return enabled ? " (SRDF: enable_collisions)" : "";
}

/// Whether there is a body with this name, and whether it has geometry.
bool hasGeometry(const PairModel& model, std::string_view name) {
  const auto collisionBody = std::ranges::find(model.collisionBodies, name, &CollisionBody::name);
  if (collisionBody != model.collisionBodies.end()) {
    const auto index = static_cast<int>(collisionBody - model.collisionBodies.begin());
    return std::ranges::any_of(model.robotGeometry, [index](const RobotGeometry& geometry) {
      return geometry.collisionBody == index;
    });
  }
  if (const WorldBody* body = model.world->find(name)) return !body->parts.empty();
  throw std::invalid_argument("Checker: '" + std::string(name) +
                              "' is no link, attached body or body of the world");
}

bool isRobots(const PairModel& model, std::string_view name) {
  const auto collisionBody = std::ranges::find(model.collisionBodies, name, &CollisionBody::name);
  return collisionBody != model.collisionBodies.end() &&
         collisionBody->kind != CollisionBody::Kind::Obstacle;
}

}  // namespace

std::set<CollisionBodyPair> disabledCarriers(const PairModel& model) {
  std::set<CollisionBodyPair> pairs;
  for (const auto& [pair, reason] : disabledReasons(model)) pairs.insert(pair);
  return pairs;
}

const PairLists& pairLists(const PairModel& model) {
  PairLists& lists = *model.lists;
  std::call_once(lists.made, [&] {
    const std::map<CollisionBodyPair, std::string> disabled = disabledReasons(model);
    for (const BodyPair& pair : model.bodyPairs) {
      Checker::Pair entry = listed(model, pair, disabled);
      if (pair.touching) lists.standing.push_back(entry);
      const bool checked = pair.reason == PairReason::Checked;
      (checked ? lists.checked : lists.skipped).push_back(std::move(entry));
    }
  });
  return lists;
}

std::string explainPair(const PairModel& model, std::string_view bodyA, std::string_view bodyB) {
  const std::string both = std::string(bodyA) + " - " + std::string(bodyB) + ": ";
  for (const std::string_view name : {bodyA, bodyB})
    if (!hasGeometry(model, name))
      return both + "not checked, " + std::string(name) + " has no collision geometry";
  if (bodyA == bodyB) return both + "not checked, one body";
  if (!isRobots(model, bodyA) && !isRobots(model, bodyB))
    return both + "not checked, both belong to the world";
  const PairLists& lists = pairLists(model);
  const auto isIt = [&](const Checker::Pair& pair) {
    return (pair.bodyA == bodyA && pair.bodyB == bodyB) ||
           (pair.bodyA == bodyB && pair.bodyB == bodyA);
  };
  const auto checked = std::ranges::find_if(lists.checked, isIt);
  if (checked != lists.checked.end())
    return both + "checked" + asked(model, bodyA, bodyB) + ", keeps more than " +
           marginText(model, *checked) + (checked->reason.empty() ? "" : "; " + checked->reason);
  const auto skipped = std::ranges::find_if(lists.skipped, isIt);
  std::string text = both + "not checked, " + skipped->reason;
  if (std::ranges::any_of(lists.standing, isIt)) text += "; in contact";
  return text;
}

}  // namespace swept::detail
