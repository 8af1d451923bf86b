// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swept/core/arithmetic.hpp"

namespace swept::detail {

/// What a ClearanceGrid reads, for kernels of another kind: SIMD lanes, single precision. Its own
/// queries need none of this.
///
/// Two grids of proven lower bounds on how far the middles of their cells are from the triangles of
/// a mesh and what it encloses, or from the balls of a cloud: one of cells everywhere, one of
/// voxels (half as large) in bricks of 4 x 4 x 4 near the set.
///
/// Lemma 1 (inside the grid): distances are 1-Lipschitz, so for any point p and any cell (or voxel)
/// with middle c and value v, p is at least v - |p - c| away. That p is in this cell is not needed.
///
/// Lemma 2 (outside): let W be a box that contains the set, and q the point of W nearest to p. Then
/// |p - o|^2 >= |p - q|^2 + |q - o|^2 for every o in W, as W is convex. So p is at least
/// sqrt(|p - q|^2 + d^2) away, with d a bound for q.
///
/// Where the grid ends before the set does, everything beyond that face counts as occupied, and W
/// has no such face.
struct ClearanceField {
  Eigen::Vector3d origin;       ///< m, shape's frame: corner of the grid
  float voxel = 0.0F;           ///< m, side of a voxel; of a cell: twice that
  float step = 0.0F;            ///< m, what one unit of a cell's value stands for
  float fineStep = 0.0F;        ///< m, of a voxel's
  std::array<int, 3> blocks{};  ///< along each axis, of 2 x 2 x 2 cells or 4 x 4 x 4 voxels
  Eigen::Vector3d lower;        ///< m, from the origin; corners of W, infinite where it has no face
  Eigen::Vector3d upper;        ///< m
  /// In steps, of cell i = (z * 2 blocks[1] + y) * 2 blocks[0] + x: byte i % 4 of word i / 4, from
  /// the lowest.
  std::vector<std::uint32_t> cells;
  std::vector<std::int32_t> bricks;  ///< per block; brick 0 says nothing
  /// In fine steps, of voxel x + 4 y + 16 z of brick b: byte x of word 16 b + y + 4 z.
  std::vector<std::uint32_t> voxels;

  std::size_t bytes() const { return 4 * (cells.size() + bricks.size() + voxels.size()); }
};

}  // namespace swept::detail
