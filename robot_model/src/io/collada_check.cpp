// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "io/collada_mesh.hpp"
#include "io/mesh_claim.hpp"
#include "io/mesh_file.hpp"
#include "io/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

constexpr int kMaxNodes = 1'000'000;  ///< shown; a few lines that name each other show billions
constexpr double kUnitAxis = 1e-3;    ///< more is no rounding but a mistake
constexpr int kMaxDepth = 500;        ///< as of all XML

struct Geometry {
  const XMLElement* element;
  ColladaMesh mesh;
  std::string materials;  ///< where it was shown first
  bool shown = false;
};

/// Puts together what the scene shows: geometries below nodes, which may show other nodes.
class SceneReader {
 public:
  SceneReader(const XMLElement& root, const InputSource& source) : root_(root), source_(source) {}
  MeshClaim read();

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  void collect(const XMLElement& element);
  void collectGeometry(const XMLElement& element);
  double unit() const;
  const XMLElement* visualScene() const;
  const XMLElement& instancedNode(const XMLElement& instance) const;
  const XMLElement& named(const XMLElement& element,
                          const std::map<std::string, const XMLElement*>& all) const;
  std::vector<double> numbers(const XMLElement& element, std::size_t count) const;
  Eigen::Matrix4d transform(const XMLElement& element) const;
  void showNode(const XMLElement& node, Eigen::Matrix4d file_from_node, int depth);
  void showChild(const XMLElement& child, Eigen::Matrix4d& file_from_node, int depth);
  void showGeometry(const XMLElement& instance, const Eigen::Matrix4d& file_from_node);

  const XMLElement& root_;
  const InputSource& source_;
  std::map<std::string, const XMLElement*> nodes_, scenes_;
  std::multimap<std::string, const XMLElement*> nodesByName_;
  std::map<std::string, Geometry> geometries_;
  int nodesShown_ = 0;
  MeshClaim claim_;
};

void SceneReader::collectGeometry(const XMLElement& element) {
  const char* id = element.Attribute("id");
  const XMLElement* mesh = element.FirstChildElement("mesh");
  if (id == nullptr) fail(element, "has no attribute 'id'");
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (e != mesh && name != "asset" && name != "extra")
      fail(*e, "in a <geometry> is not read; allowed is one <mesh>");
  }
  Geometry geometry{.element = &element, .mesh = {}, .materials = {}};
  if (mesh != nullptr) geometry.mesh = readColladaMesh(*mesh, source_);
  if (!geometries_.emplace(id, std::move(geometry)).second)
    fail(element, std::string("is a second one with the id '") + id + "'");
}

void SceneReader::collect(const XMLElement& element) {
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (name == "geometry") {
      collectGeometry(*e);
      continue;
    }
    if (name == "node" || name == "visual_scene") {
      auto& all = name == "node" ? nodes_ : scenes_;
      if (const char* label = e->Attribute("name")) nodesByName_.emplace(label, e);
      const char* id = e->Attribute("id");
      if (id != nullptr && !all.emplace(id, e).second)
        fail(*e, std::string("is a second one with the id '") + id + "'");
    }
    collect(*e);
  }
}

/// Metres.
double SceneReader::unit() const {
  const XMLElement* asset = root_.FirstChildElement("asset");
  const XMLElement* unit = asset != nullptr ? asset->FirstChildElement("unit") : nullptr;
  const char* meter = unit != nullptr ? unit->Attribute("meter") : nullptr;
  if (meter == nullptr) return 1.0;
  const auto value = parseNumber(meter);
  if (!value || !(*value > 0.0)) {
    fail(*unit, std::string("has meter=\"") + meter + "\"; it must be a number greater than 0");
  }
  return *value;
}

const XMLElement& SceneReader::named(const XMLElement& element,
                                     const std::map<std::string, const XMLElement*>& all) const {
  const auto found = all.find(colladaTarget(element, "url"));
  if (found != all.end()) return *found->second;
  const char* url = element.Attribute("url");
  fail(element, std::string("has url=\"") + (url != nullptr ? url : "") +
                    "\"; it must be # and an id of this file");
}

const XMLElement* SceneReader::visualScene() const {
  const XMLElement* scene = root_.FirstChildElement("scene");
  const XMLElement* instance =
      scene != nullptr ? scene->FirstChildElement("instance_visual_scene") : nullptr;
  return instance != nullptr ? &named(*instance, scenes_) : nullptr;
}

const XMLElement& SceneReader::instancedNode(const XMLElement& instance) const {
  const XMLElement& node = named(instance, nodes_);
  const auto [first, last] = nodesByName_.equal_range(colladaTarget(instance, "url"));
  // Assimp takes either.
  if (std::any_of(first, last, [&](const auto& other) { return other.second != &node; }))
    fail(instance, "names the id of one node, which is the name of another");
  return node;
}

