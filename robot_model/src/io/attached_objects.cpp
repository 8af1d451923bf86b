// SPDX-License-Identifier: BSD-3-Clause
#include "io/attached_objects.hpp"

#include <algorithm>
#include <variant>

#include "rules/name_pattern.hpp"

namespace swept::detail {

void AttachedObjects::read(const YamlPlace& list) {
  for (const YamlPlace& entry : list.elements()) readOne(entry);
}

void AttachedObjects::readOne(const YamlPlace& unnamed) {
  unnamed.allowOnly({"link_name", "object", "touch_links", "detach_posture", "weight"});
  const YamlPlace given = unnamed.at("object");
  if (!given.present()) given.fail("is missing");
  const std::string id = idOf(given);
  const YamlPlace entry = unnamed.called("attached object '" + id + "':");
  if (!ids_.insert(id).second) entry.fail("a second attached object has this id");
  if (robot_.findLink(id)) entry.fail("a link of the robot has this name");
  const YamlPlace place = entry.at("object");
  if (const YamlPlace motion = place.at("motion"); motion.present())
    motion.fail("is of an object that a link carries; it moves with the link");
  const SceneObject object = objects_.read(place, id);
  if (object.parts.empty()) {
    waiting_.push_back({entry, id});
    return;
  }
  AttachedBody body = begin(entry, id);
  // MoveIt reads an object without a frame as one in the model frame, after an error. Whoever wrote
  // it by hand may have meant the link's frame.
  if (frameName(place.at("header")).empty())
    place.at("header").fail("has to name the frame_id of the object's pose, such as its link's '" +
                            body.link + "'");
  const Eigen::Isometry3d model_from_header = frames_.model_from(place.at("header"));
  const Eigen::Isometry3d link_from_header =
      frames_.model_from_link(body.link).inverse() * model_from_header;
  for (const SceneObject::Part& part : object.parts)
    addPart(entry, {part.shape, link_from_header * part.header_from_shape}, body);
  for (const auto& [name, header_from_frame] : object.header_from_frame)
    frames_.add(name, model_from_header * header_from_frame);
  bodies_.push_back(std::move(body));
}

/// All but its geometry.
AttachedBody AttachedObjects::begin(const YamlPlace& entry, const std::string& id) {
  const YamlPlace link = entry.at("link_name");
  AttachedBody body{.name = id, .link = link.text(), .parts = {}, .touchLinks = {}};
  if (!robot_.findLink(body.link))
    link.fail("is '" + body.link + "', which is no link of robot '" + robot_.name() + "'");
  for (const YamlPlace& touch : entry.at("touch_links").elements()) {
    const std::string name = touch.text();
    if (robot_.findLink(name)) {
      if (isPattern(name)) touch.fail("is '" + name + "'; a name with a '*' is not supported");
      body.touchLinks.push_back(name);
    } else {
      touches_.push_back({.body = id, .name = touch});
    }
  }
  return body;
}

void AttachedObjects::addPart(const YamlPlace& entry, AttachedBody::Part part,
                              AttachedBody& body) const {
  if (std::holds_alternative<Plane>(part.shape) || std::holds_alternative<HalfSpace>(part.shape))
    entry.fail("has planes, which no link can carry");
  body.parts.push_back(std::move(part));
}

void AttachedObjects::takeFrom(World& world) {
  for (const auto& [entry, id] : waiting_) {
    if (world.findObstacle(id) != nullptr)
      entry.at("object").fail("is an object of the world that moves, which no link can take");
    const WorldBody* found = world.find(id);
    if (found == nullptr)
      entry.at("object").fail(
          "has no primitives and no meshes, and the world has no object of this id");
    AttachedBody body = begin(entry, id);
    const Eigen::Isometry3d link_from_model = frames_.model_from_link(body.link).inverse();
    for (const WorldBody::Part& part : found->parts)
      addPart(entry, {part.shape, link_from_model * part.world_from_shape}, body);
    world.remove(id);
    bodies_.push_back(std::move(body));
  }
  waiting_.clear();
}

bool AttachedObjects::has(const std::string& id) const {
  return std::ranges::find(bodies_, id, &AttachedBody::name) != bodies_.end();
}

std::vector<std::pair<std::string, std::string>> AttachedObjects::touchingBodies() const {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& [body, place] : touches_) {
    const std::string name = place.text();
    if (std::ranges::find(bodies_, name, &AttachedBody::name) == bodies_.end())
      place.warn("is '" + name + "', which is no link and no attached object");
    else if (name != body)
      pairs.emplace_back(body, name);
  }
  return pairs;
}

}  // namespace swept::detail
