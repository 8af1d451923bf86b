// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "box_worlds.hpp"
#include "swept/robot_model/world.hpp"
#include "workloads.hpp"

/// Worlds of points, triangles and small boxes around an arm of about 1 m at the origin, of any
/// size.
namespace swept::benchmark {

/// A normal number, by Box and Muller's method: those of the standard library differ.
inline double normal(std::mt19937_64& random) {
  const double length = std::sqrt(-2.0 * std::log(1.0 - uniform(random, 0.0, 1.0)));
  return length * std::cos(uniform(random, 0.0, 2.0 * std::numbers::pi));
}

/// A room 5 m wide with a table, objects on it, a post, and shelves of four boards on two sides.
inline std::vector<PlacedBox> roomWithShelves() {
  std::vector<PlacedBox> boxes = twelveBoxes();
  boxes.push_back({{5.0, 5.0, 0.1}, {0.0, 0.0, -0.8}, 0.0});
  boxes.push_back({{5.0, 5.0, 0.1}, {0.0, 0.0, 2.2}, 0.0});
  for (const double side : {-1.0, 1.0}) {
    boxes.push_back({{0.1, 5.0, 3.0}, {2.5 * side, 0.0, 0.7}, 0.0});
    boxes.push_back({{5.0, 0.1, 3.0}, {0.0, 2.5 * side, 0.7}, 0.0});
    for (int board = 0; board < 4; ++board)
      boxes.push_back({{0.4, 1.2, 0.03}, {0.3, 1.15 * side, 0.35 * board - 0.2}, 0.02 * board});
  }
  return boxes;
}

/// m. How far along the ray the box begins; none if it misses or the ray begins inside.
inline std::optional<double> hitOf(const PlacedBox& box, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& direction) {
  const Eigen::Isometry3d box_from_world = box.world_from_box.inverse();
  const Eigen::Vector3d p = box_from_world * from, d = box_from_world.linear() * direction;
  double begin = 0.0, end = 1e30;
  for (int i = 0; i < 3; ++i) {
    const double a = (-0.5 * box.size[i] - p[i]) / d[i], b = (0.5 * box.size[i] - p[i]) / d[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin > 0.0 && begin < end)) return std::nullopt;
  return begin;
}

/// What four depth cameras see of the room: rays through pixels, noise along the ray that grows
/// with the square of the depth (1 mm at 1 m), one in a thousand points off by up to 0.3 m. Balls
/// of 3 mm. Points within 0.25 m of the arm's base are its own, and left out.
inline PointCloud cameraCloud(int count) {
  const std::vector<PlacedBox> boxes = roomWithShelves();
  std::mt19937_64 random(7);
  const std::array<Eigen::Vector3d, 4> cameras{
      {{1.9, 1.6, 1.5}, {-1.8, 1.5, 1.6}, {1.7, -1.8, 1.4}, {-1.6, -1.9, 1.3}}};
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(count));
  while (points.size() < static_cast<std::size_t>(count)) {
    const Eigen::Vector3d& from = cameras[points.size() % cameras.size()];
    const Eigen::Vector3d forward = (Eigen::Vector3d(0.2, 0.0, 0.2) - from).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d direction = (forward + uniform(random, -0.8, 0.8) * right +
                                       uniform(random, -0.6, 0.6) * right.cross(forward))
                                          .normalized();
    double depth = 1e30;
    for (const PlacedBox& box : boxes)
      if (const auto hit = hitOf(box, from, direction)) depth = std::min(depth, *hit);
    if (!(depth < 1e30)) continue;
    const bool stray = random() % 1000 == 0;
    depth += 1e-3 * depth * depth * normal(random) + (stray ? uniform(random, -0.3, 0.0) : 0.0);
    const Eigen::Vector3d point = from + depth * direction;
    if (point.norm() > 0.25) points.push_back(point);
  }
  return PointCloud::build(points, 0.003);
}

/// Like cloudOf(), but for any number of points: no ball is larger than the thinnest board.
inline PointCloud surfaceCloud(int count) {
  const std::vector<PlacedBox> boxes = twelveBoxes();
  const double side = squareSide(boxes, count), radius = std::min(0.75 * side, 0.01);
  std::vector<Eigen::Vector3d> points;
  for (const PlacedBox& box : boxes) {
    const Eigen::Vector3d inner = box.size.array() - 2.0 * radius;
    eachFace(inner, partsOf(inner, side), [&](const auto& point, int m, int n) {
      for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= n; ++j)
          points.push_back(box.world_from_box *
                           point(static_cast<double>(i) / m, static_cast<double>(j) / n));
    });
  }
  return PointCloud::build(points, radius);
}

