// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

class CellGrid;
class Crew;

/// The voxels that triangles and points meet, in blocks of 4 x 4 x 4. A cell is an eighth of a
/// block: 2 x 2 x 2 voxels.
class Voxels {
 public:
  /// Bit x + 4 y + 16 z of a block.
  using Mask = std::uint64_t;
  static constexpr Mask kFull = ~Mask{0};

  /// `reach`: m, upper bound on the coordinates of everything that is marked.
  Voxels(const Eigen::Vector3d& origin, double side, const std::array<int, 3>& blocks,
         double reach);

  /// Lemma: every point of the triangle within the grid is in a marked voxel, and so is every point
  /// within rounding of it.
  void mark(const std::array<Eigen::Vector3d, 3>& corners);
  /// The same for the balls of a cloud, on the crew's threads.
  void mark(const PointCloud& cloud, Crew& crew);

  /// Marks the space that closed components enclose, and possibly small pockets between triangles.
  void fill(const TriangleMesh& mesh);

  double side() const { return side_; }                      ///< m, of a voxel
  const Eigen::Vector3d& origin() const { return origin_; }  ///< m
  const std::array<int, 3>& blocks() const { return blocks_; }
  /// Whether the whole block is unmarked.
  bool empty(int x, int y, int z) const { return masks_[blockIndex(x, y, z)] == 0; }
  Mask block(int x, int y, int z) const { return masks_[blockIndex(x, y, z)]; }
  /// Whether a voxel of the cell is marked.
  bool cell(int x, int y, int z) const {
    return (block(x / 2, y / 2, z / 2) & cellMask(x % 2, y % 2, z % 2)) != 0;
  }
  std::size_t blockIndex(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * blocks_[1] + y) * blocks_[0] + x;
  }

 private:
  static constexpr Mask cellMask(int x, int y, int z) {
    return Mask{0x330033} << (2 * x + 8 * y + 32 * z);
  }
  bool voxelsOf(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, Eigen::Array3i& first,
                Eigen::Array3i& last) const;
  void markVoxels(const Eigen::Array3i& first, const Eigen::Array3i& last,
                  const Eigen::Vector3d& normal, const std::array<Eigen::Vector3d, 3>& corners);
  void set(int x, int y, int z);
  class BallMarker;
  Eigen::Vector3d middle(int x, int y, int z) const {
    return origin_ + side_ * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
  }
  void fillCells(const TriangleMesh& mesh, const CellGrid& grid, std::vector<std::uint8_t>& cells);
  void fillBlocks(const CellGrid& grid, const std::vector<std::uint8_t>& cells);
  Mask reached(std::size_t block, const std::vector<Mask>& outside) const;

  Eigen::Vector3d origin_;
  double side_;     ///< m
  double inverse_;  ///< 1/m
  double slack_;    ///< m
  std::array<int, 3> blocks_;
  std::vector<Mask> masks_;           ///< per block
  std::vector<std::size_t> surface_;  ///< blocks that triangles meet
};

}  // namespace swept::detail
