// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// The centre (m, cloud's frame) of a ball of the cloud that a closed component of the mesh
/// encloses; none if there is no such ball.
std::optional<Eigen::Vector3d> enclosedPoint(const TriangleMesh& mesh, const PointCloud& cloud,
                                             const Eigen::Isometry3d& mesh_from_cloud);

}  // namespace swept::detail
