// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace swept::detail {

/// Triangles over the distinct positions that they use.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> keptAs;  ///< per given vertex: its index in `vertices`; -1: no triangle uses it
  int degenerateDropped = 0;  ///< triangles with two equal corners
};

/// For each point the index of the first point with equal coordinates (-0.0 equals 0.0). Without a
/// tolerance: STL files repeat a vertex of several triangles in equal numbers, and one would close
/// real gaps, so that a surface would be taken for a solid. Open addressing: half the table stays
/// empty, so probes are short.
inline std::vector<int> firstEqual(std::span<const Eigen::Vector3d> points) {
  constexpr int kFree = -1;
  const std::size_t size = std::bit_ceil(2 * points.size() + 1);
  std::vector<int> table(size, kFree);
  std::vector<int> first(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t hash = 0;
    for (double coordinate : points[i]) {
      // Adding zero turns -0.0 into 0.0, whose bits differ.
      hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (size - 1);
    while (table[slot] != kFree && points[table[slot]] != points[i]) slot = (slot + 1) & (size - 1);
    if (table[slot] == kFree) table[slot] = static_cast<int>(i);
    first[i] = table[slot];
  }
  return first;
}

/// Indices must be in range and coordinates finite.
inline WeldedMesh weld(std::span<const Eigen::Vector3d> vertices,
                       std::span<const Eigen::Vector3i> triangles) {
  constexpr int kUnused = -1;
  std::vector<int> first = firstEqual(vertices);
  std::vector<int> keptIndex(vertices.size(), kUnused);
  WeldedMesh mesh;
  mesh.triangles.reserve(triangles.size());
  for (const Eigen::Vector3i& triangle : triangles) {
    const Eigen::Vector3i corners(first[triangle[0]], first[triangle[1]], first[triangle[2]]);
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      ++mesh.degenerateDropped;
      continue;
    }
    Eigen::Vector3i kept;
    for (int i = 0; i < 3; ++i) {
      int& index = keptIndex[corners[i]];
      if (index == kUnused) {
        index = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(vertices[corners[i]]);
      }
      kept[i] = index;
    }
    mesh.triangles.push_back(kept);
  }
  for (int& vertex : first) vertex = keptIndex[vertex];
  mesh.keptAs = std::move(first);
  return mesh;
}

}  // namespace swept::detail
