// SPDX-License-Identifier: BSD-3-Clause
// Worlds whose endpoints coincide, and boxes that grow and shrink as links turn. A sweep that moves
// endpoints along sorted lists is easily broken by these: FCL 0.7 links an endpoint to itself when
// one end of a box moves and the other one stays or moves the other way, and then either runs
// through that list for ever or off its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "broadphase_samples.hpp"
#include "swept/core/broadphase/brute_force.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::test {
namespace {

/// Boxes of one world, and their next step.
class CoincidentWorld {
 public:
  virtual ~CoincidentWorld() = default;
  virtual void step(std::mt19937& random) = 0;
  const std::vector<Aabb>& boxes() const { return boxes_; }

 protected:
  std::vector<Aabb> boxes_;
};

/// Arms of eight links at the same base among shelves; joints turn by quarters, all coordinates are
/// multiples of 1/16 m. Every third link is a line, every fifth a plate.
class FoldedArms : public CoincidentWorld {
 public:
  explicit FoldedArms(bool rounded = false) : rounded_(rounded) {
    boxes_.assign(kArms * kLinks, {Vector3d::Zero(), Vector3d::Zero()});
    for (int level = 0; level < 6; ++level) {
      const double z = 0.25 * level - 0.5;
      boxes_.push_back({{-1, -1, z}, {1, 1, z}});
      for (int thing = 0; thing < 6; ++thing)
        boxes_.push_back({{0.25 * thing, 0, z}, {0.25 * thing + 0.25, 0.25, z + 0.25}});
    }
    place();
  }
  void step(std::mt19937& random) override {
    std::uniform_int_distribution<std::size_t> joint(0, kLinks - 1);
    std::uniform_int_distribution<int> turn(0, 3);
    const bool home = chance(random, 0.05);
    for (auto& arm : turns_) {
      if (home) arm.fill(0);  // stretched out, all in the same place
      arm[joint(random)] = turn(random);
    }
    place();
  }

 private:
  static constexpr std::size_t kArms = 6, kLinks = 8;

  Eigen::Isometry3d turned(int quarters, std::size_t joint) const {
    if (rounded_) {
      const double angle = 0.5 * 3.14159265358979323846 * (quarters - 4.0);
      const Vector3d axis = Vector3d::Unit(static_cast<int>(joint % 3));
      return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis));
    }
    const std::array<Eigen::Matrix3d, 3> quarter{Eigen::Matrix3d{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                                 Eigen::Matrix3d{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                                 Eigen::Matrix3d{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < quarters; ++i) pose.rotate(quarter[joint % 3]);
    return pose;
  }
  void place() {
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      for (std::size_t link = 0; link < kLinks; ++link) {
        pose = pose * turned(turns_[arm][link], link);
        const Vector3d half(0.125, link % 3 == 0 ? 0.0 : 0.0625, link % 5 < 3 ? 0.0 : 0.0625);
        const Vector3d extent = pose.linear().cwiseAbs() * half;
        boxes_[arm * kLinks + link] = around(pose * Vector3d(0.125, 0.0, 0.0), extent);
        pose.translate(Vector3d(0.25, 0.0, 0.0));
      }
    }
  }

  bool rounded_;
  std::array<std::array<int, kLinks>, kArms> turns_{};
};

/// The same but for the rounding of sines and cosines.
class NearlyFoldedArms : public FoldedArms {
 public:
  NearlyFoldedArms() : FoldedArms(true) {}
};

/// All boxes the same, but for those that are a step ahead; they grow, shrink to a point, and move.
class AllTheSame : public CoincidentWorld {
 public:
  AllTheSame() { boxes_.assign(60, {Vector3d::Zero(), Vector3d::Ones()}); }
  void step(std::mt19937& random) override {
    const Aabb now = boxes_.front();
    const int kind = std::uniform_int_distribution<int>(0, 3)(random);
    const Vector3d by = 0.5 * Vector3d::Unit(kind % 3);
    Aabb next = shifted(now, by);
    if (kind == 1) next = {now.lower - by, now.upper + by};
    if (kind == 2) next = {now.lower, now.lower};
    if (kind == 3) next = {Vector3d::Zero(), Vector3d::Ones()};
    const double share = chance(random, 0.3) ? 1.0 : uniform(random, 0.0, 1.0);
    for (Aabb& box : boxes_) box = chance(random, share) ? next : now;
  }
};

/// Cells of a grid, whose neighbours touch; they move by cells, halve and double.
class TouchingGrid : public CoincidentWorld {
 public:
  TouchingGrid() {
    for (int i = 0; i < 125; ++i) {
      const int y = i / 5 % 5, z = i / 25;
      const Vector3d lower(i % 5, y, z);
      boxes_.push_back({lower, lower + Vector3d::Ones()});
    }
    home_ = boxes_;
  }
  void step(std::mt19937& random) override {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      Aabb& box = boxes_[i];
      const int kind = std::uniform_int_distribution<int>(0, 9)(random);
      const Vector3d axis = Vector3d::Unit(kind % 3);
      if (kind < 3) box = shifted(box, (i % 2 == 0 ? 1.0 : -1.0) * axis);
      if (kind == 4) box.lower = 0.5 * (box.lower + box.upper);
      if (kind == 5) box.upper += box.upper - box.lower;
      if (kind > 6) box = home_[i];
    }
  }

 private:
  std::vector<Aabb> home_;
};

