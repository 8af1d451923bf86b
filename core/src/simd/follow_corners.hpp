// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "continuous/deforming_tree.hpp"

namespace swept::detail {

/// The largest magnitude (m) of a coordinate; NaN or infinite if one is not finite.
double largestCoordinate(std::span<const Eigen::Vector3d> points);

/// Surface areas of boxes, added up, as far as single precision tells.
struct BoxAreas {
  double triangles = 0.0;  ///< m^2
  double nodes = 0.0;      ///< m^2, of all levels above
};

/// Fills in the corners of a frame, from the points of `order`, and the boxes around them, as large
/// as the corners in single precision say: they are off by half a unit in the last place.
BoxAreas followCorners(const TreeOrder& order, std::span<const FloatPoint> points,
                       DeformingFrame& frame);

}  // namespace swept::detail
