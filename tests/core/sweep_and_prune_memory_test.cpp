// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "broadphase_samples.hpp"
#include "heap_counter.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::test {
namespace {

/// Circles; one in ten boxes teleports instead, every tenth step.
Aabb onItsWay(const Aabb& start, std::size_t box, int step) {
  const double angle = 0.05 * step + static_cast<double>(box);
  if (box % 10 == 0) return shifted(start, Vector3d((step / 10 * 7) % 13 - 6, (step / 10) % 5, 0));
  return shifted(start, 0.3 * Vector3d(std::cos(angle), std::sin(angle), 0.0));
}

TEST(SweepAndPrune, AllocatesNothingInSteadyState) {
  constexpr std::size_t kCount = 3000;
  constexpr int kCycle = 126;  // steps, about a circle
  std::mt19937 random(1);
  std::vector<Aabb> start, boxes(kCount), some;
  for (std::size_t i = 0; i < kCount; ++i) start.push_back(evenBox(random, 7.0));
  SweepAndPrune manager;
  const std::vector<BoxHandle> handles = manager.registerBoxes(start);
  some.reserve(kCount);
  BroadphaseScratch scratch;
  std::size_t pairs = 0, hits = 0, changes = 0, before = 0, nearPairs = 0;
  const auto step = [&](int at) {
    for (std::size_t i = 0; i < kCount; ++i) boxes[i] = onItsWay(start[i], i, at);
    if (at % 3 == 0)
      manager.updateAll(boxes);
    else if (at % 3 == 1)
      manager.update(handles, boxes);
    else
      for (std::size_t i = 0; i < kCount; ++i) manager.update(handles[i], boxes[i]);
    pairs = 0;
    manager.collide([&](BoxHandle, BoxHandle) { return ++pairs == 0; });
    changes += pairs != before ? 1 : 0;
    before = pairs;
    manager.collide(boxes[0], scratch, [&](BoxHandle) { return ++hits == 0; });
    manager.distance(boxes[1], scratch, [](BoxHandle, double d) { return d > 0.1 ? 0.0 : 1.0; });
    manager.collide(manager, scratch, [](BoxHandle, BoxHandle) { return false; });
    std::size_t visits = 0;
    const auto nearPair = [&](BoxHandle, BoxHandle, double d) {
      return ++visits < 100 || d == 0.0 ? 1.0 : d;
    };
    manager.distance(scratch, nearPair);
    if (at % 7 == 0) manager.distance(manager, scratch, nearPair);
    nearPairs += visits;
    if (at % 7 == 0) {
      manager.unregisterBox(5);
      manager.unregisterBox(9);
    }
  };
  const auto putBack = [&](int at) {
    if (at % 7 != 0) return;
    manager.registerBox(start[5]);
    manager.registerBox(start[9]);
  };
  for (int at = 0; at < 4 * kCycle; ++at) {
    step(at);
    putBack(at);
  }
  const auto bytes = manager.bytes();
  for (int at = 0; at < kCycle; ++at) {
    const long allocated = allocations;
    step(at);
    EXPECT_EQ(allocations, allocated) << "step " << at;
    putBack(at);  // gives a list of handles back
  }
  EXPECT_EQ(manager.bytes(), bytes);
  EXPECT_GT(pairs, kCount / 5);
  EXPECT_GT(changes, 400u);
  EXPECT_GT(hits, 100u);
  EXPECT_GT(nearPairs, 500u * 1000u);
}

TEST(SweepAndPrune, TellsItsMemory) {
  std::mt19937 random(2);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 10'000; ++i) boxes.push_back(evenBox(random, 8.0));
  const long before = heldBytes;
  SweepAndPrune manager;
  manager.registerBoxes(boxes);
  for (int step = 0; step < 50; ++step) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      boxes[i] = shifted(boxes[i], Vector3d(i % 2 == 0 ? 0.01 : -0.01, 0.0, 0.0));
    manager.updateAll(boxes);
  }
  const auto grown = static_cast<double>(heldBytes - before);
  EXPECT_NEAR(static_cast<double>(manager.bytes()) / grown, 1.0, 0.01);
  EXPECT_LT(static_cast<double>(manager.bytes()) / 10'000.0, 600.0);  // bytes a box
}

TEST(SweepAndPrune, CopiesAreOnTheirOwn) {
  std::mt19937 random(3);
  SweepAndPrune manager;
  for (int i = 0; i < 100; ++i) manager.registerBox(evenBox(random, 1.5));
  const Pairs pairs = pairsOf(manager);
  ASSERT_GT(pairs.size(), 50u);
  SweepAndPrune copy(manager), assigned;
  assigned = manager;
  for (BoxHandle i = 0; i < 100; ++i) manager.update(i, evenBox(random, 1.5));
  EXPECT_EQ(pairsOf(copy), pairs);
  EXPECT_EQ(pairsOf(assigned), pairs);
  EXPECT_NE(pairsOf(manager), pairs);
  const SweepAndPrune moved = std::move(copy);
  EXPECT_EQ(pairsOf(moved), pairs);
}

}  // namespace
}  // namespace swept::test
