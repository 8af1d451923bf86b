// SPDX-License-Identifier: BSD-3-Clause
// swept schedule: two cubes that slide through one crossing, whose conflicts are known by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ScheduleProgram : public testing::Test {
 protected:
  ScheduleProgram() {
    write("slider.urdf", R"(<robot name='slider'><link name='rail'/>
  <link name='cube'><collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>
  <joint name='slide' type='prismatic'><parent link='rail'/><child link='cube'/><axis xyz='1 0 0'/>
    <limit lower='-3' upper='3' effort='1' velocity='2'/></joint></robot>)");
    write("cell.yaml", R"(robots:
  - name: east
    urdf: slider.urdf
  - name: north
    urdf: slider.urdf
    pose: {position: [0, 0, 0], orientation: [0, 0, 0.7071067811865476, 0.7071067811865476]}
)");
    // Through the crossing, within 0.2 m of it from 0.8 s to 1.2 s.
    write("pass.csv", "time,slide\n0,-1\n2,1\n");
    write("smooth.csv", "time,slide,slide_velocity\n0,-1,0\n2,1,0\n");
    write("stays.csv", "time,slide\n0,0\n1,0\n");
    write("corner.csv", "time,slide,slide_velocity\n0,-1,0\n1,0,1\n2,1,0\n");
  }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path(name)) << text;
  }
  std::string file(const std::string& name) const { return folder_.path(name); }
  Outcome schedule(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"schedule", file("cell.yaml")};
    all.insert(all.end(), more.begin(), more.end());
    return runSwept(all);
  }
  /// Both, and the second one later.
  Outcome passes(double later, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"east=" + file("pass.csv"), "north=" + file("pass.csv"), "--at",
                               "north=" + std::to_string(later)});
    return schedule(more);
  }

  TemporaryFolder folder_;
};

TEST_F(ScheduleProgram, SaysWhoMeetsAndWhen) {
  const Outcome meet = passes(0.2);
  EXPECT_EQ(meet.exitCode, 1) << meet.err;
  EXPECT_THAT(meet.out, AllOf(HasSubstr("schedule: collision"), HasSubstr("east/cube"),
                              HasSubstr("north/cube"), HasSubstr("free until  0.99")));
  const Outcome apart = passes(0.5);
  EXPECT_EQ(apart.exitCode, 0) << apart.err;
  EXPECT_THAT(apart.out, AllOf(HasSubstr("schedule: free"), HasSubstr("duration    2.5 s"),
                               HasSubstr("part        east, 0 to 2 s"),
                               HasSubstr("part        north, 0.5 to 2.5 s")));
}

TEST_F(ScheduleProgram, ProvesDelays) {
  // One leaves at 1.2 s, and the other one arrives at 1.8 s.
  const Outcome enough = passes(1.0, {"--late", "east=0.55"});
  EXPECT_EQ(enough.exitCode, 0) << enough.err;
  EXPECT_THAT(enough.out, HasSubstr("late          east: free up to 0.55 s"));
  const Outcome late = passes(1.0, {"--late", "east=2", "--json"});
  EXPECT_EQ(late.exitCode, 1);
  const auto found = nlohmann::json::parse(late.out);
  EXPECT_EQ(found["schedule"]["verdict"], "free");
  const auto& delay = found["delays"][0];
  EXPECT_EQ(delay["group"], "east");
  EXPECT_NEAR(delay["proven"].get<double>(), 0.6, 4e-3);
  EXPECT_LE(delay["proven"].get<double>(), 0.6);
  EXPECT_NEAR(delay["contact"]["delay"].get<double>(), 0.6, 4e-3);
  EXPECT_NEAR(delay["contact"]["time"].get<double>(), 1.8, 4e-3);
  // At up to 25 % slower it leaves at 1.5 s.
  const Outcome slow = passes(1.0, {"--late", "east=0.29", "--slow", "east=25"});
  EXPECT_EQ(slow.exitCode, 0) << slow.out;
  EXPECT_THAT(slow.out, HasSubstr("free up to 0.29 s, at up to 25 % slower"));
  const Outcome slower = passes(1.0, {"--slow", "east=80"});
  EXPECT_EQ(slower.exitCode, 1);
  EXPECT_THAT(slower.out, AllOf(HasSubstr("nothing is proven, at up to 80 % slower"),
                                HasSubstr("% slower, at 1.8")));
  const Outcome two = passes(1.0, {"--late", "east=0.5", "--late", "north=9"});
  EXPECT_EQ(two.exitCode, 0);
  EXPECT_THAT(two.out, AllOf(HasSubstr("east: free"), HasSubstr("north: free up to 9 s")));
}

