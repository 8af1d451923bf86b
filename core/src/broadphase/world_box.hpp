// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// How much work a box is worth.
enum class BoxFit {
  Quick,  ///< constant time for meshes: the box around their own box, turned
  Tight,  ///< of every vertex
};

/// A box around the mesh in its own frame, from its hierarchy: constant time.
struct MeshBox {
  Eigen::Vector3d middle;  ///< m
  Eigen::Vector3d half;    ///< m, rounded outward
};
MeshBox meshBox(const TriangleMesh& mesh);

/// Box of the placed shape, rounded outward. Infinite for planes and half-spaces; a pose that is
/// not finite gives a box that is not.
Aabb worldBox(const Shape& shape, const Eigen::Isometry3d& world_from_shape, BoxFit fit);

}  // namespace swept::detail
