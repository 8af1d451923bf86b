// SPDX-License-Identifier: BSD-3-Clause
// What every broadphase manager has to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "broadphase_samples.hpp"
#include "swept/core/broadphase/brute_force.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::test {
namespace {

template <typename Manager>
class BroadphaseConformance : public ::testing::Test {
 protected:
  Manager manager_;
  BroadphaseScratch scratch_;

  std::vector<BoxHandle> overlapping(const Aabb& box) {
    return overlappingOf(manager_, box, scratch_);
  }
};

using Managers = ::testing::Types<BruteForce, SweepAndPrune>;
TYPED_TEST_SUITE(BroadphaseConformance, Managers);

Aabb cube(double x, double y, double z, double half = 0.5) {
  return around({x, y, z}, Vector3d::Constant(half));
}

std::vector<Aabb> randomBoxes(std::mt19937& random, World world, std::size_t count, double reach) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) boxes.push_back(randomBox(random, world, reach));
  return boxes;
}

TYPED_TEST(BroadphaseConformance, HandlesAreTheLeastThatAreFree) {
  EXPECT_EQ(this->manager_.registerBox(cube(0, 0, 0)), 0u);
  const std::vector<Aabb> three(3, cube(1, 0, 0));
  EXPECT_EQ(this->manager_.registerBoxes(three), (std::vector<BoxHandle>{1, 2, 3}));
  this->manager_.unregisterBox(2);
  this->manager_.unregisterBox(0);
  EXPECT_FALSE(this->manager_.contains(0));
  EXPECT_EQ(this->manager_.size(), 2u);
  EXPECT_EQ(this->manager_.registerBoxes(three), (std::vector<BoxHandle>{0, 2, 4}));
  EXPECT_EQ(this->manager_.size(), 5u);
}

TYPED_TEST(BroadphaseConformance, TouchingCounts) {
  this->manager_.registerBox(cube(0, 0, 0));
  this->manager_.registerBox(cube(1, 0, 0));                         // a face
  this->manager_.registerBox(cube(-1, -1, -1));                      // a corner
  this->manager_.registerBox(cube(0, 0, std::nextafter(1.0, 2.0)));  // not by the least
  EXPECT_EQ(pairsOf(this->manager_), (Pairs{{0, 1}, {0, 2}}));
  EXPECT_EQ(this->overlapping(cube(2, 0, 0)), (std::vector<BoxHandle>{1}));
  // Far from the origin, where single precision would not tell them apart.
  this->manager_.updateAll(std::vector<Aabb>{{{1e6, 0, 0}, {1e6 + 1e-9, 1, 1}},
                                             {{1e6 + 1e-9, 0, 0}, {1e6 + 2e-9, 1, 1}},
                                             {{1e6 + 2e-9, 0, 0}, {1e6 + 3e-9, 1, 1}},
                                             {{1e6 + 1e-7, 0, 0}, {1e6 + 2e-7, 1, 1}}});
  EXPECT_EQ(pairsOf(this->manager_), (Pairs{{0, 1}, {1, 2}}));
}

TYPED_TEST(BroadphaseConformance, BoxesThatBoundNothingAreEverywhere) {
  std::mt19937 random(1);
  const Aabb far = cube(1e9, 0, 0);
  std::vector<Aabb> bad;
  for (int k = 0; k < 3; ++k) {
    Aabb box = cube(0, 0, 0);
    box.lower[k] = kNan;
    bad.push_back(box);
    box = cube(0, 0, 0);
    box.upper[k] = kNan;
    bad.push_back(box);
    box = cube(0, 0, 0);
    std::swap(box.lower[k], box.upper[k]);
    bad.push_back(box);
  }
  const std::vector<Aabb> good = randomBoxes(random, World::Even, 50, 4.0);
  this->manager_.registerBoxes(good);
  const BoxHandle one = this->manager_.registerBox(cube(0, 0, 0));
  for (const Aabb& box : bad) {
    EXPECT_EQ(this->overlapping(box).size(), 51u);
    EXPECT_TRUE(this->overlapping(far).empty());
    this->manager_.update(one, box);
    EXPECT_EQ(this->overlapping(far), (std::vector<BoxHandle>{one}));
    const Pairs pairs = pairsOf(this->manager_);
    EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(), [&](auto p) { return p.second == one; }),
              50);
    EXPECT_EQ(nearestOf(this->manager_, far, 1, this->scratch_), (std::vector<Visit>{{one, 0.0}}));
    this->manager_.update(one, cube(0, 0, 0));
  }
}

