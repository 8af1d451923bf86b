// SPDX-License-Identifier: BSD-3-Clause
#include "io/crossing_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace swept::detail {

namespace {

using Eigen::Vector2d;

/// Pairs of edges of all faces together: about a second. A file with more has faces of thousands of
/// corners, and is refused without a line.
constexpr std::uint64_t kMaxLooks = 50'000'000;

/// Seen along the axis that is nearest to its normal, as assimp looks at it.
std::vector<Vector2d> flattened(std::span<const Eigen::Vector3d> corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  Eigen::Index along = 0;
  normal.cwiseAbs().maxCoeff(&along);
  std::vector<Vector2d> flat;
  for (const Eigen::Vector3d& corner : corners)
    flat.emplace_back(corner[(along + 1) % 3], corner[(along + 2) % 3]);
  return flat;
}

/// 1 left of the line from a to b, -1 right of it.
int sideOf(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  const Vector2d line = b - a, to = point - a;
  const double turn = line.x() * to.y() - line.y() * to.x();
  return (turn > 0.0) - (turn < 0.0);
}

enum class Meeting : std::uint8_t { None, Touch, Cross };

Meeting meeting(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const int apart = sideOf(a, b, c) * sideOf(a, b, d), across = sideOf(c, d, a) * sideOf(c, d, b);
  if (apart < 0 && across < 0) return Meeting::Cross;
  // On one line, they may be beside each other.
  const bool near = (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
                    (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
  return apart <= 0 && across <= 0 && near ? Meeting::Touch : Meeting::None;
}

/// The worst of its edges that have no common corner.
Meeting meetingOf(const std::vector<Vector2d>& corners) {
  const std::size_t n = corners.size();
  Meeting worst = Meeting::None;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n && worst != Meeting::Cross; ++j) {
      if (i == 0 && j == n - 1) continue;
      worst =
          std::max(worst, meeting(corners[i], corners[i + 1], corners[j], corners[(j + 1) % n]));
    }
  }
  return worst;
}

}  // namespace

void CrossingFace::look(std::span<const Eigen::Vector3d> corners, int line, std::int64_t face) {
  const std::uint64_t count = corners.size();
  constexpr std::uint64_t kMaxCorners = 10'000;
  if (count <= 4 || count > kMaxCorners || !crossing_.empty()) return;
  looks_ += count * count / 2;
  if (looks_ > kMaxLooks) return;
  const Meeting worst = meetingOf(flattened(corners));
  std::string& name = worst == Meeting::Cross ? crossing_ : touching_;
  if (worst == Meeting::None || !name.empty()) return;
  if (line > 0) name = "its line " + std::to_string(line) + ": ";
  name += face < 0 ? "a face" : "face " + std::to_string(face) + ", counted from 0,";
  name += " of " + std::to_string(count) + " corners";
}

}  // namespace swept::detail
