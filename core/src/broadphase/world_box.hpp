// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "bvh/wide_bvh.hpp"
#include "swept/core/bv/aabb.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// How much work a box is worth.
enum class BoxFit {
  Quick,  ///< constant time for meshes and clouds: the box around their own box, rotated
  Tight,  ///< around every vertex or point
};

/// The box that a hierarchy keeps around its content, in the shape's frame: constant time.
struct TreeBox {
  Eigen::Vector3d middle;  ///< m
  Eigen::Vector3d half;    ///< m, rounded outward
};
TreeBox treeBox(const WideBvh& bvh);

/// Box of the placed shape, rounded outward. Infinite for planes and half-spaces; not finite for a
/// non-finite pose.
Aabb worldBox(const Shape& shape, const Eigen::Isometry3d& world_from_shape, BoxFit fit);

}  // namespace swept::detail
