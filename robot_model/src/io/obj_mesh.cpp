// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/face_cutter.hpp"
#include "io/mesh_readers.hpp"
#include "io/point_file.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// Statements that have no faces, which are ignored. Others (`fo`, `curv`, `surf`, `call`) have
/// faces, or may have.
constexpr std::array<std::string_view, 13> kNoFaces{
    "vt", "vn", "vp", "p", "l", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib"};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const InputSource& source)
      : lines_(source, bytes), source_(source) {}
  MeshFileContent read();

 private:
  struct Face {
    std::uint32_t count;  ///< of its corners
    int line;
  };
  void readLine();
  void readVertex(const std::vector<std::string_view>& line);
  void readFace(const std::vector<std::string_view>& line);
  /// The index of a vertex, from 0; the vertex may follow later. What follows a slash is ignored.
  std::size_t readCorner(std::string_view word) const;
  std::int64_t readIndex(std::string_view text, std::string_view corner) const;
  void requireIndices(std::string_view text, std::string_view corner) const;
  [[noreturn]] void failCorner(std::string_view corner) const;
  void finish();

  LineReader lines_;
  const InputSource& source_;
  MeshFileContent content_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<int> corners_;  ///< of all faces
  std::vector<Face> faces_;
  std::uint64_t triangles_ = 0;  ///< of these faces
  std::size_t needed_ = 0;       ///< so many vertices
  int neededAt_ = 0;             ///< line
};

void ObjReader::readVertex(const std::vector<std::string_view>& line) {
  const std::size_t count = line.size() - 1;
  // A weight other than 1 means something to curved surfaces only, and assimp divides by it.
  const bool weighted = count == 4 && parseNumber(line[4]) == 1.0;
  if (count != 3 && count != 6 && !weighted)
    lines_.fail("a vertex must have 3 numbers, a fourth that is 1, or 6 with its colour");
  Eigen::Vector3d point;
  for (std::size_t i = 1; i <= 3; ++i) {
    const auto value = parseNumber(line[i]);
    if (!value) lines_.fail(shown(line[i]) + " of a vertex must be a finite number");
    point[static_cast<Eigen::Index>(i - 1)] = *value;
  }
  vertices_.push_back(point);
}

std::int64_t ObjReader::readIndex(std::string_view text, std::string_view corner) const {
  std::int32_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || value == 0)
    failCorner(corner);
  return value;
}

void ObjReader::failCorner(std::string_view corner) const {
  lines_.fail("corner " + shown(corner) +
              " of a face must be V, V/T, V//N or V/T/N, of whole numbers other than 0");
}

/// For texture and normal indices: the one of that number need not exist.
void ObjReader::requireIndices(std::string_view text, std::string_view corner) const {
  if (std::ranges::count(text, '/') > 1 ||
      text.find_first_not_of("0123456789-/") != std::string_view::npos)
    failCorner(corner);
}

std::size_t ObjReader::readCorner(std::string_view word) const {
  const auto first = word.find('/');
  const std::int64_t index = readIndex(word.substr(0, first), word);
  if (first != std::string_view::npos) {
    requireIndices(word.substr(first + 1), word);
  }
  const std::int64_t place = index > 0 ? index - 1 : std::ssize(vertices_) + index;
  if (place < 0) {
    lines_.fail("corner " + shown(word) + " of a face is before the first of the " +
                std::to_string(vertices_.size()) + " vertices so far");
  }
  return static_cast<std::size_t>(place);
}

void ObjReader::readFace(const std::vector<std::string_view>& line) {
  if (line.size() < 4) lines_.fail("a face must have at least 3 corners");
  triangles_ += line.size() - 3;
  requireFewTriangles(triangles_);
  faces_.push_back({static_cast<std::uint32_t>(line.size() - 1), lines_.number()});
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::size_t corner = readCorner(line[i]);
    corners_.push_back(static_cast<int>(corner));
    if (corner < needed_) continue;
    needed_ = corner + 1;
    neededAt_ = lines_.number();
  }
}

void ObjReader::readLine() {
  const std::string_view text = lines_.line();
  if (text.ends_with('\\'))
    lines_.fail("a backslash ends the line; lines that the next one continues are not allowed");
  const auto line = words(text);
  if (line.empty() || text.front() == '#') return;
  if (text.front() == ' ' || text.front() == '\t')
    lines_.fail("blanks before " + shown(line[0]) + "; lines have to start with a word");
  if (line[0] == "v") return readVertex(line);
  if (line[0] == "f") return readFace(line);
  if (std::ranges::find(kNoFaces, line[0]) == kNoFaces.end()) {
    std::string allowed = "v, f";
    for (const std::string_view word : kNoFaces) allowed += ", " + std::string(word);
    lines_.fail("unknown word " + shown(line[0]) + " in an OBJ file; allowed are " + allowed);
  }
}

void ObjReader::finish() {
  if (needed_ > vertices_.size()) {
    source_.fail(neededAt_, "a corner is vertex " + std::to_string(needed_) + "; there are " +
                                std::to_string(vertices_.size()));
  }
  FaceCutter cutter(source_);
  content_.triangles.reserve(triangles_);
  std::span<const int> rest(corners_);
  for (const Face& face : faces_) {
    cutter.cut(rest.first(face.count), vertices_, content_.triangles, face.line);
    rest = rest.subspan(face.count);
  }
  content_.vertices = std::move(vertices_);
  keepUsedVertices(content_);
}

MeshFileContent ObjReader::read() {
  while (lines_.next()) readLine();
  finish();
  return std::move(content_);
}

}  // namespace

MeshFileContent readObjMesh(std::string_view bytes, const InputSource& source) {
  return ObjReader(bytes, source).read();
}

}  // namespace swept::detail
