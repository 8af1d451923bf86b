// SPDX-License-Identifier: BSD-3-Clause
// A point that may meet each of n others puts every pair into a set of its own. Looking through all
// sets for each pair took time, and a bit for each set at each point memory, of the order n^2.
#include "point_cloud/pair_groups.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace swept {
namespace {

/// Bytes; the most that the program has held so far.
double mostMemory() {
  rusage usage{};
  EXPECT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

detail::ProbabilityRange rangeOf(double lower, double upper) {
  detail::ProbabilityRange range;
  range.lower = lower;
  range.upper = upper;
  range.estimate = lower;
  return range;
}

TEST(PairGroups, OfAStarAreBoundedInMemoryOfItsSize) {
  constexpr std::size_t kCount = 200'000;
  std::vector<detail::NoisyPair> pairs;
  for (std::size_t i = 0; i < kCount; ++i) pairs.push_back({0, i, rangeOf(1e-7, 2e-7)});
  pairs[kCount / 2].range = rangeOf(0.125, 0.25);
  std::vector<std::size_t> group(kCount);
  std::iota(group.begin(), group.end(), std::size_t{0});
  const double before = mostMemory();
  const detail::ProbabilityRange range = detail::groupRange(pairs, group);
  EXPECT_LT(mostMemory() - before, 1e9);  // a bit for each two of them: 2.5e9
  // No two pairs are known to be independent.
  EXPECT_DOUBLE_EQ(range.lower, 0.125);
  EXPECT_NEAR(range.upper, 0.25 + 2e-7 * (kCount - 1), 1e-10);
  // Nor does it matter whose point they share.
  for (detail::NoisyPair& pair : pairs) std::swap(pair.a, pair.b);
  const detail::ProbabilityRange swapped = detail::groupRange(pairs, group);
  EXPECT_EQ(swapped.lower, range.lower);
  EXPECT_EQ(swapped.upper, range.upper);
}

/// Each of n points may meet each of n others: there are more sets than bits in a word, and at
/// most n pairs in one.
TEST(PairGroups, OfAllPairsHaveSetsOfAsManyAsThereArePoints) {
  constexpr std::size_t kCount = 150;
  constexpr double kLikely = 1e-6;
  std::vector<detail::NoisyPair> pairs;
  for (std::size_t i = 0; i < kCount * kCount; ++i)
    pairs.push_back({i / kCount, i % kCount, rangeOf(kLikely, kLikely)});
  std::vector<std::size_t> group(pairs.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const detail::ProbabilityRange range = detail::groupRange(pairs, group);
  const double matched = -std::expm1(kCount * std::log1p(-kLikely));
  EXPECT_LE(range.lower, matched * (1.0 + 1e-12));
  EXPECT_GT(range.lower, 0.5 * matched);
  EXPECT_LE(range.upper, kLikely * kCount * kCount);
  EXPECT_GE(range.upper, kCount * matched * (1.0 - 1e-12));
}

}  // namespace
}  // namespace swept
