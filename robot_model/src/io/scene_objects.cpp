// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_objects.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string_view>

#include "io/scene_motion.hpp"
#include "io/zero_sizes.hpp"

namespace swept::detail {

namespace {

enum class PrimitiveType : std::uint8_t { Box, Sphere, Cylinder, Cone };

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// By name, or by the codes of shape_msgs/SolidPrimitive.
PrimitiveType primitiveType(const YamlPlace& type) {
  constexpr std::array<std::array<const char*, 2>, 4> kNames{
      {{"box", "1"}, {"sphere", "2"}, {"cylinder", "3"}, {"cone", "4"}}};
  const std::string given = lowerCase(type.text());
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (given == kNames[i][0] || given == kNames[i][1]) return static_cast<PrimitiveType>(i);
  }
  type.fail("is '" + type.text() + "'; allowed are box (1), sphere (2), cylinder (3) and cone (4)");
}

std::vector<double> sizes(const YamlPlace& place, std::size_t count, const std::string& meaning) {
  const auto elements = place.elements();
  if (elements.size() != count) {
    place.fail("has " + std::to_string(elements.size()) + " values; " + meaning);
  }
  std::vector<double> values;
  for (const YamlPlace& element : elements) {
    values.push_back(element.number());
    if (!(values.back() >= 0.0)) {
      element.fail("is '" + element.text() + "'; it must be 0 or greater");
    }
  }
  return values;
}

Shape readPrimitive(const YamlPlace& place) {
  place.allowOnly({"type", "dimensions", "polygon"});  // of prisms, which are not supported
  const YamlPlace dimensions = place.at("dimensions");
  switch (primitiveType(place.at("type"))) {
    case PrimitiveType::Box: {
      const auto s = sizes(dimensions, 3, "a box has 3 [x, y, z]");
      return makeBox({s[0], s[1], s[2]});
    }
    case PrimitiveType::Sphere:
      return makeSphere(sizes(dimensions, 1, "a sphere has 1 [radius]")[0]);
    case PrimitiveType::Cylinder: {
      const auto s = sizes(dimensions, 2, "a cylinder has 2 [height, radius]");
      return makeCylinder(s[1], s[0]);
    }
    case PrimitiveType::Cone:
      break;
  }
  const auto s = sizes(dimensions, 2, "a cone has 2 [height, radius]");
  return makeCone(s[1], s[0]);
}

/// shape_msgs/Plane: the points with a x + b y + c z + d = 0.
Shape readPlane(const YamlPlace& place) {
  const YamlPlace coefficients = place.allowOnly({"coef"}).at("coef");
  const auto elements = coefficients.elements();
  if (elements.size() != 4) {
    coefficients.fail("has " + std::to_string(elements.size()) +
                      " values; a plane has 4 [a, b, c, d]");
  }
  const Eigen::Vector3d normal(elements[0].number(), elements[1].number(), elements[2].number());
  try {
    return makePlane(normal, -elements[3].number());
  } catch (const std::invalid_argument& error) {
    coefficients.fail(std::string("cannot be used: ") + error.what());
  }
}

/// A scale factor for each axis. Robowflex calls it `dimensions` in scenes.
Eigen::Vector3d meshScale(const YamlPlace& place) {
  const YamlPlace scale = place.at("scale");
  const YamlPlace dimensions = place.at("dimensions");
  if (scale.present() && dimensions.present())
    dimensions.fail("and scale are two names for one thing; one is allowed");
  const YamlPlace& given = scale.present() ? scale : dimensions;
  if (!given.present()) return Eigen::Vector3d::Ones();
  const Eigen::Vector3d factors = given.vector();
  if (!(factors.cwiseAbs().minCoeff() > 0.0)) given.fail("must hold factors other than 0");
  return factors;
}

/// Other objects may be placed by these.
void addFrames(const YamlPlace& object, const Eigen::Isometry3d& header_from_object,
               SceneObject& result) {
  const YamlPlace names = object.at("subframe_names");
  const auto given = names.elements();
  const auto poses = object.at("subframe_poses").elements();
  if (given.size() != poses.size()) {
    names.fail("has " + std::to_string(given.size()) + " entries for " +
               std::to_string(poses.size()) + " subframe_poses");
  }
  result.header_from_frame.emplace_back(result.id, header_from_object);
  std::set<std::string> known;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string name = given[i].text();
    if (!known.insert(name).second) given[i].fail("is '" + name + "' a second time");
    result.header_from_frame.emplace_back(
        result.id + "/" + name, header_from_object * poses[i].pose("position", "orientation"));
  }
}

