// SPDX-License-Identifier: BSD-3-Clause
// A cart that drives past a gantry, and the commands that know when. All distances by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "page_data.hpp"
#include "printed_text.hpp"

namespace swept::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A cube of 0.2 m, along y from -2 to 2 m between 1 s and 5 s: the slide's x = 1 m is passed at
/// y = 0, at 3 s. The gantry's cube has 0.2 m, too, so that they meet for abs(y) <= 0.2 m.
constexpr const char* kScene = R"(world:
  collision_objects:
    - id: cart
      primitives: [{type: box, dimensions: [0.2, 0.2, 0.2]}]
      motion:
        - {time: 1, position: [1, -2, 0]}
        - {time: 5, position: [1, 2, 0]}
)";

const std::string kError = "swept: error: ";

class MovingScene : public testing::Test {
 protected:
  Outcome run(const std::string& command, std::vector<std::string> more) const {
    more.insert(more.begin(), {command, gantry_.urdf});
    more.insert(more.end(), {"--scene", scene_, "--group", "both"});
    return runSwept(more);
  }
  std::string csv(const std::string& text) const { return gantry_.folder().write("t.csv", text); }

  const Gantry gantry_;
  const std::string scene_ = gantry_.folder().write("cart.yaml", kScene);
};

TEST_F(MovingScene, AStateIsCheckedAtItsTime) {
  const Outcome there = run("check", {"1,0", "--time", "3"});
  EXPECT_EQ(there.exitCode, 1) << there.err;
  EXPECT_THAT(there.out, HasSubstr("state 1 at 3 s: collision\n"));
  EXPECT_THAT(there.out, HasSubstr("cube - cart"));
  // 0.3 m beyond the two cubes' halves.
  const Outcome gone = run("check", {"1,0", "--time", "3.5", "--json"});
  EXPECT_EQ(gone.exitCode, 0) << gone.err;
  const auto state = jsonOf(gone)["states"][0];
  EXPECT_EQ(state["time"], 3.5);
  EXPECT_EQ(state["values"].size(), 2U);
  EXPECT_NEAR(state["clearance"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(jsonOf(run("check", {"1,0", "--time", "-9", "--json"}))["states"][0]["clearance"]
                  .get<double>(),
              1.8, 1e-9)
      << "before the first waypoint it stands";
}

TEST_F(MovingScene, AMotionHasATimeForEachState) {
  // Both at rest: the cart arrives at y = -0.2 at 2.8 s, 0.7 of the way.
  const Outcome waits = run("motion", {"1,0", "1,0", "--times", "0,4"});
  EXPECT_EQ(waits.exitCode, 1) << waits.err;
  EXPECT_THAT(waits.out, HasSubstr("state 1 at 0 s to state 2 at 4 s: collision\n"));
  EXPECT_THAT(waits.out,
              ContainsRegex("contact +t = 0\\.70*[0-9]* \\(2\\.8[0-9]* s\\), cube - cart"));
  const auto segment =
      jsonOf(run("motion", {"1,0", "1,0", "--times", "0,4", "--json"}))["segments"][0];
  EXPECT_EQ(segment["times"][0], 0.0);
  EXPECT_EQ(segment["times"][1], 4.0);
  EXPECT_LE(segment["free_until"].get<double>(), 0.7);
  EXPECT_NEAR(segment["witness"]["t"].get<double>(), 0.7, 1e-3);
  // Over it at 3 s, and back down when it has passed.
  EXPECT_EQ(run("motion", {"1,0", "1,0.5", "1,0.5", "1,0", "--times", "0,1,4,5"}).exitCode, 0);
}

TEST_F(MovingScene, ATrajectoryStartsWhenTheClockSays) {
  // Under way to x = 1 m and back, there at its own 1 s.
  const std::string file = csv("time,slide,lift\n0,0,0\n1,1,0\n2,0,0\n");
  const Outcome before = run("trajectory", {file});
  EXPECT_EQ(before.exitCode, 0) << before.err << before.out;
  EXPECT_THAT(before.out, HasSubstr("  clock       shows 0 s at the time 0\n"));
  const Outcome meets = run("trajectory", {file, "--clock", "2", "--json"});
  EXPECT_EQ(meets.exitCode, 1) << meets.err;
  const auto json = jsonOf(meets);
  EXPECT_EQ(json["clock"], 2.0);
  EXPECT_EQ(json["trajectories"][0]["verdict"], "collision");
  EXPECT_EQ(run("trajectory", {file, "--clock", "3"}).exitCode, 0);
}

TEST_F(MovingScene, ARobotIsPlannedBesideIt) {
  const Outcome planned = run("info", {});
  EXPECT_EQ(planned.exitCode, 0) << planned.err;
  EXPECT_THAT(planned.out, ContainsRegex("cart +box 0\\.2.*, moves from 1 to 5 s\n"));
  std::vector<std::string> words{"schedule",           gantry_.urdf, "--plan",
                                 "both=0,0..2,0",      "--scene",    scene_,
                                 "--max-acceleration", "1"};
  const Outcome schedule = runSwept(words);
  EXPECT_EQ(schedule.exitCode, 0) << schedule.out << schedule.err;
  EXPECT_THAT(schedule.out, HasSubstr("schedule: free\n"));
}

TEST_F(MovingScene, ATrajectoryBesideItHasAProof) {
  const std::string file = csv("time,slide,lift\n0,0,0\n1,1,0\n2,0,0\n");
  const std::string proof = gantry_.folder().path() + "/proof.json";
  const Outcome written = run("trajectory", {file, "--clock", "3.1", "-o", proof});
  EXPECT_EQ(written.exitCode, 0) << written.err << written.out;
  EXPECT_THAT(written.out, HasSubstr("written to " + proof));
  const Outcome verified = runSwept({"verify", proof});
  EXPECT_EQ(verified.exitCode, 0) << verified.err << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("verified: trajectory of 2 s, 2 pieces"));
  EXPECT_THAT(verified.out, HasSubstr("beside what moves, from 3.1 to 5.1 s of its clock: cart\n"));
  const auto json = jsonOf(runSwept({"verify", proof, "--json"}));
  EXPECT_EQ(json["moving"][0], "cart");
  EXPECT_EQ(json["clock"][0], 3.1);
  // When the cart starts elsewhere, it is another world.
  gantry_.folder().write("cart.yaml", replaced(kScene, "[1, -2, 0]", "[1, -2.5, 0]"));
  const Outcome moved = runSwept({"verify", proof});
  EXPECT_EQ(moved.exitCode, 1) << moved.err;
  EXPECT_EQ(moved.out, "refused: body cart: is not as it was when the path was certified\n");
  // What collides has none.
  gantry_.folder().write("cart.yaml", kScene);
  const Outcome met = run("trajectory", {file, "--clock", "2", "-o", proof});
  EXPECT_EQ(met.exitCode, 1);
  EXPECT_THAT(met.out, HasSubstr("not written to " + proof + ": it is not free"));
}

TEST_F(MovingScene, RulesMayNameIt) {
  EXPECT_EQ(run("check", {"1,0", "--time", "3", "--allow", "cube,cart"}).exitCode, 0);
  EXPECT_EQ(run("check", {"1,0", "--time", "3.5", "--pad", "cart=0.31"}).exitCode, 1);
}

TEST_F(MovingScene, CommandsWithoutAClockRefuseIt) {
  const std::string clocks =
      " has no clock; swept check --time, motion --times, trajectory, schedule and view --time "
      "have one, and swept schedule --plan plans beside what moves\n";
  const std::string moves = kError + "object 'cart' of the scene moves, and swept ";
  EXPECT_EQ(run("plan", {"0,0", "2,0"}).err, moves + "plan" + clocks);
  EXPECT_EQ(run("certify", {csv("slide,lift\n0,0\n1,0\n")}).err, moves + "certify" + clocks);
}

TEST_F(MovingScene, APageShowsItWhereItIs) {
  if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  const std::string page = gantry_.folder().path("page.html");
  const auto shown = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"-o", page});
    const Outcome outcome = run("view", more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    std::ifstream stream(page);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_THAT(shown({"1,0", "1,0.5", "--time", "3.5"}),
              AllOf(HasSubstr("state 1 at 3.5 s"), HasSubstr("state 2 at 3.5 s")));
  EXPECT_THAT(shown({}), HasSubstr("default state at 1 s"));  // when the cart begins to move
  EXPECT_THAT(shown({"--time", "2"}), HasSubstr("default state at 2 s"));
  EXPECT_EQ(run("view", {"1,0", "-o", page}).err,
            kError + "object 'cart' of the scene moves: --time S says when the states are shown\n");
  EXPECT_EQ(gantry_.run("view", {"0,0", "--time", "3", "-o", page}).err,
            kError + "--time: no object of the scene moves (an object with a 'motion' does)\n");
}

