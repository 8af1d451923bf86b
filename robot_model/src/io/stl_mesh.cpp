// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "io/mesh_readers.hpp"
#include "io/point_file.hpp"
#include "io/scalar.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::size_t kHeader = 84;  // bytes, the count among them
constexpr std::size_t kFacet = 50;
constexpr std::size_t kCorners = 12;  // bytes of the normal ahead of them

std::uint64_t countOf(std::string_view bytes) {
  return bytesAs<std::uint32_t>(bytes.data() + kHeader - 4, std::endian::little);
}

bool isBinary(std::string_view bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * countOf(bytes);
}

/// Whether a text begins with `solid` and has no zero bytes, which headers of binary files may
/// have.
bool isText(std::string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes.substr(first).starts_with("solid") &&
         bytes.find('\0') == std::string_view::npos;
}

[[noreturn]] void failForm(std::string_view bytes, const InputSource& source) {
  const std::string size = "it has " + std::to_string(bytes.size()) + " bytes";
  std::string problem = size + ", less than the " + std::to_string(kHeader) + " of a header";
  if (bytes.size() >= kHeader) {
    const std::uint64_t count = countOf(bytes);
    problem = size + ", and a binary STL of " + std::to_string(count) +
              " triangles, as its header says, has " + std::to_string(kHeader + kFacet * count);
  }
  source.fail(0, "neither STL as text, which starts with 'solid', nor a binary one: " + problem);
}

/// Of the three vertices that come next.
void addTriangle(MeshFileContent& content) {
  const int first = static_cast<int>(content.vertices.size());
  content.triangles.emplace_back(first, first + 1, first + 2);
}

MeshFileContent readBinary(std::string_view bytes, const InputSource& source) {
  const std::uint64_t count = countOf(bytes);
  requireFewTriangles(count);
  MeshFileContent content;
  content.triangles.reserve(count);
  content.vertices.reserve(3 * count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + kHeader + kFacet * i + kCorners;
    addTriangle(content);
    for (int corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d point;
      for (double& value : point) {
        value = static_cast<double>(bytesAs<float>(at, std::endian::little));
        at += sizeof(float);
      }
      if (!point.allFinite())
        source.fail(0, "triangle " + std::to_string(i) + " has a corner that is not finite");
      content.vertices.push_back(point);
    }
  }
  return content;
}

/// The lines of a text file: solids of facets with three corners. Each line must have its exact
/// form. Normals may be anything, as in `-nan(ind)`: the corners say which way a facet looks.
class TextReader {
 public:
  TextReader(std::string_view bytes, const InputSource& source) : lines_(source, bytes) {}
  MeshFileContent read();

 private:
  /// The words of the next line, if there is one.
  bool next();
  /// Throws unless the present line begins with these words and has this many words in all.
  void require(std::string_view wanted, std::size_t count) const;
  bool startsWith(std::string_view wanted) const;
  void readNext(std::string_view wanted, std::size_t count);
  void readFacet();

  LineReader lines_;
  std::vector<std::string_view> words_;
  MeshFileContent content_;
};

bool TextReader::next() {
  if (!lines_.nextFilled()) return false;
  words_ = words(lines_.line());
  return true;
}

bool TextReader::startsWith(std::string_view wanted) const {
  const auto parts = words(wanted);
  return words_.size() >= parts.size() && std::equal(parts.begin(), parts.end(), words_.begin());
}

void TextReader::require(std::string_view wanted, std::size_t count) const {
  if (startsWith(wanted) && words_.size() == count) return;
  lines_.fail(shown(lines_.line()) + " where '" + std::string(wanted) + "' has to be" +
              (count > words(wanted).size() ? ", and three numbers" : ""));
}

void TextReader::readNext(std::string_view wanted, std::size_t count) {
  if (!next()) lines_.fail("the file ends where '" + std::string(wanted) + "' has to follow");
  require(wanted, count);
}

void TextReader::readFacet() {
  if (!startsWith("facet normal")) require("facet normal", 5);
  readNext("outer loop", 2);
  requireFewTriangles(content_.triangles.size() + 1);
  addTriangle(content_);
  for (int corner = 0; corner < 3; ++corner) {
    readNext("vertex", 4);
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = words_[static_cast<std::size_t>(1 + axis)];
      const auto value = parseNumber(word);
      if (!value) lines_.fail(shown(word) + " of a vertex must be a finite number");
      point[axis] = *value;
    }
    content_.vertices.push_back(point);
  }
  readNext("endloop", 1);
  readNext("endfacet", 1);
}

MeshFileContent TextReader::read() {
  while (next()) {
    if (!startsWith("solid")) require("solid", 1);
    for (;;) {
      if (!next()) lines_.fail("the file ends where 'endsolid' has to follow");
      if (startsWith("endsolid")) break;
      readFacet();
    }
  }
  return std::move(content_);
}

}  // namespace

MeshFileContent readStlMesh(std::string_view bytes, const InputSource& source) {
  if (isBinary(bytes)) return readBinary(bytes, source);
  if (!isText(bytes)) failForm(bytes, source);
  return TextReader(bytes, source).read();
}

}  // namespace swept::detail
