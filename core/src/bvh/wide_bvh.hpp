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

/// Box along its own axes: the points p with |axes[j] . (p - center)| <= half[j] for each j. The
/// axes are orthonormal up to the rounding of single precision.
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m
  std::array<std::array<float, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<float, 3> half{};  ///< m
};

/// Lemma: the points p with |a_j . (p - c)| <= h_j, the axes a_j orthonormal up to 3 u in the
/// entries of their Gram matrix, u = 2^-24, are c + sum t_j a_j with |t_j| <= h_j + 4 u |h|_1.
inline constexpr double kBoxSkew = 4.5 * 0x1p-24;

/// Eight oriented boxes, one per lane, in the layout that the SIMD kernels read.
struct alignas(32) WideNode {
  static constexpr int kLanes = 8;
  using Row = std::array<float, kLanes>;
  std::array<Row, 3> center;               ///< m, from `origin`
  std::array<std::array<Row, 3>, 3> axes;  ///< [j][i]: component i of axis j
  std::array<Row, 3> half;                 ///< m, along each axis
  std::array<std::int32_t, kLanes> child;  ///< a node's index, or ~index of a primitive
  /// m. Near the boxes, so that single precision loses little of them in any frame.
  Eigen::Vector3d origin;
  float reach;         ///< m; upper bound on |center|_1 + |half|_1 of each box
  std::int32_t count;  ///< number of lanes in use, which are the first ones

  OrientedBox box(int lane) const;
  void set(int lane, const OrientedBox& box);  ///< its centre must be a float from `origin`
};

/// Balls in runs of eight; the last run may be shorter. Refers to the data it is made from.
struct PointBuckets {
  std::span<const Eigen::Vector3d> points = {};  ///< m
  std::span<const double> radii = {};            ///< m, one per point; empty: all of `radius`
  double radius = 0.0;                           ///< m

  double radiusOf(std::size_t point) const { return radii.empty() ? radius : radii[point]; }
};

/// The node of a bucket: one box per ball. Each ball is a primitive, with the number of its point.
void makeNode(const PointBuckets& buckets, std::int32_t bucket, WideNode& node);

/// Eight-wide tree of oriented boxes whose leaves are single primitives. Node 0 is the root.
///
/// Unlike axis-aligned boxes, those of a smooth surface get thin with the square of their length.
/// This makes the difference between two such surfaces in near contact (Gottschalk, Lin, Manocha
/// 1996).
class WideBvh {
 public:
  /// A path from the root has at most this many nodes.
  static constexpr int kMaxDepth = kMaxTreeDepth;

  /// Has the shape of a binary tree with at most kLanes primitives per leaf. `primitives` are those
  /// of the tree, in the order of its leaves, and are numbered in that order.
  WideBvh(const TreeTopology& binary, const PrimitivePoints& primitives);
  /// For points: stores only the nodes above those of the buckets. The buckets' nodes have the
  /// following numbers and are made on request.
  WideBvh(std::vector<WideNode> nodes, const PointBuckets& buckets, const Aabb& bounds,
          const OrientedBox& rootBox);

  /// The same tree over moved primitives, in linear time except for its depth; not for points.
  /// `primitives`: the same number, in the tree's order.
  WideBvh refitted(const PrimitivePoints& primitives) const;
  /// Areas of the boxes of nodes relative to those of the primitives' boxes: a measure of the
  /// quality of the tree's order. Zero if it is unknown, for boxes without an area or beyond single
  /// precision.
  double spread() const;

  /// The result refers to `room` or to the tree.
  const WideNode& node(std::int32_t index, WideNode& room) const;
  /// Whether a node consists of points, and which: from the first up to, but without, the second.
  bool isBucket(std::int32_t node) const { return static_cast<std::size_t>(node) >= nodes_.size(); }
  std::pair<std::int32_t, std::int32_t> pointsOf(std::int32_t bucket) const {
    const std::int32_t first =
        WideNode::kLanes * (bucket - static_cast<std::int32_t>(nodes_.size()));
    const auto count = static_cast<std::int32_t>(buckets_.points.size());
    return {first, std::min(first + WideNode::kLanes, count)};
  }
  /// The stored nodes.
  const std::vector<WideNode>& nodes() const { return nodes_; }
  const Aabb& bounds() const { return bounds_; }           ///< m, of all primitives
  const OrientedBox& rootBox() const { return rootBox_; }  ///< m, of all primitives
  /// m. Upper bound on the 1-norm of all points of primitives.
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
