// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh_claim.hpp"
#include "io/numbers.hpp"
#include "io/point_file.hpp"

namespace swept::detail {

namespace {

/// What has no faces. Others (`fo`, `curv`, `surf`, `call`) have, or may have.
constexpr std::array<std::string_view, 13> kNoFaces{
    "vt", "vn", "vp", "p", "l", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib"};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const InputSource& source)
      : lines_(source, bytes), source_(source) {}
  MeshClaim read();

 private:
  void readLine();
  void readVertex(const std::vector<std::string_view>& line);
  void readFace(const std::vector<std::string_view>& line);
  /// From 0; of a vertex that may follow later.
  std::size_t readCorner(std::string_view word) const;
  std::int64_t readIndex(std::string_view text, std::string_view corner) const;
  void finish();

  LineReader lines_;
  const InputSource& source_;
  MeshClaim claim_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::uint32_t> corners_;
  std::size_t needed_ = 0;  ///< so many vertices
  int neededAt_ = 0;        ///< line
};

void ObjReader::readVertex(const std::vector<std::string_view>& line) {
  const std::size_t count = line.size() - 1;
  // A weight other than 1 means something to curved surfaces only, and assimp divides by it.
  const bool weighted = count == 4 && parseNumber(line[4]) == 1.0;
  if (count != 3 && count != 6 && !weighted)
    lines_.fail("a vertex must have 3 numbers, a fourth that is 1, or 6 with its colour");
  Eigen::Vector3d point;
  for (std::size_t i = 1; i <= count; ++i) {
    const auto value = i <= 3 ? claim_.coordinate(line[i]) : parseNumber(line[i]);
    if (!value) lines_.fail(shown(line[i]) + " of a vertex must be a finite number");
    if (i <= 3) point[static_cast<Eigen::Index>(i - 1)] = *value;
  }
  vertices_.push_back(point);
}

std::int64_t ObjReader::readIndex(std::string_view text, std::string_view corner) const {
  std::int32_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || value == 0) {
    lines_.fail("corner " + shown(corner) +
                " of a face must be V, V/T, V//N or V/T/N, of whole numbers other than 0");
  }
  return value;
}

std::size_t ObjReader::readCorner(std::string_view word) const {
  const auto first = word.find('/');
  const std::int64_t index = readIndex(word.substr(0, first), word);
  if (first != std::string_view::npos) {
    const std::string_view rest = word.substr(first + 1);
    const auto second = rest.find('/');
    if (second != 0) readIndex(rest.substr(0, second), word);
    if (second != std::string_view::npos) readIndex(rest.substr(second + 1), word);
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
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::size_t corner = readCorner(line[i]);
    corners_.push_back(static_cast<std::uint32_t>(corner));
    if (corner < needed_) continue;
    needed_ = corner + 1;
    neededAt_ = lines_.number();
  }
  claim_.triangles += line.size() - 3;
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
  for (const std::uint32_t corner : corners_) claim_.box.extend(vertices_[corner]);
}

MeshClaim ObjReader::read() {
  while (lines_.next()) readLine();
  finish();
  return claim_;
}

}  // namespace

MeshClaim checkObj(std::string_view bytes, const InputSource& source) {
  return ObjReader(bytes, source).read();
}

}  // namespace swept::detail
