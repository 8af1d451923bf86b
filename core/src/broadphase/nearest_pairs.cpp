// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/nearest_pairs.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace swept::detail {
namespace {

using Pair = BroadphaseScratch::Pair;

/// m^2. Squared distance of the box to each lane. Where infinite coordinates give NaN, the gap
/// counts as zero.
using LaneDistances = std::array<float, BoxBlock::kLanes>;
LaneDistances squaredDistances(const FloatBox& box, const BoxBlock& block) {
  LaneDistances squared{};
  for (int k = 0; k < 3; ++k) {
    for (std::size_t lane = 0; lane < BoxBlock::kLanes; ++lane) {
      const float above = block.lower[k][lane] - box.upper[k];
      const float below = box.lower[k] - block.upper[k][lane];
      const float least = above > 0.0F ? above : 0.0F;
      const float gap = below > least ? below : least;
      squared[lane] += gap * gap;
    }
  }
  return squared;
}

/// m^2. Lemma: if a rounded squared distance of floats is above this, then `boxDistance` of any
/// boxes within those is above the threshold (m).
///
/// The differences, squares and sums of floats are off by less than 8 u of the result, u = 2^-24,
/// and by less than 4 times the least denormal where they underflow; `boxDistance` is below the
/// distance by 12 * 2^-53 of it and twice the least normal double. The factor and the last term
/// exceed these: 2^-16 is 256 u, and the least normal float is 2^23 least denormals. What overflows
/// is infinite, and nothing is above that; a distance that overflows is above what does not.
float enough(double threshold) {
  const double squared = threshold * threshold * (1.0 + 0x1p-16);
  constexpr float kMost = std::numeric_limits<float>::max();
  if (!(squared < 0.5 * static_cast<double>(kMost))) return std::numeric_limits<float>::infinity();
  return static_cast<float>(squared) + std::numeric_limits<float>::min();
}

/// The nearest pairs so far are a heap with the last of them on top. Pairs farther than that are
/// skipped.
class PairSearch {
 public:
  PairSearch(const Pair& after, double bound, std::size_t most, bool among,
             std::vector<Pair>& pairs)
      : after_(after), bound_(bound), most_(most), among_(among), pairs_(pairs) {
    pairs_.clear();
    shrink();
  }

  void search(const PlacedForest& a, std::size_t treeA, const PlacedForest& b, std::size_t treeB) {
    const Node rootA = root(a, treeA), rootB = root(b, treeB);
    if (rootA.tree->live() > 0 && rootB.tree->live() > 0) meet(rootA, rootB);
  }
  std::size_t looked() const { return looked_; }

 private:
  static constexpr std::size_t kLanes = BoxBlock::kLanes;

  struct Node {
    const PlacedForest* side;
    const BoxTree* tree;
    std::size_t level, block;

    const BoxBlock& lanes() const { return tree->level(level)[block]; }
    Node below(std::size_t lane) const { return {side, tree, level - 1, block * kLanes + lane}; }
    bool operator==(const Node&) const = default;
  };
  struct Step {
    float distance;  ///< m^2
    std::uint8_t laneA, laneB;
  };

  static Node root(const PlacedForest& side, std::size_t tree) {
    const BoxTree& boxes = side.forest.tree(tree);
    return {&side, &boxes, boxes.levels() - 1, 0};
  }
  static bool isEmpty(const BoxBlock& block, std::size_t lane) {
    return !(block.lower[0][lane] <= block.upper[0][lane]);
  }

