// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mesh/mesh_components.hpp"
#include "mesh/open_patches.hpp"

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

/// Of the open components of a mesh: which widths would leave none of them open.
class OpenParts {
 public:
  /// `vertices` (m) have to outlive this.
  OpenParts(std::span<const Eigen::Vector3d> vertices, const MeshComponents& parts);
  /// Whether this width (m) alone would do.
  bool areClosedBy(double width) const;

 private:
  std::span<const Eigen::Vector3d> vertices_;
  OpenPatches patches_;
  std::vector<double> areas_;  ///< m^2, twice that of each patch
};

}  // namespace swept::detail
