// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "output/text_output.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/scene_model.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// What scene files have: a capsule is a cylinder and two spheres.
std::vector<PosedShape> sceneShapes(const std::vector<PosedShape>& shapes) {
  std::vector<PosedShape> parts;
  for (const PosedShape& posed : shapes) {
    const auto* capsule = std::get_if<Capsule>(&posed.shape);
    if (capsule == nullptr) {
      parts.push_back(posed);
      continue;
    }
    const auto& [radius, half] = *capsule;
    if (half > 0.0) parts.push_back({Cylinder{radius, half}, posed.body_from_shape});
    for (const double end : half > 0.0 ? std::vector{-half, half} : std::vector{0.0})
      parts.push_back(
          {Sphere{radius}, posed.body_from_shape * Eigen::Translation3d(0.0, 0.0, end)});
  }
  return parts;
}

std::string listed(std::initializer_list<double> numbers, const std::string& between) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(exactNumber(number));
  return joined(texts, between);
}

std::string orientationText(const Isometry3d& pose, const std::string& between) {
  const Eigen::Quaterniond turn(pose.linear());
  return listed({turn.x(), turn.y(), turn.z(), turn.w()}, between);
}

std::string placeText(const Vector3d& place, const std::string& between) {
  return listed({place.x(), place.y(), place.z()}, between);
}

/// Two lines, behind `first` and `second`.
std::string yamlPose(const Isometry3d& pose, const std::string& first, const std::string& second) {
  return first + "position: [" + placeText(pose.translation(), ", ") + "]\n" + second +
         "orientation: [" + orientationText(pose, ", ") + "]\n";
}

std::string yamlMesh(const ConvexHull& hull) {
  std::string text = "        - vertices:\n";
  for (const Vector3d& vertex : hull.vertices())
    text += "            - [" + placeText(vertex, ", ") + "]\n";
  text += "          triangles:\n";
  for (const Eigen::Vector3i& face : hull.faces())
    text += "            - vertex_indices: [" + std::to_string(face[0]) + ", " +
            std::to_string(face[1]) + ", " + std::to_string(face[2]) + "]\n";
  return text;
}

/// `type` and `dimensions`; empty for a hull.
std::string yamlPrimitive(const Shape& shape) {
  std::string type, sizes;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    type = "sphere";
    sizes = exactNumber(sphere->radius);
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    type = "box";
    sizes = placeText(2.0 * box->halfExtents, ", ");
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    type = "cylinder";
    sizes = listed({2.0 * cylinder->halfLength, cylinder->radius}, ", ");
  } else if (std::holds_alternative<ConvexHull>(shape)) {
    return {};
  } else {
    detail::refuseShape();
  }
  return "        - type: " + type + "\n          dimensions: [" + sizes + "]\n";
}

std::string yamlObject(const LinkShapes& body, const MovingObstacle* moving) {
  std::string primitives, primitivePoses, meshes, meshPoses;
  for (const PosedShape& posed : sceneShapes(body.shapes)) {
    const std::string primitive = yamlPrimitive(posed.shape);
    const std::string pose = yamlPose(posed.body_from_shape, "        - ", "          ");
    if (primitive.empty()) meshes += yamlMesh(std::get<ConvexHull>(posed.shape));
    primitives += primitive;
    (primitive.empty() ? meshPoses : primitivePoses) += pose;
  }
  // A text of JSON is one of YAML, whatever is in the name.
  std::string text =
      "    - id: " + lineOf(Json(body.link)) + "\n      header:\n        frame_id: world\n";
  if (!primitives.empty())
    text += "      primitives:\n" + primitives + "      primitive_poses:\n" + primitivePoses;
  if (!meshes.empty()) text += "      meshes:\n" + meshes + "      mesh_poses:\n" + meshPoses;
  if (moving != nullptr) {
    text += "      motion:\n";
    for (const auto& [time, world_from_body] : moving->waypoints)
      text += "        - time: " + exactNumber(time) + "\n" +
              yamlPose(world_from_body, "          ", "          ");
  }
  return text + "      operation: add\n";
}

void requireTextName(const std::string& name) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  if (name.empty() || name.find('\n') != std::string::npos || isBlank(name.front()) ||
      isBlank(name.back()))
    throw UsageError("MoveIt's text cannot have an object of the name '" + name +
                     "': it would be read as another one; write .yaml");
}

std::string textShape(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return "sphere\n" + exactNumber(sphere->radius) + "\n";
  if (const auto* box = std::get_if<Box>(&shape))
    return "box\n" + placeText(2.0 * box->halfExtents, " ") + "\n";
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return "cylinder\n" + listed({cylinder->radius, 2.0 * cylinder->halfLength}, " ") + "\n";
  const auto* hull = std::get_if<ConvexHull>(&shape);
  if (hull == nullptr) detail::refuseShape();
  std::string text = "mesh\n" + std::to_string(hull->vertices().size()) + " " +
                     std::to_string(hull->faces().size()) + "\n";
  for (const Vector3d& vertex : hull->vertices()) text += placeText(vertex, " ") + "\n";
  for (const Eigen::Vector3i& face : hull->faces())
    text += std::to_string(face[0]) + " " + std::to_string(face[1]) + " " +
            std::to_string(face[2]) + "\n";
  return text;
}

}  // namespace

std::string sceneModelJson(const ShapeModel& model, const std::string& scene,
                           const std::vector<LinkSphereReport>& reports) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return sceneModelJson(model, scene, reports); });
  const std::optional<SphereModel> spheres = sphereModelOf(model);
  const std::string what = spheres ? "spheres" : "shapes";
  Json json = {{"scene", scene}, {what, model.count()}, {"bodies", Json::array()}};
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const LinkShapes& body = model.links[i];
    Json entry = {{"body", body.link}, {what, Json::array()}};
    if (spheres)
      for (const EnclosingSphere& sphere : spheres->links[i].spheres)
        entry[what].push_back(detail::sphereJson(sphere));
    else
      for (const PosedShape& shape : body.shapes) entry[what].push_back(detail::shapeJson(shape));
    detail::addFigures(entry, body.link, reports);
    json["bodies"].push_back(std::move(entry));
  }
  return dumped(json) + "\n";
}

std::string sceneModelYaml(const ShapeModel& model, const World& world, const std::string& scene) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return sceneModelYaml(model, world, scene); });
  std::string text = "name: " + lineOf(Json(scene)) + "\nworld:\n  collision_objects:\n";
  for (const LinkShapes& body : model.links)
    if (!body.shapes.empty()) text += yamlObject(body, world.findObstacle(body.link));
  return text;
}

std::string sceneModelText(const ShapeModel& model, const World& world, const std::string& scene) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return sceneModelText(model, world, scene); });
  std::string name = scene;
  std::ranges::replace(name, '\n', ' ');
  std::string text = name + "\n";
  for (const LinkShapes& body : model.links) {
    if (body.shapes.empty()) continue;
    if (world.findObstacle(body.link) != nullptr)
      throw UsageError("object '" + body.link +
                       "' moves, which MoveIt's text cannot say; write .yaml");
    requireTextName(body.link);
    const std::vector<PosedShape> shapes = sceneShapes(body.shapes);
    text += "* " + body.link + "\n0 0 0\n0 0 0 1\n" + std::to_string(shapes.size()) + "\n";
    for (const PosedShape& posed : shapes)
      text += textShape(posed.shape) + placeText(posed.body_from_shape.translation(), " ") + "\n" +
              orientationText(posed.body_from_shape, " ") + "\n0 0 0 0\n";
    text += "0\n";
  }
  return text + ".\n";
}

}  // namespace swept
