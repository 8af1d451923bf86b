// SPDX-License-Identifier: BSD-3-Clause
// What is said of two links that overlap in the default state where values cannot be drawn: those
// of planar and floating joints have no limits. Two balls that a joint could take anywhere were
// said to be in contact always.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "matrix_robots.hpp"

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

PairStatus statusOf(const std::string& joint, const CollisionMatrixOptions& options = {}) {
  const auto robot = overlapping(joint);
  const LinkPairReport report = reportOf(*robot, collisionMatrix(*robot, options), "a", "b");
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
PairStatus statusOfTurn(const std::string& limits, const Eigen::Vector3d& other) {
  const auto robot = robotOf(linkText("a", ball(0.1), other) + linkText("between", "") +
                             linkText("b", ball(0.1), {0.5, 0.0, 0.0}) +
                             jointText("j", "revolute", "a", "between", limits) +
                             jointText("rest", "fixed", "between", "b"));
  return reportOf(*robot, collisionMatrix(*robot), "a", "b").status;
}

/// However many turns a joint may do, one is all there is to look at.
TEST(CollisionMatrixLimits, ManyTurnsAreAsOne) {
  for (const std::string limits : {"-4 4", "-1e4 1e4", "-1e9 1e9", "-1e16 1e16", "3 1e16"}) {
    EXPECT_EQ(statusOfTurn(limits, Eigen::Vector3d::Zero()), PairStatus::Never) << limits;
    for (const double angle : {0.0, 1.0, 3.1, 4.5})
      EXPECT_NE(statusOfTurn(limits, 0.5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)),
                PairStatus::Never)
          << limits << " " << angle;
  }
}

TEST(CollisionMatrixLimits, TheReasonInTheSrdfSaysNoMore) {
  const auto robot = overlapping(jointText("j", "floating", "a", "between"));
  EXPECT_THAT(srdfWithPairs(*robot, collisionMatrix(*robot)),
              testing::HasSubstr(R"(link1="a" link2="b" reason="Default")"));
}

}  // namespace
}  // namespace swept
