// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace swept::detail {

/// Triangles over the distinct positions that they use.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< with three distinct corners
  /// Triangles with two or three equal corners that reach beyond the others.
  std::vector<Eigen::Vector3i> lines;
  std::vector<int> keptAs;  ///< per given vertex: its index in `vertices`; -1: no triangle uses it
  int degenerateDropped =
      0;  ///< triangles with two equal corners that do not reach beyond the others
};

/// For each point the index of the first point with equal coordinates (-0.0 equals 0.0), without a
/// tolerance. STL files repeat a vertex of several triangles in equal numbers. A tolerance would
/// close real gaps, and a surface would count as a solid. Open addressing: half the table stays
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

/// The line of a triangle with two equal corners; with equal ends, a point.
struct WeldedLine {
  int least;
  int most;
  auto operator<=>(const WeldedLine&) const = default;
};

/// The line of a triangle, where `first` gives one index to vertices at the same place.
inline Eigen::Vector3i weldedCorners(const Eigen::Vector3i& triangle, std::span<const int> first) {
  return {first[triangle[0]], first[triangle[1]], first[triangle[2]]};
}

inline bool hasDistinctCorners(const Eigen::Vector3i& corners) {
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// The lines that are no edge of a triangle with distinct corners, each once, and the points that
/// are no corner of such a triangle and no end of a line.
inline std::vector<WeldedLine> linesBeyond(std::span<const Eigen::Vector3i> triangles,
                                           std::span<const int> first,
                                           std::vector<WeldedLine> lines) {
  std::ranges::sort(lines);
  lines.erase(std::ranges::unique(lines).begin(), lines.end());
  std::vector<bool> covered(lines.size(), false);
  const auto cover = [&](int a, int b) {
    const WeldedLine line{std::min(a, b), std::max(a, b)};
    const auto at = std::ranges::lower_bound(lines, line);
    if (at != lines.end() && *at == line) {
      covered[static_cast<std::size_t>(at - lines.begin())] = true;
    }
  };
  for (const Eigen::Vector3i& triangle : triangles) {
    const Eigen::Vector3i corners = weldedCorners(triangle, first);
    if (!hasDistinctCorners(corners)) continue;
    for (const int a : corners)
      for (const int b : corners) cover(a, b);
  }
  for (const auto [least, most] : lines) {
    if (least == most) continue;
    cover(least, least);
    cover(most, most);
  }
  std::vector<WeldedLine> beyond;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!covered[i]) beyond.push_back(lines[i]);
  return beyond;
}

/// Indices must be in range and coordinates finite.
///
/// A line is part of the shape as a triangle is: if rounding moves a corner onto another one, the
/// rest of a needle may reach far beyond all other triangles, if the surface is open there.
inline WeldedMesh weld(std::span<const Eigen::Vector3d> vertices,
                       std::span<const Eigen::Vector3i> triangles) {
  constexpr int kUnused = -1;
  std::vector<int> first = firstEqual(vertices);
  std::vector<int> keptIndex(vertices.size(), kUnused);
  WeldedMesh mesh;
  const auto keep = [&](const Eigen::Vector3i& corners) {
    Eigen::Vector3i kept;
    for (int i = 0; i < 3; ++i) {
      int& index = keptIndex[corners[i]];
      if (index == kUnused) {
        index = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(vertices[corners[i]]);
      }
      kept[i] = index;
    }
    return kept;
  };
  std::vector<WeldedLine> lines;
  mesh.triangles.reserve(triangles.size());
  for (const Eigen::Vector3i& triangle : triangles) {
    const Eigen::Vector3i corners = weldedCorners(triangle, first);
    if (hasDistinctCorners(corners)) {
      mesh.triangles.push_back(keep(corners));
    } else {
      lines.push_back({corners.minCoeff(), corners.maxCoeff()});
    }
  }
  if (!lines.empty()) {
    for (const auto [least, most] : linesBeyond(triangles, first, std::move(lines)))
      mesh.lines.push_back(keep({least, most, most}));
  }
  mesh.degenerateDropped =
      static_cast<int>(triangles.size() - mesh.triangles.size() - mesh.lines.size());
  for (int& vertex : first) vertex = keptIndex[vertex];
  mesh.keptAs = std::move(first);
  return mesh;
}

}  // namespace swept::detail
