// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swept::detail {

/// A step of a patch's border: an odd number of the patch's triangles has it, and more of them run
/// through it from `from` to `to` than back.
struct OpenEdge {
  int from;
  int to;
  int patch;
};

/// Triangles that are connected over edges of exactly two triangles. Patches end where another
/// number meets: at the border of a surface, where a sheet touches a solid, or where two solids
/// touch. A solid is bounded by some of the patches, each as a whole.
struct OpenPatches {
  std::vector<int> patchOf;  ///< per triangle
  int count = 0;
  std::vector<OpenEdge> edges;  ///< with the same two ends at most once per patch
};

/// Takes the time of sorting.
OpenPatches openPatches(std::span<const Eigen::Vector3i> triangles);

/// Whether each edge is traversed equally often both ways.
bool isOriented(std::span<const Eigen::Vector3i> triangles);

}  // namespace swept::detail
