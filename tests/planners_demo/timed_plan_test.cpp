// SPDX-License-Identifier: BSD-3-Clause
// `swept plan --timed` over a post whose distances are computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "timed_trajectories.hpp"

namespace swept::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

class TimedPlan : public testing::Test {
 protected:
  /// From one side of the post to the other one, where accelerations are up to 2 m/s^2.
  Outcome overThePost(const Words& more) const {
    Words words{"left", "right", "--timed", "--max-acceleration", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return gantry_.plan(words);
  }
  /// High above the post, where the path is straight.
  Outcome straight(const Words& more) const {
    Words words{"0,1", "2,1", "--timed"};
    words.insert(words.end(), more.begin(), more.end());
    return gantry_.plan(words);
  }
  std::string file(const std::string& name) const { return gantry_.folder().path(name); }
  std::string limits(const std::string& slide) const {
    return gantry_.folder().write("limits.yaml", "joint_limits:\n  slide: {" + slide +
                                                     "}\n  lift: {has_acceleration_limits: true, "
                                                     "max_acceleration: 5, has_jerk_limits: true, "
                                                     "max_jerk: 50}\n");
  }

  const Gantry gantry_;
};

TEST_F(TimedPlan, AStraightPathTakesWhatItsLimitsAllow) {
  // 2 m at 1 m/s, and 1 / 2 s more for both ramps.
  const Outcome run = straight({"--max-acceleration", "2"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NEAR(durationIn(run.out), 2.5, 1e-4);
  EXPECT_THAT(run.out, HasSubstr("solved: 1 segment, proven free\n"));
  EXPECT_THAT(run.out, HasSubstr("trajectory: free\n"));
  EXPECT_THAT(run.out, ContainsRegex("\n  timing      [0-9.e-]+ s, no corner\n"));
  EXPECT_THAT(run.out, HasSubstr("not kept: -o FILE.json writes it with its proof, .csv or .yaml "
                                 "without\n"));
}

TEST_F(TimedPlan, SpeedMakesTheSameCurveSlower) {
  EXPECT_NEAR(durationIn(straight({"--max-acceleration", "2", "--speed", "0.5"}).out), 5.0, 1e-4);
  const std::string fast = file("fast.csv"), slow = file("slow.csv");
  ASSERT_EQ(overThePost({"-o", fast}).exitCode, 0);
  ASSERT_EQ(overThePost({"-o", slow, "--speed", "0.25"}).exitCode, 0);
  const auto quick = gantryPoints(gantry_.folder().read("fast.csv"));
  const auto steady = gantryPoints(gantry_.folder().read("slow.csv"));
  ASSERT_EQ(quick.size(), steady.size());
  ASSERT_GT(quick.size(), 4u);
  for (std::size_t i = 0; i < quick.size(); ++i) {
    EXPECT_NEAR(steady[i].time, 4.0 * quick[i].time, 1e-6);
    for (std::size_t joint = 0; joint < 2; ++joint) {
      EXPECT_NEAR(steady[i].position[joint], quick[i].position[joint], 1e-6);
      EXPECT_NEAR(steady[i].velocity[joint], quick[i].velocity[joint] / 4.0, 1e-6);
    }
  }
}

TEST_F(TimedPlan, LimitsComeFromAFile) {
  // 0.5 m/s and 1 m/s^2: 2 / 0.5 + 0.5 / 1 s.
  const std::string slow = limits(
      "has_velocity_limits: true, max_velocity: 0.5, has_acceleration_limits: true, "
      "max_acceleration: 1");
  EXPECT_NEAR(durationIn(straight({"--limits", slow}).out), 4.5, 1e-4);
  // What the file has no limit for is given beside it.
  const std::string half = limits("has_velocity_limits: true, max_velocity: 0.5");
  EXPECT_THAT(straight({"--limits", half}).err, HasSubstr("joint slide has no limit of accel"));
  EXPECT_NEAR(durationIn(straight({"--limits", half, "--max-acceleration", "1"}).out), 4.5, 1e-4);
}

TEST_F(TimedPlan, JerkIsLimitedWhereItIsAskedFor) {
  const std::string jerk = limits(
      "has_acceleration_limits: true, max_acceleration: 2, has_jerk_limits: true, max_jerk: 10");
  const std::string smooth = file("smooth.csv");
  const Outcome run = straight({"--limits", jerk, "--jerk-limited", "-o", smooth});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  // 2 / 1 + 1 / 2 + 2 / 10 s: ramps of acceleration take 0.2 s each.
  EXPECT_NEAR(durationIn(run.out), 2.7, 1e-3);
  EXPECT_THAT(gantry_.folder().read("smooth.csv"), HasSubstr("slide_acceleration"));
}

/// The trajectory in a CSV file keeps the limits, and clear of the post by more than the tube.
void expectDrivable(const std::vector<GantryPoint>& points, double tube) {
  constexpr int kSamples = 200;
  double highest = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k <= kSamples; ++k) {
      const double share = static_cast<double>(k) / kSamples;
      const double time = points[i].time + share * (points[i + 1].time - points[i].time);
      const std::vector<double> q = cubicAt(points[i], points[i + 1], time);
      highest = std::max(highest, q[1]);
      for (const double slide : {-tube, tube})
        for (const double lift : {-tube, tube})
          ASSERT_GT(Gantry::distance(q[0] + slide, std::max(0.0, q[1] + lift)), 0.0) << time;
    }
  EXPECT_GT(highest, 0.2 + tube);
}

TEST_F(TimedPlan, TheTubeAroundTheCurveIsFree) {
  for (const double tube : {0.0, 0.05, 0.15}) {
    const Outcome run =
        overThePost({"-o", file("over.csv"), "--tracking", std::to_string(tube), "--json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const auto points = gantryPoints(gantry_.folder().read("over.csv"));
    const auto trajectory = jsonOf(run)["trajectory"];
    EXPECT_EQ(trajectory["verdict"], "free");
    EXPECT_EQ(trajectory["points"], points.size());
    EXPECT_GE(trajectory["corners"], 1);
    EXPECT_EQ(trajectory["corners"].get<int>(),
              trajectory["blended"].get<int>() + trajectory["stops"].get<int>());
    EXPECT_EQ(jsonOf(run)["path_file"], file("over.csv"));
    ASSERT_GE(points.size(), 3u);
    EXPECT_EQ(points.front().position, (std::vector<double>{0, 0}));
    EXPECT_EQ(points.back().position, (std::vector<double>{2, 0}));
    expectDrivable(points, tube);
  }
}

TEST_F(TimedPlan, FilesReadBackAreTheSameTrajectory) {
  for (const std::string ending : {"yaml", "csv", "json"}) {
    const std::string written = file("over." + ending);
    const Outcome plan = overThePost({"-o", written, "--tracking", "0.005"});
    ASSERT_EQ(plan.exitCode, 0) << plan.err;
    EXPECT_THAT(plan.out, HasSubstr("trajectory written to " + written + "\n"));
    EXPECT_THAT(plan.out, ContainsRegex("timing +[0-9.e-]+ s, [0-9]+ corners?: [0-9]+ blended, "
                                        "[0-9]+ stops?\n"));
    const Outcome read = gantry_.run("trajectory", {written, "--tracking", "0.005"});
    EXPECT_EQ(read.exitCode, 0) << read.out << read.err;
    EXPECT_THAT(read.out, HasSubstr("trajectory: free\n"));
    EXPECT_GT(durationIn(plan.out), 2.0);
    EXPECT_EQ(durationIn(read.out), durationIn(plan.out));
  }
}

TEST_F(TimedPlan, ItsProofIsVerified) {
  const std::string proof = file("over.json");
  for (const Words& more : {Words{}, Words{"--embed"}}) {
    Words words{"-o", proof, "--tracking", "0.005"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(overThePost(words).exitCode, 0);
    const Outcome verified = runSwept({"verify", proof});
    EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
    EXPECT_THAT(verified.out, ContainsRegex("verified: trajectory of [0-9.]+ s, [0-9]+ pieces, "
                                            "tube 0.005 m, 1 pair of bodies"));
  }
  // The last one is about the robot and the post in it.
  const TemporaryFolder elsewhere;
  EXPECT_EQ(
      runSwept({"verify", elsewhere.write("p.json", gantry_.folder().read("over.json"))}).exitCode,
      0);
}

TEST_F(TimedPlan, WhateverIsChangedInAProofIsRefused) {
  ASSERT_EQ(overThePost({"-o", file("over.json"), "--embed", "--tracking", "0.005"}).exitCode, 0);
  const auto honest = nlohmann::ordered_json::parse(gantry_.folder().read("over.json"));
  ASSERT_GE(honest["trajectory"]["points"].size(), 3u);
  const auto refusal = [&](const std::string& place, const nlohmann::ordered_json& value) {
    auto forged = honest;
    const nlohmann::ordered_json::json_pointer pointer(place);
    EXPECT_TRUE(forged.contains(pointer)) << place;
    forged[pointer] = value;
    const Outcome run = runSwept({"verify", gantry_.folder().write("forged.json", forged.dump(1))});
    EXPECT_EQ(run.exitCode, 1) << place << run.out << run.err;
    return run.out;
  };
  const double time = honest["trajectory"]["points"][1]["time"];
  EXPECT_THAT(refusal("/trajectory/points/1/velocities/0", 0.25), HasSubstr("refused: "));
  EXPECT_THAT(refusal("/trajectory/points/1/time", 0.99 * time), HasSubstr("refused: "));
  EXPECT_THAT(refusal("/trajectory/points/1/positions/1", 0.1), HasSubstr("refused: "));
  EXPECT_THAT(refusal("/model/tracking/slide/translation", 0.001), HasSubstr("refused: rules: "));
  EXPECT_THAT(refusal("/model/tracking/lift/translation", 0.01), HasSubstr("refused: rules: "));
}

TEST_F(TimedPlan, ATubeThatIsNotInTheFilesIsRefused) {
  ASSERT_EQ(overThePost({"-o", file("over.json"), "--tracking", "0.005"}).exitCode, 0);
  auto forged = nlohmann::ordered_json::parse(gantry_.folder().read("over.json"));
  EXPECT_EQ(forged["inputs"]["tracking"], "0.005");
  forged["inputs"]["tracking"] = "0.02";
  const Outcome run = runSwept({"verify", gantry_.folder().write("forged.json", forged.dump(1))});
  EXPECT_EQ(run.exitCode, 1) << run.out;
  EXPECT_THAT(run.out, HasSubstr("refused: rules: "));
}

TEST_F(TimedPlan, APathIsProvenInATubeToo) {
  const std::string proof = file("path.json");
  ASSERT_EQ(gantry_.plan({"left", "right", "--tracking", "0.1", "-o", proof}).exitCode, 0);
  EXPECT_THAT(runSwept({"verify", proof}).out,
              ContainsRegex("verified: [0-9]+ segments, tube 0.1 m"));
  const auto states = nlohmann::json::parse(gantry_.folder().read("path.json"))["states"];
  for (std::size_t i = 0; i + 1 < states.size(); ++i)
    for (const double slide : {-0.1, 0.1})
      for (const double lift : {-0.1, 0.1}) {
        std::vector<double> from = states[i], to = states[i + 1];
        for (std::vector<double>* end : {&from, &to}) {
          (*end)[0] += slide;
          (*end)[1] += lift;
        }
        EXPECT_GT(Gantry::leastDistance(from, to), 0.0);
      }
}

TEST_F(TimedPlan, AnEndWithoutRoomForTheTubeIsNoEnd) {
  // The cube is 0.05 m from the post.
  const Outcome near = gantry_.run("plan", {"0.75,0", "0,0", "--tracking", "0.06"});
  EXPECT_EQ(near.exitCode, 1);
  EXPECT_THAT(near.out, ContainsRegex("not solved: start is in collision: cube - post \\([0-9.]+ m "
                                      "deep, in the tube beside the state, at "));
  EXPECT_EQ(gantry_.plan({"0.75,0", "0,0", "--tracking", "0.04"}).exitCode, 0);
}

TEST_F(TimedPlan, WithoutAPathThereIsNoTrajectory) {
  const Outcome run = gantry_.run("plan", {"inside", "right", "--timed", "--max-acceleration", "1",
                                           "-o", file("none.yaml"), "--json"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_TRUE(jsonOf(run)["trajectory"].is_null());
  EXPECT_TRUE(jsonOf(run)["path_file"].is_null());
  EXPECT_THAT(gantry_.folder().names(), Not(testing::Contains("none.yaml")));
}

TEST_F(TimedPlan, NamesWhatItLacks) {
  const auto error = [&](const Words& more) {
    const Outcome run = gantry_.run("plan", more);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    return run.err;
  };
  for (const Words& option : {Words{"--max-acceleration", "1"}, Words{"--speed", "0.5"},
                              Words{"--jerk-limited"}, Words{"--limits", "limits.yaml"}}) {
    Words words{"left", "right"};
    words.insert(words.end(), option.begin(), option.end());
    EXPECT_EQ(error(words), "swept: error: " + option.front() + " requires --timed (try --help)\n");
  }
  EXPECT_EQ(error({"left", "right", "--timed"}),
            "swept: error: --timed: joint slide has no limit of acceleration, which its times "
            "depend on; --limits or --max-acceleration gives one\n");
  EXPECT_EQ(error({"left", "right", "--timed", "--max-acceleration", "1", "--jerk-limited"}),
            "swept: error: --timed: joint slide has no limit of jerk, which its times depend on; "
            "--limits gives one\n");
  for (const std::string speed : {"0", "1.5", "x"})
    EXPECT_EQ(
        error({"left", "right", "--timed", "--speed", speed}),
        "swept: error: --speed: must be between 0.001 and 1, not " + speed + " (try --help)\n");
  EXPECT_EQ(error({"--timed", "--max-acceleration", "1", "--problems", gantry_.problems}),
            "swept: error: --timed makes one trajectory; choose one problem with --set and "
            "--index\n");
  EXPECT_THAT(error({"left", "right", "--tracking", "arm=1"}),
              HasSubstr("--tracking: it has 'arm', which is no joint of robot 'gantry'"));
}

TEST_F(TimedPlan, AProblemOfASetIsTimed) {
  const Outcome run =
      gantry_.plan({"--problems", gantry_.problems, "--set", "over", "--index", "1", "--timed",
                    "--max-acceleration", "2", "-o", file("p.json"), "--tracking", "0.01"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(runSwept({"verify", file("p.json")}).exitCode, 0);
}

}  // namespace
}  // namespace swept::test
