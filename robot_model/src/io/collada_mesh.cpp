// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_mesh.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>

#include "io/mesh_claim.hpp"
#include "io/point_file.hpp"

namespace swept::detail {

using tinyxml2::XMLElement;

void failElement(const InputSource& source, const XMLElement& element, const std::string& problem) {
  source.fail(element.GetLineNum(), std::string("<") + element.Name() + "> " + problem);
}

std::vector<std::string_view> colladaWords(const XMLElement& element, const InputSource& source) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<std::string_view> found;
  for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr) failElement(source, element, "holds more than text");
    const std::string_view text = node->Value();
    for (auto at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
      const auto end = std::min(text.find_first_of(kSpace, at), text.size());
      found.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(kSpace, end);
    }
  }
  return found;
}

std::string colladaTarget(const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text != nullptr && text[0] == '#' ? text + 1 : "";
}

namespace {

using Count = std::uint64_t;

/// Whole numbers below 2^32: sums and products of a few cannot overflow.
std::optional<Count> wholeNumber(std::string_view word) {
  std::uint32_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc{} || result.ptr != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The children of that name, one after the other.
template <typename Action>
void forEachChild(const XMLElement& parent, const char* name, const Action& action) {
  for (const XMLElement* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    action(*child);
  }
}

/// How a <source> reads its array.
struct Source {
  Count count = 0, stride = 1, offset = 0;
  const XMLElement* array = nullptr;
  bool hasXyz = false;  ///< its first three parameters
};

/// How the corners of a group of faces are written.
struct Layout {
  std::vector<Count> limits;  ///< of the indices at each offset
  Count vertex = 0;           ///< the offset of the vertices
  bool hasVertex = false;
};

/// One <mesh>: every name in it is looked up in it. Assimp knows those of all, of which the latest
/// ones hide the others.
class MeshReader {
 public:
  explicit MeshReader(const InputSource& source) : source_(source) {}
  ColladaMesh read(const XMLElement& mesh);

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& problem) const {
    failElement(source_, element, problem);
  }
  std::vector<std::string_view> words(const XMLElement& element) const {
    return colladaWords(element, source_);
  }
  Count attribute(const XMLElement& element, const char* name,
                  std::optional<Count> fallback = {}) const;
  std::map<std::string, const XMLElement*> arraysOf(const XMLElement& source) const;
  void readSource(const XMLElement& source);
  void readVertices(const XMLElement& vertices);
  void readPositions(const XMLElement& input);
  Count sizeOf(const XMLElement& input) const;
  Layout layoutOf(const XMLElement& group) const;
  /// Corners in the list.
  Count readList(const XMLElement& list, const Layout& layout, bool faces);
  std::vector<Count> listsOf(const XMLElement& group, const Layout& layout, bool faces);
  void readGroup(const XMLElement& group);
  Count trianglesOf(const XMLElement& group, const std::vector<Count>& lists) const;
  Count polylistOf(const XMLElement& group, Count corners) const;

  const InputSource& source_;
  std::map<std::string, Source> sources_;
  std::map<std::string, Count> sizes_;  ///< entries of each <source> and <vertices>
  std::vector<Eigen::Vector3d> positions_;
  std::vector<bool> used_;
  std::string vertices_;  ///< id of <vertices>
  MeshClaim numbers_;
  ColladaMesh mesh_;
};

Count MeshReader::attribute(const XMLElement& element, const char* name,
                            std::optional<Count> fallback) const {
  const char* text = element.Attribute(name);
  if (text == nullptr && fallback) return *fallback;
  const auto value = wholeNumber(text != nullptr ? text : "");
  if (!value) fail(element, std::string("needs a whole number as '") + name + "'");
  return *value;
}

std::map<std::string, const XMLElement*> MeshReader::arraysOf(const XMLElement& source) const {
  std::map<std::string, const XMLElement*> arrays;
  forEachChild(source, "float_array", [&](const XMLElement& array) {
    if (words(array).size() != attribute(array, "count"))
      fail(array, "does not hold as many numbers as its count");
    if (const char* id = array.Attribute("id")) arrays[id] = &array;
  });
  return arrays;
}

void MeshReader::readSource(const XMLElement& source) {
  const auto arrays = arraysOf(source);
  const XMLElement* technique = source.FirstChildElement("technique_common");
  const XMLElement* accessor = technique ? technique->FirstChildElement("accessor") : nullptr;
  const char* id = source.Attribute("id");
  if (accessor == nullptr || id == nullptr) return;
  Source read{.count = attribute(*accessor, "count"),
              .stride = attribute(*accessor, "stride", 1),
              .offset = attribute(*accessor, "offset", 0)};
  std::string parameters;
  forEachChild(*accessor, "param", [&](const XMLElement& parameter) {
    const char* name = parameter.Attribute("name");
    parameters += name != nullptr && name[0] != '\0' && name[1] == '\0' ? name[0] : '?';
  });
  read.hasXyz = parameters.starts_with("XYZ") &&
                parameters.find_first_of("XYZRGBSTPUV", 3) == parameters.npos;
  const auto array = arrays.find(colladaTarget(*accessor, "source"));
  const Count size = array != arrays.end() ? attribute(*array->second, "count") : 0;
  if (array == arrays.end() || parameters.size() > read.stride || read.offset > size ||
      (read.stride != 0 && read.count > (size - read.offset) / read.stride)) {
    fail(*accessor, "reaches beyond its array");
  }
  read.array = array->second;
  sources_[id] = read;
  sizes_[id] = read.count;
}

Count MeshReader::sizeOf(const XMLElement& input) const {
  const auto found = sizes_.find(colladaTarget(input, "source"));
  if (found == sizes_.end()) fail(input, "names a source that does not exist");
  return found->second;
}

void MeshReader::readPositions(const XMLElement& input) {
  if (!positions_.empty()) fail(input, "is a second one of positions; one is allowed");
  const auto found = sources_.find(colladaTarget(input, "source"));
  if (found == sources_.end() || !found->second.hasXyz)
    fail(input, "needs a source whose <param> are X, Y and Z, in this order");
  const Source& source = found->second;
  const auto numbers = words(*source.array);
  for (Count i = 0; i < source.count; ++i) {
    Eigen::Vector3d position;
    for (Count axis = 0; axis < 3; ++axis) {
      const std::string_view word = numbers[source.offset + i * source.stride + axis];
      const auto value = numbers_.coordinate(word);
      if (!value) fail(*source.array, "has " + shown(word) + ", which is no finite number");
      position[static_cast<Eigen::Index>(axis)] = *value;
    }
    positions_.push_back(position);
  }
  used_.resize(positions_.size());
}

void MeshReader::readVertices(const XMLElement& vertices) {
  const char* id = vertices.Attribute("id");
  if (id == nullptr || !vertices_.empty()) fail(vertices, "needs an 'id', and to be the only one");
  vertices_ = id;
  Count size = std::numeric_limits<Count>::max();
  forEachChild(vertices, "input", [&](const XMLElement& input) {
    size = std::min(size, sizeOf(input));
    const char* semantic = input.Attribute("semantic");
    if (semantic != nullptr && std::string_view(semantic) == "POSITION") readPositions(input);
  });
  sizes_[vertices_] = std::min<Count>(size, positions_.size());
}

Layout MeshReader::layoutOf(const XMLElement& group) const {
  constexpr Count kMaxOffset = 64;  // far beyond the handful of inputs that files have
  Layout layout;
  forEachChild(group, "input", [&](const XMLElement& input) {
    const Count offset = attribute(input, "offset");
    if (offset > kMaxOffset) fail(input, "has an offset beyond every input");
    if (layout.limits.size() <= offset)
      layout.limits.resize(offset + 1, std::numeric_limits<Count>::max());
    layout.limits[offset] = std::min(layout.limits[offset], sizeOf(input));
    const char* semantic = input.Attribute("semantic");
    if (semantic == nullptr || std::string_view(semantic) != "VERTEX") return;
    if (colladaTarget(input, "source") != vertices_)
      fail(input, "does not name the <vertices> of its <mesh>");
    if (layout.hasVertex) fail(input, "is a second one of vertices; one is allowed");
    layout.hasVertex = true;
    layout.vertex = offset;
  });
  return layout;
}

Count MeshReader::readList(const XMLElement& list, const Layout& layout, bool faces) {
  const auto entries = words(list);
  const std::size_t width = layout.limits.size();
  if (!layout.hasVertex && !entries.empty()) fail(list, "has no <input> of vertices to index");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto value = wholeNumber(entries[i]);
    if (!value) fail(list, "does not hold whole numbers only");
    if (*value >= layout.limits[i % width]) fail(list, "has an index past its source");
    if (faces && i % width == layout.vertex) used_[*value] = true;
  }
  if (width > 0 && entries.size() % width != 0)
    fail(list, "ends within a corner, which takes " + std::to_string(width) + " indices");
  return width > 0 ? entries.size() / width : 0;
}

