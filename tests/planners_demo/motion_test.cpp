// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST(Motion, ThroughThePostIsACollisionWithItsFirstContact) {
  const Gantry gantry;
  const Outcome run = gantry.run("motion", {"left", "right"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("state 1 (left) to state 2 (right): collision\n"));
  EXPECT_THAT(run.out, ContainsRegex("contact +t = 0\\.40[0-9]*, cube - post: distance 0 m, at"));

  // By hand: contact begins at slide = 0.8, which is t = 0.4 of 2 m.
  const auto json = jsonOf(gantry.run("motion", {"left", "right", "--json"}));
  const auto& segment = json["segments"][0];
  EXPECT_EQ(segment["verdict"], "collision");
  EXPECT_LE(segment["free_until"], 0.4);
  EXPECT_GE(segment["free_until"], 0.4 - 1e-3);
  EXPECT_GE(segment["witness"]["t"], 0.4 - 1e-9);
  EXPECT_LE(segment["witness"]["t"], 0.4 + 1e-3);
  EXPECT_TRUE(segment["clearance"].is_null());
  EXPECT_TRUE(segment["undecided_at"].is_null());
  EXPECT_GE(segment["effort"]["intervals"], 1);
}

TEST(Motion, AFreeMotionHasItsLeastClearance) {
  const Gantry gantry;
  const std::array from{-0.3, 0.9}, to{2.2, 0.5};
  const Outcome run = gantry.run("motion", {"-0.3,0.9", "2.2,0.5", "--json"});
  EXPECT_EQ(run.exitCode, 0);
  const auto segment = jsonOf(run)["segments"][0];
  const double least = Gantry::leastDistance(from, to);
  EXPECT_EQ(segment["verdict"], "free");
  EXPECT_EQ(segment["free_until"], 1.0);
  EXPECT_TRUE(segment["witness"].is_null());
  EXPECT_LE(segment["clearance"]["lower"], least);
  EXPECT_GE(segment["clearance"]["upper"], least - 1e-9);
  const double width =
      segment["clearance"]["upper"].get<double>() - segment["clearance"]["lower"].get<double>();
  EXPECT_LE(width, 1e-4 + 1e-12);
}

TEST(Motion, SeveralStatesAreConsecutiveMotions) {
  const Gantry gantry;
  const Outcome over = gantry.run("motion", {"left", "0,1", "2,1", "right"});
  EXPECT_EQ(over.exitCode, 0) << over.out;
  EXPECT_THAT(over.out, HasSubstr("state 1 (left) to state 2: free\n"));
  EXPECT_THAT(over.out, HasSubstr("state 3 to state 4 (right): free\n"));
  const Outcome through = gantry.run("motion", {"left", "0,1", "1,0", "right"});
  EXPECT_EQ(through.exitCode, 1);
  EXPECT_THAT(through.out, HasSubstr("state 1 (left) to state 2: free\n"));
  EXPECT_THAT(through.out, HasSubstr("state 2 to state 3: collision\n"));
}

/// The gap is more than what two points may differ by and still be one, and less than what the
/// poses may be rounded by.
TEST(Motion, GrazingWithinRoundingIsUndecided) {
  const Gantry gantry;
  const Outcome run = gantry.run("motion", {"0,0.20000000000001", "2,0.20000000000001"});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(run.out, ContainsRegex("undecided +t = 0\\.[0-9]+\n"));
  EXPECT_THAT(run.out, Not(HasSubstr("contact")));
  const auto segment = jsonOf(
      gantry.run("motion", {"0,0.20000000000001", "2,0.20000000000001", "--json"}))["segments"][0];
  EXPECT_EQ(segment["verdict"], "undecided");
  EXPECT_GE(segment["undecided_at"], 0.39);
  EXPECT_LE(segment["undecided_at"], 0.61);
}

TEST(Motion, TheToleranceIsResolutionComplete) {
  const Gantry gantry;
  // 2e-5 m above the post: more than the tolerance, so it must be decided.
  EXPECT_EQ(gantry.run("motion", {"0,0.20002", "2,0.20002", "--tolerance", "1e-5"}).exitCode, 0);
  EXPECT_EQ(gantry.run("motion", {"0,0.25", "2,0.25", "--margin", "0.04"}).exitCode, 0);
  EXPECT_EQ(gantry.run("motion", {"0,0.25", "2,0.25", "--margin", "0.06"}).exitCode, 1);
}

TEST(Motion, ASingleStateIsNotAMotion) {
  const Gantry gantry;
  const Outcome run = gantry.run("motion", {"left"});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "swept: error: motion: two states or more are needed\n");
}

}  // namespace
}  // namespace swept::test
