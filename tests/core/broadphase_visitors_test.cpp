// SPDX-License-Identifier: BSD-3-Clause
// Managers whose visitors ask again, or change what they visit, and calls whose boxes are the
// managers' own.
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "broadphase_samples.hpp"
#include "swept/core/broadphase/brute_force.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::test {
namespace {

template <typename Manager>
class BroadphaseVisitors : public ::testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(11);
    for (int i = 0; i < 60; ++i) {
      const Aabb box = randomBox(random, World::Even, 1.5);
      reference_.boxes[manager_.registerBox(box)] = box;
    }
  }

  Manager manager_;
  Reference reference_;
  BroadphaseScratch scratch_;
};

using Managers = ::testing::Types<BruteForce, SweepAndPrune>;
TYPED_TEST_SUITE(BroadphaseVisitors, Managers);

const Aabb kQuery = around({0.1, 0.2, -0.1}, Vector3d::Constant(0.9));
constexpr std::size_t kAll = 9999;

/// Everything that takes a scratch, with this one.
template <typename Manager>
void askAll(const Manager& manager, BroadphaseScratch& scratch) {
  overlappingOf(manager, around({5, 5, 5}, Vector3d::Constant(0.1)), scratch);
  nearestOf(manager, around({-9, 0, 0}, Vector3d::Constant(0.1)), 3, scratch);
  nearestPairsOf<Manager>(manager, nullptr, 7, scratch);
  nearestPairsOf(manager, &manager, 7, scratch);
}

/// A query for the nearest used to go on with what a query within it had left in the scratch.
TYPED_TEST(BroadphaseVisitors, MayAskWithTheSameScratch) {
  const auto& manager = this->manager_;
  BroadphaseScratch& scratch = this->scratch_;
  std::vector<BoxHandle> found;
  manager.collide(kQuery, scratch, [&](BoxHandle a) {
    found.push_back(a);
    askAll(manager, scratch);
    return false;
  });
  EXPECT_EQ(found, this->reference_.overlapping(kQuery));
  EXPECT_GT(found.size(), 5u);

  Pairs both, expected;
  manager.collide(manager, scratch, [&](BoxHandle a, BoxHandle b) {
    both.emplace_back(a, b);
    askAll(manager, scratch);
    return false;
  });
  for (const auto& [a, box] : this->reference_.boxes)
    for (const BoxHandle b : this->reference_.overlapping(box)) expected.emplace_back(a, b);
  EXPECT_EQ(both, expected);

  std::vector<Visit> near;
  manager.distance(kQuery, scratch, [&](BoxHandle a, double distance) {
    near.push_back({a, distance});
    askAll(manager, scratch);
    return kInfinity;
  });
  BroadphaseScratch other;
  EXPECT_EQ(near, nearestOf(manager, kQuery, kAll, other));

  for (const TypeParam* second : {static_cast<const TypeParam*>(nullptr), &manager}) {
    std::vector<PairVisit> pairs;
    const auto visit = [&](BoxHandle a, BoxHandle b, double distance) {
      pairs.push_back({distance, a, b});
      askAll(manager, scratch);
      return kInfinity;
    };
    second == nullptr ? manager.distance(scratch, visit)
                      : manager.distance(*second, scratch, visit);
    const Reference* same = second == nullptr ? nullptr : &this->reference_;
    EXPECT_EQ(pairs, nearestPairsOf(this->reference_, same, kAll));
  }
}

/// The scratch is whole again, whatever ends a visit.
TYPED_TEST(BroadphaseVisitors, MayThrow) {
  const auto& manager = this->manager_;
  EXPECT_THROW(manager.collide(kQuery, this->scratch_,
                               [](BoxHandle) -> bool { throw std::runtime_error("enough"); }),
               std::runtime_error);
  EXPECT_THROW(
      manager.distance(kQuery, this->scratch_,
                       [](BoxHandle, double) -> double { throw std::runtime_error("enough"); }),
      std::runtime_error);
  EXPECT_EQ(overlappingOf(manager, kQuery, this->scratch_), this->reference_.overlapping(kQuery));
}

template <typename Manager>
using Change = std::function<void(Manager&)>;

template <typename Manager>
std::vector<Change<Manager>> changes() {
  static const Aabb box = around({0.3, 0, 0}, Vector3d::Constant(0.2));
  return {[](Manager& manager) { manager.registerBox(box); },
          [](Manager& manager) { manager.registerBoxes(std::vector<Aabb>(40, box)); },
          [](Manager& manager) { manager.unregisterBox(30); },
          [](Manager& manager) { manager.update(3, box); },
          [](Manager& manager) {
            manager.update(std::vector<BoxHandle>{1, 2}, std::vector<Aabb>(2, box));
          },
          [](Manager& manager) { manager.updateAll(std::vector<Aabb>(manager.size(), box)); },
          [](Manager& manager) { manager = Manager(); },
          [](Manager& manager) { const Manager moved = std::move(manager); }};
}

