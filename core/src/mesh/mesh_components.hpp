// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

/// The connected components of a mesh's triangles, and which of them bound a solid.
///
/// A component is closed if each of its edges has an even number of triangles, and no triangle is a
/// line (two equal corners): a cycle modulo two, for which the parity of a ray's crossings does not
/// depend on the ray. Two shells that touch along an edge (four triangles there) are such a cycle.
///
/// Repeated corner sets need a decision per component. A surface written twice (double-sided, or
/// the same part twice) has parity zero everywhere, so repetitions are dropped if that leaves the
/// component closed. Two shells that share a face repeat it too, and dropping one copy would open
/// both: if only the repetitions close the component, they stay.
namespace swept::detail {

struct MeshComponents {
  std::vector<Eigen::Vector3i> triangles;  ///< without the dropped duplicates
  std::vector<int> componentOf;  ///< per triangle: index of its closed component, -1: open
  /// Per closed component: whether every edge is traversed equally often both ways, so that the
  /// signed number of a ray's crossings does not depend on the ray either.
  std::vector<bool> oriented;
  std::vector<int> cornerOf;  ///< a vertex of each component, open or closed
  int openComponents = 0;
  int duplicatesDropped = 0;
};

class ComponentFinder {
 public:
  explicit ComponentFinder(std::span<const Eigen::Vector3i> triangles)
      : triangles_(triangles),
        root_(triangles.size()),
        repeats_(triangles.size(), false),
        parts_(triangles.size()) {
    std::iota(root_.begin(), root_.end(), 0);
    collectEdges();
    forEachEdge([&](std::span<const HalfEdge> edge) {
      for (const HalfEdge& half : edge) unite(half.triangle, edge.front().triangle);
    });
    findRepetitions();
    forEachEdge([&](std::span<const HalfEdge> edge) { countTriangles(edge); });
    forEachEdge([&](std::span<const HalfEdge> edge) { compareDirections(edge); });
  }

  MeshComponents result() {
    MeshComponents out;
    std::vector<int> closedIndex(triangles_.size(), -1);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const int root = find(static_cast<int>(i));
      Part& part = parts_[root];
      if (!part.counted) {
        part.counted = true;
        out.cornerOf.push_back(triangles_[root][0]);
        if (part.closed()) {
          closedIndex[root] = static_cast<int>(out.oriented.size());
          out.oriented.push_back(part.oriented);
        } else {
          ++out.openComponents;
        }
      }
      if (dropped(static_cast<int>(i))) {
        ++out.duplicatesDropped;
        continue;
      }
      out.triangles.push_back(triangles_[i]);
      out.componentOf.push_back(closedIndex[root]);
    }
    return out;
  }

 private:
  struct HalfEdge {
    std::uint64_t ends;  ///< smaller vertex in the upper half
    int triangle;
    int direction;  ///< +1: from the smaller vertex to the larger
  };

  /// Data of a component, stored at its root triangle.
  struct Part {
    bool evenWithoutRepetitions = true;
    bool evenWithRepetitions = true;
    bool survivesCancelling = false;  ///< some corner set occurs an odd number of times
    bool oriented = true;
    bool counted = false;
    bool keepsRepetitions() const {
      return !evenWithoutRepetitions && evenWithRepetitions && survivesCancelling;
    }
    bool closed() const { return evenWithoutRepetitions || keepsRepetitions(); }
  };

  int find(int triangle) {
    while (root_[triangle] != triangle) {
      root_[triangle] = root_[root_[triangle]];
      triangle = root_[triangle];
    }
    return triangle;
  }
  void unite(int a, int b) {
    const int rootA = find(a);
    const int rootB = find(b);
    root_[std::max(rootA, rootB)] = std::min(rootA, rootB);
  }
  bool dropped(int triangle) {
    return repeats_[triangle] && !parts_[find(triangle)].keepsRepetitions();
  }

