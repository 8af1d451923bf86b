// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"
#include "swept/core/triangle_pair.hpp"

/// Deforming meshes, and slow answers to the same questions that share nothing with the quick ones
/// but the test of two triangles.
namespace swept::test {

constexpr std::size_t kEveryPair = std::numeric_limits<std::size_t>::max();

/// Triangles and where their vertices are at either end of a step.
struct SoupMotion {
  Soup soup;                         ///< at the start
  std::vector<Eigen::Vector3d> end;  ///< m

  std::vector<Eigen::Vector3d> at(double t) const {
    std::vector<Eigen::Vector3d> vertices = soup.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      vertices[v] = (1.0 - t) * soup.vertices[v] + t * end[v];
    return vertices;
  }
  TriangleCorners corners(int triangle, double t) const {
    TriangleCorners corners;
    for (int k = 0; k < 3; ++k) {
      const auto v =
          static_cast<std::size_t>(soup.triangles[static_cast<std::size_t>(triangle)][k]);
      corners[static_cast<std::size_t>(k)] = (1.0 - t) * soup.vertices[v] + t * end[v];
    }
    return corners;
  }
  DeformingMesh mesh() const {
    DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
    mesh.moveTo(end);
    return mesh;
  }
};

/// An open sheet of 2 n^2 triangles, 2 m wide, with waves that travel.
inline Soup sheetSoup(int n, double time, double height) {
  Soup soup;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = -1.0 + 2.0 * i / n;
      const double y = -1.0 + 2.0 * j / n;
      soup.vertices.emplace_back(
          x, y, height + 0.1 * std::sin(4.0 * x + time) * std::cos(3.0 * y - 2.0 * time));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j;
      const int b = a + n + 1;
      soup.triangles.emplace_back(a, b, b + 1);
      soup.triangles.emplace_back(a, b + 1, a + 1);
    }
  }
  return soup;
}

/// Two pulsating bodies on a sheet, at a time; vertices move far in 0.1.
inline Soup bouncing(double time, int detail = 12) {
  Soup soup = sheetSoup(detail, time, 0.0);
  for (int body = 0; body < 2; ++body) {
    std::mt19937 random(5);
    Soup blob = blobSoup(random, detail, detail);
    const double pulse = 0.4 + 0.08 * std::sin(3.0 * time + body);
    const Eigen::Vector3d middle(0.5 * std::cos(time + 2.5 * body), 0.3 * body,
                                 0.1 + 0.5 * std::abs(std::sin(2.0 * time + body)));
    for (Eigen::Vector3d& v : blob.vertices) v = pulse * v + middle;
    soup.append(blob);
  }
  return soup;
}

inline SoupMotion bouncingStep(double time, double length, int detail = 12) {
  return {bouncing(time, detail), bouncing(time + length, detail).vertices};
}

/// Triangles at random, some of them without an area, a few of which share vertices.
inline SoupMotion randomTriangles(std::mt19937& random, int count, double size, double travel) {
  SoupMotion motion;
  for (int t = 0; t < count; ++t) {
    const Eigen::Vector3d middle = uniformPoint(random, 1.0);
    const auto first = static_cast<int>(motion.soup.vertices.size());
    for (int k = 0; k < 3; ++k) motion.soup.vertices.push_back(middle + uniformPoint(random, size));
    motion.soup.triangles.emplace_back(first, first + 1, first + 2);
    if (t % 7 == 0)
      motion.soup.vertices.back() = motion.soup.vertices[static_cast<std::size_t>(first)];
    if (t % 11 == 0) motion.soup.triangles.back()[1] = first;
    if (t % 5 == 0 && t > 0) motion.soup.triangles.back()[2] = first - 3;
  }
  const Eigen::Vector3d together = uniformPoint(random, travel);
  for (const Eigen::Vector3d& v : motion.soup.vertices)
    motion.end.push_back(v + together + uniformPoint(random, travel));
  return motion;
}

inline bool shareVertex(const Soup& soup, int t, int u) {
  for (const int v : soup.triangles[static_cast<std::size_t>(t)]) {
    if ((soup.triangles[static_cast<std::size_t>(u)].array() == v).any()) return true;
  }
  return false;
}

/// What selfCollideMesh() gives, sorted.
inline std::vector<TrianglePair> touchingPairs(const std::vector<Eigen::Vector3d>& vertices,
                                               const std::vector<Eigen::Vector3i>& triangles) {
  BvhModel<Aabb> model;
  model.begin();
  model.addMesh(vertices, triangles);
  model.end();
  MeshCollisionResult result;
  selfCollideMesh(model, {kEveryPair}, result);
  std::sort(result.pairs.begin(), result.pairs.end());
  return result.pairs;
}

/// Pairs that touch in one of `samples` + 1 moments.
inline std::set<TrianglePair> sampledPairs(const SoupMotion& motion, int samples) {
  std::set<TrianglePair> seen;
  for (int i = 0; i <= samples; ++i) {
    for (const TrianglePair& pair :
         touchingPairs(motion.at(static_cast<double>(i) / samples), motion.soup.triangles))
      seen.insert(pair);
  }
  return seen;
}

/// Whether two triangles provably keep more than `gap` (m): from one moment on to the next, by as
/// much as their distance allows at the speed of their fastest corners.
inline bool keepApart(const SoupMotion& a, int t, const SoupMotion& b, int u, double gap) {
  double speed = 0.0;
  for (const int v : a.soup.triangles[static_cast<std::size_t>(t)]) {
    for (const int w : b.soup.triangles[static_cast<std::size_t>(u)]) {
      const auto i = static_cast<std::size_t>(v);
      const auto j = static_cast<std::size_t>(w);
      speed =
          std::max(speed, (a.end[i] - a.soup.vertices[i] - b.end[j] + b.soup.vertices[j]).norm());
    }
  }
  double time = 0.0;
  while (true) {
    const double apart = triangleDistance(a.corners(t, time), b.corners(u, time)).lower;
    if (apart <= gap) return false;
    if (speed * (1.0 - time) < apart - gap || time == 1.0) return true;
    time = std::min(1.0, time + std::max(0.999 * (apart - gap), 1e-9) / speed);
  }
}

}  // namespace swept::test
