// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/open_patches.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace swept::detail {
namespace {

struct HalfEdge {
  std::uint64_t ends;  ///< smaller vertex in the upper half
  int triangle;
  bool rises;  ///< from the smaller vertex to the larger
};

/// Sorted by their ends.
std::vector<HalfEdge> halfEdges(std::span<const Eigen::Vector3i> triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto from = static_cast<std::uint32_t>(triangles[i][corner]);
      const auto to = static_cast<std::uint32_t>(triangles[i][(corner + 1) % 3]);
      halves.push_back({std::uint64_t{std::min(from, to)} << 32 | std::max(from, to),
                        static_cast<int>(i), from < to});
    }
  }
  std::ranges::sort(halves, {}, &HalfEdge::ends);
  return halves;
}

template <typename Visitor>
void forEachEdge(std::span<HalfEdge> halves, const Visitor& visit) {
  for (std::size_t first = 0; first < halves.size();) {
    std::size_t last = first + 1;
    while (last < halves.size() && halves[last].ends == halves[first].ends) ++last;
    visit(halves.subspan(first, last - first));
    first = last;
  }
}

}  // namespace

OpenPatches openPatches(std::span<const Eigen::Vector3i> triangles) {
  std::vector<HalfEdge> halves = halfEdges(triangles);
  std::vector<int> root(triangles.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int triangle) {
    while (root[triangle] != triangle) triangle = root[triangle] = root[root[triangle]];
    return triangle;
  };
  forEachEdge(halves, [&](std::span<HalfEdge> edge) {
    if (edge.size() == 2) root[find(edge[0].triangle)] = find(edge[1].triangle);
  });
  OpenPatches patches;
  std::vector<int> number(triangles.size(), -1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    int& known = number[find(static_cast<int>(i))];
    if (known < 0) known = patches.count++;
    patches.patchOf.push_back(known);
  }
  forEachEdge(halves, [&](std::span<HalfEdge> edge) {
    if (edge.size() == 2) return;
    std::ranges::sort(edge, {},
                      [&](const HalfEdge& half) { return patches.patchOf[half.triangle]; });
    for (std::size_t first = 0; first < edge.size();) {
      const int patch = patches.patchOf[edge[first].triangle];
      int count = 0;
      int rising = 0;
      for (; first < edge.size() && patches.patchOf[edge[first].triangle] == patch; ++first) {
        ++count;
        rising += edge[first].rises ? 1 : -1;
      }
      if (count % 2 == 0) continue;
      const int least = static_cast<int>(edge.front().ends >> 32);
      const int most = static_cast<int>(edge.front().ends & 0xFFFFFFFF);
      patches.edges.push_back(rising > 0 ? OpenEdge{least, most, patch}
                                         : OpenEdge{most, least, patch});
    }
  });
  return patches;
}

bool isOriented(std::span<const Eigen::Vector3i> triangles) {
  std::vector<HalfEdge> halves = halfEdges(triangles);
  bool oriented = true;
  forEachEdge(halves, [&](std::span<HalfEdge> edge) {
    const auto rising = std::ranges::count_if(edge, &HalfEdge::rises);
    oriented = oriented && 2 * static_cast<std::size_t>(rising) == edge.size();
  });
  return oriented;
}

}  // namespace swept::detail
