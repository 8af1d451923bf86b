// SPDX-License-Identifier: BSD-3-Clause
#include "spheres/named_bodies.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "swept/robot_model/usage_error.hpp"

namespace swept {

std::vector<PosedShape> bodyOf(const Link& link) {
  std::vector<PosedShape> body;
  for (const CollisionGeometry& geometry : link.collision)
    body.push_back({geometry.shape, geometry.link_from_shape});
  return body;
}

std::vector<NamedBody> bodiesOf(const Robot& robot) {
  std::vector<NamedBody> bodies;
  for (const Link& link : robot.links())
    if (!link.collision.empty()) bodies.push_back({link.name, bodyOf(link)});
  return bodies;
}

std::vector<NamedBody> bodiesOf(const World& world) {
  std::vector<NamedBody> bodies;
  for (const WorldBody& body : world.bodies()) {
    if (body.parts.empty()) continue;
    NamedBody& named = bodies.emplace_back(NamedBody{body.name, {}});
    for (const WorldBody::Part& part : body.parts)
      named.shapes.push_back({part.shape, part.world_from_shape});
  }
  for (const MovingObstacle& obstacle : world.obstacles()) {
    if (obstacle.parts.empty()) continue;
    NamedBody& named = bodies.emplace_back(NamedBody{obstacle.name, {}});
    for (const MovingObstacle::Part& part : obstacle.parts)
      named.shapes.push_back({part.shape, part.body_from_shape});
  }
  return bodies;
}

namespace detail {

void requireBodies(std::span<const NamedBody> bodies) {
  std::set<std::string_view> names;
  for (const NamedBody& body : bodies) {
    if (body.shapes.empty()) throw std::invalid_argument("body '" + body.name + "' has no shapes");
    if (!names.insert(body.name).second)
      throw std::invalid_argument("two bodies have the name '" + body.name + "'");
    for (const PosedShape& posed : body.shapes)
      if (std::holds_alternative<Plane>(posed.shape) ||
          std::holds_alternative<HalfSpace>(posed.shape))
        throw UsageError("body '" + body.name +
                         "' has a plane or a half-space, which no shapes contain");
  }
}

void requireEnough(std::optional<int> shapes, const char* what, const Robot& robot,
                   std::size_t links) {
  if (shapes && *shapes < static_cast<int>(links))
    throw UsageError(std::to_string(*shapes) + " " + what + " are too few for robot '" +
                     robot.name() + "': " + std::to_string(links) +
                     " links have collision geometry");
}

void requireEnough(std::optional<int> shapes, const char* what, std::size_t bodies) {
  if (shapes && *shapes < static_cast<int>(bodies))
    throw UsageError(std::to_string(*shapes) + " " + what + " are too few for " +
                     std::to_string(bodies) + " bodies");
}

}  // namespace detail
}  // namespace swept
