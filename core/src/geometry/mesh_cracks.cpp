// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/mesh_cracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Of an odd number of triangles, run through by more of them from `from` to `to` than back.
struct OpenEdge {
  int from;
  int to;
};

std::vector<OpenEdge> openEdges(const MeshComponents& parts) {
  std::vector<OpenEdge> halves;
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    if (parts.componentOf[i] >= 0) continue;
    const Vector3i& triangle = parts.triangles[i];
    for (int corner = 0; corner < 3; ++corner)
      halves.push_back({triangle[corner], triangle[(corner + 1) % 3]});
  }
  const auto ends = [](const OpenEdge& half) { return std::minmax(half.from, half.to); };
  std::ranges::sort(halves,
                    [&](const OpenEdge& a, const OpenEdge& b) { return ends(a) < ends(b); });
  std::vector<OpenEdge> open;
  for (std::size_t first = 0; first < halves.size();) {
    const OpenEdge edge = halves[first];
    int count = 0;
    int forward = 0;
    for (; first < halves.size() && ends(halves[first]) == ends(edge); ++first, ++count)
      forward += halves[first].from == edge.from ? 1 : -1;
    if (count % 2 == 1)
      open.push_back(forward > 0 ? edge : OpenEdge{.from = edge.to, .to = edge.from});
  }
  return open;
}

/// One of all vertices that are within `width` of it along each axis, for those that are given in
/// turn.
class Meeting {
 public:
  Meeting(std::span<const Vector3d> vertices, double width) : vertices_(vertices), width_(width) {}

  int of(int vertex) {
    const auto [known, isNew] = chosen_.try_emplace(vertex, vertex);
    if (!isNew) return known->second;
    const Cell cell = cellOf(vertices_[vertex]);
    for (int neighbor = 0; neighbor < 27; ++neighbor) {
      const int x = neighbor % 3 - 1, y = neighbor / 3 % 3 - 1, z = neighbor / 9 - 1;
      const Cell at = {cell[0] + x, cell[1] + y, cell[2] + z};
      const auto found = cells_.find(at);
      if (found == cells_.end()) continue;
      for (const int other : found->second) {
        const Vector3d apart = vertices_[other] - vertices_[vertex];
        if (apart.cwiseAbs().maxCoeff() <= width_) return known->second = other;
      }
    }
    cells_[cell].push_back(vertex);
    return vertex;
  }

 private:
  /// In doubles, as no integer holds them all. Where a coordinate has no room for its neighbours,
  /// nothing but equal ones is within the width.
  using Cell = std::array<double, 3>;
  Cell cellOf(const Vector3d& point) const {
    return {std::floor(point.x() / width_), std::floor(point.y() / width_),
            std::floor(point.z() / width_)};
  }

  std::span<const Vector3d> vertices_;
  double width_;
  std::map<int, int> chosen_;
  std::map<Cell, std::vector<int>> cells_;
};

/// Open edges that hang together: by common ends, once those that meet are one.
class Groups {
 public:
  explicit Groups(std::size_t vertices) : root_(vertices) {
    std::iota(root_.begin(), root_.end(), 0);
  }
  int of(int vertex) {
    while (root_[vertex] != vertex) vertex = root_[vertex] = root_[root_[vertex]];
    return vertex;
  }
  void unite(int a, int b) { root_[of(a)] = of(b); }

 private:
  std::vector<int> root_;
};

}  // namespace

std::vector<Vector3i> crackFillings(std::span<const Vector3d> vertices, const MeshComponents& parts,
                                    double width) {
  const std::vector<OpenEdge> open = openEdges(parts);
  Meeting meeting(vertices, width);
  Groups groups(vertices.size());
  std::map<std::pair<int, int>, int> count;  // of open edges that lie on each other
  for (const OpenEdge& edge : open) {
    const std::pair<int, int> ends = std::minmax({meeting.of(edge.from), meeting.of(edge.to)});
    groups.unite(ends.first, ends.second);
    if (ends.first != ends.second) ++count[ends];
  }
  std::vector<bool> isHole(vertices.size(), false);
  for (const auto& [ends, edges] : count)
    if (edges % 2 == 1) isHole[groups.of(ends.first)] = true;

  // From each open edge a strip to where it meets the others. Of each border of a strip there is an
  // even number then: at a vertex as many as open edges, which begin and end there in even number;
  // where the strips arrive as many as edges that lie on each other.
  std::vector<Vector3i> fillings;
  const auto fill = [&](int a, int b, int c) {
    if (a != b && b != c && c != a) fillings.emplace_back(a, b, c);
  };
  for (const auto& [from, to] : open) {
    const int fromMeets = meeting.of(from);
    const int toMeets = meeting.of(to);
    if (isHole[groups.of(fromMeets)]) continue;
    fill(to, from, fromMeets);
    fill(to, fromMeets, toMeets);
  }
  return fillings;
}

}  // namespace swept::detail
