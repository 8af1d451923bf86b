// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/pair_groups.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "point_cloud/any_of.hpp"

namespace swept::detail {

namespace {

/// Disjoint sets of points, each known by one of them.
class PointSets {
 public:
  explicit PointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t point) {
    while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
    return point;
  }
  void join(std::size_t one, std::size_t other) {
    one = find(one);
    other = find(other);
    parent_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Sets of pairs without a common point. Each pair goes to the first set that has none of its
/// points: the likeliest go first, and so the first sets have the most.
class PairSets {
 public:
  void add(const NoisyPair& pair) {
    Used& ofA = usedA_[pair.a];
    Used& ofB = usedB_[pair.b];
    // Below these all are used: a point with many pairs would look through all of its own for each.
    std::size_t set = std::max(ofA.least, ofB.least);
    while (ofA.has(set) || ofB.has(set)) ++set;
    ofA.mark(set);
    ofB.mark(set);
    if (set == sets_.size()) sets_.emplace_back();
    sets_[set].add(pair.range);
  }

  ProbabilityRange bounds() const {
    ProbabilityRange any{0.0, 0.0, 0.0};
    for (const AnyOfRanges& set : sets_) {
      const ProbabilityRange range = set.range(0.0);
      any.lower = std::max(any.lower, range.lower);
      any.upper += range.upper;
    }
    any.upper = std::min(1.0, any.upper);
    return any;
  }

 private:
  /// The sets that have a point: all below `least`, and those beyond. So a point with one pair is
  /// small even where its pair is in the last of many sets.
  struct Used {
    bool has(std::size_t set) const { return set < least || beyond.contains(set); }
    void mark(std::size_t set) {
      beyond.insert(set);
      while (beyond.erase(least) > 0) ++least;
    }
    std::unordered_set<std::size_t> beyond;
    std::size_t least = 0;  ///< that does not have it
  };

  std::unordered_map<std::size_t, Used> usedA_;  ///< per point
  std::unordered_map<std::size_t, Used> usedB_;
  std::vector<AnyOfRanges> sets_;
};

}  // namespace

PairGroups::PairGroups(std::span<const NoisyPair> pairs, std::size_t pointsA, std::size_t pointsB)
    : order_(pairs.size()) {
  PointSets sets(pointsA + pointsB);
  for (const NoisyPair& pair : pairs) sets.join(pair.a, pointsA + pair.b);
  std::vector<std::size_t> setOf(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) setOf[i] = sets.find(pairs[i].a);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::size_t i, std::size_t j) { return setOf[i] < setOf[j]; });
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (i == 0 || setOf[order_[i]] != setOf[order_[i - 1]]) starts_.push_back(i);
  }
  starts_.push_back(order_.size());
}

ProbabilityRange groupRange(std::span<const NoisyPair> pairs, std::span<const std::size_t> group) {
  if (group.size() == 1) return pairs[group.front()].range;
  std::vector<std::size_t> likeliest(group.begin(), group.end());
  std::stable_sort(likeliest.begin(), likeliest.end(), [&](std::size_t i, std::size_t j) {
    return pairs[i].range.upper > pairs[j].range.upper;
  });
  PairSets sets;
  AnyOf independent;
  for (const std::size_t i : likeliest) {
    sets.add(pairs[i]);
    independent.add(pairs[i].range.estimate);
  }
  ProbabilityRange range = sets.bounds();
  range.estimate = std::clamp(independent.probability(), range.lower, range.upper);
  return range;
}

}  // namespace swept::detail
