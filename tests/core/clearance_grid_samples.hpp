// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"
#include "swept/core/clearance_grid.hpp"

namespace swept::test {

/// A shape, and its distance by brute force.
struct ClearanceScene {
  std::string name;
  Shape shape;
  reference::Triangles triangles;
  bool solid = false;
  std::vector<Eigen::Vector3d> centers = {};
  std::vector<double> radii = {};

  /// m
  double distance(const Eigen::Vector3d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) least = std::min(least, reference::pointTriangle(p, t));
    for (std::size_t i = 0; i < centers.size(); ++i)
      least = std::min(least, std::max((p - centers[i]).norm() - radii[i], 0.0));
    const bool inside = solid && std::abs(reference::windingNumber(triangles, p)) > 0.5;
    return inside ? 0.0 : least;
  }

  /// On a triangle, or in a ball.
  Eigen::Vector3d point(std::mt19937& random) const {
    if (!centers.empty()) return centers[random() % centers.size()];
    const auto& [a, b, c] = triangles[random() % triangles.size()];
    const double s = uniform(random, 0.0, 1.0);
    return (1.0 - s) * a + s * (b + uniform(random, 0.0, 1.0) * (c - b));
  }
};

inline ClearanceScene meshScene(const char* name, const Soup& soup, MeshInterior interior) {
  ClearanceScene scene{name,
                       TriangleMesh::build(soup.vertices, soup.triangles, interior),
                       {},
                       interior == MeshInterior::Solid};
  scene.triangles = reference::trianglesOf(soup.vertices, soup.triangles);
  return scene;
}

/// Radii (m) between two numbers, of points within `size` (m) of `middle`.
inline ClearanceScene cloudScene(const char* name, int count, const Eigen::Vector3d& size,
                                 double least, double most,
                                 const Eigen::Vector3d& middle = Eigen::Vector3d::Zero()) {
  std::mt19937 random(3);
  std::vector<Eigen::Vector3d> centers;
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) {
    centers.push_back(middle + size.cwiseProduct(uniformPoint(random, 1.0)));
    radii.push_back(i == 0 ? most : uniform(random, least, most));
  }
  return {name, PointCloud::build(centers, radii), {}, false, centers, radii};
}

/// Thin, and in all directions.
inline Soup looseTriangles(int count, double thickness) {
  std::mt19937 random(6);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const int first = static_cast<int>(soup.vertices.size());
    const Eigen::Vector3d from = uniformPoint(random, 0.5);
    const double length = uniform(random, 0.1, 1.0);
    const Eigen::Vector3d along = length * unitVector(random);
    const Eigen::Vector3d apex = from + 0.5 * along + thickness * unitVector(random);
    soup.vertices.insert(soup.vertices.end(), {from, from + along, apex});
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  return soup;
}

inline std::vector<ClearanceScene> clearanceScenes() {
  using Eigen::Vector3d;
  std::mt19937 random(4);
  const Soup blob = blobSoup(random, 10, 12);
  const Soup far = blob.moved(Eigen::Isometry3d(Eigen::Translation3d(1e4, -2e4, 3e3)));
  Soup one;
  one.vertices = {Vector3d(0.0, 0.0, 0.1), Vector3d(0.9, 0.0, 0.3), Vector3d(0.1, 0.5, 0.0)};
  one.triangles = {{0, 1, 2}};
  const auto solid = MeshInterior::Solid;
  const auto surface = MeshInterior::Surface;
  const Vector3d all = Vector3d::Constant(0.6);
  return {
      meshScene("torus", torusSoup(20, 10, 0.5, 0.15), solid),
      meshScene("blob", blob, solid),
      meshScene("hollow blob", blob, surface),
      meshScene("blob far away", far, solid),
      meshScene("triangles", looseTriangles(40, 0.3), surface),
      meshScene("slivers", looseTriangles(40, 1e-5), surface),
      meshScene("one triangle", one, surface),
      cloudScene("points", 300, all, 0.0, 0.0),
      cloudScene("balls", 300, all, 0.03, 0.03),
      cloudScene("balls of many sizes", 300, all, 0.0, 0.12),
      cloudScene("balls far away", 200, all, 0.01, 0.05, Vector3d(-1e4, 5e3, 1e4)),
      cloudScene("flat", 200, Vector3d(0.8, 0.8, 0.0), 0.0, 0.0),
      cloudScene("on a line", 100, Vector3d(0.0, 4.0, 0.0), 0.01, 0.02),
      cloudScene("one point", 1, all, 0.0, 0.0),
      cloudScene("a point many times", 50, Vector3d::Zero(), 0.05, 0.05),
  };
}

/// m. All over the grid, at borders of its voxels, about the shape, and beyond the grid.
inline Eigen::Vector3d clearanceSample(const ClearanceScene& scene, const ClearanceGrid& grid,
                                       std::mt19937& random) {
  const Aabb& box = grid.box();
  Eigen::Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(random, box.lower[i], box.upper[i]);
  switch (random() % 5) {
    case 0:
      for (int i = 0; i < 3; ++i) {
        const double count = std::round((p[i] - box.lower[i]) / grid.voxel());
        if (random() % 2 != 0) p[i] = box.lower[i] + count * grid.voxel();
      }
      return p;
    case 1:
    case 2: {
      const Eigen::Vector3d near = scene.point(random);
      return near + uniformPoint(random, 6.0 * grid.voxel());
    }
    case 3:
      return box.center() + 1.5 * (p - box.center());
    default:
      return p;
  }
}

}  // namespace swept::test
