// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstdint>

#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// The recursions over pairs of hierarchies, and what they need from a traversal node (Pan, Chitta,
/// Manocha 2012, section III-C). A traversal node joins two hierarchies, the test of their volumes
/// and the test of their primitives. It numbers the nodes of the hierarchies as it likes; the root
/// is 0. A shape is a hierarchy of one node.
///
/// The recursions allocate nothing. Their depth is at most that of the two hierarchies together.

/// Effort of a traversal.
struct TraversalEffort {
  std::int64_t bvTests = 0;    ///< pairs of volumes
  std::int64_t leafTests = 0;  ///< pairs of primitives
};

/// Two hierarchies side by side.
template <typename Node>
concept PairTraversal = requires(Node& node, const Node& constant, int i, int j) {
  { constant.isFirstLeaf(i) } -> std::same_as<bool>;
  { constant.isSecondLeaf(j) } -> std::same_as<bool>;
  /// Which side to descend; called only if neither is a leaf.
  { constant.firstOverSecond(i, j) } -> std::same_as<bool>;
  { constant.firstChildren(i) } -> std::same_as<std::array<int, 2>>;
  { constant.secondChildren(j) } -> std::same_as<std::array<int, 2>>;
  /// Called for pairs of leaves that bvTesting does not exclude.
  node.leafTesting(i, j);
};

/// `bvTesting(i, j)`: true only if nothing below i and j can touch. `canStop()`: whether the answer
/// is known.
template <typename Node>
concept CollisionTraversal = PairTraversal<Node> && requires(Node& node, int i, int j) {
  { node.bvTesting(i, j) } -> std::same_as<bool>;
  { node.canStop() } -> std::same_as<bool>;
};

/// `bvTesting(i, j)`: lower bound (m) on the distance between the primitives below i and j.
/// `canStop(bound)`: whether nothing at this distance or farther matters any more.
template <typename Node>
concept DistanceTraversal = PairTraversal<Node> &&
    requires(Node& node, int i, int j, double bound) {
  { node.bvTesting(i, j) } -> std::same_as<double>;
  { node.canStop(bound) } -> std::same_as<bool>;
};

/// A collision traversal whose two hierarchies are the same. `leafTesting(i, i)` tests the
/// primitives of one leaf against each other.
template <typename Node>
concept SelfCollisionTraversal = CollisionTraversal<Node>;

namespace detail {

/// The two pairs below a pair that are not both leaves.
template <PairTraversal Node>
std::array<std::array<int, 2>, 2> pairsBelow(const Node& node, int i, int j) {
  const bool first = node.isSecondLeaf(j) || (!node.isFirstLeaf(i) && node.firstOverSecond(i, j));
  if (first) {
    const std::array<int, 2> c = node.firstChildren(i);
    return {{{c[0], j}, {c[1], j}}};
  }
  const std::array<int, 2> c = node.secondChildren(j);
  return {{{i, c[0]}, {i, c[1]}}};
}

template <PairTraversal Node>
bool areLeaves(const Node& node, int i, int j) {
  return node.isFirstLeaf(i) && node.isSecondLeaf(j);
}

}  // namespace detail

namespace detail {

template <CollisionTraversal Node>
void collisionDescend(Node& node, int i, int j) {
  if (node.bvTesting(i, j)) return;
  if (areLeaves(node, i, j)) {
    node.leafTesting(i, j);
    return;
  }
  for (const auto& [below, beside] : pairsBelow(node, i, j)) {
    collisionDescend(node, below, beside);
    if (node.canStop()) return;
  }
}

template <SelfCollisionTraversal Node>
void selfCollisionDescend(Node& node, int i) {
  if (node.isFirstLeaf(i)) {
    node.leafTesting(i, i);
    return;
  }
  const std::array<int, 2> children = node.firstChildren(i);
  selfCollisionDescend(node, children[0]);
  if (node.canStop()) return;
  selfCollisionDescend(node, children[1]);
  if (node.canStop()) return;
  collisionDescend(node, children[0], children[1]);
}

template <DistanceTraversal Node>
void distanceDescend(Node& node, int i, int j) {
  if (areLeaves(node, i, j)) {
    node.leafTesting(i, j);
    return;
  }
  const auto pairs = pairsBelow(node, i, j);
  const std::array<double, 2> bounds{node.bvTesting(pairs[0][0], pairs[0][1]),
                                     node.bvTesting(pairs[1][0], pairs[1][1])};
  const int nearer = bounds[1] < bounds[0] ? 1 : 0;
  for (const int k : {nearer, 1 - nearer}) {
    if (!node.canStop(bounds[k])) distanceDescend(node, pairs[k][0], pairs[k][1]);
  }
}

}  // namespace detail

/// Visits all pairs of leaves below (i, j) whose volumes may touch, until the node can stop.
template <CollisionTraversal Node>
void collisionTraverse(Node& node, int i = 0, int j = 0) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, i, j] { return collisionTraverse(node, i, j); });
  }
  detail::collisionDescend(node, i, j);
}

/// Branch and bound over the pairs of leaves below (i, j), the nearer pair of children first.
template <DistanceTraversal Node>
void distanceTraverse(Node& node, int i = 0, int j = 0) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, i, j] { return distanceTraverse(node, i, j); });
  }
  if (!node.canStop(node.bvTesting(i, j))) detail::distanceDescend(node, i, j);
}

/// Visits all pairs of leaves below i, each pair once, and each leaf with itself.
template <SelfCollisionTraversal Node>
void selfCollisionTraverse(Node& node, int i = 0) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, i] { return selfCollisionTraverse(node, i); });
  }
  detail::selfCollisionDescend(node, i);
}

}  // namespace swept
