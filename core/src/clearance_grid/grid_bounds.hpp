// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace swept::detail {

/// A ClearanceField in the form that queries in double precision read.
struct GridView {
  std::array<double, 3> origin;  ///< m
  std::array<double, 3> lower;   ///< m, from the origin, of W
  std::array<double, 3> upper;   ///< m
  std::array<double, 3> last;    ///< voxel along each axis
  double voxel;                  ///< m
  double inverse;                ///< 1/m, of the voxel
  double cellSteps;              ///< m
  double voxelSteps;             ///< m
  double halfDiagonal;           ///< m, of a voxel, and a bit more
  double rounding;               ///< m, of what does not depend on the point
  double relativeRounding;       ///< of the point's 1-norm
  double cellRow;                ///< cells
  double cellLayer;              ///< cells
  double blockRow;               ///< blocks
  double blockLayer;             ///< blocks
  const std::uint32_t* cells;
  const std::int32_t* bricks;
  const std::uint32_t* voxels;
};

/// The number of points per call.
inline constexpr std::size_t kGridLanes = 8;

/// The results of ClearanceGrid::clearance() for eight points, whose coordinates (m) are stored one
/// after the other, bit for bit. No point is far or NaN.
void gridBounds(const GridView& grid, const double* points, double* bounds);

}  // namespace swept::detail
