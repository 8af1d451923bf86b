// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "swept/core/floating_point_environment.hpp"
#include "swept/core/traversal/traversal.hpp"

namespace swept {

/// The front where a collision traversal ended, so that the next one can start there: pairs of
/// hierarchy nodes that together cover all pairs of leaves (Li and Chen 1998; Ehmann and Lin 2001;
/// Pan, Chitta, Manocha 2012, section III-D).
///
/// It is correct for any motion between two traversals. It saves time if the motion is small, since
/// the volumes above the front need no test. It belongs to one pair of hierarchies: `collideMeshes`
/// notices by itself when the pair changes or either is rebuilt, and starts over. For your own
/// traversal node, belongTo() does this for trees. Call clear() for anything else, also when the
/// node's descent rule changes (new volumes on the same trees are fine).
///
/// It is stored as the tree of pairs above the front, so that the front can move up again: two
/// disjoint sibling pairs are replaced by their parent if that is disjoint too. Testing the parent
/// costs time, so each parent is tested only in one traversal out of eight.
class FrontList {
 public:
  /// Number of pairs in the front.
  std::size_t size() const {
    return pairs_.empty() ? 0 : (pairs_.size() - 1) / 2 + 1 - free_.size();
  }
  /// Forgets everything, keeps the memory.
  void clear() {
    pairs_.clear();
    free_.clear();
  }
  /// Forgets everything unless the last call had the same two arguments, each the `BvTree::shape()`
  /// of a tree.
  void belongTo(std::uint64_t first, std::uint64_t second) {
    const std::array<std::uint64_t, 2> shapes{first, second};
    if (shapes != shapes_) clear();
    shapes_ = shapes;
  }

 private:
  template <CollisionTraversal Node>
  friend class FrontTraversal;

  struct Pair {
    int first;
    int second;
    int children;  ///< index of the left child, the right one follows; -1: in the front
  };

  /// Two new pairs side by side; returns the index of the first.
  int sprout(int index, const std::array<std::array<int, 2>, 2>& below) {
    int children = static_cast<int>(pairs_.size());
    if (free_.empty()) {
      pairs_.resize(pairs_.size() + 2);
    } else {
      children = free_.back();
      free_.pop_back();
    }
    const auto left = static_cast<std::size_t>(children);
    for (std::size_t k = 0; k < 2; ++k) pairs_[left + k] = {below[k][0], below[k][1], -1};
    pairs_[static_cast<std::size_t>(index)].children = children;
    return children;
  }

  void prune(int index) {
    Pair& pair = pairs_[static_cast<std::size_t>(index)];
    free_.push_back(pair.children);
    pair.children = -1;
  }

  std::vector<Pair> pairs_;  ///< [0] is the pair of roots
  std::vector<int> free_;    ///< left children of pairs no longer used
  std::array<std::uint64_t, 2> shapes_{};
  unsigned turn_ = 0;
};

/// One traversal from a front.
template <CollisionTraversal Node>
class FrontTraversal {
 public:
  /// Both must live until run() is done; the front must belong to the hierarchies of the node.
  FrontTraversal(Node& node, FrontList& front) : node_(node), front_(front) {}

  /// Calls leafTesting for the pairs of leaves that may touch, until the node can stop.
  void run() {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return run(); });
    }
    if (front_.pairs_.empty()) front_.pairs_.push_back({0, 0, -1});
    ++front_.turn_;
    visit(0);
  }

 private:
  static constexpr unsigned kTurns = 8;

  /// Returns true if the pair is in the front and disjoint.
  bool visit(int index) {
    const FrontList::Pair pair = front_.pairs_[static_cast<std::size_t>(index)];
    if (pair.children < 0) return visitFront(index, pair);
    const bool left = visit(pair.children);
    if (node_.canStop()) return false;
    const bool right = visit(pair.children + 1);
    const bool turn = (static_cast<unsigned>(index) + front_.turn_) % kTurns == 0;
    if (!left || !right || !turn || !node_.bvTesting(pair.first, pair.second)) return false;
    front_.prune(index);
    return true;
  }

  bool visitFront(int index, const FrontList::Pair& pair) {
    if (node_.bvTesting(pair.first, pair.second)) return true;
    if (detail::areLeaves(node_, pair.first, pair.second)) {
      node_.leafTesting(pair.first, pair.second);
      return false;
    }
    const int children = front_.sprout(index, detail::pairsBelow(node_, pair.first, pair.second));
    for (const int child : {children, children + 1}) {
      const FrontList::Pair below = front_.pairs_[static_cast<std::size_t>(child)];
      visitFront(child, below);
      if (node_.canStop()) break;
    }
    return false;
  }

  Node& node_;
  FrontList& front_;
};

/// Like collisionTraverse(node), but starts where the last traversal with this front ended.
/// Allocates only when the front grows beyond its largest size so far.
template <CollisionTraversal Node>
void collisionTraverse(Node& node, FrontList& front) {
  FrontTraversal<Node>(node, front).run();
}

}  // namespace swept