  /// Opens the higher one of two blocks, or both, nearest first: later ones are then mostly too
  /// far. The depth is at most the sum of the trees' heights.
  void meet(const Node& a, const Node& b) {
    ++looked_;
    if (a.level == 0 && b.level == 0) return meetBoxes(a, b);
    std::array<Step, kLanes * kLanes> steps;
    std::size_t count = 0;
    const auto consider = [&](const FloatBox& box, const BoxBlock& block, std::size_t first,
                              const auto& stepTo) {
      const LaneDistances distances = squaredDistances(box, block);
      for (std::size_t lane = first; lane < kLanes; ++lane) {
        if (distances[lane] > enough_ || isEmpty(block, lane)) continue;
        steps[count] = stepTo(static_cast<std::uint8_t>(lane));
        steps[count++].distance = distances[lane];
      }
    };
    if (a.level > b.level) {
      consider(b.lanes().bounds(), a.lanes(), 0, [](std::uint8_t i) { return Step{0, i, 0}; });
    } else if (a.level < b.level) {
      consider(a.lanes().bounds(), b.lanes(), 0, [](std::uint8_t i) { return Step{0, 0, i}; });
    } else {
      const bool same = among_ && a == b;
      for (std::uint8_t i = 0; i < kLanes; ++i) {
        if (isEmpty(a.lanes(), i)) continue;
        consider(a.lanes().box(i), b.lanes(), same ? i : 0, [i](std::uint8_t j) {
          return Step{0, i, j};
        });
      }
    }
    std::sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Step& x, const Step& y) { return x.distance < y.distance; });
    const std::size_t top = std::max(a.level, b.level);
    for (std::size_t i = 0; i < count && !(steps[i].distance > enough_); ++i)
      meet(a.level == top ? a.below(steps[i].laneA) : a,
           b.level == top ? b.below(steps[i].laneB) : b);
  }

  void meetBoxes(const Node& a, const Node& b) {
    const BoxBlock &blockA = a.lanes(), &blockB = b.lanes();
    const bool same = among_ && a == b;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (isEmpty(blockA, i)) continue;
      const LaneDistances distances = squaredDistances(blockA.box(i), blockB);
      for (std::size_t j = same ? i + 1 : 0; j < kLanes; ++j) {
        if (distances[j] > enough_ || isEmpty(blockB, j)) continue;
        consider(a, a.tree->owner(static_cast<BoxTree::Slot>(a.block * kLanes + i)), b,
                 b.tree->owner(static_cast<BoxTree::Slot>(b.block * kLanes + j)));
      }
    }
  }

  void consider(const Node& a, std::uint32_t numberA, const Node& b, std::uint32_t numberB) {
    const PlacedBox &boxA = a.side->boxes[numberA], &boxB = b.side->boxes[numberB];
    Pair pair{boxDistance(boxA.box, boxB.box), boxA.owner, boxB.owner};
    if (!(pair.distance < bound_)) return;
    if (among_ && pair.a > pair.b) std::swap(pair.a, pair.b);
    if (!(after_ < pair)) return;
    if (pairs_.size() == most_) {
      if (!(pair < pairs_.front())) return;
      std::pop_heap(pairs_.begin(), pairs_.end());
      pairs_.pop_back();
    }
    pairs_.push_back(pair);
    std::push_heap(pairs_.begin(), pairs_.end());
    shrink();
  }
  void shrink() { enough_ = enough(pairs_.size() == most_ ? pairs_.front().distance : bound_); }

  const Pair after_;
  const double bound_;  ///< m
  const std::size_t most_;
  const bool among_;
  std::vector<Pair>& pairs_;
  float enough_ = 0.0F;  ///< m^2
  std::size_t looked_ = 0;
};

}  // namespace

std::size_t findNearestPairs(const PlacedForest& a, const PlacedForest* b, const Pair& after,
                             double bound, std::size_t most, std::vector<Pair>& pairs) {
  PairSearch search(after, bound, most, b == nullptr, pairs);
  for (std::size_t i = 0; i < BoxForest::kTrees; ++i) {
    for (std::size_t j = b == nullptr ? i : 0; j < BoxForest::kTrees; ++j)
      search.search(a, i, b == nullptr ? a : *b, j);
  }
  std::sort_heap(pairs.begin(), pairs.end());
  return search.looked();
}

}  // namespace swept::detail
