// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/collada_mesh.hpp"
#include "io/collada_transform.hpp"
#include "io/collada_xml.hpp"
#include "io/mesh_claim.hpp"
#include "io/mesh_file.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

constexpr int kMaxNodes = 1'000'000;  ///< shown; a few lines that name each other show billions
constexpr int kMaxDepth = 500;        ///< as of all XML

struct Geometry {
  XMLElement* element;
  ColladaMesh mesh;
  bool shown = false;
};

using Elements = std::multimap<std::string, XMLElement*>;

/// Puts together what the scene shows: geometries below nodes, which may show other nodes. A node
/// that shows none (a camera, a lamp, a bone) is passed over.
class SceneReader {
 public:
  SceneReader(XMLElement& root, const InputSource& source, FaceMaterials materials)
      : root_(root), source_(source), materials_(materials) {}
  /// What is left of the elements afterwards is what the scene shows.
  MeshClaim read();

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  void collect(XMLElement& element);
  void collectGeometry(XMLElement& element);
  double unit() const;
  XMLElement* visualScene() const;
  XMLElement& instancedNode(const XMLElement& instance) const;
  XMLElement& named(const XMLElement& element, const Elements& all) const;
  bool mayShow(const XMLElement& node);
  void showNode(const XMLElement& node, Eigen::Matrix4d file_from_node, int depth);
  void showChild(const XMLElement& child, Eigen::Matrix4d& file_from_node, int depth);
  void showGeometry(const XMLElement& instance, const Eigen::Matrix4d& file_from_node);
  void keepShown();
  void keepShownIn(XMLElement& parent);
  bool isKept(const XMLElement& child, bool parentIsShown) const;

  XMLElement& root_;
  const InputSource& source_;
  FaceMaterials materials_;
  Elements nodes_, scenes_;
  Elements nodesByName_;
  std::map<std::string, Geometry> geometries_;
  std::map<const XMLElement*, bool> mayShow_;
  std::set<const XMLElement*> shown_;           ///< the scene, nodes and instances
  std::set<const tinyxml2::XMLNode*> holders_;  ///< what these are in
  int nodesShown_ = 0;
  MeshClaim claim_;
};

void SceneReader::collectGeometry(XMLElement& element) {
  const char* id = element.Attribute("id");
  XMLElement* mesh = element.FirstChildElement("mesh");
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (e != mesh && name != "asset" && name != "extra")
      fail(*e, "in a <geometry> is not read; allowed is one <mesh>");
  }
  Geometry geometry{.element = &element, .mesh = {}};
  if (mesh != nullptr) geometry.mesh = readColladaMesh(*mesh, source_, claim_.crossing, materials_);
  const bool hasFaces = geometry.mesh.triangles > 0;
  if (id == nullptr && !hasFaces) return;
  if (id == nullptr) fail(element, "has no attribute 'id'");
  const auto [known, isFirst] = geometries_.try_emplace(id, std::move(geometry));
  if (!isFirst && (hasFaces || known->second.mesh.triangles > 0))
    fail(element, std::string("is a second one with the id '") + id + "'");
}

