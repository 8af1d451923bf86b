// SPDX-License-Identifier: BSD-3-Clause
// Bounds relative to all ancestors together against those that are found one by one: never less,
// or the exact tier would prove what is not so, and hardly more.
#include "kinematics/nested_motion_bounds.hpp"

#include <gtest/gtest.h>

#include "simd_robots.hpp"

namespace swept::simd_test {
namespace {

using enum JointType;

detail::CheckerModel randomChain(Random& random) {
  ChainOptions options;
  const JointType first[] = {Revolute, Floating, Planar};
  options.types.push_back(first[random.below(3)]);
  const int joints = 1 + random.below(random.chance(0.2) ? 150 : 12);
  for (int i = 0; i < joints; ++i)
    options.types.push_back(std::array{Revolute, Continuous, Revolute, Prismatic}[random.below(4)]);
  options.link = random.scale(1e-3, 1e2);
  options.squared = random.uniform(0.0, 1.0);
  options.straight = random.chance(0.2);
  return robotOf(random, options);
}

TEST(NestedTravels, AreNeverLessAndHardlyMoreThanOneByOne) {
  Random random(71);
  int compared = 0, equal = 0, relative = 0;
  double sum = 0.0;
  for (int round = 0; round < 600; ++round) {
    const detail::CheckerModel model = randomChain(random);
    const double turn = random.scale(0.01, 20.0);
    const auto from = configuration(random, model.kinematics, turn, 1.0);
    const auto to = random.chance(0.9) ? configuration(random, model.kinematics, turn, 1.0) : from;
    std::vector<detail::JointMotion> motion(model.kinematics.bodies.size());
    if (!detail::compileMotion(model.kinematics, from, to, motion)) continue;
    for (int i = 0; i < 4; ++i) {
      const auto& levers =
          model.robotGeometry[random.below(static_cast<int>(model.robotGeometry.size()))].levers;
      std::vector<detail::PointMotionBound> all(levers.path.size() + 1);
      detail::nestedMotionBounds(model.kinematics, levers.path, levers.arms, motion, all);
      for (std::size_t first = 0; first <= levers.path.size(); ++first) {
        const detail::PointMotionBound one =
            detail::pointMotionBound(model.kinematics, levers.path, levers.arms, first, motion);
        ASSERT_GE(all[first].speed, one.speed * (1.0 - 1e-12)) << "round " << round;
        ASSERT_LE(all[first].speed, one.speed * (1.0 + 1e-9));
        ASSERT_GE(all[first].acceleration, one.acceleration * (1.0 - 1e-12))
            << "round " << round << ", relative to joint " << first;
        if (!(one.acceleration > 0.0)) continue;
        const double ratio = all[first].acceleration / one.acceleration;
        ASSERT_LE(ratio, 2.0);
        ++compared;
        sum += ratio;
        relative += first > 0 ? 1 : 0;
        equal += ratio < 1.0 + 1e-9 ? 1 : 0;
      }
    }
  }
  RecordProperty("mean ratio", std::to_string(sum / compared));
  EXPECT_GT(compared, 5000);
  EXPECT_GT(relative, compared / 2);
  EXPECT_GT(equal, compared / 10);
  EXPECT_LT(equal, compared);
  EXPECT_LT(sum / compared, 1.1);
}

}  // namespace
}  // namespace swept::simd_test
