// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swept/core/arithmetic.hpp"

namespace swept::detail {

/// The arrays of a ClearanceGrid, for kernels in SIMD lanes and single precision. ClearanceGrid's
/// own queries do not need them.
///
/// There are two grids of proven lower bounds. Each bounds how far the centres of its cells are
/// from the triangles of a mesh and what it encloses, or from the balls of a cloud. The coarse grid
/// has cells everywhere; the fine one has voxels (half as large) in bricks of 4 x 4 x 4 near the
/// set.
///
/// Lemma 1 (inside the grid): distances are 1-Lipschitz. So for any point p and any cell (or voxel)
/// with centre c and value v, p is at least v - |p - c| away, even if p is not in that cell.
///
/// Lemma 2 (outside): let W be a box that contains the set, and q the point of W nearest to p. Then
/// |p - o|^2 >= |p - q|^2 + |q - o|^2 for every o in W, as W is convex. So p is at least
/// sqrt(|p - q|^2 + d^2) away, with d a bound for q.
///
/// If the grid ends before the set does, everything beyond that face counts as occupied, and W has
/// no such face.
struct ClearanceField {
  Eigen::Vector3d origin;       ///< m, shape's frame: corner of the grid
  float voxel = 0.0F;           ///< m, side of a voxel; of a cell: twice that
  float step = 0.0F;            ///< m, one unit of a cell's value
  float fineStep = 0.0F;        ///< m, one unit of a voxel's value
  std::array<int, 3> blocks{};  ///< per axis; a block has 2 x 2 x 2 cells or 4 x 4 x 4 voxels
  Eigen::Vector3d lower;        ///< m, from the origin; corner of W, infinite where it has no face
  Eigen::Vector3d upper;        ///< m, likewise
  /// Values in steps. Cell i = (z * 2 blocks[1] + y) * 2 blocks[0] + x is byte i % 4, from the
  /// lowest, of word i / 4.
  std::vector<std::uint32_t> cells;
  std::vector<std::int32_t> bricks;  ///< per block: its brick; 0: none
  /// Values in fine steps. Voxel x + 4 y + 16 z of brick b is byte x of word 16 b + y + 4 z.
  std::vector<std::uint32_t> voxels;

  std::size_t bytes() const { return 4 * (cells.size() + bricks.size() + voxels.size()); }
};

}  // namespace swept::detail