TYPED_TEST(BroadphaseConformance, InfiniteBoxesAreLikeAnyOther) {
  const Aabb halfSpace{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, 0.0}};
  const Aabb atInfinity{{kInfinity, 0, 0}, {kInfinity, 1, 1}};
  const Aabb beam{{5, 0, 0}, {kInfinity, 1, 1}};
  this->manager_.registerBoxes(std::vector<Aabb>{halfSpace, atInfinity, beam, cube(0, 0, 3)});
  EXPECT_EQ(pairsOf(this->manager_), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(this->overlapping(cube(1e300, 0.5, 0.5)), (std::vector<BoxHandle>{0, 2}));
  const std::vector<Visit> near = nearestOf(this->manager_, cube(0, 0, 1.5), 9, this->scratch_);
  ASSERT_EQ(near.size(), 4u);
  EXPECT_EQ(near[0].handle, 3u);
  EXPECT_NEAR(near[0].distance, 0.5, 1e-12);
  EXPECT_EQ(near[1].handle, 0u);
  EXPECT_NEAR(near[1].distance, 1.0, 1e-12);
  EXPECT_EQ(near[2].handle, 2u);
  EXPECT_NEAR(near[2].distance, 4.5, 1e-12);
  EXPECT_EQ(near[3].distance, std::numeric_limits<double>::max());
}

TYPED_TEST(BroadphaseConformance, VisitorsCanStop) {
  std::mt19937 random(2);
  this->manager_.registerBoxes(randomBoxes(random, World::Even, 100, 1.0));
  TypeParam other;
  other.registerBoxes(randomBoxes(random, World::Even, 10, 1.0));
  const Pairs all = pairsOf(this->manager_);
  ASSERT_GT(all.size(), 100u);
  for (const std::size_t stop : {std::size_t{1}, std::size_t{7}, all.size()}) {
    std::size_t calls = 0;
    EXPECT_TRUE(this->manager_.collide([&](BoxHandle, BoxHandle) { return ++calls == stop; }));
    EXPECT_EQ(calls, stop);
  }
  std::size_t calls = 0;
  EXPECT_TRUE(this->manager_.collide(cube(0, 0, 0), this->scratch_,
                                     [&](BoxHandle) { return ++calls == 3; }));
  EXPECT_EQ(calls, 3u);
  calls = 0;
  EXPECT_TRUE(this->manager_.collide(other, this->scratch_,
                                     [&](BoxHandle, BoxHandle) { return ++calls == 5; }));
  EXPECT_EQ(calls, 5u);
  EXPECT_EQ(nearestOf(this->manager_, cube(9, 9, 9), 4, this->scratch_).size(), 4u);
}

