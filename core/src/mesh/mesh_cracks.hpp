// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mesh/mesh_components.hpp"
#include "mesh/open_patches.hpp"

namespace swept::detail {

/// The result of closing open components.
struct CracksClosed {
  int triangles = 0;     ///< added in cracks
  double largest = 0.0;  ///< m: no point of these is farther from an edge that was open
};

/// Finds the solids among the open components: see TriangleMesh::build(). Their triangles become
/// those of closed components; triangles in cracks are added, and so are copies of triangles that
/// bound several solids. `width` (m): of the cracks that are filled; 0: none. `vertices` (m) are
/// distinct.
///
/// Each solid uses the least of a few widths up to `width`: if the mesh has details as small as the
/// allowed cracks, its own cracks may be smaller.
CracksClosed closeCracks(std::span<const Eigen::Vector3d> vertices, double width,
                         MeshComponents& parts);

/// Finds the widths that would leave none of a mesh's open components open.
class OpenParts {
 public:
  /// `vertices` (m) must outlive this.
  OpenParts(std::span<const Eigen::Vector3d> vertices, const MeshComponents& parts);
  /// Whether this width (m) alone would do.
  bool areClosedBy(double width) const;

 private:
  std::span<const Eigen::Vector3d> vertices_;
  OpenPatches patches_;
  std::vector<double> areas_;  ///< m^2, twice that of each patch
};

}  // namespace swept::detail