void requireAdd(const YamlPlace& operation) {
  if (!operation.present()) return;
  const std::string given = lowerCase(operation.text());
  if (given == "0" || given == "add" || (given.size() == 1 && given[0] == '\0')) return;
  operation.fail("is '" + operation.text() + "'; a scene file allows only add (0)");
}

/// What an object with a motion cannot have.
void requireMovable(const YamlPlace& object) {
  for (const char* key : {"pose", "subframe_names", "planes"}) {
    const YamlPlace place = object.at(key);
    if (!place.present() || (place.isSequence() && place.elements().empty())) continue;
    const std::string_view what(key);
    place.fail(what == "pose"     ? "and motion say where the object is; one of them is allowed"
               : what == "planes" ? "are of an object with a motion; what has no bounds cannot move"
                                  : "are of an object with a motion; nothing can be placed by it");
  }
}

}  // namespace

std::string idOf(const YamlPlace& object) {
  const YamlPlace id = object.at("id");
  if (id.text().empty()) id.fail("must not be empty");
  return id.text();
}

SceneObject SceneObjects::read(const YamlPlace& object, const std::string& id) {
  object.allowOnly({"header", "pose", "id", "type", "primitives", "primitive_poses", "meshes",
                    "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                    "operation", "motion"});
  requireAdd(object.at("operation"));
  SceneObject result{.id = id, .parts = {}, .header_from_frame = {}};
  addShapes(object, "primitives", "primitive_poses", result);
  addShapes(object, "meshes", "mesh_poses", result);
  addShapes(object, "planes", "plane_poses", result);
  result.motion = readMotion(object.at("motion"));
  if (!result.motion.empty()) {
    requireMovable(object);
    return result;
  }
  const Eigen::Isometry3d pose = object.at("pose").pose("position", "orientation");
  // If an object without a pose has one shape, MoveIt takes the shape's pose for the object's
  // (PlanningScene::shapesAndPosesFromCollisionObjectMessage): subframes are relative to it.
  const bool isShape = result.parts.size() == 1 && pose.matrix() == Eigen::Matrix4d::Identity();
  addFrames(object, isShape ? result.parts.front().header_from_shape : pose, result);
  for (SceneObject::Part& part : result.parts)
    part.header_from_shape = pose * part.header_from_shape;
  return result;
}

void SceneObjects::addShapes(const YamlPlace& object, const char* shapesKey, const char* posesKey,
                             SceneObject& result) {
  const auto shapes = object.at(shapesKey).elements();
  const auto poses = object.at(posesKey).elements();
  // Without any, all shapes sit at the object's pose (moveit_msgs/CollisionObject).
  if (!poses.empty() && poses.size() != shapes.size()) {
    object.at(posesKey).fail("has " + std::to_string(poses.size()) + " entries for " +
                             std::to_string(shapes.size()) + " " + shapesKey);
  }
  const std::string_view kind(shapesKey);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape shape = kind == "primitives" ? readPrimitive(shapes[i])
                        : kind == "planes"   ? readPlane(shapes[i])
                                             : readMesh(shapes[i], result.id);
    warnOfZeroSize(shape, shapes[i].line(), "object '" + result.id + "'", warnings_);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (!poses.empty()) pose = poses[i].pose("position", "orientation");
    result.parts.push_back({shape, pose});
  }
}

Shape SceneObjects::readMesh(const YamlPlace& place, const std::string& id) {
  if (const YamlPlace resource = place.at("resource"); resource.present()) {
    place.allowOnly({"resource", "scale", "dimensions"});
    return *meshes_.get({resource.text(), resource.line(), "object '" + id + "'", meshScale(place)})
                .mesh;
  }
  place.allowOnly({"vertices", "triangles"});
  std::vector<Eigen::Vector3d> vertices;
  for (const YamlPlace& vertex : place.at("vertices").elements())
    vertices.push_back(vertex.vector());
  std::vector<Eigen::Vector3i> triangles;
  for (const YamlPlace& entry : place.at("triangles").elements()) {
    entry.allowOnly({"vertex_indices"});
    const YamlPlace indices = entry.isMap() ? entry.at("vertex_indices") : entry;
    const auto corners = indices.elements();
    if (corners.size() != 3) indices.fail("must hold 3 vertex indices");
    Eigen::Vector3i& triangle = triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) triangle[corner] = corners[corner].integer();
  }
  try {
    const TriangleMesh mesh = TriangleMesh::build(vertices, triangles);
    warnIfOpen(mesh, id, place.line(), source_);
    return mesh;
  } catch (const std::invalid_argument& error) {
    place.fail(std::string("cannot be used: ") + error.what());
  }
}

}  // namespace swept::detail
