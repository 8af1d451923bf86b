// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swept::detail {

/// Of a patch an odd number of triangles has it, and more of them run through it from `from` to
/// `to` than back.
struct OpenEdge {
  int from;
  int to;
  int patch;
};

/// Triangles that hang together over edges of just two triangles. Where another number meets, at
/// the border of a surface, where a sheet touches a solid or two solids touch, patches end: what
/// bounds a solid is some of them, and all of each.
struct OpenPatches {
  std::vector<int> patchOf;  ///< per triangle
  int count = 0;
  std::vector<OpenEdge> edges;  ///< with two ends at most once a patch
};

/// Takes the time of sorting.
OpenPatches openPatches(std::span<const Eigen::Vector3i> triangles);

/// Whether each edge is run through equally often both ways.
bool isOriented(std::span<const Eigen::Vector3i> triangles);

}  // namespace swept::detail
