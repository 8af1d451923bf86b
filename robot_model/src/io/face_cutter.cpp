// SPDX-License-Identifier: BSD-3-Clause
#include "io/face_cutter.hpp"

#include <Eigen/Geometry>
#include <string>
#include <utility>

#include "io/mesh_content.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// The most looks at corners: about a second. That is more than any drawn face needs. One with ten
/// thousand corners takes half of it.
constexpr std::uint64_t kMaxLooks = 100'000'000;

Vector3d towards(const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const double length = way.stableNorm();
  return length > 0.0 ? Vector3d(way / length) : Vector3d::Zero();
}

/// Which corner of a face of 4 has more than half a turn inside; 0: none.
int concaveCornerOf(std::span<const int> corners, std::span<const Vector3d> vertices) {
  for (int i = 0; i < 4; ++i) {
    const auto at = [&](int k) -> const Vector3d& { return vertices[corners[(i + k) % 4]]; };
    // Of the two angles between the diagonal and the sides: their sum is more than half a turn
    // where their cosines have a negative one.
    const Vector3d sides = towards(at(0), at(1)) + towards(at(0), at(3));
    if (sides.dot(towards(at(0), at(2))) < 0.0) return i;
  }
  return 0;
}

}  // namespace

void FaceCutter::cut(std::span<const int> corners, std::span<const Vector3d> vertices,
                     std::vector<Vector3i>& triangles, int line, std::int64_t face) {
  requireFewTriangles(triangles.size() + corners.size() - 2);
  if (corners.size() == 3) {
    triangles.emplace_back(corners[0], corners[1], corners[2]);
    return;
  }
  if (corners.size() == 4) {
    const int first = concaveCornerOf(corners, vertices);
    const auto at = [&](int k) { return corners[(first + k) % 4]; };
    triangles.emplace_back(at(0), at(1), at(2));
    triangles.emplace_back(at(0), at(2), at(3));
    return;
  }
  const auto fail = [&](const std::string& problem) {
    const std::string name =
        face < 0 ? "a face" : "face " + std::to_string(face) + ", counted from 0,";
    source_.fail(line, name + " of " + std::to_string(corners.size()) + " corners " + problem);
  };
  const bool isSeen = flatten(corners, vertices);
  if (isSeen && isFan()) {
    for (std::size_t i = 2; i < corners.size(); ++i)
      triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
  } else if (!isSeen || !cutEars(corners, triangles)) {
    fail(looks_ > kMaxLooks
             ? "is concave, and too much of the file is; it has to be given as triangles"
             : "crosses or touches itself; a face of more than 4 corners must not, or has to be "
               "given as triangles");
  }
}

/// Makes the face turn left. False: it winds as much one way as the other, as a face that crosses
/// itself may. It then has no normal to be seen along.
bool FaceCutter::flatten(std::span<const int> corners, std::span<const Vector3d> vertices) {
  const Vector3d& first = vertices[corners[0]];
  Vector3d normal = Vector3d::Zero();
  double sum = 0.0;  // of the areas, whichever way they turn
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vector3d area = (vertices[corners[i - 1]] - first).cross(vertices[corners[i]] - first);
    normal += area;
    sum += area.norm();
  }
  Eigen::Index along = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&along);
  // A smaller area is rounding error.
  constexpr double kLeast = 1e-10;
  if (sum != 0.0 && !(largest > kLeast * sum)) return false;
  const double side = normal[along] < 0.0 ? -1.0 : 1.0;
  outline_.points.clear();
  for (const int corner : corners) {
    const Vector3d& at = vertices[corner];
    outline_.points.emplace_back(side * at[(along + 1) % 3], at[(along + 2) % 3]);
  }
  return true;
}

/// Twice the area of a triangle; negative: it turns right.
double FaceCutter::turn(int a, int b, int c) const {
  const Vector2d ab = outline_.points[b] - outline_.points[a];
  const Vector2d ac = outline_.points[c] - outline_.points[a];
  return ab.x() * ac.y() - ab.y() * ac.x();
}

bool FaceCutter::isFan() const {
  // With a NaN the face is no fan.
  for (int i = 2; i < std::ssize(outline_.points); ++i)
    if (!(turn(0, i - 1, i) >= 0.0)) return false;
  return true;
}

void FaceCutter::lookAt(int corner) {
  outline_.turnsBack[corner] =
      !(turn(outline_.previous[corner], corner, outline_.next[corner]) > 0.0);
}

bool FaceCutter::isEar(int corner) {
  if (outline_.turnsBack[corner]) return false;
  const int before = outline_.previous[corner], after = outline_.next[corner];
  const std::vector<Vector2d>& points = outline_.points;
  for (int other = outline_.next[after]; other != before; other = outline_.next[other]) {
    ++looks_;
    if (!outline_.turnsBack[other]) continue;
    // A face with a hole goes to the hole and back the same way: corners at one place.
    const Vector2d& at = points[other];
    if (at == points[before] || at == points[corner] || at == points[after]) continue;
    if (turn(before, corner, other) >= 0.0 && turn(corner, after, other) >= 0.0 &&
        turn(after, before, other) >= 0.0)
      return false;
  }
  return true;
}

bool FaceCutter::isWithoutArea(int corner) const {
  return turn(outline_.previous[corner], corner, outline_.next[corner]) == 0.0;
}

void FaceCutter::take(int corner, std::span<const int> corners, std::vector<Vector3i>& triangles) {
  const int before = outline_.previous[corner], after = outline_.next[corner];
  triangles.emplace_back(corners[before], corners[corner], corners[after]);
  outline_.next[before] = after;
  outline_.previous[after] = before;
  lookAt(before);
  lookAt(after);
}

bool FaceCutter::cutEars(std::span<const int> corners, std::vector<Vector3i>& triangles) {
  const int count = static_cast<int>(corners.size());
  outline_.next.resize(corners.size());
  outline_.previous.resize(corners.size());
  outline_.turnsBack.resize(corners.size());
  for (int i = 0; i < count; ++i) {
    outline_.next[i] = (i + 1) % count;
    outline_.previous[i] = (i + count - 1) % count;
  }
  for (int i = 0; i < count; ++i) lookAt(i);
  int at = 0;
  for (int left = count; left > 3; --left) {
    int tried = 0;
    for (; tried < left && looks_ <= kMaxLooks && !isEar(at); ++tried) at = outline_.next[at];
    if (looks_ > kMaxLooks) return false;
    if (tried == left) {
      // A face without area covers nothing.
      for (tried = 0; tried < left && !isWithoutArea(at); ++tried) at = outline_.next[at];
      if (tried == left) return false;
    }
    const int after = outline_.next[at];
    take(at, corners, triangles);
    at = after;
  }
  if (!(turn(outline_.previous[at], at, outline_.next[at]) >= 0.0)) return false;
  triangles.emplace_back(corners[outline_.previous[at]], corners[at], corners[outline_.next[at]]);
  return true;
}

}  // namespace swept::detail
