// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace swept::detail {

/// Programs write faces with equal corners where they joined vertices. Such a face is a line or a
/// point; TriangleMesh::build() keeps what no other face has. A line of its own is an obstacle that
/// somebody meant, a point is a mistake: throws MeshFileError for a face that is a point, and no
/// corner of another. Indices that are out of range, coordinates that are not finite, and meshes
/// without any face that has an area are left to build().
void refuseLonePoints(std::span<const Eigen::Vector3d> vertices,
                      std::span<const Eigen::Vector3i> triangles);

}  // namespace swept::detail
