// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/core/bv/aabb.hpp"

namespace swept::detail {

class Crew;

/// Indices of the points along Hilbert's curve through `bounds` (m), which contains them: any run
/// of them is a compact set. Linear in their number, at most 2^30. If many points are in one cell
/// of the curve's grid, they are ordered along a curve through their own box. The threads of the
/// crew share the work; the order does not depend on them.
std::vector<int> curveOrder(std::span<const Eigen::Vector3d> points, const Aabb& bounds,
                            Crew& crew);

}  // namespace swept::detail