  /// Sorted by their ends: one bucket per vertex by counting, and then each small bucket by itself.
  void collectEdges() {
    std::vector<std::size_t> start;
    const auto smaller = [&](const Eigen::Vector3i& triangle, int corner) {
      return static_cast<std::size_t>(std::min(triangle[corner], triangle[(corner + 1) % 3]));
    };
    for (const Eigen::Vector3i& triangle : triangles_) {
      for (int corner = 0; corner < 3; ++corner) {
        const std::size_t bucket = smaller(triangle, corner);
        if (bucket + 2 > start.size()) start.resize(bucket + 2, 0);
        ++start[bucket + 1];
      }
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next = start;
    edges_.resize(triangles_.size() * 3);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        const auto a = static_cast<std::uint32_t>(triangles_[i][corner]);
        const auto b = static_cast<std::uint32_t>(triangles_[i][(corner + 1) % 3]);
        const std::uint64_t ends = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        edges_[next[smaller(triangles_[i], corner)]++] = {ends, static_cast<int>(i),
                                                          a < b ? 1 : -1};
      }
    }
    for (std::size_t bucket = 0; bucket + 1 < start.size(); ++bucket) {
      std::sort(edges_.begin() + static_cast<std::ptrdiff_t>(start[bucket]),
                edges_.begin() + static_cast<std::ptrdiff_t>(start[bucket + 1]),
                [](const HalfEdge& a, const HalfEdge& b) { return a.ends < b.ends; });
    }
  }

  template <typename Visitor>
  void forEachEdge(const Visitor& visit) {
    for (std::size_t first = 0; first < edges_.size();) {
      std::size_t last = first;
      while (last < edges_.size() && edges_[last].ends == edges_[first].ends) ++last;
      visit(std::span<const HalfEdge>(edges_).subspan(first, last - first));
      first = last;
    }
  }

  /// Whether two triangles at an edge have the same third corner. Most meshes have none.
  bool hasRepetitions() {
    const auto third = [&](const HalfEdge& half) {
      const auto ends =
          static_cast<std::uint32_t>(half.ends >> 32) + static_cast<std::uint32_t>(half.ends);
      std::uint32_t sum = 0;
      for (const int corner : triangles_[half.triangle]) sum += static_cast<std::uint32_t>(corner);
      return sum - ends;
    };
    bool found = false;
    forEachEdge([&](std::span<const HalfEdge> edge) {
      // The thorough search compares an edge of many triangles.
      if (edge.size() > 8) found = true;
      for (std::size_t i = 1; i < edge.size() && !found; ++i) {
        for (std::size_t j = 0; j < i; ++j) found = found || third(edge[i]) == third(edge[j]);
      }
    });
    return found;
  }

  void findRepetitions() {
    if (!hasRepetitions()) {
      for (Part& part : parts_) part.survivesCancelling = true;
      return;
    }
    std::vector<Eigen::Vector3i> corners(triangles_.begin(), triangles_.end());
    for (Eigen::Vector3i& set : corners) std::sort(set.begin(), set.end());
    std::vector<int> order(corners.size());
    std::iota(order.begin(), order.end(), 0);
    // Ties by index, so that the first of equal triangles is kept.
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      for (int i = 0; i < 3; ++i) {
        if (corners[a][i] != corners[b][i]) return corners[a][i] < corners[b][i];
      }
      return a < b;
    });
    for (std::size_t first = 0; first < order.size();) {
      std::size_t last = first + 1;
      while (last < order.size() && corners[order[last]] == corners[order[first]]) {
        repeats_[order[last++]] = true;
      }
      if ((last - first) % 2 == 1) parts_[find(order[first])].survivesCancelling = true;
      first = last;
    }
  }

  void countTriangles(std::span<const HalfEdge> edge) {
    const auto distinct = std::count_if(
        edge.begin(), edge.end(), [&](const HalfEdge& half) { return !repeats_[half.triangle]; });
    Part& part = parts_[find(edge.front().triangle)];
    // Lines have each edge twice, and bound nothing.
    const bool isPoint = edge.front().ends >> 32 == (edge.front().ends & 0xFFFFFFFF);
    if (isPoint || distinct % 2 == 1) part.evenWithoutRepetitions = false;
    if (isPoint || edge.size() % 2 == 1) part.evenWithRepetitions = false;
  }

  void compareDirections(std::span<const HalfEdge> edge) {
    int sum = 0;
    for (const HalfEdge& half : edge) sum += dropped(half.triangle) ? 0 : half.direction;
    if (sum != 0) parts_[find(edge.front().triangle)].oriented = false;
  }

  std::span<const Eigen::Vector3i> triangles_;
  std::vector<HalfEdge> edges_;
  std::vector<int> root_;
  std::vector<bool> repeats_;  ///< has the corners of an earlier triangle
  std::vector<Part> parts_;
};

}  // namespace swept::detail
