// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/core/convex_hull.hpp"

namespace swept::detail {

/// Relative to a component's size. A component counts as convex if its vertices pass the planes of
/// its triangles by at most this, as rounded coordinates of a polyhedron do.
inline constexpr double kConvexPart = 1e-12;

/// The closed, consistently oriented components that are convex solids, as hulls. `componentOf`:
/// index of each triangle's closed component, -1 for open ones. A component is left out if it is
/// too large to be tested against the planes of all its triangles at moderate cost.
std::vector<ConvexHull> convexParts(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const Eigen::Vector3i> triangles,
                                    std::span<const int> componentOf,
                                    const std::vector<bool>& oriented);

}  // namespace swept::detail
