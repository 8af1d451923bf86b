// SPDX-License-Identifier: BSD-3-Clause
// Long random histories of every broadphase manager. SWEPT_BROADPHASE_STEPS sets how long, in
// steps: a million takes some 10 s.
#include <gtest/gtest.h>

#include <cstdlib>

#include "broadphase_samples.hpp"
#include "swept/core/broadphase/brute_force.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::test {
namespace {

int stepsInAll() {
  const char* steps = std::getenv("SWEPT_BROADPHASE_STEPS");
  return steps == nullptr ? 300'000 : std::atoi(steps);
}

/// The reference itself gets a tenth.
template <typename Manager>
constexpr int kShare = std::is_same_v<Manager, BruteForce> ? 10 : 1;

/// One manager, and the list of boxes that it should hold.
template <typename Manager>
class History {
 public:
  History(World world, std::size_t most, double reach, unsigned seed)
      : world_(world), most_(most), reach_(reach), random_(seed) {}

  void run(int steps) {
    grow(most_ / 2);
    for (int i = 0; i < steps && !::testing::Test::HasFailure(); ++i) step();
  }
  std::size_t pairs() const { return pairs_; }
  std::size_t looks() const { return looks_; }
  std::size_t hits() const { return hits_; }
  std::size_t queries() const { return queries_; }
  std::size_t nearPairs() const { return nearPairs_; }
  std::size_t apart() const { return apart_; }
  std::size_t nearQueries() const { return nearQueries_; }
  std::size_t registered() const { return registered_; }
  std::size_t updated() const { return updated_; }

 private:
  void step() {
    const double what = uniform(random_, 0.0, 1.0);
    if (reference_.boxes.empty() || what < 0.05)
      grow(chance(random_, 0.2) ? most_ / 4 : 1);
    else if (what < 0.08)
      shrink();
    else if (what < 0.45)
      updateOne();
    else if (what < 0.60)
      updateSome();
    else if (what < 0.66)
      updateAll();
    else if (what < 0.80)
      comparePairs();
    else if (what < 0.92)
      compareQuery();
    else if (what < 0.98)
      compareNearest();
    else
      compareNearestPairs();
  }

  BoxHandle anyHandle() {
    const auto skip =
        std::uniform_int_distribution<std::size_t>(0, reference_.boxes.size() - 1)(random_);
    return std::next(reference_.boxes.begin(), static_cast<std::ptrdiff_t>(skip))->first;
  }
  Aabb next(const Aabb& box) {
    const double kind = uniform(random_, 0.0, 1.0);
    if (kind < 0.15) return randomBox(random_, world_, reach_);
    if (kind < 0.25) return box;
    const double step = std::pow(10.0, uniform(random_, -5.0, -0.5));
    return shifted(box, uniformPoint(random_, step));
  }

  void grow(std::size_t wanted) {
    const std::size_t count = std::min(wanted, most_ - reference_.boxes.size());
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) boxes.push_back(randomBox(random_, world_, reach_));
    const std::vector<BoxHandle> handles = manager_.registerBoxes(boxes);
    ASSERT_EQ(handles.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_TRUE(reference_.boxes.emplace(handles[i], boxes[i]).second);
    registered_ += count;
  }
  /// At times down to one box; mostly so in small worlds, which soon grow again.
  void shrink() {
    const bool nearlyAll = chance(random_, 2.0 / static_cast<double>(most_));
    const int count = nearlyAll ? static_cast<int>(reference_.boxes.size()) - 1 : 1;
    for (int i = 0; i < count; ++i) {
      const BoxHandle handle = anyHandle();
      manager_.unregisterBox(handle);
      reference_.boxes.erase(handle);
    }
  }
  void updateOne() {
    const BoxHandle handle = anyHandle();
    Aabb& box = reference_.boxes.at(handle);
    manager_.update(handle, box = next(box));
    ++updated_;
  }
  void updateSome() {
    std::vector<BoxHandle> handles;
    std::vector<Aabb> boxes;
    const double share = uniform(random_, 0.0, 0.5);
    for (auto& [handle, box] : reference_.boxes) {
      if (!chance(random_, share)) continue;
      handles.push_back(handle);
      boxes.push_back(next(box));
      box = boxes.back();
    }
    if (!handles.empty() && chance(random_, 0.2)) {  // twice: the last one counts
      handles.push_back(handles.front());
      boxes.push_back(next(boxes.front()));
      reference_.boxes.at(handles.front()) = boxes.back();
    }
    manager_.update(handles, boxes);
    updated_ += handles.size();
  }
  void updateAll() {
    std::vector<Aabb> boxes;
    for (auto& [handle, box] : reference_.boxes) boxes.push_back(box = next(box));
    manager_.updateAll(boxes);
    updated_ += boxes.size();
  }

