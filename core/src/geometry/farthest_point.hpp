// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace swept::detail {

constexpr std::size_t kPointLanes = 8;  ///< doubles: whole vectors, and two at once

/// The index i < count of the point (x[i], y[i], z[i]) farthest along (dx, dy, dz), up to the
/// rounding of the products: a few ulps of the coordinates. The three lists lie behind each other
/// at `coordinates`, each `count` long: a multiple of kPointLanes.
std::size_t farthestPoint(const double* coordinates, std::size_t count, double dx, double dy,
                          double dz);

}  // namespace swept::detail