TEST_F(MovingScene, TimesThatAreMissingOrWrongAreNamed) {
  const auto error = [&](const std::string& command, const std::vector<std::string>& more) {
    const Outcome outcome = run(command, more);
    EXPECT_EQ(outcome.exitCode, 3);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_EQ(
      error("check", {"1,0"}),
      kError + "object 'cart' of the scene moves: --time S says when the states are checked\n");
  EXPECT_EQ(error("motion", {"1,0", "0,0"}),
            kError +
                "object 'cart' of the scene moves: --times T,T,... says when the robot is at "
                "each state\n");
  EXPECT_EQ(error("motion", {"1,0", "0,0", "--times", "1"}),
            kError + "--times: 1 time for 2 states; each state has one\n");
  EXPECT_EQ(error("motion", {"1,0", "0,0", "--times", "1,x"}),
            kError + "--times: 'x' is no number from -1000000 to 1000000 (s)\n");
  EXPECT_EQ(error("motion", {"1,0", "0,0", "--times", "1,1"}),
            kError +
                "--times: state 2 is at 1 s; the motion to it begins at 1 s, and has to end "
                "later\n");
  EXPECT_THAT(error("check", {"1,0", "--time", "1e7"}), HasSubstr("between -1e6 and 1e6 s"));
  const std::string two = gantry_.folder().write(
      "two.yaml",
      "joint_names: [slide, lift]\npoints: [{positions: [0, 0], time_from_start: 0}, {positions: "
      "[1, 0], time_from_start: 1}]\n---\njoint_names: [slide, lift]\npoints: [{positions: [1, 0], "
      "time_from_start: 0}, {positions: [0, 0], time_from_start: 1}]\n");
  EXPECT_EQ(error("trajectory", {two}),
            kError + "'" + two +
                "' has 2 trajectories, each with a time 0 of its own; beside 'cart', which moves, "
                "one is allowed\n");
}

TEST_F(MovingScene, WhatIsNotFreeIsWrittenWithItsTimesAndAskedAgain) {
  const std::string folder = gantry_.folder().path("dump");
  EXPECT_EQ(run("check", {"1,0", "1,0.5", "--time", "3", "--dump", folder}).exitCode, 1);
  EXPECT_EQ(run("motion", {"1,0", "1,0", "--times", "0,4", "--dump", folder}).exitCode, 1);
  std::vector<std::string> words{"replay"};
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    words.push_back(entry.path().string());
  std::ranges::sort(words.begin() + 1, words.end());
  ASSERT_EQ(words.size(), 3U);  // the state over the cart is free
  const auto fileOf = [&](std::size_t i) {
    std::ifstream stream(words.at(i));
    return nlohmann::json::parse(stream);
  };
  const nlohmann::json motion = fileOf(1), state = fileOf(2);
  EXPECT_EQ(motion["cases"][0]["times"], nlohmann::json({0.0, 4.0}));
  EXPECT_EQ(motion["cases"][0]["from"], nlohmann::json({1.0, 0.0}));
  EXPECT_EQ(state["cases"][0]["time"], 3.0);
  EXPECT_EQ(state["cases"][0]["state"], nlohmann::json({1.0, 0.0}));
  const Outcome again = runSwept(words);
  EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
  EXPECT_THAT(again.out, HasSubstr("2 passed, 0 failed, 0 skipped"));
  // At another time the answer is another one, and without any there is none.
  const auto answer = [&](nlohmann::json file, const std::function<void(nlohmann::json&)>& change) {
    change(file["cases"][0]);
    const std::string path = folder + "/changed.json";
    std::ofstream(path) << file;
    return runSwept({"replay", path}).out;
  };
  EXPECT_THAT(answer(state, [](nlohmann::json& one) { one["time"] = 5.0; }), HasSubstr("wrong"));
  EXPECT_THAT(answer(motion,
                     [](nlohmann::json& one) {
                       one["times"] = {0.0, 1.0};
                     }),
              HasSubstr("wrong"));
  EXPECT_THAT(answer(motion, [](nlohmann::json& one) { one.erase("times"); }),
              HasSubstr("object 'cart' of the scene moves, and the case has no 'times'"));
  EXPECT_THAT(answer(state, [](nlohmann::json& one) { one.erase("time"); }),
              HasSubstr("object 'cart' of the scene moves, and the case has no 'time'"));
  EXPECT_THAT(answer(state, [](nlohmann::json& one) { one["inputs"].erase("scene"); }),
              HasSubstr("'time': no object of the scene moves"));
}

TEST_F(MovingScene, TimesWithoutAnythingThatMovesAreRefused) {
  const std::string nothing = ": no object of the scene moves (an object with a 'motion' does)\n";
  EXPECT_EQ(gantry_.run("check", {"0,0", "--time", "3"}).err, kError + "--time" + nothing);
  EXPECT_EQ(gantry_.run("motion", {"0,0", "0,1", "--times", "0,1"}).err,
            kError + "--times" + nothing);
  EXPECT_EQ(gantry_.run("trajectory", {csv("time,slide,lift\n0,0,0\n1,0,1\n"), "--clock", "0"}).err,
            kError + "--clock" + nothing);
}

}  // namespace
}  // namespace swept::test
