// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/world.hpp"
#include "timing.hpp"
#include "workloads.hpp"

/// Twelve boxes around an arm, and the same points of space as many boxes, a mesh and a cloud.
namespace swept::benchmark {

struct PlacedBox {
  Eigen::Vector3d size;  ///< m
  Eigen::Isometry3d world_from_box;

  PlacedBox(const Eigen::Vector3d& extents, const Eigen::Vector3d& center, double turn)
      : size(extents), world_from_box(Eigen::Translation3d(center)) {
    // Not about a coordinate axis: a turned box is a box in general position.
    world_from_box.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d(0.3, 0.2, 1.0).normalized()));
  }
};

/// A table with things on it, a shelf, a wall, a post and a beam, for an arm of 1.2 m at the
/// origin.
inline std::vector<PlacedBox> twelveBoxes() {
  return {
      {{0.8, 1.2, 0.04}, {0.85, 0.0, -0.05}, 0.0},  {{0.05, 0.05, 0.6}, {0.5, 0.55, -0.4}, 0.0},
      {{0.05, 0.05, 0.6}, {0.5, -0.55, -0.4}, 0.0}, {{0.05, 0.05, 0.6}, {1.2, 0.55, -0.4}, 0.0},
      {{0.05, 0.05, 0.6}, {1.2, -0.55, -0.4}, 0.0}, {{0.04, 1.0, 0.8}, {-0.7, 0.0, 0.5}, 0.0},
      {{0.6, 0.3, 0.03}, {0.1, 0.8, 0.3}, 0.1},     {{0.6, 0.3, 0.03}, {0.1, 0.8, 0.7}, 0.1},
      {{0.08, 0.08, 1.0}, {0.35, -0.65, 0.4}, 0.0}, {{0.7, 0.06, 0.06}, {0.3, -0.2, 1.05}, 0.5},
      {{0.2, 0.2, 0.2}, {0.75, 0.2, 0.1}, 0.4},     {{0.12, 0.16, 0.3}, {0.6, -0.3, 0.15}, -0.3}};
}

inline World worldOf(const std::vector<PlacedBox>& boxes,
                     const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  World world;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    world.add("box" + std::to_string(i), makeBox(boxes[i].size),
              Eigen::Translation3d(shift) * boxes[i].world_from_box);
  return world;
}

/// Along each axis, of parts no longer than `side` (m).
inline Eigen::Vector3i partsOf(const Eigen::Vector3d& size, double side) {
  return (size / side).array().ceil().cast<int>();
}

/// Each box cut into about `parts` smaller ones, side by side.
inline std::vector<PlacedBox> splitBoxes(const std::vector<PlacedBox>& boxes, int parts) {
  std::vector<PlacedBox> small;
  for (const PlacedBox& box : boxes) {
    const Eigen::Vector3i n = partsOf(box.size, std::cbrt(box.size.prod() / parts));
    const Eigen::Vector3d size = box.size.cwiseQuotient(n.cast<double>());
    for (int i = 0; i < n.prod(); ++i) {
      const int x = i % n.x(), y = i / n.x() % n.y(), z = i / (n.x() * n.y());
      const Eigen::Vector3d index(x, y, z);
      PlacedBox part = box;
      part.size = size;
      part.world_from_box.translate(
          Eigen::Vector3d(size.cwiseProduct(index) + 0.5 * (size - box.size)));
      small.push_back(part);
    }
  }
  return small;
}

/// Calls `face(point, m, n)` for the six sides of a box: point(u, v) with u and v in [0, 1], to be
/// divided into m by n. Neighbouring sides divide their common edge alike, to the last bit.
template <typename Face>
void eachFace(const Eigen::Vector3d& size, const Eigen::Vector3i& parts, const Face& face) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const int first = side > 0.0 ? (axis + 1) % 3 : (axis + 2) % 3, second = 3 - axis - first;
      face(
          [=](double u, double v) {
            Eigen::Vector3d p;
            p[axis] = 0.5 * side * size[axis];
            p[first] = size[first] * (u - 0.5);
            p[second] = size[second] * (v - 0.5);
            return p;
          },
          parts[first], parts[second]);
    }
  }
}

