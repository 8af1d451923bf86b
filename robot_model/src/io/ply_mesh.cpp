// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/face_cutter.hpp"
#include "io/mesh_readers.hpp"
#include "io/ply_header.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

bool isFace(const PlyElement& element) {
  return element.name == "face";
}

bool isCorners(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

/// Requires what the header must have for the reader to find all faces.
void checkHeader(const PlyHeader& header, const InputSource& source) {
  const auto face = std::ranges::find_if(header.elements, isFace);
  if (face == header.elements.end()) source.fail(0, "the header has no element 'face'");
  const auto vertex = std::ranges::find_if(header.elements, isVertex);
  if (face < vertex) source.fail(face->line, "the element 'face' must follow the element 'vertex'");
  for (const PlyProperty& property : vertex->properties) {
    if (property.axis >= 0 && !isFloat(property.type))
      source.fail(vertex->line, shown(property.name) + " of the vertex must be float or double");
  }
  const auto corners = std::ranges::count_if(face->properties, isCorners);
  const auto list = std::ranges::find_if(face->properties, isCorners);
  if (corners != 1 || !list->lengthType || isFloat(list->type)) {
    source.fail(face->line,
                "the face must have one list of whole numbers 'vertex_indices' or 'vertex_index'");
  }
  for (const PlyElement& element : header.elements) {
    if (!isFace(element) && std::ranges::any_of(element.properties, isCorners)) {
      source.fail(element.line, "the element " + shown(element.name) +
                                    " has corners; allowed are those of the element 'face'");
    }
  }
}

/// The values of the elements, one after the other.
class PlyBody {
 public:
  PlyBody(LineReader& lines, PlyForm form, std::string_view bytes, const InputSource& source)
      : lines_(lines), form_(form), bytes_(bytes), at_(lines.offset()), source_(source) {}

  /// Call it before each element: in text an element has a line.
  void begin(const PlyElement& element, std::uint64_t index);
  /// A finite number.
  double next(const PlyElement& element, const PlyProperty& property, Scalar type);
  bool isText() const { return form_ == PlyForm::Ascii; }
  /// The line of the present element; 0: it has none.
  int line() const { return isText() ? lines_.number() : 0; }
  /// Skips a value that does not concern a face: any word, or any bytes.
  void skip(const PlyElement& element, const PlyProperty& property);
  /// Call it after each element, and after the last.
  void end() const;
  void endFile();
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  std::string_view nextWord(const PlyProperty& property);
  const char* nextBytes(const PlyElement& element, Scalar type);

  LineReader& lines_;
  PlyForm form_;
  std::string_view bytes_;
  std::size_t at_;
  const InputSource& source_;
  std::vector<std::string_view> words_;
  std::size_t used_ = 0;
};

void PlyBody::fail(const std::string& problem) const {
  if (isText()) lines_.fail(problem);
  source_.fail(0, "at byte " + std::to_string(at_) + ": " + problem);
}

void PlyBody::begin(const PlyElement& element, std::uint64_t index) {
  if (!isText()) return;
  if (!lines_.nextFilled()) {
    fail("the file ends after " + std::to_string(index) + " of " + std::to_string(element.count) +
         " elements " + shown(element.name));
  }
  words_ = words(lines_.line());
  used_ = 0;
}

std::string_view PlyBody::nextWord(const PlyProperty& property) {
  if (used_ == words_.size())
    fail("the line ends where " + shown(property.name) + " should follow");
  return words_[used_++];
}

const char* PlyBody::nextBytes(const PlyElement& element, Scalar type) {
  if (bytes_.size() - at_ < sizeOf(type)) {
    fail("the file ends within " + std::to_string(element.count) + " elements " +
         shown(element.name));
  }
  at_ += sizeOf(type);
  return bytes_.data() + at_ - sizeOf(type);
}

void PlyBody::skip(const PlyElement& element, const PlyProperty& property) {
  if (isText()) {
    nextWord(property);
  } else {
    nextBytes(element, property.type);
  }
}

double PlyBody::next(const PlyElement& element, const PlyProperty& property, Scalar type) {
  const auto order = form_ == PlyForm::LittleEndian ? std::endian::little : std::endian::big;
  const std::optional<double> value =
      isText() ? parseNumber(nextWord(property)) : decode(type, nextBytes(element, type), order);
  if (!value || !std::isfinite(*value)) fail(shown(property.name) + " must be a finite number");
  return *value;
}

void PlyBody::end() const {
  if (isText() && used_ != words_.size())
    fail(shown(words_[used_]) + " follows the last value of the line");
}

void PlyBody::endFile() {
  if (isText() ? lines_.nextFilled() : at_ < bytes_.size())
    fail("more follows after the last element of the header");
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const InputSource& source)
      : lines_(source, bytes),
        header_(readPlyHeader(lines_, source)),
        body_(lines_, header_.form, bytes, source),
        cutter_(source) {
    checkHeader(header_, source);
  }
  MeshFileContent read();

 private:
  void readElement(const PlyElement& element);
  void readCorners(const PlyElement& element, const PlyProperty& property, std::uint64_t count);
  std::uint64_t wholeNumber(const PlyElement& element, const PlyProperty& property, Scalar type);

  LineReader lines_;
  PlyHeader header_;
  PlyBody body_;
  FaceCutter cutter_;
  MeshFileContent content_;
  std::vector<int> corners_;  ///< of the present face
  std::int64_t faces_ = 0;    ///< so far
};

