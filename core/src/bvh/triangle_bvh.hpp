// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swept::detail {

/// Binary tree of axis-aligned boxes over triangles, in depth-first order: the left child of node i
/// is i + 1.
class TriangleBvh {
 public:
  /// depth() never exceeds this, so a traversal's stack may be an array.
  static constexpr int kMaxDepth = 64;
  static constexpr int kMaxLeafTriangles = 2;

  struct Node {
    Eigen::Vector3d center;       ///< m, mesh frame
    Eigen::Vector3d halfExtents;  ///< m, rounded outward
    int rightChild;               ///< -1: a leaf
    int firstTriangle;            ///< the subtree's triangles are contiguous
    int triangleCount;
  };

  /// Reorders `triangles` (and `componentOf` alike) into leaf order. At least one and at most 2^30
  /// triangles; `vertices` are finite.
  static TriangleBvh build(std::span<const Eigen::Vector3d> vertices,
                           std::vector<Eigen::Vector3i>& triangles, std::vector<int>& componentOf);

  const std::vector<Node>& nodes() const { return nodes_; }
  int depth() const { return depth_; }

 private:
  std::vector<Node> nodes_;
  int depth_ = 0;  ///< longest path from root to leaf, in nodes
};

}  // namespace swept::detail
