// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace swept::detail {

/// Programs write faces with equal corners where they joined vertices. Such a face is a line or a
/// point, which TriangleMesh::build() drops; nothing is lost where another face has that line for
/// an edge, or that point for a corner. Throws MeshFileError where none has. Indices that are out
/// of range, and coordinates that are not finite, are left to build().
void requireLinesCovered(std::span<const Eigen::Vector3d> vertices,
                         std::span<const Eigen::Vector3i> triangles);

}  // namespace swept::detail
