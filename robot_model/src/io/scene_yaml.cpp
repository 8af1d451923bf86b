// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

#include "io/mesh_store.hpp"
#include "io/scene.hpp"
#include "io/scene_extras.hpp"
#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/foreign_text.hpp"

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
    if (!(values.back() > 0.0)) {
      element.fail("is '" + element.text() + "'; it must be greater than 0");
    }
  }
  return values;
}

Shape readPrimitive(const YamlPlace& place) {
  place.allowOnly({"type", "dimensions", "polygon"});  // of prisms, which no type here is
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

/// A factor for each axis. Robowflex's name for it in scenes is `dimensions`.
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

class SceneReader {
 public:
  explicit SceneReader(const InputSource& source)
      : source_(source), meshes_(source), frames_(source) {}
  World read(const YamlPlace& root);

 private:
  void readObject(const YamlPlace& unnamed);
  void addShapes(const YamlPlace& object, const char* shapesKey, const char* posesKey,
                 const Eigen::Isometry3d& world_from_object, WorldBody& body);
  Shape readMesh(const YamlPlace& place, const std::string& id);

  const InputSource& source_;
  MeshStore meshes_;
  SceneFrames frames_;
  World world_;
};

World SceneReader::read(const YamlPlace& root) {
  if (!root.isMap()) root.fail("a planning scene must be a mapping");
  root.allowOnly({"name", "robot_state", "robot_model_name", "fixed_frame_transforms",
                  "allowed_collision_matrix", "link_padding", "link_scale", "object_colors",
                  "world", "collision_objects", "is_diff"});
  const YamlPlace world = root.at("world");
  const YamlPlace outer = root.at("collision_objects");
  world.allowOnly({"collision_objects", "octomap"});
  const YamlPlace inner = world.present() ? world.at("collision_objects") : world;
  if (inner.present() && outer.present()) {
    outer.fail("stand at the top and in 'world' too; one place is allowed");
  }
  if (!world.present() && !outer.present()) {
    root.fail("a planning scene needs 'world' or 'collision_objects'");
  }
  checkSceneExtras(root);
  frames_.read(root.at("fixed_frame_transforms"));
  for (const YamlPlace& object :
       (inner.present() ? inner.called("collision_objects") : outer).elements()) {
    readObject(object);
  }
  return std::move(world_);
}

void SceneReader::readObject(const YamlPlace& unnamed) {
  const std::string id = unnamed.at("id").text();
  const YamlPlace object = unnamed.called("object '" + id + "':");
  if (id.empty()) unnamed.at("id").fail("must not be empty");
  if (world_.find(id) != nullptr) object.fail("a second object has this id");
  object.allowOnly({"header", "pose", "id", "type", "primitives", "primitive_poses", "meshes",
                    "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                    "operation"});
  if (const YamlPlace operation = object.at("operation"); operation.present()) {
    const std::string given = lowerCase(operation.text());
    if (given != "0" && given != "add" && !(given.size() == 1 && given[0] == '\0')) {
      operation.fail("is '" + operation.text() + "'; a scene file allows only add (0)");
    }
  }
  const Eigen::Isometry3d world_from_object =
      frames_.model_from(object.at("header")) * object.at("pose").pose("position", "orientation");
  WorldBody body;
  body.name = id;
  addShapes(object, "primitives", "primitive_poses", world_from_object, body);
  addShapes(object, "meshes", "mesh_poses", world_from_object, body);
  addShapes(object, "planes", "plane_poses", world_from_object, body);
  if (body.parts.empty()) object.fail("it has no primitives, no meshes and no planes");
  try {
    world_.add(std::move(body));
  } catch (const std::invalid_argument& error) {
    object.fail(error.what());
  }
}

void SceneReader::addShapes(const YamlPlace& object, const char* shapesKey, const char* posesKey,
                            const Eigen::Isometry3d& world_from_object, WorldBody& body) {
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
                                             : readMesh(shapes[i], body.name);
    Eigen::Isometry3d pose = world_from_object;
    if (!poses.empty()) pose = pose * poses[i].pose("position", "orientation");
    body.parts.push_back({shape, pose});
  }
}

Shape SceneReader::readMesh(const YamlPlace& place, const std::string& id) {
  if (const YamlPlace resource = place.at("resource"); resource.present()) {
    place.allowOnly({"resource", "scale", "dimensions"});
    return meshes_.mesh(resource.text(), meshScale(place), resource.line(), "object '" + id + "'");
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

}  // namespace

World readSceneYaml(const std::string& text, const InputSource& source) {
  const YamlPlace root = YamlPlace::parse(text, source);
  try {
    return SceneReader(source).read(root);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace swept::detail
