// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_mesh.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>

#include "io/collada_positions.hpp"
#include "io/collada_xml.hpp"
#include "io/point_file.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;
using Count = std::uint64_t;

/// How the corners of a group of faces are written.
struct Layout {
  Count width = 0;   ///< indices of each
  Count vertex = 0;  ///< which one of them is the vertex
  bool hasVertex = false;
};

/// A list of corners: indices of positions.
using Corners = std::vector<Count>;

bool isFaces(const XMLElement& group) {
  constexpr std::array<std::string_view, 4> kFaces{"triangles", "polylist", "polygons",
                                                   "tristrips"};
  return std::ranges::find(kFaces, std::string_view(group.Name())) != kFaces.end();
}

/// One <mesh>: every name in it is looked up in it.
class MeshReader {
 public:
  MeshReader(XMLElement& mesh, const InputSource& source, CrossingFace& crossing,
             FaceMaterials materials)
      : xml_(mesh),
        source_(source),
        crossing_(crossing),
        materials_(materials),
        positions_(mesh, source) {}
  ColladaMesh read();

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  std::vector<std::string_view> words(const XMLElement& element) const {
    return colladaWords(element, source_);
  }
  bool hasFaces() const;
  void requireKnown(const XMLElement& group) const;
  Layout layoutOf(XMLElement& group) const;
  Corners readList(XMLElement& list, const Layout& layout);
  void readGroup(XMLElement& group);
  Count trianglesOf(XMLElement& group, const std::vector<Corners>& lists);
  Count polylistOf(XMLElement& group, const Corners& corners);
  void look(const XMLElement& list, std::span<const Count> corners, std::int64_t face = -1);
  void keepFaces();

  XMLElement& xml_;
  const InputSource& source_;
  CrossingFace& crossing_;
  FaceMaterials materials_;
  ColladaPositions positions_;
  std::vector<bool> used_;
  std::set<const XMLElement*> groups_;  ///< that have faces
  ColladaMesh mesh_;
};

bool MeshReader::hasFaces() const {
  bool found = false;
  forEachChild(xml_, nullptr, [&](const XMLElement& group) {
    if (!isFaces(group)) return;
    forEachChild(group, "p", [&](const XMLElement& list) { found |= !list.NoChildren(); });
  });
  return found;
}

void MeshReader::requireKnown(const XMLElement& group) const {
  const std::string_view name = group.Name();
  const bool isKnown = isFaces(group) || name == "source" || name == "vertices" ||
                       name == "extra" || name == "lines" || name == "linestrips";
  if (!isKnown) {
    fail(group,
         "is not read; allowed are triangles, polylist, polygons and tristrips, and lines and "
         "linestrips, which have no faces");
  }
  const XMLElement* const hole = group.FirstChildElement("ph");
  if (hole != nullptr && name != "extra") fail(*hole, "is a polygon with holes, which is not read");
}

Layout MeshReader::layoutOf(XMLElement& group) const {
  constexpr Count kMaxOffset = 64;  // far beyond the handful of inputs that files have
  Layout layout;
  forEachChild(group, "input", [&](const XMLElement& input) {
    const Count offset = colladaCount(source_, input, "offset");
    if (offset > kMaxOffset) fail(input, "has an offset beyond every input");
    layout.width = std::max(layout.width, offset + 1);
    if (!hasSemantic(input, "VERTEX")) return;
    positions_.requireNamed(input);
    if (layout.hasVertex) fail(input, "is a second one of vertices; one is allowed");
    layout.hasVertex = true;
    layout.vertex = offset;
  });
  return layout;
}

/// What is left of the list are indices of vertices.
Corners MeshReader::readList(XMLElement& list, const Layout& layout) {
  const auto entries = words(list);
  if (entries.empty()) return {};
  if (!layout.hasVertex) fail(list, "has no <input> of vertices to index");
  if (entries.size() % layout.width != 0) {
    fail(list, "ends within a corner, which takes " + std::to_string(layout.width) + " indices");
  }
  Corners corners;
  std::vector<std::string_view> kept;
  for (std::size_t i = layout.vertex; i < entries.size(); i += layout.width) {
    const auto value = colladaCount(entries[i]);
    if (!value) fail(list, "does not hold whole numbers only");
    if (*value >= used_.size()) fail(list, "has an index past its source");
    used_[*value] = true;
    corners.push_back(*value);
    kept.push_back(entries[i]);
  }
  setColladaWords(list, kept);
  return corners;
}

