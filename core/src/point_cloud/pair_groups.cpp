// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/pair_groups.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "point_cloud/any_of.hpp"

namespace swept::detail {

namespace {

/// Disjoint sets of points, each represented by one of them.
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
/// points. The likeliest pairs go first, so the first sets have the most.
class PairSets {
 public:
  void add(const NoisyPair& pair) {
    Used& ofA = usedA_[pair.a];
    Used& ofB = usedB_[pair.b];
    // All earlier sets are used: a point with many pairs would otherwise search all of its sets for
    // each pair.
    std::size_t word = std::max(ofA.full, ofB.full);
    while ((ofA.word(word) | ofB.word(word)) == kAll) ++word;
    const std::size_t set = kWord * word + std::countr_one(ofA.word(word) | ofB.word(word));
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
  static constexpr std::size_t kWord = 64;  ///< sets in a word, a bit each
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  /// The sets that have a point: all of the words before `full`, and the words beyond that have
  /// any. So a point with one pair needs little memory even if its pair is in the last of many
  /// sets.
  struct Used {
    std::uint64_t word(std::size_t index) const {
      const auto found = beyond.find(index);
      return index < full ? kAll : found == beyond.end() ? 0 : found->second;
    }
    void mark(std::size_t set) {
      beyond[set / kWord] |= std::uint64_t{1} << (set % kWord);
      for (; word(full) == kAll; ++full) beyond.erase(full);
    }
    std::unordered_map<std::size_t, std::uint64_t> beyond;
    std::size_t full = 0;
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