inline double surfaceArea(const Eigen::Vector3d& size) {
  return 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

/// m. The surfaces of all boxes hold about `count` squares of this side.
inline double squareSide(const std::vector<PlacedBox>& boxes, double count) {
  double area = 0.0;
  for (const PlacedBox& box : boxes) area += surfaceArea(box.size);
  return std::sqrt(area / count);
}

/// One mesh of closed parts, about `triangles` in all.
inline TriangleMesh meshOf(const std::vector<PlacedBox>& boxes, int triangles) {
  const double side = squareSide(boxes, 0.5 * triangles);
  Soup soup;
  for (const PlacedBox& box : boxes) {
    eachFace(box.size, partsOf(box.size, side), [&](const auto& point, int m, int n) {
      const auto offset = static_cast<int>(soup.vertices.size());
      const Soup part = grid(m, n, false, false, [&](double u, double v) {
        return Eigen::Vector3d(box.world_from_box * point(u, v));
      });
      soup.vertices.insert(soup.vertices.end(), part.vertices.begin(), part.vertices.end());
      for (const Eigen::Vector3i& t : part.triangles)
        soup.triangles.emplace_back(t.array() + offset);
    });
  }
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

/// About `count` points on the surfaces, each a ball that touches its surface from within; so dense
/// that the balls of neighbours overlap.
inline PointCloud cloudOf(const std::vector<PlacedBox>& boxes, int count) {
  const double side = squareSide(boxes, count), radius = 0.75 * side;
  std::vector<Eigen::Vector3d> points;
  for (const PlacedBox& box : boxes) {
    const Eigen::Vector3d inner = box.size.array() - 2.0 * radius;
    eachFace(inner, partsOf(inner, side), [&](const auto& point, int m, int n) {
      const Soup part = grid(m, n, false, false, [&](double u, double v) {
        return Eigen::Vector3d(box.world_from_box * point(u, v));
      });
      points.insert(points.end(), part.vertices.begin(), part.vertices.end());
    });
  }
  return PointCloud::build(points, radius);
}

struct NamedWorld {
  std::string name;
  std::shared_ptr<const World> world;
  double megabytes = 0.0;  ///< of its shapes
};

/// The twelve boxes; cut into more than a thousand; their surfaces as one mesh, and as a cloud.
inline std::vector<NamedWorld> worldsOfOneSpace() {
  const std::vector<PlacedBox> boxes = twelveBoxes(), small = splitBoxes(boxes, 100);
  std::vector<NamedWorld> worlds;
  const auto add = [&](const auto& make) {
    const double before = heapBytes();
    NamedWorld named;
    auto world = std::make_shared<World>();
    named.name = make(*world);
    named.world = std::move(world);
    named.megabytes = 1e-6 * (heapBytes() - before);
    worlds.push_back(std::move(named));
  };
  const auto addBoxes = [&](const std::vector<PlacedBox>& some) {
    add([&](World& world) {
      world = worldOf(some);
      return std::to_string(some.size()) + " boxes";
    });
  };
  addBoxes(boxes);
  addBoxes(small);
  add([&](World& world) {
    const TriangleMesh mesh = meshOf(boxes, 100'000);
    world.add("mesh", mesh, Eigen::Isometry3d::Identity());
    return "mesh of " + std::to_string(mesh.triangles().size()) + " triangles";
  });
  add([&](World& world) {
    const PointCloud cloud = cloudOf(boxes, 100'000);
    world.add("cloud", cloud, Eigen::Isometry3d::Identity());
    return "cloud of " + std::to_string(cloud.points().size()) + " points";
  });
  return worlds;
}

}  // namespace swept::benchmark