std::vector<double> SceneReader::numbers(const XMLElement& element, std::size_t count) const {
  std::vector<double> values;
  MeshClaim unused;
  for (const std::string_view word : colladaWords(element, source_)) {
    const auto value = unused.coordinate(word);
    if (!value) fail(element, "holds more than finite numbers");
    values.push_back(*value);
  }
  if (values.size() != count)
    fail(element, "has " + std::to_string(values.size()) + " numbers; " + std::to_string(count) +
                      " have to be there");
  return values;
}

/// Of the elements that place a node; of others the identity.
Eigen::Matrix4d SceneReader::transform(const XMLElement& element) const {
  const std::string_view name = element.Name();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (name == "translate") {
    result.translation() = Eigen::Vector3d::Map(numbers(element, 3).data());
  } else if (name == "scale") {
    result.linear() = Eigen::Vector3d::Map(numbers(element, 3).data()).asDiagonal();
  } else if (name == "rotate") {
    const auto values = numbers(element, 4);
    const Eigen::Vector3d axis = Eigen::Vector3d::Map(values.data());
    if (values[3] == 0.0) return result.matrix();
    // Assimp takes the axis for a unit vector.
    if (std::abs(axis.norm() - 1.0) > kUnitAxis)
      fail(element, "has an axis whose length is " + formatNumber(axis.norm()) + "; it must be 1");
    result.linear() = Eigen::AngleAxisd(values[3] * std::numbers::pi / 180.0, axis.normalized())
                          .toRotationMatrix();
  } else if (name == "matrix") {
    const auto values = numbers(element, 16);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      fail(element, "has a last row other than 0 0 0 1");
    return matrix;
  }
  return result.matrix();
}

std::string materialsOf(const XMLElement& instance) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  if (const XMLElement* materials = instance.FirstChildElement("bind_material"))
    materials->Accept(&printer);
  return printer.CStr();
}

void SceneReader::showGeometry(const XMLElement& instance, const Eigen::Matrix4d& file_from_node) {
  const auto found = geometries_.find(colladaTarget(instance, "url"));
  if (found == geometries_.end()) fail(instance, "names a <geometry> that does not exist");
  Geometry& geometry = found->second;
  const std::string materials = materialsOf(instance);
  // Assimp then takes faces of one group for those of another.
  if (geometry.shown && geometry.mesh.groups > 1 && materials != geometry.materials)
    fail(instance, "shows a <geometry> of several groups of faces again with other materials");
  geometry.shown = true;
  geometry.materials = materials;
  claim_.triangles += geometry.mesh.triangles;
  requireFewTriangles(claim_.triangles);
  const Eigen::Matrix3d linear = file_from_node.topLeftCorner<3, 3>();
  const Eigen::Vector3d offset = file_from_node.topRightCorner<3, 1>();
  for (const Eigen::Vector3d& corner : geometry.mesh.corners)
    claim_.box.extend(Eigen::Vector3d(linear * corner + offset));
  claim_.loss =
      std::max(claim_.loss, geometry.mesh.loss * linear.cwiseAbs().rowwise().sum().maxCoeff());
}

void SceneReader::showChild(const XMLElement& child, Eigen::Matrix4d& file_from_node, int depth) {
  const std::string_view name = child.Name();
  if (name == "node") {
    showNode(child, file_from_node, depth + 1);
  } else if (name == "instance_node") {
    showNode(instancedNode(child), file_from_node, depth + 1);
  } else if (name == "instance_geometry") {
    showGeometry(child, file_from_node);
  } else if (name == "instance_controller" || name == "skew" || name == "lookat") {
    fail(child,
         "is not read; allowed are instance_geometry and instance_node, and translate, "
         "rotate, scale and matrix");
  }
}

/// Whatever the order of its children, all transforms of a node count for all that it shows.
void SceneReader::showNode(const XMLElement& node, Eigen::Matrix4d file_from_node, int depth) {
  if (++nodesShown_ > kMaxNodes || depth > kMaxDepth) {
    fail(node, "is one too many: " + std::to_string(kMaxNodes) +
                   " nodes are the most that are shown, " + std::to_string(kMaxDepth) +
                   " in each other");
  }
  for (const XMLElement* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    file_from_node *= transform(*e);
  for (const XMLElement* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    showChild(*e, file_from_node, depth);
}

MeshClaim SceneReader::read() {
  collect(root_);
  const XMLElement* scene = visualScene();
  if (scene == nullptr) source_.fail(0, "it has no <scene> with an <instance_visual_scene>");
  Eigen::Matrix4d file_from_scene = Eigen::Matrix4d::Identity();
  file_from_scene.topLeftCorner<3, 3>() *= unit();
  showNode(*scene, file_from_scene, 0);
  for (const auto& [id, geometry] : geometries_) {
    if (!geometry.shown && geometry.mesh.triangles > 0)
      fail(*geometry.element,
           "with the id '" + id + "' has faces, and no node of the scene shows it");
  }
  return claim_;
}

}  // namespace

MeshClaim checkCollada(std::string_view bytes, const InputSource& source) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
    source.fail(document.ErrorLineNum(), "malformed XML");
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA")
    source.fail(0, "its root element is not <COLLADA>");
  return SceneReader(*root, source).read();
}

}  // namespace swept::detail