std::vector<Count> MeshReader::listsOf(const XMLElement& group, const Layout& layout, bool faces) {
  std::vector<Count> lists;
  forEachChild(group, "p",
               [&](const XMLElement& list) { lists.push_back(readList(list, layout, faces)); });
  return lists;
}

Count MeshReader::polylistOf(const XMLElement& group, Count corners) const {
  Count triangles = 0, listed = 0, polygons = 0;
  forEachChild(group, "vcount", [&](const XMLElement& sizes) {
    for (const std::string_view word : words(sizes)) {
      const auto size = wholeNumber(word);
      if (!size) fail(sizes, "does not hold whole numbers only");
      if (*size < 3) fail(sizes, "has a face of " + shown(word) + " corners; 3 are the least");
      triangles += *size - 2;
      listed += *size;
      ++polygons;
    }
  });
  if (listed != corners || polygons != attribute(group, "count")) {
    fail(group, "has " + std::to_string(polygons) + " faces of " + std::to_string(listed) +
                    " corners by its <vcount>, and " + std::to_string(corners) +
                    " corners in its <p>; its count is " + group.Attribute("count"));
  }
  return triangles;
}

Count MeshReader::trianglesOf(const XMLElement& group, const std::vector<Count>& lists) const {
  const std::string_view name = group.Name();
  const Count count = attribute(group, "count");
  Count corners = 0;
  for (const Count list : lists) corners += list;
  if (name == "triangles" || name == "polylist") {
    if (lists.size() > 1) fail(group, "has more than one <p>; one is allowed");
    if (name == "polylist") return polylistOf(group, corners);
    if (corners == 3 * count) return count;
    fail(group, "has " + std::to_string(corners) + " corners; as many as 3 times its count, " +
                    std::to_string(count) + ", have to be there");
  }
  if (lists.size() != count) {
    fail(group, "has " + std::to_string(lists.size()) + " elements <p>; its count is " +
                    std::to_string(count));
  }
  if (std::ranges::any_of(lists, [](Count list) { return list < 3; }))
    fail(group, "has a <p> of less than 3 corners");
  return corners - 2 * count;
}

