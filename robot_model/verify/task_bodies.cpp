// SPDX-License-Identifier: BSD-3-Clause
#include "task_bodies.hpp"

#include <algorithm>
#include <set>

#include "encoding.hpp"
#include "task.hpp"

namespace swept::verify {
namespace {

/// The body of a name; null: there is none.
const Json& bodyOf(const Json& bodies, const std::string& name) {
  static const Json none;
  const auto found =
      std::ranges::find_if(bodies, [&](const Json& body) { return body["name"] == name; });
  return found == bodies.end() ? none : *found;
}

Json shapesWithoutPoses(const Json& body) {
  Json shapes = body["shapes"];
  for (Json& shape : shapes) shape.erase("pose");
  return shapes;
}

/// By its waypoints. Such a body has no `link`.
bool movesByItself(const Json& body) {
  return !body.is_null() && body.contains("waypoints");
}

bool isCarried(const Json& body) {
  return !body.is_null() && !movesByItself(body) && !body["link"].is_null();
}

/// `in the world`, `carried by hand`.
std::string carriedText(const Json& body) {
  return isCarried(body) ? "carried by " + body["link"].get<std::string>() : "in the world";
}

}  // namespace

BodyChanges::BodyChanges(const Json& list, const std::string& where) : where_(where) {
  if (!list.is_array()) throw Refusal(where + ": changes is not a list");
  for (const Json& change : list) {
    const std::string place = where + ", changes";
    const Json &body = at(change, "body", place), &kind = at(change, "change", place);
    if (change.size() != 2) throw Refusal(place + ": not a body and a change: " + change.dump());
    if (!body.is_string()) throw Refusal(place + ": not a text: " + body.dump());
    if (kind != "attached" && kind != "placed" && kind != "sensed")
      throw Refusal(place + ": " + kind.dump() + " is none of attached, placed and sensed");
    if (!stated_.emplace(body.get<std::string>(), kind.get<std::string>()).second)
      throw Refusal(place + ": body " + body.get<std::string>() + " is there twice");
    order_.push_back(body);
  }
}

void BodyChanges::requireNone() const {
  if (!order_.empty()) throw Refusal(where_ + ", changes: no phase is before it");
}

std::vector<std::string> BodyChanges::check(const BodiesOfPhases& bodies) const {
  std::set<std::string> names;
  for (const Json* list : {&bodies.before, &bodies.now})
    for (const Json& body : *list) names.insert(body["name"].get<std::string>());
  for (const std::string& name : names) {
    const Json &before = bodyOf(bodies.before, name), &now = bodyOf(bodies.now, name);
    if (before != now) checkChange(name, before, now, bodies);
  }
  std::vector<std::string> words;
  for (const std::string& name : order_) {
    const std::string kind = statedOf(name);
    if (!names.contains(name)) throw Refusal(where_ + ", changes: there is no body " + name);
    const Json &before = bodyOf(bodies.before, name), &now = bodyOf(bodies.now, name);
    if (kind != "sensed" && before == now)
      refuse(name, "it is said to be " + kind + ", and is as it was");
    words.push_back(kind == "attached" ? name + " attached to " + now["link"].get<std::string>()
                    : kind == "placed" ? name + " placed"
                    : now.is_null()    ? name + " no longer sensed"
                                       : name + " sensed");
  }
  return words;
}

void BodyChanges::checkChange(const std::string& name, const Json& before, const Json& now,
                              const BodiesOfPhases& bodies) const {
  const std::string stated = statedOf(name), in = " in " + bodies.phaseBefore;
  if (stated == "sensed") {
    for (const Json* body : {&before, &now})
      if (isCarried(*body))
        refuse(name, "it is said to be sensed, and is " + carriedText(*body) +
                         (body == &before ? in : ""));
    return;
  }
  if (before.is_null()) refuse(name, "it was not there" + in);
  if (now.is_null()) refuse(name, "it is not there, and was" + in);
  if (movesByItself(before) != movesByItself(now))
    refuse(name, movesByItself(now) ? "it moves by itself, and did not" + in
                                    : "it does not move by itself any more, as it did" + in);
  if (movesByItself(now)) refuse(name, "it moves by itself, and not as it did" + in);
  if (shapesWithoutPoses(before) != shapesWithoutPoses(now))
    refuse(name, "its shape is not what it was" + in);
  if (before["link"] == now["link"]) refuse(name, "it is not where it was" + in);
  const std::string needed = now["link"].is_null() ? "placed" : "attached";
  if (stated != needed)
    refuse(name, "it is " + carriedText(now) + ", and was " + carriedText(before) + in +
                     (stated.empty() ? "; no change says so" : "; it is said to be " + stated));
  requireSamePlace(name, before, now, bodies);
}

void BodyChanges::requireSamePlace(const std::string& name, const Json& before, const Json& now,
                                   const BodiesOfPhases& bodies) const {
  const auto poseOf = [&](const Json& body, std::size_t shape) {
    const Eigen::Isometry3d own = readPose(body["shapes"][shape]["pose"], where_ + ", " + name);
    return body["link"].is_null() ? own : bodies.poseOf(body["link"]) * own;
  };
  for (std::size_t i = 0; i < now["shapes"].size(); ++i) {
    const Eigen::Isometry3d from = poseOf(before, i), to = poseOf(now, i);
    const double moved = (to.translation() - from.translation()).norm();
    const double turned = (to.linear() - from.linear()).cwiseAbs().maxCoeff();
    if (!(moved <= kMovedBy))
      refuse(name,
             "it is " + numberText(moved, 3) + " m from where it was in " + bodies.phaseBefore);
    if (!(turned <= kMovedBy)) refuse(name, "it is turned since " + bodies.phaseBefore);
  }
}

std::string BodyChanges::statedOf(const std::string& body) const {
  const auto found = stated_.find(body);
  return found == stated_.end() ? "" : found->second;
}

void BodyChanges::refuse(const std::string& body, const std::string& text) const {
  throw Refusal(where_ + ", body " + body + ": " + text);
}

}  // namespace swept::verify
