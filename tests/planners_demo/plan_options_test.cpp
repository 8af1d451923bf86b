// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "gantry.hpp"

/// An option of `plan` that would be of no account is refused, before any file is read.
namespace swept::test {
namespace {

using Words = std::vector<std::string>;

/// Neither robot nor problems are there: a message about them would come too late.
std::string refusal(const Words& more) {
  Words words{"plan", "nowhere.urdf"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome run = runSwept(words);
  EXPECT_EQ(run.exitCode, 3) << run.out;
  EXPECT_EQ(run.out, "");
  return run.err;
}

std::string refusalOf(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return refusal(words);
}

const Words kStates{"left", "right"};
const Words kOne{"--problems", "nowhere.json", "--set", "over", "--index", "1"};
const Words kSet{"--problems", "nowhere.json", "--set", "over"};
const Words kPose{"left", "--goal-pose", "0,0,0,0,0,0,1"};
const Words kRequest{"--request", "nowhere.yaml"};

TEST(PlanOptions, StartsAndGoalsHaveOneSource) {
  for (const Words& problems : {kOne, kSet}) {
    EXPECT_EQ(
        refusalOf(problems, kRequest),
        "swept: error: --request cannot be combined with states or --problems: it has its own\n");
    EXPECT_EQ(refusalOf(problems, {"left"}),
              "swept: error: states and --problems cannot be combined: the problem has its own\n");
    EXPECT_EQ(refusalOf(problems, {"--scene", "s.yaml"}),
              "swept: error: --scene and --problems cannot be combined: the problem has its own "
              "world\n");
    EXPECT_EQ(refusalOf(problems, {"--cloud", "c.pcd"}),
              "swept: error: --cloud and --problems cannot be combined: the problem has its own "
              "world\n");
    EXPECT_EQ(refusalOf(problems, {"--goal-pose", "nonsense", "--link", "nope"}),
              "swept: error: --goal-pose and --problems cannot be combined: the problem has its "
              "own goals\n");
  }
  EXPECT_EQ(
      refusalOf(kRequest, kStates),
      "swept: error: --request cannot be combined with states or --problems: it has its own\n");
  EXPECT_EQ(refusalOf(kRequest, {"--goal-pose", "0,0,0,0,0,0,1"}),
            "swept: error: --goal-pose and --request cannot be combined: the request has its own "
            "goals\n");
}

TEST(PlanOptions, WhatBelongsToAGoalPoseNeedsOne) {
  for (const Words& words : {kStates, kOne, kSet, kRequest})
    for (const Words& option : {Words{"--link", "hand"}, Words{"--position-tolerance", "0.001"},
                                Words{"--orientation-tolerance", "0.01"}})
      EXPECT_EQ(refusalOf(words, option),
                "swept: error: " + option.front() + " needs --goal-pose\n");
}

TEST(PlanOptions, TheRobotGoesIntoAJsonFileOnly) {
  const std::string message = "swept: error: --embed needs -o FILE.json\n";
  for (const Words& words : {kStates, kOne, kSet, kRequest, kPose}) {
    EXPECT_EQ(refusalOf(words, {"--embed"}), message);
  }
  EXPECT_EQ(refusalOf(kStates, {"--embed", "-o", "path.csv"}), message);
  EXPECT_EQ(refusalOf(kStates, {"--embed", "-o", "path.yaml"}), message);
}

TEST(PlanOptions, SimplificationIsOnOrOff) {
  for (const Words& words : {kStates, kSet})
    EXPECT_EQ(refusalOf(words, {"--simplify", "1", "--no-simplify"}),
              "swept: error: --simplify and --no-simplify cannot be combined\n");
}

TEST(PlanOptions, OneProblemIsNotSeveral) {
  for (const Words& words : {kStates, kOne, kRequest, kPose})
    EXPECT_EQ(refusalOf(words, {"--jobs", "2"}),
              "swept: error: --jobs plans several problems at the same time; here is one\n");
  EXPECT_EQ(refusalOf(kSet, {"-o", "path.json"}),
            "swept: error: -o writes one path; choose one problem with --set and --index\n");
  EXPECT_EQ(refusal({"--problems", "nowhere.json", "--index", "1"}),
            "swept: error: --index needs --set\n");
}

TEST(PlanOptions, EndsAreCounted) {
  EXPECT_EQ(refusal({"left"}), "swept: error: plan: a start and a goal are needed\n");
  EXPECT_EQ(refusalOf(kPose, {"right"}),
            "swept: error: plan: with --goal-pose a start is needed, and no other state\n");
}

TEST(PlanOptions, WhatFitsIsTaken) {
  const Gantry gantry;
  EXPECT_EQ(gantry
                .run("plan", {"left", "--goal-pose", "2,0,0,0,0,0,1", "--link", "cube",
                              "--position-tolerance", "0.002", "--orientation-tolerance", "0.02",
                              "--jobs", "1", "--simplify", "0.1"})
                .exitCode,
            0);
}

/// The goal lies 0.8 mm beside the plane in which the cube moves: within the tolerance, but beyond
/// the half of it that the search for goals leaves. The message used to end behind "and ".
TEST(PlanOptions, AGoalPoseOnlyJustWithinTheTolerancesIsExplained) {
  const Gantry gantry;
  const Words words{"left", "--goal-pose", "2,0.0008,0,0,0,0,1", "--link", "cube"};
  const Outcome run = gantry.run("plan", words);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_NE(run.out.find("not solved: the search for goals missed a free configuration that puts "
                         "cube at the goal pose: try larger tolerances or another --seed\n"),
            std::string::npos)
      << run.out;
  Words wider = words;
  wider.insert(wider.end(), {"--position-tolerance", "0.002"});
  EXPECT_EQ(gantry.run("plan", wider).exitCode, 0);
}

}  // namespace
}  // namespace swept::test
