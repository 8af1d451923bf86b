// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/collada_colours.hpp"
#include "io/collada_mesh.hpp"
#include "io/collada_transform.hpp"
#include "io/collada_xml.hpp"
#include "io/face_cutter.hpp"
#include "io/mesh_readers.hpp"
#include "swept/core/tolerances.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

constexpr int kMaxNodes = 1'000'000;  ///< shown; a few lines that name each other show billions
constexpr int kMaxDepth = 500;        ///< as of all XML

/// Of the largest coordinate. A proof takes 2 kRoundingPerJoint of it, and more, for the rounding
/// of a pose, of which the operations there need a third.
constexpr double kLittleError = 1.25 * tolerance::kRoundingPerJoint;

struct Geometry {
  const XMLElement* element;
  ColladaMesh mesh;
  double size = 0.0;  ///< no vertex is farther from the mesh's origin
  bool shown = false;

  bool hasFaces() const { return !mesh.content.triangles.empty(); }
};

using Elements = std::multimap<std::string, const XMLElement*>;

/// Collects what the scene shows: geometries below nodes, which may instantiate other nodes. Skips
/// a node that shows none (a camera, a lamp, a bone).
class SceneReader {
 public:
  SceneReader(const XMLElement& root, const InputSource& source, FaceMaterials materials)
      : root_(root), source_(source), cutter_(source) {
    if (materials == FaceMaterials::Kept) colours_.emplace(root);
  }
  MeshFileContent read();

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  void collect(const XMLElement& element);
  const XMLElement* meshOf(const XMLElement& geometry) const;
  void collectGeometry(const XMLElement& element);
  double unit() const;
  const XMLElement* visualScene() const;
  const XMLElement& instancedNode(const XMLElement& instance) const;
  const XMLElement& named(const XMLElement& element, const Elements& all) const;
  bool mayShow(const XMLElement& node);
  void showNode(const XMLElement& node, ColladaPlace place, int depth);
  void showChild(const XMLElement& child, const ColladaPlace& place, int depth);
  void showGeometry(const XMLElement& instance, const ColladaPlace& place);

  const XMLElement& root_;
  const InputSource& source_;
  FaceCutter cutter_;
  std::optional<ColladaColours> colours_;  ///< none: nobody wants them
  Elements nodes_, scenes_;
  Elements nodesByName_;
  std::map<std::string, Geometry> geometries_;
  std::map<const XMLElement*, bool> mayShow_;
  int nodesShown_ = 0;
  MeshFileContent content_;
};

/// A <convex_mesh> in the place of a <mesh> has the same children, and a proof is about its faces,
/// whether or not they are those of a convex solid. One with convex_hull_of has none.
const XMLElement* SceneReader::meshOf(const XMLElement& geometry) const {
  const XMLElement* const mesh = geometry.FirstChildElement("mesh");
  const XMLElement* const convex = geometry.FirstChildElement("convex_mesh");
  if (mesh != nullptr || convex == nullptr || convex->NoChildren() ||
      convex->Attribute("convex_hull_of") != nullptr)
    return mesh;
  return convex;
}

void SceneReader::collectGeometry(const XMLElement& element) {
  const char* id = element.Attribute("id");
  const XMLElement* const mesh = meshOf(element);
  forEachChild(element, nullptr, [&](const XMLElement& e) {
    const std::string_view name = e.Name();
    if (&e != mesh && name != "asset" && name != "extra")
      fail(e, "in a <geometry> is not read; allowed is one <mesh>");
  });
  Geometry geometry{.element = &element, .mesh = {}};
  if (mesh != nullptr) geometry.mesh = readColladaMesh(*mesh, source_, cutter_);
  for (const Eigen::Vector3d& vertex : geometry.mesh.content.vertices)
    geometry.size = std::max(geometry.size, vertex.stableNorm());
  const bool hasFaces = geometry.hasFaces();
  if (id == nullptr && !hasFaces) return;
  if (id == nullptr) fail(element, "has no attribute 'id'");
  const auto [known, isFirst] = geometries_.try_emplace(id, std::move(geometry));
  if (!isFirst && (hasFaces || known->second.hasFaces()))
    fail(element, std::string("is a second one with the id '") + id + "'");
}