TEST_F(ScheduleProgram, WritesOneTrajectoryWithAProof) {
  const std::string out = folder_.path("both.json");
  const Outcome run = passes(0.5, {"-o", out});
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const Outcome verified = runSwept({"verify", out});
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
  // And is a trajectory of the cell like any other.
  const Outcome again = runSwept({"trajectory", file("cell.yaml"), out, "--group", "all"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("duration    2.5 s"));

  const std::string csv = folder_.path("both.csv");
  const Outcome smooth = schedule(
      {"east=" + file("smooth.csv"), "north=" + file("smooth.csv"), "--at", "north=2", "-o", csv});
  EXPECT_EQ(smooth.exitCode, 0) << smooth.out << smooth.err;
  EXPECT_EQ(runSwept({"trajectory", file("cell.yaml"), csv, "--group", "all"}).exitCode, 0);
}

TEST_F(ScheduleProgram, SaysWhyNothingIsWritten) {
  const std::string out = folder_.path("no.json");
  const Outcome collides = passes(0.0, {"-o", out});
  EXPECT_EQ(collides.exitCode, 1);
  EXPECT_THAT(collides.out, HasSubstr("not written to " + out + ": it is not free"));
  const Outcome mixed = schedule(
      {"east=" + file("pass.csv"), "north=" + file("corner.csv"), "--at", "north=3", "-o", out});
  EXPECT_EQ(mixed.exitCode, 2) << mixed.out;
  EXPECT_THAT(mixed.out, HasSubstr("no one trajectory has the curves of all parts"));
  EXPECT_FALSE(std::ifstream(out).good());
}

TEST_F(ScheduleProgram, PlansBesideATrajectory) {
  const auto arrival = [&](const std::string& speed) {
    const Outcome run = schedule({"east=" + file("pass.csv"), "--plan", "north=-1..1",
                                  "--max-acceleration", "10", "--speed", speed, "--json"});
    EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
    const auto found = nlohmann::json::parse(run.out);
    EXPECT_EQ(found["schedule"]["verdict"], "free");
    EXPECT_EQ(found["parts"][0]["planned"], false);
    EXPECT_EQ(found["parts"][1]["planned"], true);
    EXPECT_EQ(found["parts"][1]["file"], nullptr);
    return found["parts"][1]["end"].get<double>();
  };
  // At 2 m/s it has left the crossing by 0.7 s, before the other arrives; it takes 1.2 s.
  EXPECT_GE(arrival("1"), 1.2);
  EXPECT_LE(arrival("1"), 1.25);
  // At half of that it would be there from 1 s on, and has to wait until 1.2 s.
  EXPECT_GE(arrival("0.5"), 2.4 + 0.1);
  EXPECT_LE(arrival("0.5"), 2.4 + 0.6);

  const std::string out = folder_.path("planned.json");
  const Outcome run = schedule({"east=" + file("smooth.csv"), "--at", "east=0.2", "--plan",
                                "north=-1..1", "--max-acceleration", "10", "-o", out});
  EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("part        east, 0.2 to 2.2 s\n"),
                             HasSubstr("part        north, 0 to 1.2"), HasSubstr(" s, planned")));
  const Outcome verified = runSwept({"verify", out});
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
}

