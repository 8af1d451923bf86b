// SPDX-License-Identifier: BSD-3-Clause
// The files of `swept trajectory -o`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "page_data.hpp"
#include "timed_trajectories.hpp"

namespace swept::test {
namespace {

using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class TrajectoryOutput : public testing::Test {
 protected:
  std::string csv(const std::string& text) const {
    return gantry_.folder().write("given.csv", text);
  }
  /// Over the post at a height, in 2.5 s.
  std::string over(const std::string& height) const {
    return csv("time,slide,lift\n0,0," + height + "\n2.5,2," + height + "\n");
  }
  std::string file(const std::string& name) const { return gantry_.folder().path(name); }
  Outcome run(std::vector<std::string> words) const { return gantry_.run("trajectory", words); }
  nlohmann::json written(const std::string& name) const {
    return nlohmann::json::parse(gantry_.folder().read(name));
  }

  const Gantry gantry_;
};

TEST_F(TrajectoryOutput, AProofIsVerified) {
  const std::string proof = file("proof.json");
  for (const bool embed : {false, true}) {
    std::vector<std::string> words{over("0.3"), "--tracking", "0.005", "-o", proof};
    if (embed) words.emplace_back("--embed");
    const Outcome made = run(words);
    EXPECT_EQ(made.exitCode, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("\nwritten to " + proof + "\n"));
    const Outcome verified = runSwept({"verify", proof});
    EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
    EXPECT_THAT(verified.out,
                HasSubstr("verified: trajectory of 2.5 s, 1 piece, tube 0.005 m, 1 pair of"));
    EXPECT_EQ(written("proof.json").contains("model"), embed);
  }
}

TEST_F(TrajectoryOutput, ControllersAreAFileOfTheProof) {
  const auto controllers = [&](const std::string& tolerance) {
    return gantry_.folder().write(
        "controllers.yaml",
        "arm:\n  ros__parameters:\n    joints: [slide, lift]\n    constraints:\n      slide: "
        "{trajectory: 0.01}\n      lift: {trajectory: " +
            tolerance + "}\n");
  };
  const std::string proof = file("proof.json");
  ASSERT_EQ(run({over("0.3"), "--controllers", controllers("0.02"), "-o", proof}).exitCode, 0);
  EXPECT_THAT(runSwept({"verify", proof}).out, HasSubstr(", tube 0.01 to 0.02 m, "));
  controllers("0.03");
  const Outcome changed = runSwept({"verify", proof});
  EXPECT_EQ(changed.exitCode, 1);
  EXPECT_THAT(changed.out, HasSubstr("refused: rules: "));
}

TEST_F(TrajectoryOutput, FormatsHoldTheSameTrajectory) {
  const std::string given =
      csv("time,slide,lift,slide_velocity,lift_velocity\n0,0,0.3,0,0\n1.5,1,0.4,0.75,0.1\n"
          "3,2,0.3,0,0\n");
  for (const std::string ending : {"csv", "yaml", "json"}) {
    const std::string out = file("out." + ending);
    ASSERT_EQ(run({given, "-o", out}).exitCode, 0);
    const auto again = jsonOf(run({out, "--json", "-o", file("again.csv")}))["trajectories"][0];
    EXPECT_EQ(again["verdict"], "free");
    EXPECT_EQ(again["end"], 3.0);
    EXPECT_EQ(gantry_.folder().read("again.csv"), gantry_.folder().read("given.csv")) << ending;
  }
}

TEST_F(TrajectoryOutput, WhatIsNotFreeIsNotWritten) {
  for (const std::string name : {"no.json", "no.csv", "no.yaml"}) {
    const Outcome made = run({over("0.1"), "-o", file(name)});
    EXPECT_EQ(made.exitCode, 1);
    EXPECT_THAT(made.out, HasSubstr("\nnot written to " + file(name) + ": it is not free\n"));
    EXPECT_THAT(gantry_.folder().names(), Not(Contains(name)));
  }
  const auto json = jsonOf(run({over("0.1"), "-o", file("no.csv"), "--json"}));
  EXPECT_TRUE(json["trajectory_file"].is_null());
  EXPECT_EQ(json["not_written"], "it is not free");
}

TEST_F(TrajectoryOutput, WhatLeavesLimitsOfPositionsIsNotWritten) {
  // The first joint of rook7 turns by 2.9 rad at most, and nothing stands around it.
  const std::string out = file("far.json");
  const Outcome made = runSwept(
      {"trajectory", "models/robots/rook7/rook7.urdf",
       csv("time,joint1,joint2,joint3,joint4,joint5,joint6,joint7\n0,2.8,-0.5,0,1,0,0.4,0\n"
           "1,3,-0.5,0,1,0,0.4,0\n"),
       "--group", "arm", "-o", out});
  EXPECT_EQ(made.exitCode, 1) << made.err;
  EXPECT_THAT(made.out, HasSubstr("trajectory: free\n"));
  EXPECT_THAT(made.out, HasSubstr("not written to " + out + ": it leaves limits of positions\n"));
  EXPECT_THAT(gantry_.folder().names(), Not(Contains("far.json")));
}

TEST_F(TrajectoryOutput, WhatIsOnlyTooFastIsWritten) {
  const std::string proof = file("fast.json");
  const Outcome made = run({csv("time,slide,lift\n0,0,0.3\n1,2,0.3\n"), "-o", proof, "--json"});
  EXPECT_EQ(made.exitCode, 1);
  EXPECT_EQ(jsonOf(made)["trajectories"][0]["violations"][0]["kind"], "velocity");
  EXPECT_EQ(jsonOf(made)["trajectory_file"], proof);
  EXPECT_TRUE(jsonOf(made)["not_written"].is_null());
  EXPECT_EQ(runSwept({"verify", proof}).exitCode, 0);
}

TEST_F(TrajectoryOutput, TheStartIsPartOfIt) {
  const std::string proof = file("proof.json");
  const std::string given = csv("time,slide,lift,slide_velocity,lift_velocity\n4,2,0.5,0,0\n");
  ASSERT_EQ(run({given, "--start", "0,0.5", "-o", proof}).exitCode, 0);
  const auto points = written("proof.json")["trajectory"]["points"];
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0]["time"], 0.0);
  EXPECT_EQ(points[0]["positions"], (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(points[0]["velocities"], (std::vector<double>{0.0, 0.0}));
  EXPECT_THAT(runSwept({"verify", proof}).out, HasSubstr("verified: trajectory of 4 s, 1 piece"));
}

TEST_F(TrajectoryOutput, TimesOfMessagesAreWholeNanoseconds) {
  const std::string given =
      csv("time,slide,lift\n0,0,0.3\n1.23456789012345,1,0.3\n2.50000000049,2,0.3\n");
  const std::string out = file("out.yaml");
  const auto made = jsonOf(run({given, "-o", out, "--json"}));
  EXPECT_EQ(made["trajectories"][0]["end"], 2.5);
  EXPECT_EQ(jsonOf(run({out, "--json"}))["trajectories"][0]["end"], 2.5);
  ASSERT_EQ(run({given, "-o", file("out.json")}).exitCode, 0);
  EXPECT_EQ(written("out.json")["trajectory"]["points"][1]["time"], 1.23456789012345);
  const Outcome close =
      run({csv("time,slide,lift\n0,0,0.3\n1,1,0.3\n1.0000000001,1,0.3\n"), "-o", out});
  EXPECT_EQ(close.exitCode, 3);
  EXPECT_THAT(close.err, HasSubstr("nanosecond"));
}

TEST_F(TrajectoryOutput, OfARepairIsItsProof) {
  const std::string proof = file("slow.json");
  const Outcome made = run({csv("time,slide,lift\n0,0,0.3\n1,2,0.3\n"), "--repair", "-o", proof,
                            "--embed", "--max-acceleration", "2", "--speed", "0.5"});
  EXPECT_EQ(made.exitCode, 0) << made.out << made.err;
  // 2 / 0.5 + 0.5 / 0.5 s.
  EXPECT_THAT(made.out, ContainsRegex("repaired: free\n  duration    5.* s, "));
  EXPECT_THAT(runSwept({"verify", proof}).out, HasSubstr("verified: trajectory of 5 s"));
  // What needs no repair is written as it is.
  ASSERT_EQ(run({over("0.3"), "--repair", "-o", proof}).exitCode, 0);
  EXPECT_THAT(runSwept({"verify", proof}).out, HasSubstr("verified: trajectory of 2.5 s, 1 piece"));
}

TEST_F(TrajectoryOutput, RefusesWhatItCannotWrite) {
  const auto error = [&](const std::vector<std::string>& words) {
    const Outcome made = run(words);
    EXPECT_EQ(made.exitCode, 3) << made.out;
    return made.err;
  };
  const std::string given = over("0.3");
  EXPECT_EQ(error({given, "--embed"}), "swept: error: --embed needs -o FILE.json\n");
  EXPECT_EQ(error({given, "--embed", "-o", file("out.csv")}),
            "swept: error: --embed needs -o FILE.json\n");
  EXPECT_EQ(error({given, "-o", file("out.txt")}),
            "swept: error: '" + file("out.txt") + "': a path file ends in .json, .csv or .yaml\n");
  EXPECT_EQ(
      error({given, "-o", given}),
      "swept: error: -o '" + given + "' would replace the file of trajectory '" + given + "'\n");
  EXPECT_EQ(error({given, "--max-acceleration", "1"}),
            "swept: error: --max-acceleration requires --repair (try --help)\n");
  const std::string point = "{positions: [2, 1], time_from_start: {sec: 3, nanosec: 0}}";
  const std::string message = "joint_names: [slide, lift]\npoints: [" + point + "]\n";
  const std::string two = gantry_.folder().write("two.yaml", message + "---\n" + message);
  EXPECT_EQ(error({two, "--start", "0,1", "-o", file("out.csv")}),
            "swept: error: -o writes one trajectory; '" + two + "' has 2\n");
}

TEST_F(TrajectoryOutput, PagesOfPathsRefuseItsProof) {
  if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  const std::string proof = file("proof.json"), page = file("page.html");
  ASSERT_EQ(run({over("0.3"), "-o", proof}).exitCode, 0);
  const Outcome viewed = runSwept({"view", gantry_.urdf, proof, "-o", page});
  EXPECT_EQ(viewed.exitCode, 3);
  EXPECT_EQ(viewed.err, "swept: error: '" + proof +
                            "' has a trajectory, and paths are shown as straight motions; swept "
                            "trajectory --html shows it\n");
  const Outcome verified = runSwept({"verify", proof, "--html", page});
  EXPECT_EQ(verified.exitCode, 3);
  EXPECT_EQ(verified.err, "swept: error: --html shows straight motions, and '" + proof +
                              "' has a trajectory; swept trajectory --html shows it\n");
  EXPECT_EQ(run({proof, "--html", page}).exitCode, 0);
}

}  // namespace
}  // namespace swept::test
