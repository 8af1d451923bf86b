// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "fuzz_input.hpp"
#include "swept/core/shapes.hpp"

/// Shapes and poses from bytes, and points that are certainly in them.
namespace swept::fuzz {

inline Eigen::Vector3d vector3(Numbers& numbers) {
  const double x = numbers.unit(), y = numbers.unit();
  return {x, y, numbers.unit()};
}

inline Eigen::Isometry3d pose(Numbers& numbers, double scale) {
  Eigen::Isometry3d found = Eigen::Isometry3d::Identity();
  found.translation() = scale * vector3(numbers);
  const Eigen::Vector3d turn = vector3(numbers);
  if (turn.norm() > 0.0)
    found.linear() = Eigen::AngleAxisd(3.0 * turn.norm(), turn.normalized()).toRotationMatrix();
  return found;
}

/// A shape, and points of it, m.
struct Sampled {
  Shape shape;
  std::vector<Eigen::Vector3d> points;
};

inline std::vector<Eigen::Vector3d> axisPoints(const Eigen::Vector3d& reach) {
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      points.emplace_back(side * reach[axis] * Eigen::Vector3d::Unit(axis));
  return points;
}

inline Sampled box(const Eigen::Vector3d& size) {
  Sampled found{makeBox(size), {}};
  for (int corner = 0; corner < 8; ++corner)
    found.points.emplace_back(0.5 * Eigen::Vector3d((corner & 1) != 0 ? size.x() : -size.x(),
                                                    (corner & 2) != 0 ? size.y() : -size.y(),
                                                    (corner & 4) != 0 ? size.z() : -size.z()));
  return found;
}

inline Sampled triangle(Numbers& numbers, double scale) {
  std::array<Eigen::Vector3d, 3> corners;
  for (Eigen::Vector3d& corner : corners) corner = scale * vector3(numbers);
  return {makeTriangle(corners[0], corners[1], corners[2]), {corners.begin(), corners.end()}};
}

inline Sampled hull(Numbers& numbers, double scale) {
  std::vector<Eigen::Vector3d> points;
  const int count = 1 + numbers.byte() % 12;
  for (int i = 0; i < count; ++i) points.push_back(scale * vector3(numbers));
  return {ConvexHull::of(points), points};
}

/// A cube as a closed mesh.
inline Sampled mesh(double size) {
  const Sampled cube = box(Eigen::Vector3d::Constant(size));
  std::vector<Eigen::Vector3i> triangles;
  constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& face : kFaces) triangles.emplace_back(face[0], face[1], face[2]);
  return {TriangleMesh::build(cube.points, triangles), cube.points};
}

inline Sampled shape(Numbers& numbers, double scale) {
  const int kind = numbers.byte() % 9;
  const double a = scale * std::abs(numbers.unit()), b = scale * std::abs(numbers.unit());
  switch (kind) {
    case 0:
      return {makeSphere(a), axisPoints({a, a, a})};
    case 1:
      return box({a, b, scale * std::abs(numbers.unit())});
    case 2:
      return {makeCylinder(a, b), axisPoints({a, a, 0.5 * b})};
    case 3:
      return {makeCapsule(a, b), axisPoints({a, a, 0.5 * b + a})};
    case 4:
      return {makeCone(a, b), {{0.0, 0.0, 0.5 * b}, {a, 0.0, -0.5 * b}, {0.0, -a, -0.5 * b}}};
    case 5: {
      const Eigen::Vector3d axes(a, b, scale * std::abs(numbers.unit()));
      return {makeEllipsoid(axes), axisPoints(axes)};
    }
    case 6:
      return triangle(numbers, scale);
    case 7:
      return hull(numbers, scale);
    default:
      return mesh(a > 0.0 ? a : scale);
  }
}

}  // namespace swept::fuzz