std::uint64_t PlyReader::wholeNumber(const PlyElement& element, const PlyProperty& property,
                                     Scalar type) {
  const double value = body_.next(element, property, type);
  // The test fails for NaN.
  if (!(value >= 0.0 && value < 4294967296.0 && value == std::floor(value)))
    body_.fail(shown(property.name) + " has " + formatNumber(value) +
               " where a whole number from 0 to 2^32 - 1 has to be");
  return static_cast<std::uint64_t>(value);
}

void PlyReader::readCorners(const PlyElement& element, const PlyProperty& property,
                            std::uint64_t count) {
  if (count < 3)
    body_.fail("a face has " + std::to_string(count) + " corners; it must have at least 3");
  corners_.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t corner = wholeNumber(element, property, property.type);
    if (corner >= content_.vertices.size()) {
      body_.fail("a corner is vertex " + std::to_string(corner) + "; there are " +
                 std::to_string(content_.vertices.size()) + ", counted from 0");
    }
    corners_.push_back(static_cast<int>(corner));
  }
  cutter_.cut(corners_, content_.vertices, content_.triangles, body_.line(),
              body_.line() > 0 ? -1 : faces_);
  ++faces_;
}

void PlyReader::readElement(const PlyElement& element) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const PlyProperty& property : element.properties) {
    if (property.axis >= 0) {
      point[property.axis] = body_.next(element, property, property.type);
      continue;
    }
    const std::uint64_t count =
        property.lengthType ? wholeNumber(element, property, *property.lengthType) : 1;
    if (isFace(element) && isCorners(property)) {
      readCorners(element, property, count);
      continue;
    }
    for (std::uint64_t i = 0; i < count; ++i) body_.skip(element, property);
  }
  if (isVertex(element)) content_.vertices.push_back(point);
}

MeshFileContent PlyReader::read() {
  for (const PlyElement& element : header_.elements) {
    // An element without properties has nothing to count.
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body_.begin(element, i);
      readElement(element);
      body_.end();
    }
  }
  body_.endFile();
  keepUsedVertices(content_);
  return std::move(content_);
}

}  // namespace

MeshFileContent readPlyMesh(std::string_view bytes, const InputSource& source) {
  return PlyReader(bytes, source).read();
}

}  // namespace swept::detail
