// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

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
using Corners = std::vector<int>;

bool isFaces(const XMLElement& group) {
  constexpr std::array<std::string_view, 4> kFaces{"triangles", "polylist", "polygons",
                                                   "tristrips"};
  return std::ranges::find(kFaces, std::string_view(group.Name())) != kFaces.end();
}

/// One <mesh>: every name in it is looked up in it.
class MeshReader {
 public:
  MeshReader(const XMLElement& mesh, const InputSource& source, FaceCutter& cutter)
      : xml_(mesh), source_(source), cutter_(cutter), positions_(mesh, source) {}
  ColladaMesh read();

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  bool hasFaces() const;
  void requireKnown(const XMLElement& group) const;
  Layout layoutOf(const XMLElement& group) const;
  Corners readList(const XMLElement& list, const Layout& layout) const;
  void readGroup(const XMLElement& group);
  void addTriangles(const XMLElement& group, const XMLElement* list, const Corners& corners);
  void addPolylist(const XMLElement& group, const XMLElement* list, const Corners& corners);
  void addStrip(const Corners& corners);
  void add(const XMLElement& list, std::span<const int> corners, std::int64_t face = -1) {
    cutter_.cut(corners, positions_.all(), mesh_.content.triangles, list.GetLineNum(), face);
  }

  const XMLElement& xml_;
  const InputSource& source_;
  FaceCutter& cutter_;
  ColladaPositions positions_;
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

Layout MeshReader::layoutOf(const XMLElement& group) const {
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

Corners MeshReader::readList(const XMLElement& list, const Layout& layout) const {
  Corners corners;
  Count entries = 0;
  forEachColladaWord(list, source_, [&](std::string_view word) {
    if (!layout.hasVertex) fail(list, "has no <input> of vertices to index");
    if (entries++ % layout.width != layout.vertex) return;
    const auto value = colladaCount(word);
    if (!value) fail(list, "does not hold whole numbers only");
    if (*value >= positions_.all().size()) fail(list, "has an index past its source");
    corners.push_back(static_cast<int>(*value));
  });
  if (entries > 0 && entries % layout.width != 0)
    fail(list, "ends within a corner, which takes " + std::to_string(layout.width) + " indices");
  return corners;
}

void MeshReader::addTriangles(const XMLElement& group, const XMLElement* list,
                              const Corners& corners) {
  const Count count = colladaCount(source_, group, "count");
  if (corners.size() != 3 * count) {
    fail(group, "has " + std::to_string(corners.size()) +
                    " corners; as many as 3 times its count, " + std::to_string(count) +
                    ", have to be there");
  }
  for (std::size_t i = 0; i < corners.size(); i += 3) add(*list, std::span(corners).subspan(i, 3));
}

void MeshReader::addPolylist(const XMLElement& group, const XMLElement* list,
                             const Corners& corners) {
  std::vector<std::uint32_t> faces;
  Count listed = 0;
  forEachChild(group, "vcount", [&](const XMLElement& sizes) {
    forEachColladaWord(sizes, source_, [&](std::string_view word) {
      const auto size = colladaCount(word);
      if (!size) fail(sizes, "does not hold whole numbers only");
      if (*size < 3) fail(sizes, "has a face of " + shown(word) + " corners; 3 are the least");
      listed += *size;
      faces.push_back(static_cast<std::uint32_t>(*size));
    });
  });
  const Count count = colladaCount(source_, group, "count");
  if (listed != corners.size() || faces.size() != count) {
    fail(group, "has " + std::to_string(faces.size()) + " faces of " + std::to_string(listed) +
                    " corners by its <vcount>, and " + std::to_string(corners.size()) +
                    " corners in its <p>; its count is " + std::to_string(count));
  }
  std::span<const int> rest(corners);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    add(*list, rest.first(faces[face]), static_cast<std::int64_t>(face));
    rest = rest.subspan(faces[face]);
  }
}

/// Every other triangle of a strip has its corners in the opposite orientation.
void MeshReader::addStrip(const Corners& corners) {
  requireFewTriangles(mesh_.content.triangles.size() + corners.size() - 2);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const bool isOdd = i % 2 != 0;
    mesh_.content.triangles.emplace_back(corners[i - (isOdd ? 1 : 2)], corners[i - (isOdd ? 2 : 1)],
                                         corners[i]);
  }
}

void MeshReader::readGroup(const XMLElement& group) {
  const std::string_view name = group.Name();
  const bool isOneList = name == "triangles" || name == "polylist";
  const Layout layout = layoutOf(group);
  const std::size_t before = mesh_.content.triangles.size();
  Count lists = 0;
  forEachChild(group, "p", [&](const XMLElement&) { ++lists; });
  if (isOneList && lists > 1) fail(group, "has more than one <p>; one is allowed");
  forEachChild(group, "p", [&](const XMLElement& list) {
    const Corners corners = readList(list, layout);
    if (name == "triangles") return addTriangles(group, &list, corners);
    if (name == "polylist") return addPolylist(group, &list, corners);
    if (corners.size() < 3) fail(group, "has a <p> of less than 3 corners");
    if (name == "tristrips") return addStrip(corners);
    add(list, corners);
  });
  if (lists == 0 && name == "triangles") addTriangles(group, nullptr, {});
  if (lists == 0 && name == "polylist") addPolylist(group, nullptr, {});
  if (!isOneList && lists != colladaCount(source_, group, "count")) {
    fail(group, "has " + std::to_string(lists) + " elements <p>; its count is " +
                    std::to_string(colladaCount(source_, group, "count")));
  }
  const char* const material = group.Attribute("material");
  mesh_.groups.push_back({mesh_.content.triangles.size() - before, material ? material : ""});
}

ColladaMesh MeshReader::read() {
  forEachChild(xml_, nullptr, [&](const XMLElement& child) { requireKnown(child); });
  if (hasFaces()) positions_.read();
  forEachChild(xml_, nullptr, [&](const XMLElement& child) {
    if (isFaces(child)) readGroup(child);
  });
  mesh_.content.vertices = positions_.all();
  keepUsedVertices(mesh_.content);
  return std::move(mesh_);
}

}  // namespace

ColladaMesh readColladaMesh(const XMLElement& mesh, const InputSource& source, FaceCutter& cutter) {
  return MeshReader(mesh, source, cutter).read();
}

}  // namespace swept::detail
