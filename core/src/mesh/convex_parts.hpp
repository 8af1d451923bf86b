// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/core/convex_hull.hpp"

namespace swept::detail {

/// Relative to a component's size. Its vertices may pass the planes of its triangles by this, and
/// it still counts as convex: what the rounding of coordinates does to the faces of a polyhedron.
inline constexpr double kConvexPart = 1e-12;

/// The closed, consistently oriented components that are convex solids, as hulls. `componentOf`:
/// index of each triangle's closed component, -1 for open ones. A component too large to be checked
/// against the planes of all its triangles at moderate cost is left out.
std::vector<ConvexHull> convexParts(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const Eigen::Vector3i> triangles,
                                    std::span<const int> componentOf,
                                    const std::vector<bool>& oriented);

}  // namespace swept::detail
