// SPDX-License-Identifier: BSD-3-Clause
// What is said of two links that overlap in the default state where values cannot be drawn: those
// of planar and floating joints have no limits. Two balls that a joint could take anywhere were
// said to be in contact always.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(CollisionMatrixLimits, TheReasonInTheSrdfSaysNoMore) {
  const auto robot = overlapping(jointText("j", "floating", "a", "between"));
  EXPECT_THAT(srdfWithPairs(*robot, collisionMatrix(*robot)),
              testing::HasSubstr(R"(link1="a" link2="b" reason="Default")"));
}

}  // namespace
}  // namespace swept
