// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_cracks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "mesh/crack_paths.hpp"
#include "mesh/patch_cycles.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Triangles between an edge and its path. The path is halved repeatedly, so that few of them are
/// long.
void fill(std::span<const int> path, std::vector<Vector3i>& triangles) {
  if (path.size() < 3) return;
  const std::size_t middle = path.size() / 2;
  triangles.emplace_back(path.back(), path.front(), path[middle]);
  fill(path.first(middle + 1), triangles);
  fill(path.subspan(middle), triangles);
}

std::vector<double> areasOf(std::span<const Vector3d> vertices, std::span<const Vector3i> triangles,
                            const OpenPatches& patches) {
  std::vector<double> areas(static_cast<std::size_t>(patches.count), 0.0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vector3d& a = vertices[triangles[i][0]];
    const Vector3d normal = (vertices[triangles[i][1]] - a).cross(vertices[triangles[i][2]] - a);
    areas[patches.patchOf[i]] += normal.norm();
  }
  return areas;
}

/// The patches around each solid.
std::vector<std::vector<int>> solidsOf(std::span<const OpenEdge> edges,
                                       std::span<const double> areas, CrackPaths& paths) {
  // Cap on memory: reached only if very many edges lie along each other.
  constexpr std::size_t kMostSteps = std::size_t{1} << 26;
  std::vector<PatchStep> steps;
  for (const OpenEdge& edge : edges) {
    const std::vector<int>& path = paths.between(edge);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const auto [least, most] = std::minmax(path[i], path[i + 1]);
      steps.push_back({{least, most}, edge.patch});
    }
    if (steps.size() > kMostSteps) return {};
  }
  return patchCycles(std::move(steps), areas);
}

/// Whether some corners belong to an odd number of triangles. If not, the triangles lie on each
/// other: a sheet that is narrower than a crack.
bool hasSides(std::vector<Vector3i> triangles) {
  for (Vector3i& corners : triangles) std::sort(corners.begin(), corners.end());
  std::ranges::sort(triangles, [](const Vector3i& a, const Vector3i& b) {
    return std::ranges::lexicographical_compare(a, b);
  });
  for (std::size_t first = 0; first < triangles.size();) {
    std::size_t last = first;
    while (last < triangles.size() && triangles[last] == triangles[first]) ++last;
    if ((last - first) % 2 == 1) return true;
    first = last;
  }
  return false;
}