TYPED_TEST(BroadphaseConformance, BoundsShrinkAndNeverGrow) {
  for (int i = 0; i < 40; ++i) this->manager_.registerBox(cube(2.0 * i, 0, 0));
  const Aabb query = cube(-10, 0, 0);  // box i is 9 + 2 i away
  std::vector<BoxHandle> visited;
  const double bound = this->manager_.distance(query, this->scratch_, [&](BoxHandle a, double d) {
    EXPECT_NEAR(d, 9.0 + 2.0 * a, 1e-12);
    visited.push_back(a);
    if (a == 0) return 30.0;
    if (a == 1) return 20.0;
    return a == 2 ? kNan : 50.0;
  });
  EXPECT_EQ(bound, 20.0);
  EXPECT_EQ(visited, (std::vector<BoxHandle>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(TypeParam().distance(query, this->scratch_, [](BoxHandle, double) { return 0.0; }),
            kInfinity);
}

/// Two rows of cubes side by side; what is in a box is taken to be 0.2 m behind its faces.
TYPED_TEST(BroadphaseConformance, NearestPairOfWhatIsInTheBoxes) {
  TypeParam other;
  for (int i = 0; i < 40; ++i) {
    this->manager_.registerBox(cube(3.0 * i, 0, 0));
    other.registerBox(cube(3.0 * i, 1.5 + 0.25 * std::abs(i - 30), 0));
  }
  std::vector<PairVisit> visited;
  const double bound =
      this->manager_.distance(other, this->scratch_, [&](BoxHandle a, BoxHandle b, double d) {
        visited.push_back({d, a, b});
        return d + 0.4;
      });
  EXPECT_NEAR(bound, 0.9, 1e-12);
  ASSERT_EQ(visited.size(), 3u);  // 0.5, then 0.75 twice; 1.0 is not nearer
  EXPECT_EQ(visited[0].a, 30u);
  EXPECT_EQ(visited[0].b, 30u);
  EXPECT_EQ(visited[1].a, 29u);
  EXPECT_EQ(visited[2].a, 31u);
  // Among themselves all neighbours are equally near.
  EXPECT_EQ(nearestPairsOf<TypeParam>(this->manager_, nullptr, 39, this->scratch_).back().b, 39u);
  visited.clear();
  EXPECT_NEAR(this->manager_.distance(this->scratch_,
                                      [&](BoxHandle a, BoxHandle b, double d) {
                                        visited.push_back({d, a, b});
                                        if (a == 0) return 6.0;
                                        return a == 1 ? kNan : 7.0;
                                      }),
              6.0, 0.0);
  ASSERT_EQ(visited.size(), 39u + 38u);  // 2 m and 5 m; not 8 m
  EXPECT_EQ(visited[38].a, 38u);
  EXPECT_EQ(visited[39].a, 0u);
  EXPECT_EQ(visited[39].b, 2u);
}

TYPED_TEST(BroadphaseConformance, NearestPairsOfNothing) {
  const auto never = [](BoxHandle, BoxHandle, double) -> double {
    ADD_FAILURE();
    return 0.0;
  };
  TypeParam other;
  EXPECT_EQ(this->manager_.distance(this->scratch_, never), kInfinity);
  EXPECT_EQ(this->manager_.distance(other, this->scratch_, never), kInfinity);
  this->manager_.registerBox(cube(0, 0, 0));
  EXPECT_EQ(this->manager_.distance(this->scratch_, never), kInfinity);
  EXPECT_EQ(this->manager_.distance(other, this->scratch_, never), kInfinity);
  EXPECT_EQ(other.distance(this->manager_, this->scratch_, never), kInfinity);
  this->manager_.unregisterBox(0);
  EXPECT_EQ(this->manager_.distance(this->scratch_, never), kInfinity);
  // Against itself, each box also meets itself.
  this->manager_.registerBox(cube(0, 0, 0));
  EXPECT_EQ(nearestPairsOf(this->manager_, &this->manager_, 5, this->scratch_),
            (std::vector<PairVisit>{{0.0, 0, 0}}));
}

/// All pairs of every kind of world, also of one kind against another.
TYPED_TEST(BroadphaseConformance, NearestPairsOfAllWorlds) {
  std::mt19937 random(7);
  std::size_t overlapping = 0, all = 0;
  for (const World world : kWorlds) {
    for (const World second : {world, World::Hostile, World::Grid}) {
      Reference reference, others;
      TypeParam manager, other;
      for (const Aabb& box : randomBoxes(random, world, 60, 2.0))
        reference.boxes[manager.registerBox(box)] = box;
      for (const Aabb& box : randomBoxes(random, second, 40, 2.0))
        others.boxes[other.registerBox(box)] = box;
      // Some far from where they were, so that they are in the other tree.
      for (const BoxHandle moved : {3U, 8U, 11U, 30U, 31U}) {
        const Aabb box = shifted(reference.boxes[moved], Vector3d(9.0, -1.0, 0.5));
        reference.boxes[moved] = box;
        manager.update(moved, box);
      }
      const auto among =
          nearestPairsOf(manager, static_cast<TypeParam*>(nullptr), 9999, this->scratch_);
      EXPECT_EQ(among, nearestPairsOf(reference, nullptr, 9999));
      EXPECT_EQ(nearestPairsOf(manager, &other, 9999, this->scratch_),
                nearestPairsOf(reference, &others, 9999));
      for (const PairVisit& visit : among) overlapping += visit.distance > 0.0 ? 0 : 1;
      all += among.size();
      // What overlaps comes as in `collide`.
      const Pairs pairs = pairsOf(manager);
      for (std::size_t i = 0; i < pairs.size(); ++i)
        EXPECT_EQ(among[i], (PairVisit{0.0, pairs[i].first, pairs[i].second}));
      if (pairs.size() < among.size()) {
        EXPECT_GT(among[pairs.size()].distance, 0.0);
      }
    }
  }
  EXPECT_EQ(all, kWorlds.size() * 3 * 60 * 59 / 2);
  EXPECT_GT(overlapping, all / 20);
  EXPECT_LT(overlapping, all / 2);
}

TYPED_TEST(BroadphaseConformance, WrongCallsChangeNothing) {
  std::mt19937 random(3);
  const std::vector<Aabb> boxes = randomBoxes(random, World::Even, 30, 1.0);
  this->manager_.registerBoxes(boxes);
  this->manager_.unregisterBox(4);
  const Pairs before = pairsOf(this->manager_);
  const std::vector<BoxHandle> handles{3, 4}, two{3, 5};
  EXPECT_THROW(this->manager_.unregisterBox(4), std::invalid_argument);
  EXPECT_THROW(this->manager_.unregisterBox(30), std::invalid_argument);
  EXPECT_THROW(this->manager_.update(4, boxes[0]), std::invalid_argument);
  EXPECT_THROW(this->manager_.box(4), std::invalid_argument);
  EXPECT_THROW(this->manager_.update(handles, std::span(boxes).first(2)), std::invalid_argument);
  EXPECT_THROW(this->manager_.update(two, std::span(boxes).first(3)), std::invalid_argument);
  EXPECT_THROW(this->manager_.updateAll(boxes), std::invalid_argument);
  EXPECT_EQ(pairsOf(this->manager_), before);
}

TYPED_TEST(BroadphaseConformance, ManagerAgainstManager) {
  std::mt19937 random(4);
  std::size_t found = 0, most = 0;
  for (const World world : kWorlds) {
    Reference first, second;
    TypeParam manager, other;
    for (const Aabb& box : randomBoxes(random, world, 60, 2.0))
      first.boxes[manager.registerBox(box)] = box;
    for (const Aabb& box : randomBoxes(random, world, 40, 2.0))
      second.boxes[other.registerBox(box)] = box;
    Pairs expected, visited;
    for (const auto& [a, box] : first.boxes)
      for (const BoxHandle b : second.overlapping(box)) expected.emplace_back(a, b);
    EXPECT_FALSE(manager.collide(other, this->scratch_, [&](BoxHandle a, BoxHandle b) {
      visited.emplace_back(a, b);
      return false;
    }));
    EXPECT_EQ(visited, expected);
    found += expected.size();
    most += std::size_t{60} * 40;
  }
  EXPECT_GT(found, most / 50);
  EXPECT_LT(found, most / 2);
}

/// The same boxes reached on different ways: built at once; one at a time and backwards; moved in
/// small steps; teleported, with others that come and go.
TYPED_TEST(BroadphaseConformance, OrderTellsNothingOfTheHistory) {
  std::mt19937 random(5);
  for (const World world : kWorlds) {
    const std::vector<Aabb> boxes = randomBoxes(random, world, 200, 3.0);
    TypeParam atOnce, oneByOne, moved, churned;
    atOnce.registerBoxes(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) oneByOne.registerBox(cube(0, 0, 0));
    for (auto i = static_cast<BoxHandle>(boxes.size()); i-- > 0;) oneByOne.update(i, boxes[i]);
    std::vector<Aabb> start = boxes;
    moved.registerBoxes(start);
    for (int step = 20; step >= 0; --step) {
      for (std::size_t i = 0; i < boxes.size(); ++i)
        start[i] = step == 0 ? boxes[i] : shifted(boxes[i], Vector3d(0.01 * step, 0, 0));
      moved.updateAll(start);
    }
    churned.registerBoxes(randomBoxes(random, world, 300, 3.0));
    for (BoxHandle i = 0; i < 300; i += 2) churned.unregisterBox(i);
    for (BoxHandle i = 0; i < 200; i += 2) churned.registerBox(boxes[i]);
    for (BoxHandle i = 201; i < 300; i += 2) churned.unregisterBox(i);
    churned.updateAll(boxes);
    const Aabb query = cube(0.5, 0.5, 0.5);
    const Pairs pairs = pairsOf(atOnce);
    const auto near = nearestOf(atOnce, query, 50, this->scratch_);
    const auto nearPairs = nearestPairsOf<TypeParam>(atOnce, nullptr, 999, this->scratch_);
    const auto nearOthers = nearestPairsOf(atOnce, &atOnce, 999, this->scratch_);
    EXPECT_FALSE(pairs.empty());
    for (const TypeParam* same : {&oneByOne, &moved, &churned}) {
      EXPECT_EQ(pairsOf(*same), pairs);
      EXPECT_EQ(overlappingOf(*same, query, this->scratch_),
                overlappingOf(atOnce, query, this->scratch_));
      EXPECT_EQ(nearestOf(*same, query, 50, this->scratch_), near);
      EXPECT_EQ(nearestPairsOf<TypeParam>(*same, nullptr, 999, this->scratch_), nearPairs);
      EXPECT_EQ(nearestPairsOf(*same, &atOnce, 999, this->scratch_), nearOthers);
    }
  }
}

/// Shelves: boards and walls without thickness, things that stand on them side by side, and some
/// that are the same. All coordinates are multiples of 1/16 m.
std::vector<Aabb> shelves() {
  std::vector<Aabb> boxes;
  for (int level = 0; level < 8; ++level) {
    const double z = 0.25 * level;
    boxes.push_back({{0, 0, z}, {2, 0.5, z}});
    for (int thing = 0; thing < 12; ++thing) {
      const double x = 0.125 * thing, deep = 0.0625 * (thing % 3);
      boxes.push_back({{x, 0.125, z}, {x + 0.125, 0.125 + deep, z + 0.125}});
    }
  }
  for (const double x : {0.0, 2.0}) boxes.push_back({{x, 0, 0}, {x, 0.5, 2}});
  for (int same = 0; same < 40; ++same) boxes.push_back({{1, 0.25, 0.5}, {1, 0.25, 0.5}});
  return boxes;
}

/// A sweep that swaps neighbours until they are in order may go on for ever where endpoints are
/// equal.
TYPED_TEST(BroadphaseConformance, CoincidentEndpointsOfARobotWorld) {
  std::mt19937 random(6);
  std::vector<Aabb> boxes = shelves();
  std::uniform_int_distribution<std::size_t> any(0, boxes.size() - 1);
  Reference reference;
  const std::vector<BoxHandle> handles = this->manager_.registerBoxes(boxes);
  for (int step = 0; step < 200; ++step) {
    if (step % 5 == 0) boxes = shelves();  // all back
    for (int i = 0; i < 20; ++i) {
      Aabb& box = boxes[any(random)];
      box = shifted(box, (chance(random, 0.5) ? 0.0625 : -0.0625) * Vector3d::Unit(step % 3));
    }
    if (step % 2 == 0)
      this->manager_.update(handles, boxes);
    else
      this->manager_.updateAll(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) reference.boxes[handles[i]] = boxes[i];
    ASSERT_EQ(pairsOf(this->manager_), reference.pairs());
    ASSERT_GT(pairsOf(this->manager_).size(), boxes.size());
  }
  std::set<double> coordinates;
  for (const Aabb& box : boxes) coordinates.insert({box.lower.x(), box.upper.x()});
  EXPECT_LT(coordinates.size(), boxes.size() / 2);
}

}  // namespace
}  // namespace swept::test