void SceneReader::collect(const XMLElement& element) {
  forEachChild(element, nullptr, [&](const XMLElement& e) {
    const std::string_view name = e.Name();
    if (name == "geometry") return collectGeometry(e);
    if (name == "node" || name == "visual_scene") {
      Elements& all = name == "node" ? nodes_ : scenes_;
      if (const char* label = e.Attribute("name")) nodesByName_.emplace(label, &e);
      if (const char* id = e.Attribute("id")) all.emplace(id, &e);
    }
    collect(e);
  });
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

const XMLElement& SceneReader::named(const XMLElement& element, const Elements& all) const {
  const auto [first, last] = all.equal_range(colladaTarget(element, "url"));
  const char* text = element.Attribute("url");
  const std::string url = std::string("has url=\"") + (text != nullptr ? text : "") + "\"; ";
  if (first == last) fail(element, url + "it must be # and an id of this file");
  // Elements that nothing refers to may share an id.
  if (const auto second = std::next(first); second != last) {
    fail(element, url + "the elements at lines " + std::to_string(first->second->GetLineNum()) +
                      " and " + std::to_string(second->second->GetLineNum()) +
                      " both have that id");
  }
  return *first->second;
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
  // Some readers take either.
  if (std::any_of(first, last, [&](const auto& other) { return other.second != &node; }))
    fail(instance, "names the id of one node, which is the name of another");
  return node;
}

/// Whether there is geometry below it, or another node is named there.
bool SceneReader::mayShow(const XMLElement& node) {
  if (const auto known = mayShow_.find(&node); known != mayShow_.end()) return known->second;
  bool may = false;
  forEachChild(node, nullptr, [&](const XMLElement& child) {
    const std::string_view name = child.Name();
    may = may || name == "instance_geometry" || name == "instance_controller" ||
          name == "instance_node" || (name == "node" && mayShow(child));
  });
  mayShow_[&node] = may;
  return may;
}

void SceneReader::showGeometry(const XMLElement& instance, const ColladaPlace& place) {
  const auto found = geometries_.find(colladaTarget(instance, "url"));
  if (found == geometries_.end()) fail(instance, "names a <geometry> that does not exist");
  Geometry& geometry = found->second;
  geometry.shown = true;
  if (!geometry.hasFaces()) return;
  const MeshFileContent& mesh = geometry.mesh.content;
  requireFewTriangles(content_.triangles.size() + mesh.triangles.size());
  const Eigen::Vector3i first =
      Eigen::Vector3i::Constant(static_cast<int>(content_.vertices.size()));
  for (const Eigen::Vector3d& vertex : mesh.vertices) content_.vertices.push_back(place(vertex));
  for (const Eigen::Vector3i& triangle : mesh.triangles)
    content_.triangles.emplace_back(first + triangle);
  const double error = place.error(geometry.size);
  if (!std::isfinite(error)) fail(instance, "is taken beyond every number by its nodes");
  content_.error = std::max(content_.error, error);
  if (!colours_) return;
  for (const ColladaMesh::Group& group : geometry.mesh.groups)
    content_.colours.insert(content_.colours.end(), group.triangles,
                            colours_->of(instance, group.material));
}

void SceneReader::showChild(const XMLElement& child, const ColladaPlace& place, int depth) {
  const std::string_view name = child.Name();
  if (name == "node") {
    showNode(child, place, depth + 1);
  } else if (name == "instance_node") {
    showNode(instancedNode(child), place, depth + 1);
  } else if (name == "instance_geometry") {
    showGeometry(child, place);
  } else if (name == "instance_controller" || name == "skew" || name == "lookat") {
    fail(child,
         "is not read; allowed are instance_geometry and instance_node, and translate, "
         "rotate, scale and matrix");
  }
}

/// All transforms of a node apply to all that it shows, whatever the order of its children.
void SceneReader::showNode(const XMLElement& node, ColladaPlace place, int depth) {
  if (++nodesShown_ > kMaxNodes || depth > kMaxDepth) {
    fail(node, "is one too many: " + std::to_string(kMaxNodes) +
                   " nodes are the most that are shown, " + std::to_string(kMaxDepth) +
                   " in each other");
  }
  if (!mayShow(node)) return;
  forEachChild(node, nullptr, [&](const XMLElement& child) { place.enter(child, source_); });
  forEachChild(node, nullptr, [&](const XMLElement& child) { showChild(child, place, depth); });
}

MeshFileContent SceneReader::read() {
  collect(root_);
  const XMLElement* scene = visualScene();
  if (scene == nullptr) source_.fail(0, "it has no <scene> with an <instance_visual_scene>");
  showNode(*scene, ColladaPlace(unit()), 0);
  for (const auto& [id, geometry] : geometries_) {
    if (!geometry.shown && geometry.hasFaces())
      fail(*geometry.element,
           "with the id '" + id + "' has faces, and no node of the scene shows it");
  }
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : content_.vertices)
    largest = std::max(largest, vertex.stableNorm());
  if (content_.error <= kLittleError * largest) content_.error = 0.0;
  return std::move(content_);
}

}  // namespace

MeshFileContent readColladaFile(std::string_view bytes, const InputSource& source,
                                FaceMaterials materials) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
    source.fail(document.ErrorLineNum(), "malformed XML");
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA")
    source.fail(0, "its root element is not <COLLADA>");
  return SceneReader(*root, source, materials).read();
}

}  // namespace swept::detail
