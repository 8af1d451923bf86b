// SPDX-License-Identifier: BSD-3-Clause
// Obstacles that come from up to 1e9 m away, by clocks that count from as far back: nothing is free
// that is not, and no more is lost of what is free than 1e-12 of that, and of others nothing. A
// state in contact was free by 2e-11 m while an obstacle passed that came from 1e6 m away.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "far_values.hpp"

namespace swept::far_test {
namespace {

MovingObstacle shuttle(double far, double begin, double end) {
  MovingObstacle obstacle{.name = "shuttle",
                          .parts = {{makeSphere(kRadius), Eigen::Isometry3d::Identity()}}};
  for (const auto& [time, x] : {std::pair{begin, -far}, std::pair{end, far}})
    obstacle.waypoints.push_back({time, Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0))});
  return obstacle;
}

/// A ball at rest beside an obstacle that comes from `far` and goes as far.
struct Passing {
  explicit Passing(Random& random) : far(random.scale(1.0, 1e9)) {
    // Half of them by clocks that count from far back, half as they pass the middle.
    const bool middle = random.chance(0.5);
    begin = middle ? -random.scale(1.0, 1e3) : random.scale(1.0, 1e9);
    end = middle ? random.scale(1.0, 1e3) : begin + random.scale(1.0, 1e3);
    const double share = middle ? 0.5 + random.uniform(-0.4, 0.4) / far : random.uniform(0.3, 0.7);
    time = begin + share * (end - begin);
    const Digits exact = (Digits(time) - Digits(begin)) / (Digits(end) - Digits(begin));
    x = Digits(-far) + exact * 2 * Digits(far);
    slide = static_cast<double>(x + Digits(2.0 * kRadius + someGap(random, far)));
    gap = abs(Digits(slide) - x) - 2 * Digits(kRadius);
  }

  double far;               ///< m
  double begin, end, time;  ///< s
  double slide = 0.0;       ///< m, of the ball at rest
  Digits x, gap;            ///< m, of the obstacle, and between the two
};

TEST(FarObstacles, AndClocksLoseWhatTheyRound) {
  Random random(7);
  const auto robot = robotOf(ball("tip") + joint("j", "prismatic", "base", "tip", wide("1 0 0")));
  int touching = 0, apart = 0, near = 0;
  for (int round = 0; round < 600 && !HasFailure(); ++round) {
    const Passing passing(random);
    World world;
    world.add(shuttle(passing.far, passing.begin, passing.end));
    const Checker checker(robot, "all", std::make_shared<const World>(std::move(world)));
    Workspace workspace(checker);
    const std::vector<double> q{passing.slide, passing.time};
    const double loss = kLoss * passing.far + kIterations;
    const Verdict verdict = checker.checkState(q, workspace);
    SCOPED_TRACE(testing::Message() << passing.gap << " m, waypoints at " << passing.far);
    if (passing.gap <= 0) {
      EXPECT_NE(verdict, Verdict::Free);
    } else if (passing.gap > loss) {
      EXPECT_EQ(verdict, Verdict::Free);
    }
    touching += passing.gap <= 0 ? 1 : 0;
    apart += passing.gap > loss ? 1 : 0;
    near += passing.gap <= 0 && std::abs(passing.slide) < 1e-3 * passing.far ? 1 : 0;
    const auto gap = static_cast<double>(passing.gap);
    EXPECT_LE(checker.clearance(q, workspace), std::max(0.0, gap) * (1.0 + 1e-12));
    EXPECT_GE(checker.clearance(q, workspace), gap - loss);
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 150);
  EXPECT_GT(near, 50);
}

/// What one branch or obstacle does far away is nothing to the others.
TEST(FarObstacles, AreNothingToOthers) {
  const std::string near =
      ball("tip") + joint("j", "prismatic", "base", "tip", wide("1 0 0")) + "<link name='wheel'/>" +
      joint("w", "continuous", "base", "wheel", "<axis xyz='0 0 1'/>") + ball("crane", "0 9 0") +
      joint("c", "prismatic", "base", "crane", wide("0 1 0"));
  for (const double far : {1e3, 1e6, 1e9, 1e12}) {
    World world;
    MovingObstacle moon = shuttle(1.0, 0.0, 1.0);
    for (auto& waypoint : moon.waypoints) waypoint.world_from_body.translation().z() = far;
    world.add(moon);
    world.add("ball", makeSphere(kRadius),
              Eigen::Isometry3d(Eigen::Translation3d(2.0 * kRadius + 1e-3 + 1e-6, 0.0, 0.0)));
    const Checker checker(robotOf(near), "all", std::make_shared<const World>(std::move(world)));
    Workspace workspace(checker);
    const std::vector<double> q{0.0, far, far, 0.5}, from{-0.5, far - 1.0, far, 0.1};
    EXPECT_NEAR(checker.clearance(q, workspace), 1e-3 + 1e-6, kIterations) << far;
    EXPECT_EQ(checker.checkState(q, workspace), Verdict::Free) << far;
    EXPECT_EQ(checker.certifyMotion(from, q, workspace).verdict, Verdict::Free) << far;
  }
}

}  // namespace
}  // namespace swept::far_test