  void comparePairs() {
    const Pairs expected = reference_.pairs();
    ASSERT_EQ(pairsOf(manager_), expected);
    ASSERT_EQ(manager_.size(), reference_.boxes.size());
    pairs_ += expected.size();
    looks_ += reference_.boxes.size();
  }
  void compareQuery() {
    const Aabb query = randomBox(random_, world_, reach_);
    const std::vector<BoxHandle> expected = reference_.overlapping(query);
    ASSERT_EQ(overlappingOf(manager_, query, scratch_), expected);
    hits_ += expected.empty() ? 0 : 1;
    ++queries_;
  }
  void compareNearest() {
    const Aabb query = Reference::meaning(randomBox(random_, world_, reach_));
    std::vector<Visit> expected;
    for (const auto& [handle, box] : reference_.boxes)
      expected.push_back({handle, boxDistance(query, Reference::meaning(box))});
    std::stable_sort(expected.begin(), expected.end(),
                     [](const Visit& a, const Visit& b) { return a.distance < b.distance; });
    const auto most = std::uniform_int_distribution<std::size_t>(1, 10)(random_);
    if (expected.size() > most) expected.resize(most);
    ASSERT_EQ(nearestOf(manager_, query, most, scratch_), expected);
  }
  /// Up to all of them, against itself or some other boxes.
  void compareNearestPairs() {
    Reference other;
    Manager others;
    const bool among = chance(random_, 0.5);
    for (int i = 0; i < 20 && !among; ++i) {
      const Aabb box = randomBox(random_, world_, reach_);
      other.boxes[others.registerBox(box)] = box;
    }
    const auto most = static_cast<std::size_t>(std::pow(10.0, uniform(random_, 0.0, 3.5)));
    const auto expected = nearestPairsOf(reference_, among ? nullptr : &other, most);
    ASSERT_EQ(nearestPairsOf(manager_, among ? nullptr : &others, most, scratch_), expected);
    if (expected.empty()) return;
    nearPairs_ += expected.size();
    apart_ += expected.back().distance > 0.0 ? 1 : 0;
    ++nearQueries_;
  }

  World world_;
  std::size_t most_;
  double reach_;
  std::mt19937 random_;
  Manager manager_;
  Reference reference_;
  BroadphaseScratch scratch_;
  std::size_t nearPairs_ = 0, apart_ = 0, nearQueries_ = 0;
  std::size_t pairs_ = 0, looks_ = 0, hits_ = 0, queries_ = 0, registered_ = 0, updated_ = 0;
};

template <typename Manager>
class BroadphaseHistory : public ::testing::Test {};
using Managers = ::testing::Types<BruteForce, SweepAndPrune>;
TYPED_TEST_SUITE(BroadphaseHistory, Managers);

TYPED_TEST(BroadphaseHistory, AgreesWithAllPairs) {
  const int steps = stepsInAll() / kShare<TypeParam> / static_cast<int>(kWorlds.size());
  for (const World world : kWorlds) {
    History<TypeParam> history(world, 48, 2.0, 1 + static_cast<unsigned>(world));
    history.run(steps);
    // Neither empty nor full of pairs, and all of the kinds of steps.
    const double perBox =
        static_cast<double>(history.pairs()) / static_cast<double>(history.looks());
    EXPECT_GT(perBox, 0.1) << static_cast<int>(world);
    EXPECT_LT(perBox, world == World::Identical ? 30.0 : 12.0) << static_cast<int>(world);
    EXPECT_GT(history.hits(), history.queries() / 10) << static_cast<int>(world);
    EXPECT_GT(history.nearQueries(), static_cast<std::size_t>(steps) / 100);
    EXPECT_GT(history.nearPairs(), 10 * history.nearQueries()) << static_cast<int>(world);
    EXPECT_GT(history.apart(), history.nearQueries() / 10) << static_cast<int>(world);
    EXPECT_GT(history.registered(), static_cast<std::size_t>(steps) / 50);
    EXPECT_GT(history.updated(), static_cast<std::size_t>(steps) * 3 / 2);
  }
}

TYPED_TEST(BroadphaseHistory, AgreesWithAllPairsInLargerWorlds) {
  for (const World world : kWorlds) {
    History<TypeParam> history(world, 900, 4.0, 11 + static_cast<unsigned>(world));
    history.run(std::max(200, stepsInAll() / 4000 / kShare<TypeParam>));
    EXPECT_GT(history.pairs(), history.looks() / 20) << static_cast<int>(world);
    EXPECT_GT(history.looks(), std::size_t{10'000}) << static_cast<int>(world);
  }
}

TEST(BoxDistance, IsALowerBoundAndClose) {
  std::mt19937 random(7);
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::pow(10.0, uniform(random, -150.0, 150.0));
    const Aabb a = evenBox(random, 1.0), b = evenBox(random, 1.0);
    const auto scaled = [&](const Aabb& box) { return Aabb{scale * box.lower, scale * box.upper}; };
    long double sum = 0.0L;
    for (int k = 0; k < 3; ++k) {
      const Aabb first = scaled(a), second = scaled(b);
      const long double gap =
          std::max({0.0L, static_cast<long double>(first.lower[k]) - second.upper[k],
                    static_cast<long double>(second.lower[k]) - first.upper[k]});
      sum += gap * gap;
    }
    const auto truth = static_cast<double>(std::sqrt(sum));
    const double bound = boxDistance(scaled(a), scaled(b));
    EXPECT_LE(bound, truth);
    EXPECT_GE(bound, truth * (1.0 - 1e-14) - 1e-300);
    EXPECT_EQ(bound == 0.0, scaled(a).overlaps(scaled(b)));
    EXPECT_EQ(bound, boxDistance(scaled(b), scaled(a)));
    apart += truth > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 10000);
  // By the least that doubles can tell.
  for (const double x : {0.0, 1e-310, 1e-300, 1.0}) {
    const double next = std::nextafter(x, 2.0);
    const Aabb below{Vector3d::Constant(-1.0), Vector3d(1.0, 1.0, x)};
    const Aabb above{Vector3d(-1.0, -1.0, next), Vector3d::Constant(2.0)};
    EXPECT_GT(boxDistance(below, above), 0.0) << x;
    EXPECT_LE(boxDistance(below, above), next - x) << x;
  }
}

}  // namespace
}  // namespace swept::test
