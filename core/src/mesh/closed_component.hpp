// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "bvh/wide_bvh.hpp"
#include "swept/core/bv/aabb.hpp"

namespace swept::detail {

/// A closed component of a mesh, with its own tree.
struct ClosedComponent {
  std::span<const Eigen::Vector3d> vertices;   ///< m
  std::span<const Eigen::Vector3i> triangles;  ///< in the order of the tree's leaves
  const WideBvh& bvh;
  Aabb box;       ///< m, of the triangles
  bool oriented;  ///< its winding number is defined
};

/// Like TriangleMesh::encloses(), for this component alone. In the default floating-point
/// environment.
bool encloses(const ClosedComponent& component, const Eigen::Vector3d& point);

}  // namespace swept::detail
