// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_faces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "io/mesh_content.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using Point = std::array<double, 3>;

std::string textOf(const Point& point) {
  return "(" + formatNumber(point[0]) + ", " + formatNumber(point[1]) + ", " +
         formatNumber(point[2]) + ")";
}

class PointFaces {
 public:
  PointFaces(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles)
      : vertices_(vertices), triangles_(triangles) {}

  /// The positions of faces that are points and no corner of other faces, each with the first such
  /// face.
  std::map<Point, std::size_t> alone() const {
    std::map<Point, std::size_t> points;
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      if (differentCorners(triangles_[i]) == 1) points.emplace(cornersOf(triangles_[i])[0], i);
    if (points.empty()) return points;
    for (const Eigen::Vector3i& triangle : triangles_) {
      if (differentCorners(triangle) < 2) continue;
      for (const Point& corner : cornersOf(triangle)) points.erase(corner);
    }
    return points;
  }
  bool anyHasArea() const {
    return std::ranges::any_of(triangles_, [&](const Eigen::Vector3i& triangle) {
      return differentCorners(triangle) == 3;
    });
  }

 private:
  /// 0: an index is out of range.
  int differentCorners(const Eigen::Vector3i& triangle) const {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= std::ssize(vertices_)) return 0;
    const auto [a, b, c] = cornersOf(triangle);
    if (a == b && b == c) return 1;
    return a == b || b == c || c == a ? 2 : 3;
  }
  std::array<Point, 3> cornersOf(const Eigen::Vector3i& triangle) const {
    std::array<Point, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& vertex = vertices_[static_cast<std::size_t>(triangle[i])];
      // Adding zero turns -0.0 into 0.0.
      corners[static_cast<std::size_t>(i)] = {vertex.x() + 0.0, vertex.y() + 0.0, vertex.z() + 0.0};
    }
    return corners;
  }

  std::span<const Eigen::Vector3d> vertices_;
  std::span<const Eigen::Vector3i> triangles_;
};

}  // namespace

void refuseLonePoints(std::span<const Eigen::Vector3d> vertices,
                      std::span<const Eigen::Vector3i> triangles) {
  const PointFaces faces(vertices, triangles);
  const auto alone = faces.alone();
  // If there are no other faces at all, build() has a message.
  if (alone.empty() || !faces.anyHasArea()) return;
  const auto& [point, triangle] = *alone.begin();
  throw MeshFileError("has a face, its triangle " + std::to_string(triangle) +
                      " counted from 0, that is only the point " + textOf(point) +
                      ", in m, and no corner of another; faces must have distinct corners");
}

}  // namespace swept::detail
