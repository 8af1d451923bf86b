// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/fit_rules.hpp"
#include "swept/core/bvh/split_rules.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// N primitives. Each is the convex hull of the same number of points, grown by a radius.
struct PrimitivePoints {
  std::span<const Eigen::Vector3d> points;  ///< m; primitive i has [i * per, (i + 1) * per)
  std::size_t perPrimitive = 1;             ///< at least 1
  std::span<const double> radii = {};       ///< m, one per primitive; empty: all zero

  /// Number of primitives.
  std::size_t count() const { return points.size() / perPrimitive; }
};

/// The shape of a tree, without volumes.
struct TreeTopology {
  /// An inner node has both children; a leaf has its primitives.
  struct Node {
    int rightChild;  ///< -1: a leaf. The left child of node i is i + 1
    int first;       ///< first of the node's primitives, which are contiguous in `order`
    int count;       ///< number of these primitives
  };
  std::vector<Node> nodes;  ///< depth first
  std::vector<int> order;   ///< primitive indices
  int depth = 0;            ///< nodes on the longest path from the root

  /// Builds a tree whose leaves hold at most `maxLeaf` primitives. Below half of the greatest
  /// depth, nodes are halved whatever the rule; this bounds the depth for up to 2^30 primitives.
  /// Throws std::invalid_argument as `BvTree::build` does.
  static TreeTopology build(const PrimitivePoints& primitives, const SplitFunction& split,
                            int maxLeaf);
};

namespace detail {

/// A number that no call in this process has returned before, and not 0.
std::uint64_t nextTreeShape();
/// Throws std::invalid_argument unless `primitives` has `count` primitives and is valid.
void requireAsAtBuild(const PrimitivePoints& primitives, std::size_t count);

}  // namespace detail

/// Greatest depth of any tree in nodes; bounds the depth of a recursion.
inline constexpr int kMaxTreeDepth = 64;

/// Binary tree of bounding volumes over primitives (Pan, Chitta, Manocha 2012, section III).
template <BoundingVolume BV>
class BvTree {
 public:
  static constexpr int kMaxDepth = kMaxTreeDepth;  ///< of any tree, in nodes

  /// Children follow their parents; the root is node 0.
  struct Node {
    BV volume;       ///< contains all primitives below
    int rightChild;  ///< -1: a leaf. The left child of node i is i + 1
    int first;       ///< first of the node's primitives, which are contiguous in order()
    int count;       ///< number of these primitives

    /// Whether the node has no children.
    bool isLeaf() const { return rightChild < 0; }
  };

  BvTree() = default;  ///< no nodes

  /// Builds a tree top-down. `primitives` are finite, at least one and at most 2^30. Throws
  /// std::invalid_argument unless maxLeaf >= 1, perPrimitive >= 1 and the number of radii is zero
  /// or that of the primitives, and for a split rule that does more than reorder its input.
  static BvTree build(const PrimitivePoints& primitives, const SplitFunction& split = MeanSplit{},
                      const FitFunction<BV>& fit = defaultFit<BV>(), int maxLeaf = 1);

  /// Fits new volumes bottom-up in linear time for primitives that moved; the tree keeps its shape.
  /// `primitives` has the same number and order as at build, else throws std::invalid_argument;
  /// each may have more points.
  void refit(const PrimitivePoints& primitives, const FitFunction<BV>& fit = FitToChildren{});

  /// Nodes, depth first from the root; empty for an empty tree.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Node i, unchecked.
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  /// Primitive indices in the order of the leaves.
  const std::vector<int>& order() const { return order_; }
  int depth() const { return depth_; }  ///< nodes on the longest path from the root; <= kMaxDepth
  /// Identifies the build: the same after refits and for copies, else different. 0: no nodes.
  std::uint64_t shape() const { return shape_; }
  /// Bytes on the heap.
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(int);
  }

 private:
  double largestRadius(const PrimitivePoints& primitives, const Node& node) const;

  std::vector<Node> nodes_;
  std::vector<int> order_;
  int depth_ = 0;
  std::uint64_t shape_ = 0;
};

template <BoundingVolume BV>
BvTree<BV> BvTree<BV>::build(const PrimitivePoints& primitives, const SplitFunction& split,
                             const FitFunction<BV>& fit, int maxLeaf) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, maxLeaf] { return build(primitives, split, fit, maxLeaf); });
  }
  TreeTopology topology = TreeTopology::build(primitives, split, maxLeaf);
  BvTree tree;
  tree.order_ = std::move(topology.order);
  tree.depth_ = topology.depth;
  tree.shape_ = detail::nextTreeShape();
  tree.nodes_.reserve(topology.nodes.size());
  const BV unknown = BV::fit({});
  for (const TreeTopology::Node& node : topology.nodes) {
    tree.nodes_.push_back({unknown, node.rightChild, node.first, node.count});
  }
  tree.refit(primitives, fit);
  return tree;
}

template <BoundingVolume BV>
void BvTree<BV>::refit(const PrimitivePoints& primitives, const FitFunction<BV>& fit) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return refit(primitives, fit); });
  }
  detail::requireAsAtBuild(primitives, order_.size());
  const std::size_t per = primitives.perPrimitive;
  // In leaf order, so that the points of any node are one span.
  std::vector<Eigen::Vector3d> points(primitives.points.size());
  for (std::size_t slot = 0; slot < order_.size(); ++slot) {
    const std::size_t from = static_cast<std::size_t>(order_[slot]) * per;
    std::copy_n(primitives.points.begin() + static_cast<std::ptrdiff_t>(from), per,
                points.begin() + static_cast<std::ptrdiff_t>(slot * per));
  }
  const std::span<const Eigen::Vector3d> ordered(points);
  std::vector<double> radii(primitives.radii.empty() ? 0 : nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // children follow their parents
    Node& node = nodes_[i];
    FitInput<BV> input;
    input.points = ordered.subspan(static_cast<std::size_t>(node.first) * per,
                                   static_cast<std::size_t>(node.count) * per);
    const auto right = static_cast<std::size_t>(node.rightChild);
    if (!node.isLeaf()) {
      input.left = &nodes_[i + 1].volume;
      input.right = &nodes_[right].volume;
    }
    if (!radii.empty()) {
      radii[i] =
          node.isLeaf() ? largestRadius(primitives, node) : std::max(radii[i + 1], radii[right]);
      input.radius = radii[i];
    }
    node.volume = fit(input);
  }
}

template <BoundingVolume BV>
double BvTree<BV>::largestRadius(const PrimitivePoints& primitives, const Node& node) const {
  double largest = 0.0;
  for (int slot = node.first; slot < node.first + node.count; ++slot) {
    largest = std::max(largest, primitives.radii[order_[static_cast<std::size_t>(slot)]]);
  }
  return largest;
}

extern template class BvTree<Aabb>;
extern template class BvTree<Obb>;
extern template class BvTree<Rss>;
extern template class BvTree<ObbRss>;
extern template class BvTree<KDop<16>>;
extern template class BvTree<KDop<18>>;
extern template class BvTree<KDop<24>>;

}  // namespace swept
