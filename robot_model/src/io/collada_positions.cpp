// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_positions.hpp"

#include <iterator>

#include "io/mesh_claim.hpp"
#include "io/point_file.hpp"

namespace swept::detail {

using tinyxml2::XMLElement;
using Count = std::uint64_t;

XMLElement* ColladaPositions::arrayOf(XMLElement& source, const XMLElement& accessor) const {
  const std::string wanted = colladaTarget(accessor, "source");
  XMLElement* found = nullptr;
  forEachChild(source, "float_array", [&](XMLElement& array) {
    const char* const id = array.Attribute("id");
    if (id == nullptr || id != wanted) return;
    if (found != nullptr) fail(array, "is a second one with the id '" + wanted + "'");
    found = &array;
    if (words(array).size() != colladaCount(source_, array, "count"))
      fail(array, "does not hold as many numbers as its count");
  });
  return found;
}

ColladaPositions::Source ColladaPositions::readSource(XMLElement& source) const {
  XMLElement* technique = source.FirstChildElement("technique_common");
  XMLElement* accessor = technique ? technique->FirstChildElement("accessor") : nullptr;
  if (accessor == nullptr) return {};
  Source read{.count = colladaCount(source_, *accessor, "count"),
              .stride = colladaCount(source_, *accessor, "stride", 1),
              .offset = colladaCount(source_, *accessor, "offset", 0),
              .array = arrayOf(source, *accessor),
              .accessor = accessor};
  std::string parameters;
  forEachChild(*accessor, "param", [&](const XMLElement& parameter) {
    const char* name = parameter.Attribute("name");
    parameters += name != nullptr && name[0] != '\0' && name[1] == '\0' ? name[0] : '?';
  });
  read.hasXyz = parameters.starts_with("XYZ") &&
                parameters.find_first_of("XYZRGBSTPUV", 3) == parameters.npos;
  const Count size = read.array != nullptr ? colladaCount(source_, *read.array, "count") : 0;
  if (read.array == nullptr || parameters.size() > read.stride || read.offset > size ||
      (read.stride != 0 && read.count > (size - read.offset) / read.stride)) {
    fail(*accessor, "reaches beyond its array");
  }
  return read;
}

void ColladaPositions::readPositions(XMLElement& input) {
  if (positions_ != nullptr) fail(input, "is a second one of positions; one is allowed");
  const std::string id = colladaTarget(input, "source");
  const auto [first, last] = sources_.equal_range(id);
  if (std::distance(first, last) > 1)
    fail(input, "names the id '" + id + "', which more than one source has");
  if (first != last) positions_ = first->second;
  const Source source = positions_ != nullptr ? readSource(*positions_) : Source{};
  if (!source.hasXyz) fail(input, "needs a source whose <param> are X, Y and Z, in this order");
  const auto entries = words(*source.array);
  std::vector<std::string_view> kept;
  MeshClaim numbers;
  for (Count i = 0; i < source.count; ++i) {
    Eigen::Vector3d position;
    for (Count axis = 0; axis < 3; ++axis) {
      const std::string_view word = entries[source.offset + i * source.stride + axis];
      const auto value = numbers.coordinate(word);
      if (!value) fail(*source.array, "has " + shown(word) + ", which is no finite number");
      position[static_cast<Eigen::Index>(axis)] = *value;
      kept.push_back(word);
    }
    all_.push_back(position);
  }
  loss_ = numbers.loss;
  keepPositions(source, kept);
}

/// Of an array that may hold normals or colours between the positions.
void ColladaPositions::keepPositions(const Source& source,
                                     const std::vector<std::string_view>& words) {
  setColladaWords(*source.array, words);
  source.array->SetAttribute("count", static_cast<unsigned>(words.size()));
  source.accessor->SetAttribute("stride", 3);
  source.accessor->DeleteAttribute("offset");
  int parameters = 0;
  keepChildren(*source.accessor, [&](const XMLElement& child) {
    return std::string_view(child.Name()) == "param" && ++parameters <= 3;
  });
  keepChildren(*positions_, [&](const XMLElement& child) {
    return &child == source.array || &child == source.accessor->Parent();
  });
}

void ColladaPositions::readVertices(XMLElement& vertices) {
  const char* id = vertices.Attribute("id");
  if (id == nullptr || vertices_ != nullptr)
    fail(vertices, "needs an 'id', and to be the only one");
  vertices_ = &vertices;
  verticesId_ = id;
  keepChildren(vertices, [](const XMLElement& child) {
    return std::string_view(child.Name()) == "input" && hasSemantic(child, "POSITION");
  });
  forEachChild(vertices, "input", [&](XMLElement& input) { readPositions(input); });
}

void ColladaPositions::requireNamed(const XMLElement& input) const {
  const std::string id = colladaTarget(input, "source");
  if (!isRead_ || (vertices_ != nullptr && id == verticesId_)) return;
  fail(input, sources_.contains(id) ? "does not name the <vertices> of its <mesh>"
                                    : "names a source that does not exist");
}

void ColladaPositions::moveToFront() {
  mesh_.InsertFirstChild(vertices_);
  mesh_.InsertFirstChild(positions_);
}

void ColladaPositions::read() {
  isRead_ = true;
  forEachChild(mesh_, "source", [&](XMLElement& source) {
    if (const char* id = source.Attribute("id")) sources_.emplace(id, &source);
  });
  forEachChild(mesh_, "vertices", [&](XMLElement& vertices) { readVertices(vertices); });
}

}  // namespace swept::detail
