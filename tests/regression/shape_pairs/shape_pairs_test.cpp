// SPDX-License-Identifier: BSD-3-Clause
// Pairs of shapes that made FCL, Coal, Drake's use of FCL and Jolt throw, hang or answer wrongly:
// EPA on faces that are nearly parallel or just touch, GJK that stops early far from the origin,
// absolute tolerances at small sizes, closed forms that forget a half-turn. Each as it was found,
// and moved, scaled and swapped: a right answer does not depend on the frame or the unit.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "shape_pair_case.hpp"

namespace swept::test {
namespace {

const std::vector<ShapePairCase>& cases() {
  static const std::vector<ShapePairCase> all = readShapePairs(SWEPT_SHAPE_PAIRS);
  return all;
}

TEST(ShapePairs, TheFileHasThemWithTheirSources) {
  std::set<std::string> ids;
  int apart = 0, overlapping = 0;
  for (const ShapePairCase& item : cases()) {
    EXPECT_TRUE(ids.insert(item.id).second) << item.id;
    EXPECT_FALSE(item.source.empty()) << item.id;
    EXPECT_GT(item.tolerance, 0.0) << item.id;
    apart += item.signedDistance > item.tolerance;
    overlapping += item.signedDistance < -item.tolerance;
  }
  EXPECT_EQ(ids.size(), 41u);
  EXPECT_GT(apart, 8);
  EXPECT_GT(overlapping, 16);
}

TEST(ShapePairs, AsFound) {
  for (const ShapePairCase& item : cases()) expectRight(item);
}

TEST(ShapePairs, FarFromTheOrigin) {
  Eigen::Isometry3d shift = Eigen::Isometry3d::Identity();
  shift.translation() = Eigen::Vector3d(1e3, -1e3, 1e3);
  for (const ShapePairCase& item : cases()) expectRight(item.moved(shift));
}

TEST(ShapePairs, InMillimetresAndKilometres) {
  for (const ShapePairCase& item : cases()) {
    expectRight(item.scaled(1e-3));
    expectRight(item.scaled(1e3));
  }
}

TEST(ShapePairs, TurnedTogether) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const ShapePairCase& item : cases()) {
    for (int i = 0; i < 20; ++i) {
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      const double w = normal(random), x = normal(random), y = normal(random);
      motion.linear() = Eigen::Quaterniond(w, x, y, normal(random)).normalized().toRotationMatrix();
      motion.translation() = Eigen::Vector3d(5.0 * x, 5.0 * y, 5.0 * w);
      expectRight(item.moved(motion));
    }
  }
}

}  // namespace
}  // namespace swept::test