TEST_F(ScheduleProgram, PlansSeveralGroups) {
  const Outcome run = schedule({"--plan", "east=-1..1", "--plan", "north=-1..1",
                                "--max-acceleration", "10", "--seed", "3", "--late", "north=0.5"});
  EXPECT_THAT(run.out, AllOf(HasSubstr("schedule: free"), HasSubstr("part        east, 0 to 1.2")))
      << run.err;

  // What is planned leaves room for the delays that are asked about.
  EXPECT_EQ(run.exitCode, 0) << run.out;
  EXPECT_THAT(run.out, HasSubstr("late          north: free up to 0.5 s"));
  const Outcome slow = schedule({"--plan", "east=-1..1", "--plan", "north=-1..1",
                                 "--max-acceleration", "10", "--slow", "east=20"});
  EXPECT_EQ(slow.exitCode, 0) << slow.out << slow.err;
  EXPECT_THAT(slow.out, HasSubstr("east: free up to 0 s, at up to 20 % slower"));

  const Outcome meet =
      schedule({"--plan", "east=-1..0", "--plan", "north=-1..0.1", "--max-acceleration", "10"});
  EXPECT_EQ(meet.exitCode, 1) << meet.err;
  EXPECT_THAT(meet.out,
              AllOf(HasSubstr("schedule      not found: north: the goal is not free, even when all "
                              "others have come to rest: "),
                    HasSubstr("east/cube - north/cube")));
  const Outcome start = schedule(
      {"--plan", "east=0..1", "--plan", "north=0.1..1", "--max-acceleration", "10", "--json"});
  EXPECT_EQ(start.exitCode, 1) << start.err;
  const auto found = nlohmann::json::parse(start.out);
  EXPECT_EQ(found["schedule"], nullptr);
  EXPECT_EQ(found["status"], "start not free");
  EXPECT_EQ(found["not_found"], "east");
  EXPECT_EQ(found["contact"]["body_a"], "east/cube");
  // Nothing leads around a cube that stands in the crossing.
  const Outcome blocked = schedule({"east=" + file("stays.csv"), "--plan", "north=-1..1",
                                    "--max-acceleration", "10", "--time", "0.2"});
  EXPECT_EQ(blocked.exitCode, 1) << blocked.err;
  EXPECT_THAT(blocked.out, HasSubstr("not found: north: no way was found in 0.2 s"));
}

TEST_F(ScheduleProgram, ProvesDelaysBesideAnObjectThatIsNeverLate) {
  // It passes the crossing from above, within 0.2 m of it from 2.8 s to 3.2 s.
  write("cart.yaml", R"(world:
  collision_objects:
    - id: cart
      primitives: [{type: box, dimensions: [0.2, 0.2, 0.2]}]
      primitive_poses: [{position: [0, 0, 0], orientation: [0, 0, 0, 1]}]
      motion:
        - {time: 1, position: [0, 0, 2]}
        - {time: 5, position: [0, 0, -2]}
)");
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--scene", file("cart.yaml"), "--json"});
    const Outcome run = schedule(more);
    return nlohmann::json::parse(run.out, nullptr, false);
  };
  write("away.csv", "time,slide\n0,-2\n1,-2\n");
  const std::string north = "north=" + file("away.csv");
  // East leaves the crossing at 1.2 s, so it may be late by 1.6 s.
  const auto late = with({"east=" + file("pass.csv"), north, "--late", "east=2"});
  EXPECT_EQ(late["delays"][0]["verdict"], "collision");
  EXPECT_NEAR(late["delays"][0]["proven"].get<double>(), 1.6, 5e-3);
  EXPECT_EQ(late["delays"][0]["contact"]["witness"]["body_b"], "cart");
  // Half a second later at a third slower: it leaves the crossing at 0.5 s + 1.6 s.
  const auto slow =
      with({"east=" + file("pass.csv"), north, "--late", "east=0.5", "--slow", "east=33"});
  EXPECT_EQ(slow["delays"][0]["verdict"], "free");
  // What is planned leaves room: as early as it can be, or after the cart.
  const auto planned =
      with({north, "--plan", "east=-1..1", "--max-acceleration", "1", "--late", "east=0.5"});
  EXPECT_EQ(planned["schedule"]["verdict"], "free");
  EXPECT_EQ(planned["delays"][0]["verdict"], "free");
  EXPECT_EQ(planned["delays"][0]["proven"], 0.5);
}

