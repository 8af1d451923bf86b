// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/face_cutter.hpp"
#include "io/mesh_readers.hpp"
#include "io/point_file.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// The lines of a text: `OFF`, three counts, vertices, faces. What follows the coordinates of a
/// vertex (normal, colour, texture) or the corners of a face (colour) is not looked at.
class OffReader {
 public:
  OffReader(std::string_view bytes, const InputSource& source)
      : lines_(source, bytes), cutter_(source) {}
  MeshFileContent read();

 private:
  /// The words of the next line that has some, less a remark.
  bool next();
  void readNext(const std::string& what);
  std::uint64_t wholeNumber(std::size_t word, std::uint64_t most, const std::string& what) const;
  std::array<std::uint64_t, 2> readCounts();
  void readVertex();
  void readFace();

  LineReader lines_;
  std::vector<std::string_view> words_;
  FaceCutter cutter_;
  std::vector<int> corners_;
  MeshFileContent content_;
};

bool OffReader::next() {
  while (lines_.nextFilled()) {
    words_ = words(lines_.line().substr(0, lines_.line().find('#')));
    if (!words_.empty()) return true;
  }
  return false;
}

void OffReader::readNext(const std::string& what) {
  if (!next()) lines_.fail("the file ends where " + what + " has to follow");
}

std::uint64_t OffReader::wholeNumber(std::size_t word, std::uint64_t most,
                                     const std::string& what) const {
  const auto value = word < words_.size() ? parseCount(words_[word]) : std::nullopt;
  if (!value || *value > most)
    lines_.fail(what + " must be a whole number from 0 to " + std::to_string(most));
  return *value;
}

/// Of vertices and faces. The third, of edges, means nothing.
std::array<std::uint64_t, 2> OffReader::readCounts() {
  constexpr std::array<std::string_view, 8> kForms{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                   "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  readNext("'OFF'");
  const std::string form(words_[0]);
  if (std::ranges::find(kForms, form) == kForms.end() ||
      (words_.size() > 1 && words_[1] == "BINARY")) {
    lines_.fail(shown(lines_.line()) +
                " where 'OFF' has to be, or that with C, N or ST ahead of it, as text");
  }
  // Some programs write the counts on the same line.
  words_.erase(words_.begin());
  if (words_.empty()) readNext("the counts of vertices, faces and edges");
  return {wholeNumber(0, kMaxPoints, "the count of vertices"),
          wholeNumber(1, kMaxPoints, "the count of faces")};
}

void OffReader::readVertex() {
  readNext("a vertex");
  Eigen::Vector3d point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = axis < words_.size() ? parseNumber(words_[axis]) : std::nullopt;
    if (!value) lines_.fail("a vertex must start with three finite numbers");
    point[static_cast<Eigen::Index>(axis)] = *value;
  }
  content_.vertices.push_back(point);
}

void OffReader::readFace() {
  readNext("a face");
  const std::uint64_t count = wholeNumber(0, kMaxPoints, "the count of the corners of a face");
  if (count < 3)
    lines_.fail("a face has " + std::to_string(count) + " corners; it must have at least 3");
  if (count >= words_.size()) lines_.fail("the line ends where a corner has to follow");
  corners_.clear();
  for (std::size_t i = 1; i <= count; ++i) {
    const std::uint64_t corner = wholeNumber(i, kMaxPoints, "a corner");
    if (corner >= content_.vertices.size()) {
      lines_.fail("a corner is vertex " + std::to_string(corner) + "; there are " +
                  std::to_string(content_.vertices.size()) + ", counted from 0");
    }
    corners_.push_back(static_cast<int>(corner));
  }
  cutter_.cut(corners_, content_.vertices, content_.triangles, lines_.number());
}

MeshFileContent OffReader::read() {
  const auto [vertices, faces] = readCounts();
  for (std::uint64_t i = 0; i < vertices; ++i) readVertex();
  for (std::uint64_t i = 0; i < faces; ++i) readFace();
  if (next()) lines_.fail("more follows after the last face");
  keepUsedVertices(content_);
  return std::move(content_);
}

}  // namespace

MeshFileContent readOffMesh(std::string_view bytes, const InputSource& source) {
  return OffReader(bytes, source).read();
}

}  // namespace swept::detail