void MeshReader::readGroup(const XMLElement& group) {
  constexpr std::array<std::string_view, 4> kFaces{"triangles", "polylist", "polygons",
                                                   "tristrips"};
  const std::string_view name = group.Name();
  if (name == "source" || name == "vertices" || name == "extra") return;
  const bool lines = name == "lines" || name == "linestrips";
  const bool faces = std::ranges::find(kFaces, name) != kFaces.end();
  if (!lines && !faces) {
    fail(group,
         "is not read; allowed are triangles, polylist, polygons and tristrips, and lines and "
         "linestrips, which have no faces");
  }
  if (const XMLElement* hole = group.FirstChildElement("ph"))
    fail(*hole, "is a polygon with holes, which is not read");
  const auto lists = listsOf(group, layoutOf(group), faces);
  if (!faces) return;
  const Count triangles = trianglesOf(group, lists);
  mesh_.triangles += triangles;
  mesh_.groups += triangles > 0 ? 1 : 0;
}

ColladaMesh MeshReader::read(const XMLElement& mesh) {
  forEachChild(mesh, "source", [&](const XMLElement& source) { readSource(source); });
  forEachChild(mesh, "vertices", [&](const XMLElement& vertices) { readVertices(vertices); });
  forEachChild(mesh, nullptr, [&](const XMLElement& group) { readGroup(group); });
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (used_[i]) mesh_.corners.push_back(positions_[i]);
  mesh_.loss = numbers_.loss;
  return std::move(mesh_);
}

}  // namespace

ColladaMesh readColladaMesh(const XMLElement& mesh, const InputSource& source) {
  return MeshReader(source).read(mesh);
}

}  // namespace swept::detail
