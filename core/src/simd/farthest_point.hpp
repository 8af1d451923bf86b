// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace swept::detail {

/// The index i < count of the point (x[i], y[i], z[i]) farthest along (dx, dy, dz), up to the
/// rounding of the products: a few ulps of the coordinates. The three lists lie behind each other
/// at `coordinates`, each `count` long: a multiple of ConvexHull::kLanes.
std::size_t farthestPoint(const double* coordinates, std::size_t count, double dx, double dy,
                          double dz);

}  // namespace swept::detail
