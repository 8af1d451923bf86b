// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace swept::detail {

namespace {

using Words = std::vector<std::string_view>;

class PlyHeaderReader {
 public:
  PlyHeaderReader(LineReader& lines, const InputSource& source) : lines_(lines), source_(source) {}
  PlyHeader read();

 private:
  void readFirst();
  void readFormat(const Words& line);
  void readElement(const Words& line);
  void readProperty(const Words& line);
  Scalar scalar(std::string_view name) const;
  void checkVertex() const;
  void checkAxes(const PlyElement& vertex) const;

  LineReader& lines_;
  const InputSource& source_;
  PlyHeader header_;
  bool formatKnown_ = false;
};

void PlyHeaderReader::readFirst() {
  if (!lines_.next() || lines_.line() != "ply") {
    lines_.fail("the first line is " + shown(lines_.line()) + "; it must be 'ply'");
  }
}

void PlyHeaderReader::readFormat(const Words& line) {
  if (formatKnown_) lines_.fail("a second line 'format'; one is allowed");
  if (line.size() != 3) lines_.fail("'format' must have a form and a version behind it");
  formatKnown_ = true;
  constexpr std::array<std::pair<std::string_view, PlyForm>, 3> kForms{
      {{"ascii", PlyForm::Ascii},
       {"binary_little_endian", PlyForm::LittleEndian},
       {"binary_big_endian", PlyForm::BigEndian}}};
  const auto found =
      std::ranges::find(kForms, line[1], [](const auto& form) { return form.first; });
  if (found == kForms.end()) {
    lines_.fail("the format is " + shown(line[1]) +
                "; allowed are ascii, binary_little_endian and binary_big_endian");
  }
  if (line[2] != "1.0") {
    lines_.fail("the version of the format is " + shown(line[2]) + "; it must be 1.0");
  }
  header_.form = found->second;
}

void PlyHeaderReader::readElement(const Words& line) {
  if (line.size() != 3) lines_.fail("'element' must have a name and a count behind it");
  const auto count = parseCount(line[2]);
  if (!count) {
    lines_.fail("the count of element " + shown(line[1]) + " is " + shown(line[2]) +
                "; it must be a whole number from 0 to 9e15");
  }
  const auto first = std::ranges::find(header_.elements, line[1], &PlyElement::name);
  if (first != header_.elements.end()) {
    lines_.fail("a second element " + shown(line[1]) + "; the first is at line " +
                std::to_string(first->line));
  }
  header_.elements.push_back({std::string(line[1]), lines_.number(), *count, {}});
}

Scalar PlyHeaderReader::scalar(std::string_view name) const {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> kTypes{
      {{"char", Scalar::Int8},
       {"int8", Scalar::Int8},
       {"uchar", Scalar::UInt8},
       {"uint8", Scalar::UInt8},
       {"short", Scalar::Int16},
       {"int16", Scalar::Int16},
       {"ushort", Scalar::UInt16},
       {"uint16", Scalar::UInt16},
       {"int", Scalar::Int32},
       {"int32", Scalar::Int32},
       {"uint", Scalar::UInt32},
       {"uint32", Scalar::UInt32},
       {"float", Scalar::Float32},
       {"float32", Scalar::Float32},
       {"double", Scalar::Float64},
       {"float64", Scalar::Float64}}};
  const auto found = std::ranges::find(kTypes, name, [](const auto& type) { return type.first; });
  if (found == kTypes.end()) {
    lines_.fail("the type " + shown(name) +
                " is not known; allowed are char, uchar, short, ushort, int, uint, float, double, "
                "int8, uint8, int16, uint16, int32, uint32, float32 and float64");
  }
  return found->second;
}

void PlyHeaderReader::readProperty(const Words& line) {
  if (header_.elements.empty()) lines_.fail("'property' before the first 'element'");
  PlyElement& element = header_.elements.back();
  const bool isList = line.size() > 1 && line[1] == "list";
  if (line.size() != (isList ? 5 : 3)) {
    lines_.fail(
        "'property' must have a type and a name behind it, or 'list', two types and a name");
  }
  PlyProperty property;
  property.name = line.back();
  property.type = scalar(line[line.size() - 2]);
  if (isList) {
    property.lengthType = scalar(line[2]);
    if (isFloat(*property.lengthType)) {
      lines_.fail("the length of list " + shown(property.name) + " is of type " + shown(line[2]) +
                  "; it must be of a type of whole numbers");
    }
  }
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  const auto axis = std::ranges::find(kAxes, property.name);
  if (isVertex(element) && axis != kAxes.end()) {
    if (isList) lines_.fail(shown(property.name) + " of the vertex is a list; it must be a number");
    property.axis = static_cast<int>(axis - kAxes.begin());
    if (std::ranges::count(element.properties, property.axis, &PlyProperty::axis) > 0) {
      lines_.fail("a second property " + shown(property.name) + " of the vertex");
    }
  }
  constexpr std::array<std::string_view, 3> kViews{"view_px", "view_py", "view_pz"};
  const auto view = std::ranges::find(kViews, property.name);
  if (isCamera(element) && !isList && view != kViews.end())
    property.view = static_cast<int>(view - kViews.begin());
  element.properties.push_back(std::move(property));
}

void PlyHeaderReader::checkAxes(const PlyElement& vertex) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::ranges::count(vertex.properties, axis, &PlyProperty::axis) == 1) continue;
    const std::string name(1, "xyz"[axis]);
    source_.fail(vertex.line, "the vertex has no property '" + name + "'; x, y and z are needed");
  }
}

void PlyHeaderReader::checkVertex() const {
  if (!formatKnown_) lines_.fail("the header has no line 'format'");
  const auto vertex = std::ranges::find_if(header_.elements, isVertex);
  if (vertex == header_.elements.end()) lines_.fail("the header has no element 'vertex'");
  if (vertex->count > kMaxPoints) {
    source_.fail(vertex->line, "the count of element 'vertex' is '" +
                                   std::to_string(vertex->count) + "'; at most " +
                                   std::to_string(kMaxPoints) + " are allowed");
  }
  checkAxes(*vertex);
}

PlyHeader PlyHeaderReader::read() {
  readFirst();
  while (lines_.next()) {
    const Words line = words(lines_.line());
    if (line.empty() || line[0] == "comment" || line[0] == "obj_info") continue;
    if (line[0] == "end_header") {
      checkVertex();
      return std::move(header_);
    }
    if (line[0] == "format") {
      readFormat(line);
    } else if (line[0] == "element") {
      readElement(line);
    } else if (line[0] == "property") {
      readProperty(line);
    } else {
      lines_.fail("unknown word " + shown(line[0]) +
                  " in a PLY header; allowed are format, comment, obj_info, element, property and "
                  "end_header");
    }
  }
  source_.fail(0, "the file ends where 'end_header' should follow");
}

}  // namespace

PlyHeader readPlyHeader(LineReader& lines, const InputSource& source) {
  return PlyHeaderReader(lines, source).read();
}

}  // namespace swept::detail