TEST_F(ScheduleProgram, RefusesWhatIsNoSchedule) {
  const std::string pass = file("pass.csv");
  const auto err = [&](const std::vector<std::string>& more) {
    const Outcome run = schedule(more);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    return run.err;
  };
  EXPECT_THAT(err({pass}), HasSubstr("part '" + pass + "': must be GROUP=FILE"));
  EXPECT_THAT(err({"east=" + pass, "east=" + pass}),
              HasSubstr("group 'east' has a trajectory already"));
  EXPECT_THAT(err({"esat=" + pass}), HasSubstr("has no group 'esat'"));
  EXPECT_THAT(err({"east=" + pass, "--at", "north=1"}),
              HasSubstr("--at 'north=1': no part is of group 'north'; there are east"));
  EXPECT_THAT(err({"east=" + pass, "--at", "east=-1"}),
              HasSubstr("--at 'east=-1': '-1' is no number from 0 to 1000000 (S)"));
  EXPECT_THAT(err({"east=" + pass, "--late", "east=soon"}),
              HasSubstr("--late 'east=soon': 'soon' is no number from 0 to 1000000 (S)"));
  EXPECT_THAT(err({"east=" + pass, "--slow", "east"}),
              HasSubstr("--slow 'east': must be GROUP=PERCENT"));
  EXPECT_THAT(err({"east=" + pass, "--at", "east=1", "--at", "east=2"}),
              HasSubstr("--at 'east=2': group 'east' has one already"));
  EXPECT_THAT(err({"east=" + pass, "--group", "all"}),
              HasSubstr("the group of a schedule is that of its parts: leave out --group"));
  EXPECT_THAT(err({"east=" + pass, "all=" + pass}),
              HasSubstr("'slide', which is no joint of robot 'cell'; group 'all' has"));
  write("two.yaml",
        "joint_names: [slide]\npoints:\n- positions: [0]\n  time_from_start: {sec: 0, nanosec: 0}\n"
        "- positions: [1]\n  time_from_start: {sec: 1, nanosec: 0}\n---\n"
        "joint_names: [slide]\npoints:\n- positions: [1]\n  time_from_start: {sec: 0, nanosec: 0}\n"
        "- positions: [0]\n  time_from_start: {sec: 1, nanosec: 0}\n");
  EXPECT_THAT(err({"east=" + file("two.yaml")}),
              HasSubstr("the file has 2 trajectories, and a part is one"));
  write("wrong.csv", "time,glide\n0,1\n");
  EXPECT_THAT(err({"east=" + file("wrong.csv")}),
              AllOf(HasSubstr("wrong.csv:1"), HasSubstr("'glide', which is no joint of robot")));
  write("twice.csv", "time,slide,east/slide\n0,1,1\n1,1,1\n");
  EXPECT_THAT(err({"east=" + file("twice.csv")}), HasSubstr("a second time"));
  EXPECT_THAT(err({"east=" + pass, "-o", pass}), HasSubstr("pass.csv"));
  const std::string form = "': must be GROUP=START..GOAL";
  EXPECT_THAT(err({"--plan", "north"}), HasSubstr("--plan 'north" + form));
  EXPECT_THAT(err({"--plan", "north=-1"}), HasSubstr("--plan 'north=-1" + form));
  EXPECT_THAT(err({"--plan", "north=..1"}), HasSubstr("--plan 'north=..1" + form));
  EXPECT_THAT(err({}), HasSubstr("there is no trajectory: GROUP=FILE names one, --plan "
                                 "GROUP=START..GOAL plans one"));
  EXPECT_THAT(err({"east=" + pass, "--plan", "east=0..1"}),
              HasSubstr("--plan 'east=0..1': group 'east' has a trajectory already"));
  EXPECT_THAT(err({"--plan", "east=0..1", "--plan", "east=0..2"}),
              HasSubstr("--plan 'east=0..2': group 'east' is planned already"));
  EXPECT_THAT(err({"--plan", "east=0..1"}),
              HasSubstr("--plan: joint east/slide has no limit of acceleration, which its times "
                        "depend on; --limits or --max-acceleration gives one"));
  EXPECT_THAT(err({"--plan", "east=0..9", "--max-acceleration", "1"}),
              HasSubstr("--plan east: goal: east/slide is 9, allowed is -3 to 3 m"));
  EXPECT_THAT(err({"--plan", "east=0..1", "--at", "east=1", "--max-acceleration", "1"}),
              HasSubstr("--at: group 'east' is planned, and may move from 0 s on"));
  EXPECT_THAT(err({"east=" + pass, "--time", "1"}), HasSubstr("--time requires --plan"));
}

}  // namespace
}  // namespace swept::test
