// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_tree.hpp"

/// An eight-wide tree over triangles, without pointers: triangle, or block, 8 b + l of one level is
/// lane l of block b of the next. Level 0 holds the corners of triangles, the levels above hold
/// boxes; the topmost has a single lane in use. Unused lanes repeat the last used one.
namespace swept::detail {

inline constexpr int kTreeLanes = 8;
/// 8^11 > 2^32.
inline constexpr int kMostTreeLevels = 12;

using TreeRow = std::array<float, kTreeLanes>;

/// Corners of eight triangles, the nearest numbers in single precision.
struct alignas(64) CornerBlock {
  std::array<std::array<TreeRow, 3>, 3> at;  ///< m, [corner][coordinate]
};

/// Vertices of eight triangles, as numbered by the tree.
struct alignas(32) VertexBlock {
  std::array<std::array<std::int32_t, kTreeLanes>, 3> of;  ///< [corner]
};

struct alignas(16) FloatPoint {
  float x, y, z, unused;
};

/// The moving part: one frame.
struct DeformingFrame {
  std::vector<Eigen::Vector3d> vertices;  ///< m, as numbered by the tree
  std::vector<CornerBlock> corners;
  std::array<std::vector<BoxBlock>, kMostTreeLevels> boxes;  ///< none on level 0
  double reach = 0.0;                                        ///< m. No coordinate is larger.
};

/// The constant part: the places of the triangles.
struct TreeOrder {
  std::vector<int> triangleOf;        ///< the caller's number of a triangle of the tree
  std::vector<int> vertexOf;          ///< the caller's number of a vertex of the tree
  std::vector<VertexBlock> vertices;  ///< of each block of level 0
  std::vector<std::uint8_t> marked;   ///< of each block of level 0: bit of each marked triangle
  std::array<std::size_t, kMostTreeLevels> blocks{};  ///< on each level
  int levels = 0;                                     ///< the topmost one has one lane in use

  /// How many blocks, or triangles, lie below a level.
  std::size_t below(int level) const {
    return level == 0 ? triangleOf.size() : blocks[static_cast<std::size_t>(level) - 1];
  }
};

/// For triangles with vertices at these points. `component` names the connected piece of surface
/// that each triangle belongs to, numbered from 0: pieces are kept apart, since they are what moves
/// apart.
TreeOrder arrangeTriangles(std::span<const Eigen::Vector3d> points,
                           std::span<const Eigen::Vector3i> triangles,
                           std::span<const int> component, std::span<const std::uint8_t> marks);

}  // namespace swept::detail
