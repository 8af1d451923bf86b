// SPDX-License-Identifier: BSD-3-Clause
// How wide the limits of a robot's joints are says nothing about a motion within them: verdicts,
// where it is free until, and clearances are the same with limits of 1 m or rad and of 1e16.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "wide_robots.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using wide_test::families;
using wide_test::Family;

const std::vector<double> kLimits{1.0, 1e1, 1e3, 1e6, 1e9, 1e11, 1e12, 1e14, 1e16};
std::shared_ptr<const World> someWorld() {
  auto world = std::make_shared<World>();
  world->add("ball", makeSphere(0.1), Isometry3d(Eigen::Translation3d(0.55, 0.35, 0.1)));
  world->add("post", makeCylinder(0.05, 0.8), Isometry3d(Eigen::Translation3d(0.3, -0.6, 0.0)));
  world->add("shelf", makeBox({0.5, 0.5, 0.05}), Isometry3d(Eigen::Translation3d(0.6, 0.0, -0.4)));
  return world;
}

Checker checkerFor(const Family& family, double limit, const std::shared_ptr<const World>& world,
                   int maxIntervals) {
  CheckerOptions options;
  options.maxIntervals = maxIntervals;
  return {Robot::parse("<robot name='r'>" + family.text(limit) + "</robot>", "r.urdf"), "all",
          world, options};
}

struct Motion {
  std::vector<double> from, to;
};

std::vector<Motion> someMotions(std::size_t dimension, int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-0.9, 0.9);
  std::vector<Motion> motions(count);
  for (Motion& motion : motions) {
    for (std::vector<double>* q : {&motion.from, &motion.to})
      for (std::size_t i = 0; i < dimension; ++i) q->push_back(value(random));
  }
  return motions;
}

struct Counts {
  int free = 0, collisions = 0, stops = 0;
};

void expectSameMotion(const Checker& narrow, const Checker& wide, const Motion& motion,
                      Counts& counts) {
  Workspace first(narrow), second(wide);
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
    const auto known = narrow.certifyMotion(motion.from, motion.to, first, query);
    const auto found = wide.certifyMotion(motion.from, motion.to, second, query);
    ASSERT_EQ(found.verdict, known.verdict);
    // A millimetre, the tolerance, takes longer than this.
    ASSERT_NEAR(found.freeUntil, known.freeUntil, 2e-3);
    counts.free += known.verdict == Verdict::Free ? 1 : 0;
    counts.collisions += known.verdict == Verdict::Collision ? 1 : 0;
    counts.stops += known.freeUntil > 0.0 && known.freeUntil < 1.0 ? 1 : 0;
  }
  const MotionClearance known = narrow.motionClearance(motion.from, motion.to, 1e-3, first);
  const MotionClearance found = wide.motionClearance(motion.from, motion.to, 1e-3, second);
  ASSERT_NEAR(found.lower, known.lower, 1.001e-3);
}

void expectSameStates(const Checker& narrow, const Checker& wide, const std::vector<double>& states,
                      Counts& counts) {
  Workspace first(narrow), second(wide);
  const auto dimension = static_cast<std::size_t>(narrow.dimension());
  const std::size_t count = states.size() / dimension;
  std::vector<Verdict> known(count), found(count);
  narrow.checkStates(states, known, first);
  wide.checkStates(states, found, second);
  ASSERT_EQ(found, known);
  for (std::size_t i = 0; i < count; ++i) {
    const auto q = std::span(states).subspan(i * dimension, dimension);
    ASSERT_EQ(wide.checkState(q, second), known[i]);
    ASSERT_EQ(wide.reportState(q, second).verdict, known[i]);
    ASSERT_NEAR(wide.clearance(q, second), narrow.clearance(q, first), 2e-9);
    ASSERT_NEAR(wide.signedClearance(q, second).lower, narrow.signedClearance(q, first).lower,
                2e-9);
    counts.free += known[i] == Verdict::Free ? 1 : 0;
    counts.collisions += known[i] == Verdict::Collision ? 1 : 0;
  }
}

/// With 4 intervals the lanes are not asked, and most motions stay undecided: the same ones.
TEST(WideLimits, SayNothingAboutMotions) {
  const auto world = someWorld();
  for (const int maxIntervals : {4, 1 << 20}) {
    Counts all;
    for (const Family& family : families()) {
      const std::vector<Motion> motions = someMotions(family.dimension, 40);
      const Checker narrow = checkerFor(family, kLimits.front(), world, maxIntervals);
      for (const double limit : kLimits) {
        const Checker wide = checkerFor(family, limit, world, maxIntervals);
        for (std::size_t i = 0; i < motions.size(); ++i) {
          SCOPED_TRACE(testing::Message() << family.name << " within " << limit << ", motion " << i
                                          << ", " << maxIntervals << " intervals");
          expectSameMotion(narrow, wide, motions[i], all);
          if (HasFatalFailure()) return;
        }
      }
    }
    EXPECT_GT(all.free, 1000) << maxIntervals;
    EXPECT_GT(all.collisions, 1000) << maxIntervals;
    EXPECT_GT(all.stops, maxIntervals > 4 ? 500 : 0);
  }
}

