// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/json_value.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/scene_model.hpp"

namespace swept {
namespace {

/// Empty if the world has such a body, else what is wrong with the name.
std::string unknownBody(const World& world, const std::string& name) {
  if (world.find(name) != nullptr || world.findObstacle(name) != nullptr) return {};
  std::vector<std::string> known;
  for (const NamedBody& body : bodiesOf(world)) known.push_back(body.name);
  return "'" + name + "', which is no body of the scene" + didYouMean(name, known);
}

ShapeModel bodiesFromJson(const std::string& file, const World& world) {
  const nlohmann::json json = JsonValue::parseFile(file);
  const JsonValue root(json, "the file", file);
  ShapeModel model;
  for (const JsonValue& entry : root.at("bodies").elements()) {
    const JsonValue name = entry.at("body");
    const std::string body = name.text();
    if (const std::string unknown = unknownBody(world, body); !unknown.empty())
      name.fail("is " + unknown);
    if (model.find(body) != nullptr) name.fail("is '" + body + "' a second time");
    LinkShapes own{body, {}};
    if (entry.has("spheres"))
      for (const JsonValue& value : entry.at("spheres").elements()) {
        const EnclosingSphere sphere = detail::sphereOf(value);
        own.shapes.push_back(
            {Sphere{sphere.radius}, Eigen::Isometry3d(Eigen::Translation3d(sphere.center))});
      }
    else
      for (const JsonValue& value : entry.at("shapes").elements())
        own.shapes.push_back(detail::shapeOf(value));
    model.links.push_back(std::move(own));
  }
  return model;
}

bool isSameMotion(const MovingObstacle& a, const MovingObstacle& b) {
  return std::ranges::equal(a.waypoints, b.waypoints, [](const auto& first, const auto& second) {
    return first.time == second.time &&
           first.world_from_body.isApprox(second.world_from_body, 1e-9);
  });
}

ShapeModel bodiesFromScene(const std::filesystem::path& file, const World& world,
                           const LoadOptions& options) {
  const World shaped = World::load(file, options);
  for (const MovingObstacle& obstacle : shaped.obstacles()) {
    const MovingObstacle* own = world.findObstacle(obstacle.name);
    if (own != nullptr && !isSameMotion(*own, obstacle))
      throw InputError(file.string(), 0,
                       "object '" + obstacle.name + "' has another motion than in the scene");
  }
  ShapeModel model;
  for (NamedBody& body : bodiesOf(shaped)) {
    if (const std::string unknown = unknownBody(world, body.name); !unknown.empty())
      throw InputError(file.string(), 0, "it has object " + unknown);
    if ((world.find(body.name) != nullptr) != (shaped.find(body.name) != nullptr))
      throw InputError(file.string(), 0,
                       "object '" + body.name + "' moves in one of the two scenes alone");
    model.links.push_back({std::move(body.name), detail::withCapsules(body.shapes)});
  }
  return model;
}

}  // namespace

ShapeModel readSceneModel(const std::filesystem::path& file, const World& world,
                          const LoadOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return readSceneModel(file, world, options); });
  if (file.extension() == ".json") return bodiesFromJson(file.string(), world);
  return bodiesFromScene(file, world, options);
}

}  // namespace swept
