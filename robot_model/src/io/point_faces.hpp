// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace swept::detail {

/// Refuses faces that are points. Programs write faces with equal corners where they joined
/// vertices; such a face is a line or a point. TriangleMesh::build() keeps a corner that no other
/// face has. A line on its own is an obstacle that somebody meant; a point is a mistake. Throws
/// MeshFileError for a face that is a point and no corner of another face. build() treats indices
/// that are out of range, coordinates that are not finite, and meshes in which no face has an area.
void refuseLonePoints(std::span<const Eigen::Vector3d> vertices,
                      std::span<const Eigen::Vector3i> triangles);

}  // namespace swept::detail