TEST(WideLimits, SayNothingAboutStates) {
  const auto world = someWorld();
  Counts all;
  for (const Family& family : families()) {
    std::vector<double> states;
    for (const Motion& motion : someMotions(family.dimension, 25))
      states.insert(states.end(), motion.to.begin(), motion.to.end());
    const Checker narrow = checkerFor(family, kLimits.front(), world, 1 << 20);
    for (const double limit : kLimits) {
      SCOPED_TRACE(testing::Message() << family.name << " within " << limit);
      expectSameStates(narrow, checkerFor(family, limit, world, 1 << 20), states, all);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(all.free, 500);
  EXPECT_GT(all.collisions, 200);
}

/// A ball that slides to within `gap` of another one is free if that is more than the tolerance,
/// whatever its limits, and a state if it is more than a double rounds.
TEST(WideLimits, WhatKeepsTheToleranceIsFree) {
  constexpr double kRadius = 0.1, kNear = 0.0625;
  const Family slide = families().front();
  for (const double limit : kLimits) {
    for (const double gap : {1e-3 + 1e-9, 2e-3, 0.05}) {
      auto world = std::make_shared<World>();
      world->add("ball", makeSphere(kRadius),
                 Isometry3d(Eigen::Translation3d(kNear + 2.0 * kRadius + gap, 0.0, 0.0)));
      for (const int maxIntervals : {1000, 1 << 20}) {
        const Checker checker = checkerFor(slide, limit, world, maxIntervals);
        Workspace workspace(checker);
        for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
          const auto found =
              checker.certifyMotion(std::vector{-0.5}, std::vector{kNear}, workspace, query);
          EXPECT_EQ(found.verdict, Verdict::Free) << limit << " " << gap;
          EXPECT_EQ(found.freeUntil, 1.0) << limit << " " << gap;
        }
        EXPECT_NEAR(checker.clearance(std::vector{kNear}, workspace), gap, 2e-9) << limit;
        EXPECT_NEAR(
            checker.motionClearance(std::vector{-0.5}, std::vector{kNear}, 1e-6, workspace).lower,
            gap, 1.1e-6)
            << limit;
      }
    }
    // To the limit itself and back, on a way that rounds: by centimetres at 1e12 m.
    if (limit > 1e12) continue;
    const Checker checker = checkerFor(slide, limit, someWorld(), 1 << 20);
    Workspace workspace(checker);
    const auto found =
        checker.certifyMotion(std::vector{-0.1}, std::vector{-limit}, workspace).verdict;
    EXPECT_EQ(found, Verdict::Free) << limit;
    EXPECT_EQ(checker.certifyMotion(std::vector{-limit}, std::vector{-0.1}, workspace).verdict,
              Verdict::Free)
        << limit;
  }
}

TEST(WideLimits, AttachedBodiesAreAsFree) {
  const auto world = someWorld();
  const Family arm = families()[3];
  AttachedBody load{.name = "load", .link = "l2"};
  load.parts = {{makeSphere(0.07), Isometry3d(Eigen::Translation3d(0.4, 0.0, 0.1))}};
  const Checker narrow = checkerFor(arm, 1.0, world, 1 << 20).withAttached(load);
  Counts all;
  for (const double limit : kLimits) {
    const Checker wide = checkerFor(arm, limit, world, 1 << 20).withAttached(load);
    for (const Motion& motion : someMotions(arm.dimension, 20)) {
      SCOPED_TRACE(limit);
      expectSameMotion(narrow, wide, motion, all);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(all.free, 50);
  EXPECT_GT(all.collisions, 50);
}

TEST(WideLimits, SayNothingAboutTheMotionOfALink) {
  for (const Family& family : families()) {
    for (const Motion& motion : someMotions(family.dimension, 5)) {
      const auto of = [&](double limit) {
        const auto robot =
            Robot::parse("<robot name='r'>" + family.text(limit) + "</robot>", "r.urdf");
        return LinkMotion(*robot, "all", robot->links().back().name, motion.from, motion.to);
      };
      const LinkMotion narrow = of(1.0);
      for (const double limit : kLimits) {
        const LinkMotion wide = of(limit);
        EXPECT_EQ(wide.rounding(1.0), narrow.rounding(1.0)) << family.name << " " << limit;
        EXPECT_EQ(wide.rates(0.0, 1.0).speed, narrow.rates(0.0, 1.0).speed) << family.name;
        EXPECT_EQ(wide.rates(0.0, 1.0).acceleration, narrow.rates(0.0, 1.0).acceleration);
        EXPECT_LT(wide.rounding(1.0), 1e-11);
      }
    }
  }
}

}  // namespace
}  // namespace swept