void SceneReader::collect(XMLElement& element) {
  forEachChild(element, nullptr, [&](XMLElement& e) {
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

XMLElement& SceneReader::named(const XMLElement& element, const Elements& all) const {
  const auto [first, last] = all.equal_range(colladaTarget(element, "url"));
  const char* text = element.Attribute("url");
  const std::string url = std::string("has url=\"") + (text != nullptr ? text : "") + "\"; ";
  if (first == last) fail(element, url + "it must be # and an id of this file");
  // Of elements that nothing names it is of no account that they have the same.
  if (const auto second = std::next(first); second != last) {
    fail(element, url + "the elements at lines " + std::to_string(first->second->GetLineNum()) +
                      " and " + std::to_string(second->second->GetLineNum()) +
                      " both have that id");
  }
  return *first->second;
}

XMLElement* SceneReader::visualScene() const {
  const XMLElement* scene = root_.FirstChildElement("scene");
  const XMLElement* instance =
      scene != nullptr ? scene->FirstChildElement("instance_visual_scene") : nullptr;
  return instance != nullptr ? &named(*instance, scenes_) : nullptr;
}

XMLElement& SceneReader::instancedNode(const XMLElement& instance) const {
  XMLElement& node = named(instance, nodes_);
  const auto [first, last] = nodesByName_.equal_range(colladaTarget(instance, "url"));
  // Assimp takes either.
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

void SceneReader::showGeometry(const XMLElement& instance, const Eigen::Matrix4d& file_from_node) {
  const auto found = geometries_.find(colladaTarget(instance, "url"));
  if (found == geometries_.end()) fail(instance, "names a <geometry> that does not exist");
  Geometry& geometry = found->second;
  geometry.shown = true;
  if (geometry.mesh.triangles == 0) return;
  shown_.insert(&instance);
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
    const XMLElement& node = instancedNode(child);
    if (mayShow(node)) shown_.insert(&child);
    showNode(node, file_from_node, depth + 1);
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
  if (!mayShow(node)) return;
  shown_.insert(&node);
  const tinyxml2::XMLNode* holder = node.Parent();
  while (holder != nullptr && holders_.insert(holder).second) holder = holder->Parent();
  for (const XMLElement* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    file_from_node *= colladaTransform(*e, source_);
  for (const XMLElement* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    showChild(*e, file_from_node, depth);
}

/// A child of one that is shown; of others that hold such nodes, these alone.
bool SceneReader::isKept(const XMLElement& child, bool parentIsShown) const {
  const std::string_view name = child.Name();
  if (name == "node" || name == "visual_scene")
    return shown_.contains(&child) || holders_.contains(&child);
  return parentIsShown && (isColladaTransform(name) || shown_.contains(&child));
}

void SceneReader::keepShownIn(XMLElement& parent) {
  const bool isShown = shown_.contains(&parent);
  keepChildren(parent, [&](const XMLElement& child) { return isKept(child, isShown); });
  forEachChild(parent, nullptr, [&](XMLElement& child) {
    const std::string_view name = child.Name();
    if (isColladaTransform(name)) return setColladaWords(child, colladaWords(child, source_));
    if (name == "node" || name == "visual_scene") return keepShownIn(child);
    if (materials_ == FaceMaterials::LeftOut) child.DeleteChildren();
  });
}

void SceneReader::keepShown() {
  forEachChild(root_, "library_nodes", [&](XMLElement& nodes) { keepShownIn(nodes); });
  forEachChild(root_, "library_visual_scenes", [&](XMLElement& scenes) { keepShownIn(scenes); });
  forEachChild(root_, "library_geometries", [&](XMLElement& library) {
    keepChildren(library, [&](const XMLElement& child) {
      const char* const id = child.Attribute("id");
      const auto found = geometries_.find(id != nullptr ? id : "");
      return found != geometries_.end() && found->second.element == &child && found->second.shown &&
             found->second.mesh.triangles > 0;
    });
    forEachChild(library, nullptr, [](XMLElement& geometry) {
      keepChildren(geometry, [](const XMLElement& child) {
        return std::string_view(child.Name()) == "mesh";
      });
    });
  });
  keepChildren(root_, [&](const XMLElement& child) {
    const std::string_view name = child.Name();
    const bool isOfMaterials =
        name == "library_materials" || name == "library_effects" || name == "library_images";
    return (isOfMaterials && materials_ == FaceMaterials::Kept) || name == "asset" ||
           name == "library_geometries" || name == "library_nodes" ||
           name == "library_visual_scenes" || name == "scene";
  });
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
  keepShown();
  return std::move(claim_);
}

MeshClaim check(std::string_view bytes, const InputSource& source, FaceMaterials materials) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
    source.fail(document.ErrorLineNum(), "malformed XML");
  XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA")
    source.fail(0, "its root element is not <COLLADA>");
  MeshClaim claim = SceneReader(*root, source, materials).read();
  tinyxml2::XMLPrinter printer(nullptr, true);
  root->Accept(&printer);
  claim.bare = printer.CStr();
  return claim;
}

}  // namespace

MeshClaim checkCollada(std::string_view bytes, const InputSource& source) {
  return check(bytes, source, FaceMaterials::LeftOut);
}

MeshClaim checkColladaWithMaterials(std::string_view bytes, const InputSource& source) {
  return check(bytes, source, FaceMaterials::Kept);
}

}  // namespace swept::detail
