// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "simd/compile/obstacles.hpp"

namespace swept::detail {

/// A tree over the boxes of all geometries; [0] is the root; empty without geometries. `reach` (m)
/// and `extras`: as for compileObstacles.
std::vector<SimdWorldNode> buildObstacleTree(const std::vector<WorldGeometry>& world, double reach,
                                             std::span<const float> extras);

}  // namespace swept::detail
