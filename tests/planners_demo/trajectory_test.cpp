// SPDX-License-Identifier: BSD-3-Clause
// `swept trajectory` beside a post whose distances are computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Trajectory : public testing::Test {
 protected:
  std::string csv(const std::string& text) const {
    return gantry_.folder().write("trajectory.csv", text);
  }
  Outcome run(const std::string& file, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), file);
    return gantry_.run("trajectory", more);
  }
  /// Over the post at a height, in 2 s, at rest at both ends.
  std::string over(const std::string& height) const {
    return csv("time,slide,lift\n0," + std::string("0,") + height + "\n2.5,2," + height + "\n");
  }

  const Gantry gantry_;
};

TEST_F(Trajectory, OverThePostIsFree) {
  const Outcome run = this->run(over("0.3"));
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("trajectory: free\n  duration    2.5 s, 2 points\n"));
  // 0.3 m - 0.2 m, while the cube is over the post.
  EXPECT_THAT(run.out, ContainsRegex("world +0\\.(0999[0-9]*|1) to 0\\.1[0-9]*, cube - post, at "));
}

TEST_F(Trajectory, ATubeTakesWhatJointsMayBeOff) {
  const std::string file = over("0.3");
  EXPECT_EQ(run(file, {"--tracking", "0.05"}).exitCode, 0);
  const Outcome wide = run(file, {"--tracking", "0.12", "--json"});
  EXPECT_EQ(wide.exitCode, 1);
  const auto contact = jsonOf(wide)["trajectories"][0]["contact"];
  EXPECT_TRUE(contact["in_tube"]);
  const double slide = contact["configuration"][0];
  const double lift = contact["configuration"][1];
  const double time = contact["time"];
  EXPECT_NEAR(lift, 0.3 - 0.12, 1e-9);
  EXPECT_LE(std::abs(slide - 2.0 * time / 2.5), 0.12 + 1e-9);
  EXPECT_EQ(Gantry::distance(slide, lift), 0.0);
  // Only one of the joints is off.
  EXPECT_EQ(run(file, {"--tracking", "slide=0.12"}).exitCode, 0);
  EXPECT_EQ(run(file, {"--tracking", "lift=0.12"}).exitCode, 1);
  EXPECT_EQ(run(file, {"--tracking", "0.2,lift=0.05"}).exitCode, 0);
}

TEST_F(Trajectory, TheCurveOfVelocitiesIsProvenAndNotTheLine) {
  // The cubic is at 0.25 + 2 / 8 * (-0.4 - 0.4) = 0.05 m in the middle.
  const std::string file =
      csv("time,slide,lift,slide_velocity,lift_velocity\n0,0,0.25,0.5,-0.4\n2,2,0.25,0.5,0.4\n");
  const Outcome curve = run(file);
  EXPECT_EQ(curve.exitCode, 1);
  EXPECT_THAT(curve.out, HasSubstr("trajectory: collision\n"));
  EXPECT_THAT(curve.out, HasSubstr("between points 1 and 2: cube - post: distance 0 m, at"));
  EXPECT_THAT(curve.out, HasSubstr("  limit       velocity of slide 1.25, allowed 1: at 1 s, "
                                   "between points 1 and 2\n"));
  EXPECT_EQ(run(csv("time,slide,lift\n0,0,0.25\n2,2,0.25\n")).exitCode, 0);
}

TEST_F(Trajectory, TheStartIsWhereTheRobotWaits) {
  const std::string file = csv("time,slide,lift\n1,2,0\n");
  const Outcome without = run(file);
  EXPECT_EQ(without.exitCode, 3);
  EXPECT_THAT(without.err, HasSubstr("the trajectory has one point, at which the robot stays: give "
                                     "the state that it starts from"));
  EXPECT_EQ(run(file, {"--start", "left"}).exitCode, 1);
  EXPECT_THAT(run(file, {"--start", "1.5,0"}).out, HasSubstr("trajectory: free\n"));
}

TEST_F(Trajectory, MessagesFollowEachOther) {
  const std::string point = "{positions: [2, 1], time_from_start: {sec: 3, nanosec: 0}}";
  const std::string file = gantry_.folder().write(
      "two.yaml", "joint_names: [slide, lift]\npoints: [" + point +
                      "]\n---\njoint_names: [lift, slide]\npoints: [{positions: [0, 2], "
                      "time_from_start: {sec: 2, nanosec: 0}}]\n---\n");
  const Outcome run = this->run(file, {"--start", "0,1"});
  EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("trajectory 1: free\n  duration    3 s"));
  EXPECT_THAT(run.out, HasSubstr("trajectory 2: free\n  duration    2 s"));
}

