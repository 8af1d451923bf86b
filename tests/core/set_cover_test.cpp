// SPDX-License-Identifier: BSD-3-Clause
#include "cover/set_cover.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace swept::detail {
namespace {

using Sets = std::vector<std::vector<int>>;

std::set<int> unionOf(const Sets& sets, const std::vector<int>& chosen) {
  std::set<int> all;
  for (const int index : chosen) all.insert(sets[index].begin(), sets[index].end());
  return all;
}

TEST(SetCover, CoversAllAndKeepsNothingSuperfluous) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> element(0, 39);
  int smaller = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Sets sets;
    for (int i = 0; i < 40; ++i) sets.push_back({i});  // all can be covered
    for (int i = 0; i < 30; ++i) {
      std::set<int> some;
      for (int k = 0; k < 9; ++k) some.insert(element(random));
      sets.emplace_back(some.begin(), some.end());
    }
    const std::vector<int> chosen = greedyCover(40, sets);
    EXPECT_EQ(unionOf(sets, chosen).size(), 40u);
    smaller += chosen.size() <= 12 ? 1 : 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      std::vector<int> others = chosen;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_LT(unionOf(sets, others).size(), 40u);
    }
  }
  EXPECT_GT(smaller, 150);
}

TEST(SetCover, FindsTheHardElementsFirst) {
  // The largest set is a trap: the two others are needed anyway, and do.
  const Sets sets{{1, 2, 3, 4}, {0, 1, 2}, {3, 4, 5}};
  const std::vector<int> chosen = greedyCover(6, sets);
  EXPECT_EQ(chosen.size(), 2u);
}

TEST(SetCover, NothingNeedsNothing) {
  EXPECT_TRUE(greedyCover(0, {}).empty());
  EXPECT_TRUE(greedyCover(0, {{}, {}}).empty());
}

}  // namespace
}  // namespace swept::detail
