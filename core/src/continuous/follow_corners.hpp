// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "continuous/deforming_tree.hpp"

namespace swept::detail {

/// The largest magnitude (m) of a coordinate; NaN or infinite if one is not finite.
double largestCoordinate(std::span<const Eigen::Vector3d> points);

/// Surface areas of boxes, summed with the accuracy of single precision.
struct BoxAreas {
  double triangles = 0.0;  ///< m^2
  double nodes = 0.0;      ///< m^2, of the levels above
};

/// A frame is filled in by subtrees: all nodes below one block of this level, or, in a lower tree,
/// of the level below the top. A subtree has 4096 triangles, which fit into a processor's own
/// cache, and a mesh that keeps several processors busy has many subtrees.
inline constexpr int kSubtreeLevel = 3;
inline int subtreeLevel(const TreeOrder& order) {
  return std::min(kSubtreeLevel, order.levels - 2);
}
inline std::size_t subtrees(const TreeOrder& order) {
  return order.blocks[static_cast<std::size_t>(subtreeLevel(order))];
}

/// Fills in the corners of a subtree, from the points of `order`, and the boxes around these
/// corners in single precision, which are off by half a unit in the last place. Several threads may
/// each fill another subtree at once.
BoxAreas followSubtree(const TreeOrder& order, std::span<const FloatPoint> points,
                       std::size_t subtree, DeformingFrame& frame);
/// The boxes above all subtrees, once these are done. Returns their area (m^2).
double followTop(const TreeOrder& order, DeformingFrame& frame);

}  // namespace swept::detail