TEST_F(Trajectory, ControllersSayWhatTheyTolerate) {
  const auto controllers = [&](const std::string& lift) {
    return gantry_.folder().write("controllers.yaml",
                                  "/robot/arm:\n  ros__parameters:\n    joints: [slide, lift]\n"
                                  "    constraints:\n      goal_time: 0.0\n"
                                  "      slide: {trajectory: 0.2}\n      lift: {" +
                                      lift + "}\n");
  };
  const std::string file = over("0.3");
  EXPECT_EQ(run(file, {"--controllers", controllers("trajectory: 0.05")}).exitCode, 0);
  EXPECT_EQ(run(file, {"--controllers", controllers("trajectory: 0.12")}).exitCode, 1);
  const std::string never = controllers("trajectory: 0.0");
  const Outcome refused = run(file, {"--controllers", never});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_THAT(refused.err,
              HasSubstr(never + ":7: error: /robot/arm.ros__parameters.constraints.lift.trajectory "
                                "joint 'lift' has no tolerance 'constraints.lift.trajectory' above "
                                "0: its controller never aborts; give one with --tracking "
                                "lift=..."));
  EXPECT_EQ(run(file, {"--controllers", never, "--tracking", "lift=0.05"}).exitCode, 0);
  const std::string other = gantry_.folder().write("other.yaml", "a: {ros__parameters: {b: 1}}\n");
  EXPECT_THAT(run(file, {"--controllers", other}).err,
              HasSubstr("has no joint_trajectory_controller: no 'ros__parameters' with 'joints' "
                        "and 'constraints'"));
}

TEST_F(Trajectory, RepairsWhatIsTooFast) {
  const std::string file = csv("time,slide,lift\n0,0,0.3\n1,2,0.3\n");
  const Outcome fast = run(file);
  EXPECT_EQ(fast.exitCode, 1);
  EXPECT_THAT(fast.out, HasSubstr("trajectory: free\n"));
  EXPECT_THAT(fast.out, HasSubstr("limit       velocity of slide 2, allowed 1"));
  const std::string slow = gantry_.folder().path("slow.yaml");
  EXPECT_THAT(run(file, {"--repair"}).err, HasSubstr("--repair needs -o FILE"));
  EXPECT_THAT(run(file, {"--repair", "-o", slow}).err,
              HasSubstr("--repair: joint slide has no limit of acceleration, which its times "
                        "depend on; --limits or --max-acceleration gives one\n"));
  const Outcome repaired = run(file, {"--repair", "-o", slow, "--max-acceleration", "2"});
  EXPECT_EQ(repaired.exitCode, 0) << repaired.out << repaired.err;
  // 2 m at 1 m/s, and 1 / 2 s more for both ramps.
  EXPECT_THAT(repaired.out, ContainsRegex("repaired: free\n  duration +2\\.5[0-9]* s"));
  const Outcome again = run(slow);
  EXPECT_EQ(again.exitCode, 0) << again.out;
  EXPECT_THAT(again.out, Not(HasSubstr("limit")));
}

TEST_F(Trajectory, SaysWhereNoRepairHelps) {
  const std::string file = csv("time,slide,lift\n0,0,0.25\n2,1,0.1\n4,2,0.25\n");
  const Outcome run = this->run(
      file, {"--repair", "-o", gantry_.folder().path("no.csv"), "--max-acceleration", "1"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, ContainsRegex("repaired: cannot be, for at 2 s the curve itself is in "
                                     "contact: cube - post"));
  EXPECT_THAT(gantry_.folder().names(), Not(testing::Contains("no.csv")));
}

TEST_F(Trajectory, NamesWhatItCannotUse) {
  const std::string file = over("0.3");
  const auto error = [&](const std::vector<std::string>& more) { return run(file, more).err; };
  EXPECT_THAT(error({"--tracking", "x"}),
              HasSubstr("--tracking: 'x' is no tolerance; it must be a number of rad or m that is "
                        "not negative"));
  EXPECT_THAT(error({"--tracking", "lift=-1"}), HasSubstr("--tracking: '-1' is no tolerance"));
  EXPECT_THAT(error({"--tracking", "left=1"}),
              HasSubstr("--tracking: it has 'left', which is no joint of robot 'gantry'"));
  EXPECT_THAT(error({"--tracking", "lift=1,0.5"}),
              HasSubstr("--tracking: '0.5' is no JOINT=TOLERANCE; only the first may be a number "
                        "for all joints"));
  EXPECT_THAT(error({"--tracking", "lift=1,lift=2"}),
              HasSubstr("--tracking: it has joint 'lift' twice"));
  EXPECT_THAT(error({"--start", "somewhere"}), HasSubstr("--start"));
}

}  // namespace
}  // namespace swept::test
