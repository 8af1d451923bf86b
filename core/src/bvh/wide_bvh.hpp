// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "swept/core/bvh/bv_tree.hpp"

namespace swept::detail {

/// Box along axes of its own: the points p with |axes[j] . (p - center)| <= half[j] for each j. The
/// axes are orthonormal up to the rounding of single precision.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m
  std::array<std::array<float, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<float, 3> half{};  ///< m
};

/// Lemma: the points p with |a_j . (p - c)| <= h_j, the axes a_j orthonormal up to 3 u in the
/// entries of their Gram matrix, u = 2^-24, are c + sum t_j a_j with |t_j| <= h_j + 4 u |h|_1.
inline constexpr double kBoxSkew = 4.5 * 0x1p-24;

/// Eight oriented boxes, one a lane, in the layout that the vector kernels read.
struct alignas(32) WideNode {
  static constexpr int kLanes = 8;
  using Row = std::array<float, kLanes>;
  std::array<Row, 3> center;               ///< m, from `origin`
  std::array<std::array<Row, 3>, 3> axes;  ///< [j][i]: component i of axis j
  std::array<Row, 3> half;                 ///< m, along each axis
  std::array<std::int32_t, kLanes> child;  ///< a node's index, or ~index of a primitive
  /// m. Near the boxes, so that single precision loses little of them whatever the frame.
  Eigen::Vector3d origin;
  float reach;         ///< m; |center|_1 + |half|_1 of no box is larger
  std::int32_t count;  ///< lanes in use, the first ones

  OrientedBox box(int lane) const;
  void set(int lane, const OrientedBox& box);  ///< its centre has to be a float from `origin`
};

/// Balls in runs of eight, the last one perhaps shorter. Refers to what it is made of.
struct PointBuckets {
  std::span<const Eigen::Vector3d> points = {};  ///< m
  std::span<const double> radii = {};            ///< m, one per point; empty: all of `radius`
  double radius = 0.0;                           ///< m

  double radiusOf(std::size_t point) const { return radii.empty() ? radius : radii[point]; }
};

/// The node of a bucket: a box per ball. Each is a primitive, numbered as the points are.
void makeNode(const PointBuckets& buckets, std::int32_t bucket, WideNode& node);

/// Eight-wide tree of oriented boxes whose leaves are single primitives. Node 0 is the root.
///
/// The boxes of a smooth surface, unlike axis-aligned ones, get thin with the square of their
/// length: what makes the difference between two such surfaces in near contact (Gottschalk, Lin,
/// Manocha 1996).
class WideBvh {
 public:
  /// A path from the root has at most this many nodes.
  static constexpr int kMaxDepth = kMaxTreeDepth;

  /// In the shape of a binary tree with at most kLanes primitives a leaf. `primitives` are those of
  /// the tree, in the order of its leaves, and so are they numbered.
  WideBvh(const TreeTopology& binary, const PrimitivePoints& primitives);
  /// Of points: the nodes above those of the buckets, which are numbered on from them and made when
  /// they are asked for.
  WideBvh(std::vector<WideNode> nodes, const PointBuckets& buckets, const Aabb& bounds,
          const OrientedBox& rootBox);

  /// The same tree over primitives that moved, in linear time but for its depth; not of points.
  /// `primitives`: as many, in the tree's order.
  WideBvh refitted(const PrimitivePoints& primitives) const;
  /// Areas of the boxes of nodes, in terms of those of the primitives' boxes: what the order of the
  /// tree is worth. Zero where it says nothing, as for boxes without an area or beyond single
  /// precision.
  double spread() const;

  /// Refers to `room` or to the tree.
  const WideNode& node(std::int32_t index, WideNode& room) const;
  /// Whether a node is one of points, and which: from the first up to, and without, the second.
  bool isBucket(std::int32_t node) const { return static_cast<std::size_t>(node) >= nodes_.size(); }
  std::pair<std::int32_t, std::int32_t> pointsOf(std::int32_t bucket) const {
    const std::int32_t first =
        WideNode::kLanes * (bucket - static_cast<std::int32_t>(nodes_.size()));
    const auto count = static_cast<std::int32_t>(buckets_.points.size());
    return {first, std::min(first + WideNode::kLanes, count)};
  }
  /// Those that are kept.
  const std::vector<WideNode>& nodes() const { return nodes_; }
  const Aabb& bounds() const { return bounds_; }           ///< m, of all primitives
  const OrientedBox& rootBox() const { return rootBox_; }  ///< m, of all primitives
  /// m. The 1-norm of no point of a primitive is larger.
  double reach() const { return reach_; }
  std::size_t bytes() const { return nodes_.capacity() * sizeof(WideNode); }

 private:
  WideBvh() = default;
  void findReach();

  std::vector<WideNode> nodes_;
  PointBuckets buckets_;
  Aabb bounds_;
  OrientedBox rootBox_;
  double reach_ = 0.0;
};

}  // namespace swept::detail
