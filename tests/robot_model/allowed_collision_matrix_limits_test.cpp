// SPDX-License-Identifier: BSD-3-Clause
// What is said of two links that overlap in the default state where values cannot be drawn: those
// of planar and floating joints have no limits. Two balls that a joint could take anywhere were
// said to be in contact always.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "matrix_robots.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using matrix_test::ball;
using matrix_test::jointText;
using matrix_test::linkText;
using matrix_test::reportOf;
using matrix_test::robotOf;

/// Two balls of 0.1 m, one in the other; the empty link between keeps them from being adjacent.
std::shared_ptr<const Robot> overlapping(const std::string& joint) {
  return robotOf(linkText("a", ball(0.1)) + linkText("between", "") + linkText("b", ball(0.1)) +
                 joint + jointText("rest", "fixed", "between", "b"));
}

PairStatus statusOf(const std::string& joint, const AllowedCollisionMatrixOptions& options = {}) {
  const auto robot = overlapping(joint);
  const LinkPairReport report =
      reportOf(*robot, computeAllowedCollisionMatrix(*robot, options), "a", "b");
  EXPECT_TRUE(report.witness);
  return report.status;
}

TEST(CollisionMatrixLimits, WhatCannotBeSampledIsNotAlwaysInContact) {
  EXPECT_EQ(statusOf(jointText("j", "floating", "a", "between")), PairStatus::Default);
  EXPECT_EQ(statusOf(jointText("j", "planar", "a", "between")), PairStatus::Default);
}

TEST(CollisionMatrixLimits, SamplesInContactSuggestAlways) {
  const std::string within = jointText("j", "prismatic", "a", "between", "-0.05 0.05");
  EXPECT_EQ(statusOf(within), PairStatus::Always);
  EXPECT_EQ(statusOf(within, {.samples = 0}), PairStatus::Default);
  EXPECT_EQ(statusOf(jointText("j", "prismatic", "a", "between", "-1 1")), PairStatus::Default);
}

TEST(CollisionMatrixLimits, RigidlyAttachedLinksNeedNoSamples) {
  EXPECT_EQ(statusOf(jointText("j", "fixed", "a", "between"), {.samples = 0}), PairStatus::Always);
}

/// A ball that turns about an axis 0.5 m away, beside one that is in its way or is not.
std::shared_ptr<const Robot> turningBall(const std::string& limits, const Eigen::Vector3d& other) {
  return robotOf(linkText("a", ball(0.1), other) + linkText("between", "") +
                 linkText("b", ball(0.1), {0.5, 0.0, 0.0}) +
                 jointText("j", "revolute", "a", "between", limits) +
                 jointText("rest", "fixed", "between", "b"));
}

PairStatus statusOfTurn(const std::string& limits, const Eigen::Vector3d& other) {
  const auto robot = turningBall(limits, other);
  return reportOf(*robot, computeAllowedCollisionMatrix(*robot), "a", "b").status;
}

const std::vector<std::string> kManyTurns{"-4 4",     "-1e4 1e4",  "-1e9 1e9",     "-1e16 1e16",
                                          "3 1e16",   "-2000 -10", "-1e6 -900",    "-1e16 -3",
                                          "2000 1e4", "-990 -10",  "-1001 -990.5", "1000.5 1010"};

/// However many turns a joint may do, one is all there is to look at.
TEST(CollisionMatrixLimits, ManyTurnsAreAsOne) {
  for (const std::string& limits : kManyTurns) {
    EXPECT_EQ(statusOfTurn(limits, Eigen::Vector3d::Zero()), PairStatus::Never) << limits;
    for (const double angle : {0.0, 1.0, 3.1, 4.5})
      EXPECT_NE(statusOfTurn(limits, 0.5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)),
                PairStatus::Never)
          << limits << " " << angle;
  }
}

/// A box of values whose lower end was one turn's and whose upper one the limit, below that, had no
/// values, and so whatever was asked of it was proven.
TEST(CollisionMatrixLimits, WhatMeetsAfterManyTurnsIsACollision) {
  for (const std::string& limits : kManyTurns) {
    const auto robot = turningBall(limits, {-0.5, 0.0, 0.0});
    const Checker checker(robot, "all", std::make_shared<const World>());
    Workspace workspace(checker);
    EXPECT_EQ(checker.explain("a", "b"), "a - b: checked, keeps more than 0 m") << limits;
    const Variable& joint = robot->variables().front();
    // Half a turn and whole ones; near the upper limit, and where that is known to 1e-6 rad.
    const double most = std::min(joint.upper, 1e6);
    double q = (2.0 * std::floor((most / M_PI - 1.0) / 2.0) + 1.0) * M_PI;
    if (q < joint.lower) q = joint.lower > 0.0 ? q + 2.0 * M_PI : q;
    ASSERT_TRUE(checker.withinLimits(std::vector{q})) << limits << " " << q;
    EXPECT_EQ(checker.checkState(std::vector{q}, workspace), Verdict::Collision) << limits;
    const auto motion = checker.certifyMotion(std::vector{q - 1e-3}, std::vector{q}, workspace);
    EXPECT_EQ(motion.verdict, Verdict::Collision) << limits;
  }
}

TEST(CollisionMatrixLimits, TheReasonInTheSrdfSaysNoMore) {
  const auto robot = overlapping(jointText("j", "floating", "a", "between"));
  EXPECT_THAT(srdfWithPairs(*robot, computeAllowedCollisionMatrix(*robot)),
              testing::HasSubstr(R"(link1="a" link2="b" reason="Default")"));
}

}  // namespace
}  // namespace swept
