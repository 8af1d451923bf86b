// SPDX-License-Identifier: BSD-3-Clause
// What the program says of the world and of the robot itself, by itself. A hand turns about its own
// middle, 13.6 mm from its carriage whatever they do, and a post stands beside their way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "program.hpp"
#include "slide_robot.hpp"

namespace swept::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

const std::string kUrdf = slideUrdf("1 0 0");

constexpr const char* kScene = R"(name: post
world:
  collision_objects:
    - id: post
      primitives: [{type: sphere, dimensions: [0.05]}]
      primitive_poses: [{position: [0, 0.31, 0], orientation: [0, 0, 0, 1]}]
)";

class Margins : public testing::Test {
 protected:
  Margins() : urdf_(folder_.write("slide.urdf", kUrdf)), scene_(folder_.write("p.yaml", kScene)) {}
  Outcome run(const std::string& command, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{command, urdf_, "--srdf", "none", "--scene", scene_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwept(arguments);
  }

  TemporaryFolder folder_;
  const std::string urdf_, scene_;
};

TEST_F(Margins, StatesHaveBothClearances) {
  EXPECT_EQ(run("check", {"0,0"}).out,
            "state 1: free, clearance 0.0136 m, nearest carriage - hand (self); world 0.21 m, "
            "nearest carriage - post\n");
  const Json state = jsonOf(run("check", {"0,0", "--json"}))["states"][0];
  EXPECT_NEAR(state["clearance"], 0.0136, 1e-8);
  EXPECT_NEAR(state["clearance_self"], 0.0136, 1e-8);
  EXPECT_NEAR(state["clearance_world"], 0.21, 1e-8);
  EXPECT_EQ(state["nearest"], Json({"carriage", "hand"}));
  EXPECT_EQ(state["nearest_self"], Json({"carriage", "hand"}));
  EXPECT_EQ(state["nearest_world"], Json({"carriage", "post"}));
}

TEST_F(Margins, MotionsHaveBothClearances) {
  const Outcome text = run("motion", {"-0.5,-1", "0.5,1"});
  EXPECT_THAT(text.out,
              testing::ContainsRegex(
                  "  clearance   0\\.013[56][0-9]* m or more, and no more than 0\\.0136 "
                  "m \\(at t = [0-9.]+\\), nearest carriage - hand \\(self\\)\n"
                  "  world       0\\.2(09|1)[0-9]* m or more, .*nearest [a-z]+ - post\n"));
  const Json motion = jsonOf(run("motion", {"-0.5,-1", "0.5,1", "--json"}))["segments"][0];
  EXPECT_NEAR(motion["clearance"]["lower"], 0.0136, 1e-3);
  EXPECT_NEAR(motion["clearance_self"]["upper"], 0.0136, 1e-8);
  EXPECT_NEAR(motion["clearance_world"]["lower"], 0.21, 2e-4);
  EXPECT_EQ(motion["clearance_world"]["nearest"][1], "post");
}

TEST_F(Margins, EachKindHasItsOwn) {
  EXPECT_EQ(run("check", {"0,0", "--margin", "0.02"}).exitCode, 1);
  EXPECT_EQ(run("check", {"0,0", "--margin", "0.02", "--margin-self", "0.01"}).exitCode, 0);
  EXPECT_EQ(run("check", {"0,0", "--margin-world", "0.2"}).exitCode, 0);
  EXPECT_EQ(run("check", {"0,0", "--margin-world", "0.22"}).exitCode, 1);
  EXPECT_EQ(run("check", {"0,0", "--margin-self", "0.02"}).exitCode, 1);
  EXPECT_EQ(run("motion", {"0,0", "1,0", "--margin-world", "0.2"}).exitCode, 0);
  EXPECT_EQ(run("motion", {"0,0", "1,0", "--margin-world", "0.22"}).exitCode, 1);
  const Json json =
      jsonOf(run("check", {"0,0", "--margin", "0.2", "--margin-self", "0", "--json"}));
  EXPECT_EQ(json["margin"], 0.2);
  EXPECT_EQ(json["margin_self"], 0.0);
  EXPECT_EQ(json["margin_world"], 0.2);
  EXPECT_EQ(run("check", {"0,0", "--margin-self", "-1"}).exitCode, 3);
}

TEST_F(Margins, ReasonsSayThatNothingTouches) {
  const std::string contact =
      "carriage - hand: distance 0.0136 m, closer than the margin of 0.02 m, at [";
  const Outcome check = run("check", {"0,0", "--margin", "0.02"});
  EXPECT_THAT(check.out, HasSubstr("state 1: collision (closer than the margin)\n  " + contact));
  EXPECT_THAT(run("motion", {"0,0", "1,0", "--margin", "0.02"}).out, HasSubstr(contact));
  EXPECT_THAT(run("plan", {"0,0", "1,0", "--margin", "0.02"}).out,
              HasSubstr("not solved: start is closer than the margin: carriage - hand (0.0136 m "
                        "apart, margin 0.02 m, at ["));
  // Bodies that touch are in collision, whatever the margin.
  folder_.write("p.yaml", std::string(kScene).replace(std::string(kScene).find("0.31"), 4, "0.09"));
  const Outcome touching = run("check", {"0,0", "--margin-world", "0.2"});
  EXPECT_THAT(touching.out, HasSubstr("state 1: collision\n  carriage - post: distance 0 m, at ["));
  EXPECT_THAT(run("plan", {"0,0", "1,0", "--margin-world", "0.2"}).out,
              HasSubstr("not solved: start is in collision: carriage - post (0.01 m deep, at ["));
}

TEST_F(Margins, PathsHaveThemAndProofsHold) {
  const std::string file = folder_.path("path.json");
  const Outcome plan = run("plan", {"-0.5,-1", "0.5,1", "--margin-self", "0.01", "--margin-world",
                                    "0.1", "-o", file, "--embed"});
  EXPECT_EQ(plan.exitCode, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("\nsolved: 1 segment, proven free\nclearance 0.01"));
  EXPECT_THAT(plan.out, HasSubstr(", nearest carriage - hand (self); world 0.2"));
  Json path = Json::parse(folder_.read("path.json"));
  EXPECT_EQ(path["margin_self"], 0.01);
  EXPECT_EQ(path["inputs"]["margin_world"], 0.1);
  EXPECT_NEAR(path["segments"][0]["clearance_world"], 0.21, 2e-4);
  EXPECT_NEAR(path["segments"][0]["clearance_self"], 0.0136, 1e-3);
  EXPECT_EQ(path["segments"][0]["nearest_self"], Json({"carriage", "hand"}));
  const Outcome verified = runSwept({"verify", file});
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, testing::ContainsRegex("; pairs with the world more than 0\\.[0-9]+ m, "
                                                   "pairs of the robot's bodies more than 0\\.01"));
  path["model"]["margin_world"] = 0.05;
  folder_.write("path.json", path.dump());
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 1);
  path["model"]["margin_world"] = 0.1;
  path["margin_world"] = 0.05;
  folder_.write("path.json", path.dump());
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 1);
}

/// The proof is of the margins that the file says, also where robot and world are read again.
TEST_F(Margins, PathsAreProvenWithTheirOwnAgain) {
  const std::string file = folder_.path("path.json");
  ASSERT_EQ(run("plan", {"-0.5,-1", "0.5,1", "--margin-world", "0.1", "-o", file}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 0);
  Json path = Json::parse(folder_.read("path.json"));
  path["inputs"]["margin_world"] = 0.05;
  folder_.write("path.json", path.dump());
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 1);
}

}  // namespace
}  // namespace swept::test
