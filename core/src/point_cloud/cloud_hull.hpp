// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "point_cloud/cloud_tree.hpp"
#include "swept/core/convex_hull.hpp"

namespace swept::detail {

/// A convex body that contains the points: their hull if they are few, else one of few vertices
/// that reaches some hundredths of its size beyond them.
ConvexHull cloudHull(std::span<const Eigen::Vector3d> points, const CloudTree& tree);

}  // namespace swept::detail
