// SPDX-License-Identifier: BSD-3-Clause
// What SweepAndPrune is made of.
#include <gtest/gtest.h>

#include <set>

#include "broadphase/box_forest.hpp"
#include "broadphase/nearest_pairs.hpp"
#include "broadphase/pair_set.hpp"
#include "broadphase/partner_lists.hpp"
#include "broadphase/room.hpp"
#include "broadphase_samples.hpp"

namespace swept::test {
namespace {

using detail::PairKey;

TEST(FloatBox, IsRoundedOutward) {
  std::mt19937 random(1);
  const double most = std::numeric_limits<double>::max(), least = 5e-324;
  std::vector<double> values{0.0, least,  1e-45,  1e-40, 1.2e-38,
                             1.0, 3.4e38, 3.5e38, most,  kInfinity};
  for (int i = 0; i < 100'000; ++i)
    values.push_back(std::ldexp(uniform(random, 0.5, 1.0),
                                std::uniform_int_distribution<int>(-160, 135)(random)));
  for (int i = 0; i < 10'000; ++i)  // next to a float, and between two
    values.push_back(std::nextafter(static_cast<double>(static_cast<float>(values[20 + i])),
                                    i % 2 == 0 ? 0.0 : kInfinity));
  for (const double value : values) {
    for (const double x : {value, -value}) {
      const double below = detail::floatBelow(x), above = detail::floatAbove(x);
      EXPECT_LE(below, x);
      EXPECT_GE(above, x);
      if (value > 1e-30 && value < 1e38) {
        EXPECT_LT(above - below, 1e-6 * value);
      }
    }
  }
}

TEST(Room, ContainsTheBox) {
  std::mt19937 random(2);
  int with = 0;
  for (const World world : kWorlds) {
    for (std::uint32_t i = 0; i < 3000; ++i) {
      const Aabb before = Reference::meaning(randomBox(random, world, 2.0));
      const double step = std::pow(10.0, uniform(random, -9.0, 3.0));
      const Aabb now =
          Reference::meaning(chance(random, 0.1) ? randomBox(random, world, 2.0)
                                                 : shifted(before, uniformPoint(random, step)));
      const detail::FloatBox room = detail::roomFor(before, now, i);
      EXPECT_TRUE(room.contains(now));
      with += room.contains(shifted(now, 0.5 * (now.lower - before.lower))) ? 1 : 0;
    }
  }
  EXPECT_GT(with, 5000);
}

TEST(PairSet, HoldsWhatWasToggled) {
  std::mt19937 random(3);
  for (const int bits : {3, 9, 17}) {
    detail::PairSet pairs;
    std::set<PairKey> expected;
    std::uniform_int_distribution<std::uint32_t> any(0, (1U << bits) - 1);
    for (int round = 0; round < 60; ++round) {
      std::vector<PairKey> keys;
      const int count = round % 20 == 0 ? 5000 : 5 * round;
      for (int i = 0; i < count; ++i) {
        const std::uint32_t a = any(random);
        const PairKey key = detail::pairKey(a, a ^ (1 + any(random) % 7));
        keys.push_back(key);
        if (!expected.erase(key)) expected.insert(key);
      }
      pairs.toggle(keys, bits + 3);
      std::vector<PairKey> found;
      std::set_symmetric_difference(pairs.sorted().begin(), pairs.sorted().end(),
                                    pairs.changed().begin(), pairs.changed().end(),
                                    std::back_inserter(found));
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
      ASSERT_TRUE(std::is_sorted(pairs.changed().begin(), pairs.changed().end()));
    }
    EXPECT_GT(expected.size(), 5u);
  }
}

TEST(PartnerLists, PartnersKnowWhereTheyAre) {
  std::mt19937 random(4);
  constexpr std::uint32_t kCount = 40;
  detail::PartnerLists lists;
  lists.resize(kCount);
  std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
  std::uniform_int_distribution<std::uint32_t> any(0, kCount - 1);
  for (int step = 0; step < 20'000; ++step) {
    // Box 0 is a partner of nearly everyone.
    const std::uint32_t a = chance(random, 0.3) ? 0 : any(random), b = any(random);
    if (a == b) continue;
    const auto pair = std::minmax(a, b);
    if (expected.insert(pair).second) {
      lists.add(a, b, step % 2 == 0);
    } else if (chance(random, 0.5)) {
      expected.erase(pair);
      const auto list = lists.of(a);
      std::uint32_t at = 0;
      while (list[at].box != b) ++at;
      lists.remove(a, at);
    }
    std::size_t found = 0;
    for (std::uint32_t box = 0; box < kCount; ++box) {
      const auto list = lists.of(box);
      for (std::uint32_t i = 0; i < list.size(); ++i) {
        const auto mate = lists.of(list[i].box)[list[i].mate];
        ASSERT_EQ(mate.box, box);
        ASSERT_EQ(mate.mate, i);
        ASSERT_EQ(mate.overlaps, list[i].overlaps);
        found += expected.count(std::minmax(box, std::uint32_t{list[i].box}));
      }
    }
    ASSERT_EQ(found, 2 * expected.size());
  }
  EXPECT_GT(lists.of(0).size(), 15u);
}

/// How many blocks a search looks at cannot be seen from outside; that the blocks are small can.
TEST(BoxForest, LargeBoxesDoNotSpoilTheSmallOnes) {
  std::mt19937 random(5);
  std::vector<detail::FloatBox> boxes;
  std::vector<std::uint32_t> owners;
  for (std::uint32_t i = 0; i < 8000; ++i) {
    const double half = i % 10 == 0 ? 5.0 : 0.05;
    boxes.push_back(detail::floatBox(around(uniformPoint(random, 10.0), Vector3d::Constant(half))));
    owners.push_back(i);
  }
  detail::BoxForest forest;
  forest.build(owners, boxes);
  int large = 0;
  for (const detail::BoxBlock& block : forest.tree(0).level(0)) {
    const detail::FloatBox bounds = block.bounds();
    large += bounds.upper[0] - bounds.lower[0] > 6.0F ? 1 : 0;
  }
  EXPECT_LE(large, 102);  // 800 large boxes, 8 a block, and where the two sorts meet
  EXPECT_GE(large, 100);
}

/// Blocks looked at, per box, for the first 32 pairs: spread-out boxes of two sizes must not take
/// much more when there are more of them.
TEST(NearestPairs, SpreadOutBoxesAreNotAllCompared) {
  double least = kInfinity, most = 0.0;
  for (const std::uint32_t count : {1000U, 4000U, 16'000U, 64'000U}) {
    std::mt19937 random(6);
    const double side = std::cbrt(static_cast<double>(count));
    std::vector<detail::PlacedBox> boxes;
    std::vector<detail::FloatBox> rooms;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double half = i % 50 == 0 ? 1.0 : 0.1;
      boxes.push_back({around(uniformPoint(random, 0.5 * side), Vector3d::Constant(half)), i});
      rooms.push_back(detail::floatBox(boxes.back().box));
      numbers.push_back(i);
    }
    detail::BoxForest forest;
    forest.build(numbers, rooms);
    const detail::PlacedForest placed{forest, boxes};
    std::vector<BroadphaseScratch::Pair> pairs;
    const std::size_t looked = detail::findNearestPairs(
        placed, nullptr, {0.0, 0xFFFFFFFF, 0xFFFFFFFF}, kInfinity, 32, pairs);
    EXPECT_EQ(pairs.size(), 32u);
    EXPECT_LE(pairs.capacity(), 64u);
    const double perBox = static_cast<double>(looked) / count;
    least = std::min(least, perBox);
    most = std::max(most, perBox);
  }
  EXPECT_LT(most, 2.0 * least);
  EXPECT_LT(most, 4.0);
}

}  // namespace
}  // namespace swept::test
