// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/surface_features.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "swept/core/triangle_pair.hpp"

namespace swept::detail {

namespace {

/// Surfaces around busier triangles than this are marked without testing each pair: a fan of n
/// triangles has n^2 of them.
constexpr std::size_t kMostNeighbours = 96;

struct EdgeUse {
  std::uint64_t ends;  ///< the smaller vertex in the upper half
  int triangle;
  int corner;
};

std::span<const int> run(const std::vector<int>& first, const std::vector<int>& items, int i) {
  const auto from = static_cast<std::size_t>(first[static_cast<std::size_t>(i)]);
  const auto to = static_cast<std::size_t>(first[static_cast<std::size_t>(i) + 1]);
  return std::span(items).subspan(from, to - from);
}

}  // namespace

SurfaceFeatures::SurfaceFeatures(std::size_t vertices, std::span<const Eigen::Vector3i> triangles)
    : triangles_(triangles.begin(), triangles.end()), marks_(triangles.size(), 0) {
  aroundFirst_.assign(vertices + 1, 0);
  const auto eachVertex = [](const Eigen::Vector3i& t, const auto& visit) {
    for (int k = 0; k < 3; ++k) {
      if ((k < 1 || t[k] != t[0]) && (k < 2 || t[k] != t[1])) visit(static_cast<std::size_t>(t[k]));
    }
  };
  for (const Eigen::Vector3i& t : triangles_)
    eachVertex(t, [this](std::size_t v) { ++aroundFirst_[v + 1]; });
  std::partial_sum(aroundFirst_.begin(), aroundFirst_.end(), aroundFirst_.begin());
  around_.resize(static_cast<std::size_t>(aroundFirst_.back()));
  std::vector<int> next(aroundFirst_.begin(), aroundFirst_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    eachVertex(triangles_[t], [&](std::size_t v) {
      around_[static_cast<std::size_t>(next[v]++)] = static_cast<int>(t);
    });
  }
  findPieces(vertices);
  numberEdges();
  markOrphans(vertices);
}

std::span<const int> SurfaceFeatures::around(int vertex) const {
  return run(aroundFirst_, around_, vertex);
}

std::span<const int> SurfaceFeatures::beside(int edge) const {
  return run(besideFirst_, beside_, edge);
}

void SurfaceFeatures::findPieces(std::size_t vertices) {
  std::vector<int> leader(vertices);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&leader](int v) {
    while (leader[static_cast<std::size_t>(v)] != v) {
      int& up = leader[static_cast<std::size_t>(v)];
      up = leader[static_cast<std::size_t>(up)];
      v = up;
    }
    return v;
  };
  for (const Eigen::Vector3i& t : triangles_) {
    for (int k = 1; k < 3; ++k) leader[static_cast<std::size_t>(find(t[k]))] = find(t[0]);
  }
  std::vector<int> number(vertices, -1);
  int pieces = 0;
  pieces_.reserve(triangles_.size());
  for (const Eigen::Vector3i& t : triangles_) {
    int& piece = number[static_cast<std::size_t>(find(t[0]))];
    if (piece < 0) piece = pieces++;
    pieces_.push_back(piece);
  }
}

void SurfaceFeatures::numberEdges() {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      const std::uint64_t ends =
          static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
      uses.push_back({ends, static_cast<int>(t), k});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle;
  });
  edges_.resize(triangles_.size());
  beside_.reserve(uses.size());
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const EdgeUse& use = uses[i];
    if (i == 0 || uses[i - 1].ends != use.ends)
      besideFirst_.push_back(static_cast<int>(beside_.size()));
    edges_[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.corner)] =
        static_cast<int>(besideFirst_.size()) - 1;
    beside_.push_back(use.triangle);
  }
  besideFirst_.push_back(static_cast<int>(beside_.size()));
  besideFirst_.shrink_to_fit();
}

bool SurfaceFeatures::isOrphan(int vertex, int face) const {
  const std::span<const int> star = around(vertex);
  return std::all_of(star.begin(), star.end(),
                     [this, face](int t) { return shareVertex(triangle(t), triangle(face)); });
}

bool SurfaceFeatures::areOrphans(int edge, int other) const {
  for (const int t : beside(edge)) {
    for (const int u : beside(other)) {
      if (!shareVertex(triangle(t), triangle(u))) return false;
    }
  }
  return true;
}

std::size_t SurfaceFeatures::neighbours(int t) const {
  std::size_t count = 0;
  for (const int v : triangle(t)) count += around(v).size();
  return count;
}

int SurfaceFeatures::leastBusy(std::span<const int> candidates) const {
  return *std::min_element(candidates.begin(), candidates.end(),
                           [this](int t, int u) { return neighbours(t) < neighbours(u); });
}

/// Every triangle of a feature shares a vertex with every triangle of its fellow orphan. So all
/// triangles of the latter are neighbours of any one of the former.
void SurfaceFeatures::markOrphans(std::size_t vertices) {
  const auto mark = [this](std::span<const int> all) {
    for (const int t : all) marks_[static_cast<std::size_t>(t)] = 1;
  };
  std::vector<std::uint8_t> starMarked(vertices, 0);
  // Visits the neighbours of one triangle, or marks them all.
  const auto eachNeighbour = [&](int t, const auto& visit) {
    const bool busy = neighbours(t) > kMostNeighbours;
    for (const int v : triangle(t)) {
      std::uint8_t& done = starMarked[static_cast<std::size_t>(v)];
      if (busy && done == 0) mark(around(v));
      if (busy) done = 1;
      if (!busy) {
        for (const int u : around(v)) visit(u);
      }
    }
  };
  for (int v = 0; v < static_cast<int>(vertices); ++v) {
    if (around(v).empty()) continue;
    eachNeighbour(leastBusy(around(v)), [&](int u) {
      if ((triangle(u).array() == v).any() || !isOrphan(v, u)) return;
      mark(around(v));
      marks_[static_cast<std::size_t>(u)] = 1;
    });
  }
  std::vector<std::array<int, 2>> ends(besideFirst_.size() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k)
      ends[static_cast<std::size_t>(edge(static_cast<int>(t), k))] = {triangles_[t][k],
                                                                      triangles_[t][(k + 1) % 3]};
  }
  for (int e = 0; e < static_cast<int>(ends.size()); ++e) {
    const std::array<int, 2> own = ends[static_cast<std::size_t>(e)];
    eachNeighbour(leastBusy(beside(e)), [&](int u) {
      for (int k = 0; k < 3; ++k) {
        const int f = edge(u, k);
        const std::array<int, 2>& other = ends[static_cast<std::size_t>(f)];
        const bool meet = std::ranges::find_first_of(own, other) != own.end();
        if (f <= e || meet || !areOrphans(e, f)) continue;
        mark(beside(e));
        mark(beside(f));
      }
    });
  }
}

}  // namespace swept::detail
