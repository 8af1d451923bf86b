// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace swept::detail {

/// Programs write faces with equal corners where they joined vertices. Such a face is a line or a
/// point, which TriangleMesh::build() drops; nothing is lost where another face has that line for
/// an edge, or that point for a corner. A line that none has gets a face without area, with its
/// middle for a third corner. Throws MeshFileError for a point that none has. Indices that are out
/// of range, and coordinates that are not finite, are left to build().
void keepLines(std::vector<Eigen::Vector3d>& vertices, std::vector<Eigen::Vector3i>& triangles);

}  // namespace swept::detail
