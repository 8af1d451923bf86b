// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/json_value.hpp"
#include "spheres/link_names.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/shape_model.hpp"

namespace swept {
namespace {

std::vector<PosedShape>& shapesOf(ShapeModel& model, const std::string& link) {
  const auto found = std::ranges::find(model.links, link, &LinkShapes::link);
  if (found != model.links.end()) return found->shapes;
  model.links.push_back({link, {}});
  return model.links.back().shapes;
}

ShapeModel shapesFromUrdf(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const auto shaped = Robot::load(file, {}, options);
  ShapeModel model;
  for (const Link& link : shaped->links()) {
    if (link.collision.empty()) continue;
    if (const std::string unknown = detail::unknownLink(robot, link.name); !unknown.empty())
      throw InputError(file, 0, "it has link " + unknown);
    model.links.push_back({link.name, detail::withCapsules(bodyOf(link))});
  }
  return model;
}

ShapeModel shapesFromJson(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const nlohmann::json json = JsonValue::parseFile(file);
  const JsonValue root(json, "the file", file);
  if (const auto urdf = detail::urdfOfConfiguration(root))
    return shapesFromUrdf(urdf->string(), robot, options);
  ShapeModel model;
  bool hasShapes = false;
  for (const JsonValue& entry : root.at("links").elements()) {
    if (!entry.has("shapes")) continue;
    hasShapes = true;
    const JsonValue name = entry.at("link");
    const std::string link = name.text();
    if (const std::string unknown = detail::unknownLink(robot, link); !unknown.empty())
      name.fail("is " + unknown);
    std::vector<PosedShape>& shapes = shapesOf(model, link);
    for (const JsonValue& shape : entry.at("shapes").elements())
      shapes.push_back(detail::shapeOf(shape));
  }
  return hasShapes ? model : shapeModelOf(readSphereModel(file, robot, options));
}

}  // namespace

ShapeModel readShapeModel(const std::filesystem::path& file, const Robot& robot,
                          const LoadOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return readShapeModel(file, robot, options); });
  if (file.extension() == ".json") return shapesFromJson(file.string(), robot, options);
  if (file.extension() == ".urdf") return shapesFromUrdf(file.string(), robot, options);
  return shapeModelOf(readSphereModel(file, robot, options));
}

}  // namespace swept