/// Makes components of the open triangles of a mesh.
class Closing {
 public:
  Closing(std::span<const Vector3d> vertices, MeshComponents& parts)
      : vertices_(vertices), parts_(parts) {
    MeshComponents closed;
    closed.oriented = parts.oriented;
    closed.duplicatesDropped = parts.duplicatesDropped;
    std::vector<bool> hasCorner(parts.oriented.size(), false);
    for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
      const int component = parts.componentOf[i];
      if (component < 0) {
        open_.push_back(parts.triangles[i]);
        continue;
      }
      closed.triangles.push_back(parts.triangles[i]);
      closed.componentOf.push_back(component);
      if (!hasCorner[component]) closed.cornerOf.push_back(parts.triangles[i][0]);
      hasCorner[component] = true;
    }
    parts = std::move(closed);
    patches_ = openPatches(open_);
    isClosed_.assign(static_cast<std::size_t>(patches_.count), false);
    trianglesOf_.resize(isClosed_.size());
    for (std::size_t i = 0; i < open_.size(); ++i)
      trianglesOf_[patches_.patchOf[i]].push_back(open_[i]);
    edgesOf_.resize(isClosed_.size());
    for (const OpenEdge& edge : patches_.edges) edgesOf_[edge.patch].push_back(edge);
  }

  bool isDone() const { return std::ranges::find(isClosed_, false) == isClosed_.end(); }

  /// With the patches that are still open; `all`: also with the others, as some may share a wall
  /// with solids that are closed.
  void close(double width, bool all, CracksClosed& done) {
    if (isDone()) return;
    std::vector<OpenEdge> edges;
    for (const OpenEdge& edge : patches_.edges)
      if (all || !isClosed_[edge.patch]) edges.push_back(edge);
    CrackPaths paths(vertices_, edges, width);
    for (const std::vector<int>& solid : solidsOf(edges, areas(), paths)) {
      // Closed patches have no edges here, and are solids of their own.
      if (std::ranges::all_of(solid, [&](int patch) { return isClosed_[patch]; })) continue;
      std::vector<Vector3i> triangles;
      for (const int patch : solid)
        triangles.insert(triangles.end(), trianglesOf_[patch].begin(), trianglesOf_[patch].end());
      const std::size_t given = triangles.size();
      double largest = 0.0;
      for (const int patch : solid) {
        for (const OpenEdge& edge : edgesOf_[patch]) {
          const std::vector<int>& path = paths.of(edge);
          fill(path, triangles);
          // The distance to a segment is convex: the farthest point of a triangle is a corner.
          for (const int vertex : path)
            largest = std::max(largest, distanceToSegment(vertices_[vertex], vertices_[edge.from],
                                                          vertices_[edge.to]));
        }
      }
      if (!hasSides(triangles)) continue;
      done.triangles += static_cast<int>(triangles.size() - given);
      done.largest = std::max(done.largest, largest);
      closed_.insert(closed_.end(), solid.begin(), solid.end());
      add(triangles);
    }
    for (const int patch : closed_) isClosed_[patch] = true;
  }

  /// The rest.
  void addOpen() {
    std::vector<Vector3i> left;
    for (std::size_t i = 0; i < open_.size(); ++i)
      if (!isClosed_[patches_.patchOf[i]]) left.push_back(open_[i]);
    if (left.empty()) return;
    const std::vector<int> corners = ComponentFinder(left).result().cornerOf;
    parts_.triangles.insert(parts_.triangles.end(), left.begin(), left.end());
    parts_.componentOf.resize(parts_.triangles.size(), -1);
    parts_.cornerOf.insert(parts_.cornerOf.end(), corners.begin(), corners.end());
    parts_.openComponents = static_cast<int>(corners.size());
  }

 private:
  std::vector<double> areas() const { return areasOf(vertices_, open_, patches_); }

  void add(std::span<const Vector3i> triangles) {
    parts_.triangles.insert(parts_.triangles.end(), triangles.begin(), triangles.end());
    parts_.componentOf.resize(parts_.triangles.size(), static_cast<int>(parts_.oriented.size()));
    parts_.oriented.push_back(isOriented(triangles));
    parts_.cornerOf.push_back(triangles.front()[0]);
  }

  std::span<const Vector3d> vertices_;
  MeshComponents& parts_;
  std::vector<Vector3i> open_;  ///< at first
  OpenPatches patches_;         ///< of those
  std::vector<std::vector<Vector3i>> trianglesOf_;
  std::vector<std::vector<OpenEdge>> edgesOf_;
  std::vector<bool> isClosed_;
  std::vector<int> closed_;
};

}  // namespace

CracksClosed closeCracks(std::span<const Vector3d> vertices, double width, MeshComponents& parts) {
  CracksClosed done;
  Closing closing(vertices, parts);
  closing.close(0.0, false, done);
  for (const double share : {1.0 / 1024.0, 1.0 / 32.0, 1.0})
    if (share * width > 0.0) closing.close(share * width, false, done);
  closing.close(width, true, done);
  closing.addOpen();
  return done;
}

OpenParts::OpenParts(std::span<const Vector3d> vertices, const MeshComponents& parts)
    : vertices_(vertices) {
  std::vector<Vector3i> open;
  for (std::size_t i = 0; i < parts.triangles.size(); ++i)
    if (parts.componentOf[i] < 0) open.push_back(parts.triangles[i]);
  patches_ = openPatches(open);
  areas_ = areasOf(vertices, open, patches_);
}

bool OpenParts::areClosedBy(double width) const {
  CrackPaths paths(vertices_, patches_.edges, width);
  std::vector<bool> isClosed(static_cast<std::size_t>(patches_.count), false);
  for (const std::vector<int>& solid : solidsOf(patches_.edges, areas_, paths))
    for (const int patch : solid) isClosed[patch] = true;
  return std::ranges::find(isClosed, false) == isClosed.end();
}

}  // namespace swept::detail