/// Endpoints at zero, of either sign, and the least numbers next to it.
class SignedZeros : public CoincidentWorld {
 public:
  SignedZeros() { boxes_.assign(60, {Vector3d::Zero(), Vector3d::Zero()}); }
  void step(std::mt19937& random) override {
    constexpr std::array kValues{-1.0, -5e-324, -0.0, 0.0, 5e-324, 1.0};
    std::uniform_int_distribution<std::size_t> any(0, kValues.size() - 1);
    for (Aabb& box : boxes_) {
      if (chance(random, 0.5)) continue;
      for (int k = 0; k < 3; ++k) {
        const double a = kValues[any(random)], b = kValues[any(random)];
        box.lower[k] = std::min(a, b);
        // Also -0.0 above 0.0.
        box.upper[k] = a == b && a == 0.0 && chance(random, 0.5) ? -box.lower[k] : std::max(a, b);
      }
    }
  }
};

/// Part of the coordinates that another box has too.
double shared(const std::vector<Aabb>& boxes) {
  std::size_t different = 0;
  for (int k = 0; k < 3; ++k) {
    std::set<double> coordinates;
    for (const Aabb& box : boxes) coordinates.insert({box.lower[k], box.upper[k]});
    different += coordinates.size();
  }
  return 1.0 - static_cast<double>(different) / (6.0 * static_cast<double>(boxes.size()));
}

/// Tells a manager about what changed: all at once, those that changed, or one by one.
void follow(SweepAndPrune& manager, const std::vector<Aabb>& before, const std::vector<Aabb>& boxes,
            int how) {
  std::vector<BoxHandle> handles;
  std::vector<Aabb> changed;
  for (BoxHandle i = 0; i < boxes.size(); ++i) {
    if (before[i].lower == boxes[i].lower && before[i].upper == boxes[i].upper) continue;
    handles.push_back(i);
    changed.push_back(boxes[i]);
  }
  if (how == 0) return manager.updateAll(boxes);
  if (how == 1) return manager.update(handles, changed);
  for (std::size_t i = 0; i < handles.size(); ++i) manager.update(handles[i], changed[i]);
}

template <typename World>
class CoincidentEndpoints : public ::testing::Test {};
using Worlds =
    ::testing::Types<FoldedArms, NearlyFoldedArms, AllTheSame, TouchingGrid, SignedZeros>;
TYPED_TEST_SUITE(CoincidentEndpoints, Worlds);

TYPED_TEST(CoincidentEndpoints, AgreesWithAllPairs) {
  constexpr int kSteps = 600;
  TypeParam world;
  std::mt19937 random(1);
  SweepAndPrune manager;
  BruteForce reference;
  manager.registerBoxes(world.boxes());
  reference.registerBoxes(world.boxes());
  BroadphaseScratch scratch;
  std::size_t pairs = 0, changes = 0;
  Pairs last;
  double coincident = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Aabb> before = world.boxes();
    world.step(random);
    const std::vector<Aabb>& boxes = world.boxes();
    follow(manager, before, boxes, step % 3);
    reference.updateAll(boxes);
    const Pairs expected = pairsOf(reference);
    ASSERT_EQ(pairsOf(manager), expected) << "step " << step;
    pairs += expected.size();
    changes += expected != last ? 1 : 0;
    last = expected;
    coincident += shared(boxes);
    if (step % 7 != 0) continue;
    const Aabb query = boxes[static_cast<std::size_t>(step) % boxes.size()];
    ASSERT_EQ(overlappingOf(manager, query, scratch), overlappingOf(reference, query, scratch));
    ASSERT_EQ(nearestOf(manager, query, 40, scratch), nearestOf(reference, query, 40, scratch));
    ASSERT_EQ(nearestPairsOf<SweepAndPrune>(manager, nullptr, 2000, scratch),
              nearestPairsOf<BruteForce>(reference, nullptr, 2000, scratch));
  }
  const auto count = static_cast<double>(world.boxes().size());
  EXPECT_GT(static_cast<double>(pairs), 0.5 * kSteps * count);
  EXPECT_GT(changes, kSteps / 6);
  // What ought to coincide with the nearly folded ones mostly differs by roundings.
  constexpr bool kRounded = std::is_same_v<TypeParam, NearlyFoldedArms>;
  EXPECT_GT(coincident / kSteps, kRounded ? 0.4 : 0.7);
}

/// The smallest of the histories that FCL's sweep does not come back from: a box grows to both
/// sides, and then moves on past another.
TEST(SweepAndPruneUpdate, ABoxGrowsAndMovesOn) {
  const Aabb cell{Vector3d::Zero(), Vector3d::Ones()};
  SweepAndPrune manager;
  manager.registerBoxes(
      std::vector<Aabb>{cell, shifted(cell, Vector3d(2, 0, 0)), shifted(cell, Vector3d(-2, 0, 0))});
  EXPECT_EQ(pairsOf(manager), Pairs{});
  manager.update(0, {{-1, -1, -1}, {2, 2, 2}});
  EXPECT_EQ(pairsOf(manager), (Pairs{{0, 1}, {0, 2}}));
  manager.update(0, shifted(cell, Vector3d(-2, 0, 0)));
  EXPECT_EQ(pairsOf(manager), (Pairs{{0, 2}}));
  manager.update(0, {{1, 0, 0}, {1, 1, 1}});  // shrinks from below to a plate
  EXPECT_EQ(pairsOf(manager), Pairs{});
  manager.update(0, {{2, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(pairsOf(manager), (Pairs{{0, 1}}));
}

}  // namespace
}  // namespace swept::test
