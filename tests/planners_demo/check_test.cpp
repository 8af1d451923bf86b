// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;

TEST(Check, AFreeStateHasItsClearance) {
  const Gantry gantry;
  const Outcome run = gantry.run("check", {"left"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out,
            "state 1 (left): free, clearance 0.8 m, nearest cube - post (world); "
            "self: no pair to check\n");
}

TEST(Check, ACollisionHasItsContacts) {
  const Gantry gantry;
  const Outcome run = gantry.run("check", {"1,0.1"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("state 1: collision\n  cube - post: distance 0 m, at ["));
}

TEST(Check, WithinRoundingOfTouchingIsUndecided) {
  const Gantry gantry;
  const Outcome run = gantry.run("check", {"0.79999999999999,0"});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_EQ(run.out,
            "state 1: undecided, clearance 0 m, nearest cube - post (world); "
            "self: no pair to check\n");
}

TEST(Check, TheWorstStateGivesTheExitCode) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("check", {"left", "right"}).exitCode, 0);
  EXPECT_EQ(gantry.run("check", {"left", "0.79999999999999,0", "right"}).exitCode, 2);
  EXPECT_EQ(gantry.run("check", {"inside", "0.79999999999999,0", "right"}).exitCode, 1);
}

TEST(Check, JsonAgreesWithDistancesByHand) {
  const Gantry gantry;
  const auto json = jsonOf(gantry.run("check", {"--json", "0.3,0", "1.5,0.6", "1,0.7", "inside"}));
  const double values[][2] = {{0.3, 0}, {1.5, 0.6}, {1, 0.7}, {1, 0.1}};
  ASSERT_EQ(json["states"].size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const auto& state = json["states"][i];
    const double distance = Gantry::distance(values[i][0], values[i][1]);
    EXPECT_EQ(state["values"][0], values[i][0]);
    EXPECT_EQ(state["values"][1], values[i][1]);
    EXPECT_EQ(state["verdict"], distance > 0 ? "free" : "collision");
    EXPECT_LE(state["clearance"], distance + 1e-12);
    EXPECT_GE(state["clearance"], distance - 1e-6);
    EXPECT_EQ(state["contacts"].size(), distance > 0 ? 0u : 1u);
  }
  EXPECT_EQ(json["states"][3]["contacts"][0]["body_a"], "cube");
  EXPECT_EQ(json["states"][3]["contacts"][0]["distance"], 0.0);
}

TEST(Check, TheMarginCountsAsContact) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("check", {"left", "--margin", "0.79"}).exitCode, 0);
  const Outcome run = gantry.run("check", {"left", "--margin", "0.81"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, HasSubstr("state 1 (left): collision (closer than the margin)\n"
                                 "  cube - post: distance 0.8 m, closer than the margin of 0.81 m, "
                                 "at [0.1 "));
}

TEST(Check, NegativeValuesAreStatesWithAndWithoutTheSeparator) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("check", {"-0.1,0.2"}).exitCode, 0);
  EXPECT_EQ(gantry.run("check", {"-.1,0.2", "-0.2,0"}).exitCode, 0);
  const Outcome separated =
      runSwept({"check", gantry.urdf, "--group", "both", "--", "-0.1,0.2", "-0.2,0"});
  EXPECT_EQ(separated.exitCode, 0);
  EXPECT_EQ(separated.out, "state 1: free, no pair to check\nstate 2: free, no pair to check\n");
}

TEST(Check, ValuesMayHaveBlanksAndAGroupMayHaveOneValue) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("check", {" 0.5 , 0 "}).exitCode, 0);
  EXPECT_EQ(gantry.run("check", {"0.5", "--group", "slider"}).exitCode, 0);
  EXPECT_EQ(gantry.run("check", {"1", "--group", "slider"}).exitCode, 1);
}

TEST(Check, ARobotWithOneGroupNeedsNoName) {
  const Gantry gantry;
  EXPECT_EQ(runSwept({"check", gantry.urdf, "--srdf", "none", "0,0"}).exitCode, 0);
}

TEST(Check, AnglesWithoutLimitsMayHaveAnyNumberOfTurns) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write(
      "turn.urdf",
      "<robot name='turn'><link name='post'/><link name='vane'/><joint name='spin' "
      "type='continuous'><parent link='post'/><child link='vane'/><axis xyz='0 0 1'/></joint>"
      "</robot>");
  const auto json = jsonOf(runSwept({"check", urdf, "--json", "3", "7", "-100"}));
  EXPECT_EQ(json["states"][0]["values"][0], 3.0);
  EXPECT_NEAR(json["states"][1]["values"][0], 7.0 - 2.0 * M_PI, 1e-14);
  EXPECT_NEAR(json["states"][2]["values"][0], 32.0 * M_PI - 100.0, 1e-13);
}

TEST(Check, LimitsHoldToWithinTheRoundingOfFiles) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("check", {"2.5,1", "-0.5,0", "2.5000000001,0"}).exitCode, 0);
  EXPECT_EQ(gantry.run("check", {"2.50002,0"}).exitCode, 3);
}

}  // namespace
}  // namespace swept::test
