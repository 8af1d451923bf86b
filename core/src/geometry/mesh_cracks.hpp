// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/mesh_components.hpp"

namespace swept::detail {

/// What closed components that were open.
struct CracksClosed {
  int triangles = 0;     ///< added in cracks
  double largest = 0.0;  ///< m: no point of them is farther from an edge that was open
};

/// Finds the solids among the open components: see TriangleMesh::build(). Their triangles become
/// those of closed components, triangles in cracks are added, and copies of those that bound
/// several. `width` (m): of the cracks that are filled; 0: none. `vertices` (m) are distinct.
///
/// Each solid has the least of a few widths up to `width`: where the mesh has details as small as
/// the cracks that are allowed, its own may be smaller.
CracksClosed closeCracks(std::span<const Eigen::Vector3d> vertices, double width,
                         MeshComponents& parts);

/// Whether this width alone would leave no component open.
bool closesAll(std::span<const Eigen::Vector3d> vertices, double width,
               const MeshComponents& parts);

}  // namespace swept::detail
