// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_faces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "io/mesh_file.hpp"
#include "io/numbers.hpp"

namespace swept::detail {

namespace {

using Point = std::array<double, 3>;
/// Its ends in order; equal ones: a point.
using Line = std::pair<Point, Point>;

Point pointOf(const Eigen::Vector3d& vertex) {
  // Adding zero turns -0.0 into 0.0.
  return {vertex.x() + 0.0, vertex.y() + 0.0, vertex.z() + 0.0};
}

Line lineOf(const Point& a, const Point& b) {
  return a < b ? Line{a, b} : Line{b, a};
}

std::string textOf(const Point& point) {
  return "(" + formatNumber(point[0]) + ", " + formatNumber(point[1]) + ", " +
         formatNumber(point[2]) + ")";
}

class LineFaces {
 public:
  LineFaces(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles)
      : vertices_(vertices), triangles_(triangles) {}
  /// Those that no face with an area covers, each with the first of its faces.
  std::map<Line, std::size_t> uncovered() const;

 private:
  bool inRange(const Eigen::Vector3i& triangle) const {
    return triangle.minCoeff() >= 0 && triangle.maxCoeff() < std::ssize(vertices_);
  }
  bool isLine(const Eigen::Vector3i& triangle) const {
    const auto& [a, b, c] = std::array{vertices_[static_cast<std::size_t>(triangle[0])],
                                       vertices_[static_cast<std::size_t>(triangle[1])],
                                       vertices_[static_cast<std::size_t>(triangle[2])]};
    return a == b || b == c || c == a;
  }
  std::array<Point, 3> cornersOf(const Eigen::Vector3i& triangle) const;
  void erase(const Eigen::Vector3i& triangle, std::map<Line, std::size_t>& lines) const;

  std::span<const Eigen::Vector3d> vertices_;
  std::span<const Eigen::Vector3i> triangles_;
};

std::array<Point, 3> LineFaces::cornersOf(const Eigen::Vector3i& triangle) const {
  std::array<Point, 3> corners;
  for (int i = 0; i < 3; ++i)
    corners[static_cast<std::size_t>(i)] =
        pointOf(vertices_[static_cast<std::size_t>(triangle[i])]);
  return corners;
}

void LineFaces::erase(const Eigen::Vector3i& triangle, std::map<Line, std::size_t>& lines) const {
  const auto corners = cornersOf(triangle);
  for (const Point& a : corners)
    for (const Point& b : corners) lines.erase(lineOf(a, b));
}

std::map<Line, std::size_t> LineFaces::uncovered() const {
  std::map<Line, std::size_t> lines;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (!inRange(triangles_[i]) || !isLine(triangles_[i])) continue;
    const auto corners = cornersOf(triangles_[i]);
    const auto [least, most] = std::ranges::minmax(corners);
    lines.emplace(lineOf(least, most), i);
  }
  // build() has a message for no other faces at all.
  if (lines.empty() || std::ranges::all_of(triangles_, [&](const Eigen::Vector3i& triangle) {
        return inRange(triangle) && isLine(triangle);
      })) {
    return {};
  }
  for (const Eigen::Vector3i& triangle : triangles_)
    if (inRange(triangle) && !isLine(triangle)) erase(triangle, lines);
  return lines;
}

}  // namespace

void keepLines(std::vector<Eigen::Vector3d>& vertices, std::vector<Eigen::Vector3i>& triangles) {
  for (const auto& [line, triangle] : LineFaces(vertices, triangles).uncovered()) {
    const Eigen::Vector3d first(line.first.data()), second(line.second.data());
    const Eigen::Vector3d middle = 0.5 * first + 0.5 * second;
    if (middle == first || middle == second) {
      throw MeshFileError("has a face, its triangle " + std::to_string(triangle) +
                          " counted from 0, that is only the point " + textOf(line.first) +
                          ", in m, and no corner of another; faces must have distinct corners");
    }
    const int next = static_cast<int>(vertices.size());
    vertices.insert(vertices.end(), {first, middle, second});
    triangles.emplace_back(next, next + 1, next + 2);
  }
}

}  // namespace swept::detail
