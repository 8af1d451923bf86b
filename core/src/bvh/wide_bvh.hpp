// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swept/core/bvh/bv_tree.hpp"

namespace swept::detail {

/// Box in single precision that contains what it bounds: centre and half extents, m.
struct BoxF {
  std::array<float, 3> center{};
  std::array<float, 3> half{};
};

/// Eight axis-aligned boxes, one a lane, in the layout that the vector kernels read.
struct alignas(32) WideNode {
  static constexpr int kLanes = 8;
  std::array<std::array<float, kLanes>, 3> center;  ///< m
  std::array<std::array<float, kLanes>, 3> half;    ///< m
  std::array<std::int32_t, kLanes> child;           ///< a node's index, or ~index of a primitive
  std::int32_t count;                               ///< lanes in use, the first ones

  BoxF box(int lane) const {
    return {{center[0][lane], center[1][lane], center[2][lane]},
            {half[0][lane], half[1][lane], half[2][lane]}};
  }
};

/// Eight-wide tree of boxes whose leaves are single primitives. Node 0 is the root. Coordinates are
/// relative to `origin()`, so that single precision loses little whatever the frame.
class WideBvh {
 public:
  /// A path from the root has at most this many nodes.
  static constexpr int kMaxDepth = kMaxTreeDepth;

  /// Of the tree's boxes, with primitives numbered in the order of the tree's leaves, one a leaf.
  explicit WideBvh(const BvTree<Aabb>& binary);

  const std::vector<WideNode>& nodes() const { return nodes_; }
  const Eigen::Vector3d& origin() const { return origin_; }  ///< m
  const BoxF& rootBox() const { return rootBox_; }           ///< m, relative to origin()
  /// m. The 1-norm of no point of a box, relative to origin(), is larger.
  double reach() const { return reach_; }
  std::size_t bytes() const { return nodes_.capacity() * sizeof(WideNode); }

 private:
  std::vector<WideNode> nodes_;
  Eigen::Vector3d origin_;
  BoxF rootBox_;
  double reach_ = 0.0;
};

}  // namespace swept::detail