/// Points spread evenly in the twelve boxes, with balls of 2 mm.
inline PointCloud uniformCloud(int count) {
  const std::vector<PlacedBox> boxes = twelveBoxes();
  double volume = 0.0;
  for (const PlacedBox& box : boxes) volume += box.size.prod();
  std::mt19937_64 random(8);
  std::vector<Eigen::Vector3d> points;
  for (const PlacedBox& box : boxes) {
    const auto own = static_cast<int>(std::lround(count * box.size.prod() / volume));
    for (int i = 0; i < own; ++i) {
      Eigen::Vector3d p;
      for (int k = 0; k < 3; ++k) p[k] = box.size[k] * uniform(random, -0.5, 0.5);
      points.push_back(box.world_from_box * p);
    }
  }
  return PointCloud::build(points, 0.002);
}

/// Nine tenths of the points on a box of 0.2 m, the others on the rest of a hall 40 m wide.
inline PointCloud unevenCloud(int count) {
  const std::vector<PlacedBox> boxes = roomWithShelves();
  std::mt19937_64 random(9);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const PlacedBox& box = random() % 10 != 0 ? boxes[10] : boxes[random() % boxes.size()];
    Eigen::Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = box.size[k] * uniform(random, -0.5, 0.5);
    const auto side = static_cast<int>(random() % 3);
    p[side] = std::copysign(0.5 * box.size[side], p[side]);
    Eigen::Vector3d point = box.world_from_box * p;
    if (point.cwiseAbs().maxCoeff() > 2.0) point *= 8.0;
    points.push_back(point);
  }
  return PointCloud::build(points, 0.002);
}

/// The surface of the twelve boxes as a sensor's mesh: corners off by up to a fifth of an edge.
inline TriangleMesh noisyMesh(int triangles) {
  const std::vector<PlacedBox> boxes = twelveBoxes();
  const double side = squareSide(boxes, 0.5 * triangles);
  const double noise = std::min(0.004, 0.2 * side);
  std::mt19937_64 random(10);
  Soup soup;
  for (const PlacedBox& box : boxes) {
    eachFace(box.size, partsOf(box.size, side), [&](const auto& point, int m, int n) {
      const auto offset = static_cast<int>(soup.vertices.size());
      const Soup part = grid(m, n, false, false, [&](double u, double v) {
        return Eigen::Vector3d(box.world_from_box * point(u, v) +
                               uniform(random, 0.0, noise) * direction(random));
      });
      soup.vertices.insert(soup.vertices.end(), part.vertices.begin(), part.vertices.end());
      for (const Eigen::Vector3i& t : part.triangles)
        soup.triangles.emplace_back(t.array() + offset);
    });
  }
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

/// Small boxes, each turned and moved at random, on the surfaces of the twelve.
inline std::vector<PlacedBox> rubble(int count) {
  const std::vector<PlacedBox> boxes = twelveBoxes();
  const double side = squareSide(boxes, count);
  std::mt19937_64 random(11);
  std::vector<PlacedBox> small;
  for (const PlacedBox& box : boxes) {
    eachFace(box.size, partsOf(box.size, side), [&](const auto& point, int m, int n) {
      for (int i = 0; i < m * n; ++i) {
        const Eigen::Vector3d at = box.world_from_box * point((i % m + 0.5) / m, (i / m + 0.5) / n);
        const double size = std::min(0.05, side);
        PlacedBox one({uniform(random, 0.3, 1.0) * size, uniform(random, 0.3, 1.0) * size,
                       uniform(random, 0.3, 1.0) * size},
                      at, 0.0);
        one.world_from_box.rotate(Eigen::AngleAxisd(uniform(random, 0.0, 3.0), direction(random)));
        small.push_back(one);
      }
    });
  }
  return small;
}

struct SensedKind {
  std::string name;
  std::string part;  ///< points, meshes or boxes
  std::vector<int> sizes;
  std::function<World(int)> make;
};

inline std::vector<SensedKind> sensedKinds() {
  const std::vector<int> points{10'000, 100'000, 1'000'000, 10'000'000};
  const std::vector<int> triangles{1'000, 10'000, 100'000, 1'000'000};
  const std::vector<int> boxes{100, 1'000, 10'000, 100'000};
  const auto one = [](auto shape) {
    World world;
    world.add("world", std::move(shape), Eigen::Isometry3d::Identity());
    return world;
  };
  return {
      {"surfaces", "points", points, [=](int n) { return one(surfaceCloud(n)); }},
      {"cameras", "points", points, [=](int n) { return one(cameraCloud(n)); }},
      {"uniform", "points", points, [=](int n) { return one(uniformCloud(n)); }},
      {"uneven", "points", points, [=](int n) { return one(unevenCloud(n)); }},
      {"smooth", "meshes", triangles, [=](int n) { return one(meshOf(twelveBoxes(), n)); }},
      {"noisy", "meshes", triangles, [=](int n) { return one(noisyMesh(n)); }},
      {"split", "boxes", boxes, [](int n) { return worldOf(splitBoxes(twelveBoxes(), n / 12)); }},
      {"rubble", "boxes", boxes, [](int n) { return worldOf(rubble(n)); }},
  };
}

}  // namespace swept::benchmark
