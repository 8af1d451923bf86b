// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_positions.hpp"

#include <iterator>

#include "io/point_file.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

using tinyxml2::XMLElement;
using Count = std::uint64_t;

const XMLElement* ColladaPositions::arrayOf(const XMLElement& source,
                                            const XMLElement& accessor) const {
  const std::string wanted = colladaTarget(accessor, "source");
  const XMLElement* found = nullptr;
  forEachChild(source, "float_array", [&](const XMLElement& array) {
    const char* const id = array.Attribute("id");
    if (id == nullptr || id != wanted) return;
    if (found != nullptr) fail(array, "is a second one with the id '" + wanted + "'");
    found = &array;
    Count size = 0;
    forEachColladaWord(array, source_, [&](std::string_view) { ++size; });
    if (size != colladaCount(source_, array, "count"))
      fail(array, "does not hold as many numbers as its count");
  });
  return found;
}

ColladaPositions::Source ColladaPositions::readSource(const XMLElement& source) const {
  const XMLElement* technique = source.FirstChildElement("technique_common");
  const XMLElement* accessor = technique ? technique->FirstChildElement("accessor") : nullptr;
  if (accessor == nullptr) return {};
  Source read{.count = colladaCount(source_, *accessor, "count"),
              .stride = colladaCount(source_, *accessor, "stride", 1),
              .offset = colladaCount(source_, *accessor, "offset", 0),
              .array = arrayOf(source, *accessor)};
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

void ColladaPositions::readPositions(const XMLElement& input) {
  if (positions_ != nullptr) fail(input, "is a second one of positions; one is allowed");
  const std::string id = colladaTarget(input, "source");
  const auto [first, last] = sources_.equal_range(id);
  if (std::distance(first, last) > 1)
    fail(input, "names the id '" + id + "', which more than one source has");
  if (first != last) positions_ = first->second;
  const Source source = positions_ != nullptr ? readSource(*positions_) : Source{};
  if (!source.hasXyz) fail(input, "needs a source whose <param> are X, Y and Z, in this order");
  Count at = 0;
  forEachColladaWord(*source.array, source_, [&](std::string_view word) {
    const Count number = at++;
    if (number < source.offset) return;
    const Count vertex = (number - source.offset) / source.stride;
    const Count axis = (number - source.offset) % source.stride;
    if (vertex >= source.count || axis > 2) return;
    const auto value = parseNumber(word);
    if (!value) fail(*source.array, "has " + shown(word) + ", which is no finite number");
    if (axis == 0) all_.emplace_back();
    all_.back()[static_cast<Eigen::Index>(axis)] = *value;
  });
}

void ColladaPositions::readVertices(const XMLElement& vertices) {
  const char* id = vertices.Attribute("id");
  if (id == nullptr || vertices_ != nullptr)
    fail(vertices, "needs an 'id', and to be the only one");
  vertices_ = &vertices;
  verticesId_ = id;
  forEachChild(vertices, "input", [&](const XMLElement& input) {
    if (hasSemantic(input, "POSITION")) readPositions(input);
  });
}

void ColladaPositions::requireNamed(const XMLElement& input) const {
  const std::string id = colladaTarget(input, "source");
  if (!isRead_ || (vertices_ != nullptr && id == verticesId_)) return;
  fail(input, sources_.contains(id) ? "does not name the <vertices> of its <mesh>"
                                    : "names a source that does not exist");
}

void ColladaPositions::read() {
  isRead_ = true;
  forEachChild(mesh_, "source", [&](const XMLElement& source) {
    if (const char* id = source.Attribute("id")) sources_.emplace(id, &source);
  });
  forEachChild(mesh_, "vertices", [&](const XMLElement& vertices) { readVertices(vertices); });
}

}  // namespace swept::detail