void MeshReader::look(const XMLElement& list, std::span<const Count> corners, std::int64_t face) {
  if (corners.size() <= 4) return;
  std::vector<Eigen::Vector3d> polygon;
  for (const Count corner : corners) polygon.push_back(positions_.all()[corner]);
  crossing_.look(polygon, list.GetLineNum(), face);
}

Count MeshReader::polylistOf(XMLElement& group, const Corners& corners) {
  std::vector<Count> faces;
  Count triangles = 0, listed = 0;
  forEachChild(group, "vcount", [&](XMLElement& sizes) {
    const auto entries = words(sizes);
    for (const std::string_view word : entries) {
      const auto size = colladaCount(word);
      if (!size) fail(sizes, "does not hold whole numbers only");
      if (*size < 3) fail(sizes, "has a face of " + shown(word) + " corners; 3 are the least");
      triangles += *size - 2;
      listed += *size;
      faces.push_back(*size);
    }
    setColladaWords(sizes, entries);
  });
  if (listed != corners.size() || faces.size() != colladaCount(source_, group, "count")) {
    fail(group, "has " + std::to_string(faces.size()) + " faces of " + std::to_string(listed) +
                    " corners by its <vcount>, and " + std::to_string(corners.size()) +
                    " corners in its <p>; its count is " + group.Attribute("count"));
  }
  Count first = 0;
  for (std::size_t face = 0; face < faces.size(); first += faces[face++])
    look(*group.FirstChildElement("p"), std::span(corners).subspan(first, faces[face]),
         static_cast<std::int64_t>(face));
  return triangles;
}

Count MeshReader::trianglesOf(XMLElement& group, const std::vector<Corners>& lists) {
  const std::string_view name = group.Name();
  const Count count = colladaCount(source_, group, "count");
  if (name == "triangles" || name == "polylist") {
    if (lists.size() > 1) fail(group, "has more than one <p>; one is allowed");
    const Corners corners = lists.empty() ? Corners{} : lists.front();
    if (name == "polylist") return polylistOf(group, corners);
    if (corners.size() == 3 * count) return count;
    fail(group, "has " + std::to_string(corners.size()) +
                    " corners; as many as 3 times its count, " + std::to_string(count) +
                    ", have to be there");
  }
  if (lists.size() != count) {
    fail(group, "has " + std::to_string(lists.size()) + " elements <p>; its count is " +
                    std::to_string(count));
  }
  if (std::ranges::any_of(lists, [](const Corners& list) { return list.size() < 3; }))
    fail(group, "has a <p> of less than 3 corners");
  Count triangles = 0;
  const XMLElement* list = group.FirstChildElement("p");
  for (const Corners& corners : lists) {
    if (name == "polygons") look(*list, corners);
    list = list->NextSiblingElement("p");
    triangles += corners.size() - 2;
  }
  return triangles;
}

void MeshReader::readGroup(XMLElement& group) {
  const Layout layout = layoutOf(group);
  std::vector<Corners> lists;
  forEachChild(group, "p", [&](XMLElement& list) { lists.push_back(readList(list, layout)); });
  const Count triangles = trianglesOf(group, lists);
  if (triangles == 0) return;
  mesh_.triangles += triangles;
  groups_.insert(&group);
  if (materials_ == FaceMaterials::LeftOut) group.DeleteAttribute("material");
  keepChildren(group, [](XMLElement& child) {
    const std::string_view name = child.Name();
    if (name == "input") child.SetAttribute("offset", 0);
    return name == "p" || name == "vcount" || (name == "input" && hasSemantic(child, "VERTEX"));
  });
}

/// In the order that assimp needs: it looks up what it has read already.
void MeshReader::keepFaces() {
  keepChildren(xml_, [&](const XMLElement& child) {
    return !groups_.empty() && (positions_.isPart(child) || groups_.contains(&child));
  });
  if (!groups_.empty()) positions_.moveToFront();
}

ColladaMesh MeshReader::read() {
  forEachChild(xml_, nullptr, [&](XMLElement& child) { requireKnown(child); });
  if (hasFaces()) positions_.read();
  used_.resize(positions_.all().size());
  forEachChild(xml_, nullptr, [&](XMLElement& child) {
    if (isFaces(child)) readGroup(child);
  });
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (used_[i]) mesh_.corners.push_back(positions_.all()[i]);
  mesh_.loss = positions_.loss();
  keepFaces();
  return std::move(mesh_);
}

}  // namespace

ColladaMesh readColladaMesh(XMLElement& mesh, const InputSource& source, CrossingFace& crossing,
                            FaceMaterials materials) {
  return MeshReader(mesh, source, crossing, materials).read();
}

}  // namespace swept::detail
