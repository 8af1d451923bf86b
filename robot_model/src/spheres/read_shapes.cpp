// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/json_value.hpp"
#include "spheres/link_names.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/shape_model.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d poseAt(const JsonValue& value) {
  const std::vector<JsonValue> numbers = value.elements(7);
  const auto number = [&](std::size_t i) { return numbers[i].number(); };
  Eigen::Quaterniond turn(number(6), number(3), number(4), number(5));
  if (!(std::abs(turn.norm() - 1.0) < 0.01)) value.fail("has a quaternion that is no rotation");
  Isometry3d pose(turn.normalized());
  pose.translation() = Vector3d(number(0), number(1), number(2));
  return pose;
}

Shape shapeAt(const JsonValue& value) {
  const JsonValue type = value.at("type");
  const std::string name = type.text();
  const auto size = [&](const char* key) { return value.at(key).notNegative(); };
  if (name == "sphere") return makeSphere(size("radius"));
  if (name == "capsule") return makeCapsule(size("radius"), size("length"));
  if (name == "cylinder") return makeCylinder(size("radius"), size("length"));
  if (name == "box") {
    Vector3d sides;
    const std::vector<JsonValue> sizes = value.at("size").elements(3);
    for (int axis = 0; axis < 3; ++axis)
      sides[axis] = sizes[static_cast<std::size_t>(axis)].notNegative();
    return makeBox(sides);
  }
  if (name != "convex") type.refuse("sphere, box, cylinder, capsule or convex");
  std::vector<Vector3d> vertices;
  for (const JsonValue& vertex : value.at("vertices").elements())
    vertices.push_back(vertex.vector3());
  if (vertices.empty()) value.at("vertices").fail("is empty");
  return ConvexHull::of(vertices);
}

std::vector<PosedShape>& shapesOf(ShapeModel& model, const std::string& link) {
  const auto found = std::ranges::find(model.links, link, &LinkShapes::link);
  if (found != model.links.end()) return found->shapes;
  model.links.push_back({link, {}});
  return model.links.back().shapes;
}

/// A cylinder and the spheres at its ends, as they are written for a capsule.
bool isCapsule(const PosedShape* first) {
  const auto* cylinder = std::get_if<Cylinder>(&first[0].shape);
  if (cylinder == nullptr) return false;
  for (const int end : {-1, 1}) {
    const PosedShape& posed = first[end < 0 ? 1 : 2];
    const auto* sphere = std::get_if<Sphere>(&posed.shape);
    if (sphere == nullptr || sphere->radius != cylinder->radius) return false;
    const Vector3d tip = first[0].body_from_shape * Vector3d(0, 0, end * cylinder->halfLength);
    if (!((posed.body_from_shape.translation() - tip).norm() <= 1e-9)) return false;
  }
  return true;
}

/// The ends that are written are off by rounding, so the capsule is that much thinner.
std::vector<PosedShape> withCapsules(const std::vector<PosedShape>& parts) {
  std::vector<PosedShape> shapes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i + 2 < parts.size() && isCapsule(&parts[i])) {
      const auto& cylinder = std::get<Cylinder>(parts[i].shape);
      shapes.push_back({Capsule{std::max(0.0, cylinder.radius - 2e-9), cylinder.halfLength},
                        parts[i].body_from_shape});
      i += 2;
    } else {
      shapes.push_back(parts[i]);
    }
  }
  return shapes;
}

ShapeModel shapesFromUrdf(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const auto shaped = Robot::load(file, {}, options);
  ShapeModel model;
  for (const Link& link : shaped->links()) {
    if (link.collision.empty()) continue;
    if (const std::string unknown = detail::unknownLink(robot, link.name); !unknown.empty())
      throw InputError(file, 0, "it has link " + unknown);
    model.links.push_back({link.name, withCapsules(bodyOf(link))});
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
      shapes.push_back({shapeAt(shape), poseAt(shape.at("pose"))});
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
