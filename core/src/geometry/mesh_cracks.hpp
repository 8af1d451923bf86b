// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/mesh_components.hpp"

namespace swept::detail {

/// Triangles between vertices of open components that close their cracks: see
/// TriangleMesh::build(). `parts`: of triangles over `vertices`, which are distinct (m). `width`
/// (m): positive.
std::vector<Eigen::Vector3i> crackFillings(std::span<const Eigen::Vector3d> vertices,
                                           const MeshComponents& parts, double width);

}  // namespace swept::detail