std::string refusalOf(const std::function<void()>& visit) {
  try {
    visit();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}
constexpr const char* kRefusal = "broadphase: a visitor has changed the boxes that it visits";

/// Each way to visit, with one more thing to do at the first visit; `stop`: which then ends it.
template <typename Manager>
std::vector<std::function<void()>> visits(Manager& manager, const Manager& other,
                                          BroadphaseScratch& scratch,
                                          const std::function<void()>& act, bool stop) {
  const auto one = [&act, stop](BoxHandle) {
    act();
    return stop;
  };
  const auto two = [&act, stop](BoxHandle, BoxHandle) {
    act();
    return stop;
  };
  const auto near = [&act, stop](BoxHandle, double) {
    act();
    return stop ? -1.0 : kInfinity;
  };
  const auto nearPair = [&act, stop](BoxHandle, BoxHandle, double) {
    act();
    return stop ? -1.0 : kInfinity;
  };
  return {[&manager, two] { manager.collide(two); },
          [&manager, &scratch, one] { manager.collide(kQuery, scratch, one); },
          [&manager, &other, &scratch, two] { manager.collide(other, scratch, two); },
          [&manager, &other, &scratch, two] { other.collide(manager, scratch, two); },
          [&manager, &scratch, near] { manager.distance(kQuery, scratch, near); },
          [&manager, &scratch, nearPair] { manager.distance(scratch, nearPair); },
          [&manager, &other, &scratch, nearPair] { manager.distance(other, scratch, nearPair); },
          [&manager, &other, &scratch, nearPair] { other.distance(manager, scratch, nearPair); }};
}

/// Pairs were read where they had been before the change.
TYPED_TEST(BroadphaseVisitors, ThatChangeWhatTheyVisitAreRefused) {
  const TypeParam other = this->manager_;
  for (std::size_t which = 0; which < 8; ++which) {
    for (const Change<TypeParam>& change : changes<TypeParam>()) {
      TypeParam manager = this->manager_;
      const std::function<void()> act = [&] { change(manager); };
      EXPECT_EQ(refusalOf(visits(manager, other, this->scratch_, act, false)[which]), kRefusal)
          << which;
    }
  }
}

/// Nothing is read any more then.
TYPED_TEST(BroadphaseVisitors, ThatEndTheVisitMayChangeWhatTheyVisit) {
  const TypeParam other = this->manager_;
  for (std::size_t which = 0; which < 8; ++which) {
    for (const Change<TypeParam>& change : changes<TypeParam>()) {
      TypeParam manager = this->manager_;
      int calls = 0;
      const std::function<void()> act = [&] {
        change(manager);
        ++calls;
      };
      EXPECT_NO_THROW(visits(manager, other, this->scratch_, act, true)[which]());
      EXPECT_EQ(calls, 1);
    }
  }
  EXPECT_EQ(pairsOf(this->manager_), this->reference_.pairs());
}

/// A change of another manager, a copy too, is no one's business.
TYPED_TEST(BroadphaseVisitors, MayChangeOtherManagers) {
  TypeParam copy = this->manager_;
  Pairs found;
  this->manager_.collide([&](BoxHandle a, BoxHandle b) {
    found.emplace_back(a, b);
    if (copy.contains(a)) copy.unregisterBox(a);
    return false;
  });
  EXPECT_EQ(found, this->reference_.pairs());
}

/// Memory for one box more may lie elsewhere, and the box that is given with it.
TYPED_TEST(BroadphaseVisitors, BoxesMayBeTheManagersOwn) {
  TypeParam& manager = this->manager_;
  Reference& reference = this->reference_;
  for (BoxHandle i = 0; i < 300; ++i) {
    const Aabb box = reference.boxes[i];
    const BoxHandle handle = i % 2 == 0
                                 ? manager.registerBox(manager.box(i))
                                 : manager.registerBoxes(std::span(&manager.box(i), 1)).front();
    reference.boxes[handle] = box;
    ASSERT_EQ(manager.box(handle).lower, box.lower);
    ASSERT_EQ(manager.box(handle).upper, box.upper);
  }
  for (BoxHandle i = 0; i < 100; ++i) {
    manager.update(i, manager.box(i + 100));
    reference.boxes[i] = reference.boxes[i + 100];
  }
  EXPECT_EQ(pairsOf(manager), reference.pairs());
}

}  // namespace
}  // namespace swept::test
