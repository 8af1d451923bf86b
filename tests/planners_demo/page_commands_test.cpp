// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "page_data.hpp"

/// Pages of each subcommand, `view`, and what cannot be a page.
namespace swept::test {
namespace {

using nlohmann::json;

const std::string kRook = "models/robots/rook7/rook7.urdf";
const std::string kShelf = "models/scenes/shelf.yaml";
const std::string kSlot = "models/scenes/narrow_slot.yaml";

std::vector<std::string> namesOf(const json& bodies) {
  std::vector<std::string> names;
  for (const json& body : bodies) names.push_back(body["name"]);
  return names;
}

std::string factOf(const json& data, const std::string& name) {
  for (const json& fact : data["facts"])
    if (fact[0] == name) return fact[1];
  return {};
}

class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  }
  /// The page of a command line that has all but --html.
  json pageOf(std::vector<std::string> arguments, int exitCode = 0) {
    arguments.insert(arguments.end(), {"--html", folder_.path("p.html")});
    const Outcome run = runSwept(arguments);
    EXPECT_EQ(run.exitCode, exitCode) << run.err;
    return pageData(folder_.read("p.html"));
  }
  TemporaryFolder folder_;
};

TEST_F(Page, TrajectoryPlaysItsCurve) {
  const std::vector<std::string> command{
      "trajectory", kRook,    "models/trajectories/rook7_shelf.yaml",
      "--group",    "arm",    "--tracking",
      "0.005",      "--scene"};
  std::vector<std::string> free = command, colliding = command;
  free.push_back(kShelf);
  colliding.push_back(kSlot);
  const json data = pageOf(free);
  EXPECT_EQ(data["headline"], "trajectory: free");
  EXPECT_EQ(data["tone"], "good");
  ASSERT_EQ(data["motions"].size(), 1u);
  EXPECT_TRUE(data["motions"][0].contains("curve"));
  EXPECT_EQ(data["paths"][0]["label"], "trajectory");
  EXPECT_EQ(pageOf(colliding, 1)["tone"], "bad");
}

TEST_F(Page, TimedPlanPlaysItsTrajectory) {
  const std::vector<std::string> plan{"plan",    kRook, "home",    "ready",
                                      "--group", "arm", "--scene", kSlot};
  std::vector<std::string> timed = plan, said = plan;
  timed.insert(timed.end(), {"--timed", "--max-acceleration", "3"});
  said.emplace_back("--json");
  const json data = pageOf(timed);
  EXPECT_EQ(data["title"], "swept plan");
  EXPECT_EQ(data["headline"], "trajectory: free");
  EXPECT_EQ(data["tone"], "good");
  ASSERT_EQ(data["motions"].size(), 1u);
  // Beside it are the states of the path, packed: 7 values of 8 bytes, 4 characters for 3 bytes.
  const std::size_t states = jsonOf(runSwept(said))["states"].size();
  ASSERT_GE(states, 3u);
  EXPECT_EQ(data["motions"][0]["curve"]["polyline"].get<std::string>().size(),
            4 * ((states * 7 * 8 + 2) / 3));
  EXPECT_THAT(data["facts"].dump(), testing::HasSubstr("CertifiedConnect"));
}

TEST_F(Page, CheckShowsItsStatesAndContacts) {
  const std::vector<std::string> states{"home", "ready", "0.2,0.4,0,1.2,0,0.8,0"};
  std::vector<std::string> command{"check", kRook, "--group", "arm", "--scene", kSlot};
  command.insert(command.end(), states.begin(), states.end());
  const json data = pageOf(command, 1);
  command.push_back("--json");
  const json said = jsonOf(runSwept(command));
  EXPECT_EQ(data["headline"], "3 states: 2 free, 1 in collision");
  EXPECT_EQ(data["tone"], "bad");
  ASSERT_EQ(data["states"].size(), 3u);
  EXPECT_EQ(data["frames"]["count"], 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(data["states"][i]["verdict"], said["states"][i]["verdict"]);
    EXPECT_EQ(data["states"][i]["values"], said["states"][i]["values"]);
    EXPECT_EQ(data["states"][i]["clearance"], said["states"][i]["clearance"]);
  }
  ASSERT_EQ(data["states"][2]["contacts"].size(), 1u);
  const json& contact = data["states"][2]["contacts"][0];
  EXPECT_EQ(contact["body_b"], "plate_left");
  EXPECT_EQ(contact["point_a"], said["states"][2]["contacts"][0]["point_a"]);
}

TEST_F(Page, MotionShowsWhereItCollides) {
  const std::vector<std::string> command{"motion",  kRook, "home",    "ready",
                                         "--group", "arm", "--scene", kSlot};
  const json data = pageOf(command, 1);
  ASSERT_EQ(data["motions"].size(), 1u);
  const json& motion = data["motions"][0];
  EXPECT_EQ(data["headline"], "motion: in collision");
  EXPECT_EQ(motion["label"], "state 1 (home) to state 2 (ready)");
  ASSERT_EQ(motion["contacts"].size(), 1u);
  EXPECT_EQ(motion["contacts"][0]["body_a"], "finger_left");
  EXPECT_EQ(motion["contacts"][0]["body_b"], "lintel");
  const json& tiers = motion["pieces"]["tiers"];
  // The parts before the one in which it is free no more are free, and that one is not.
  const auto first = static_cast<std::size_t>(motion["contacts"][0]["t"].get<double>() *
                                              static_cast<double>(tiers.size()));
  ASSERT_GT(first, 0u);
  for (std::size_t i = 0; i < first; ++i)
    EXPECT_TRUE(tiers[i] == "lanes" || tiers[i] == "exact") << tiers[i];
  EXPECT_EQ(tiers[first], "collision");
}

TEST_F(Page, InfoShowsTheDefaultStateWithAndWithoutAGroup) {
  const json without = pageOf({"info", kRook, "--scene", kShelf});
  EXPECT_EQ(without["tone"], "plain");
  EXPECT_TRUE(without["clearances"].is_null());
  EXPECT_TRUE(without["states"][0]["verdict"].is_null());
  const json with = pageOf({"info", kRook, "--scene", kShelf, "--group", "arm"});
  EXPECT_EQ(with["states"][0]["label"], "default state");
  EXPECT_TRUE(with["states"][0]["verdict"].is_string());
  EXPECT_EQ(namesOf(with["bodies"]), namesOf(without["bodies"]));
  EXPECT_THAT(namesOf(with["bodies"]), testing::IsSupersetOf({"hand", "board_1"}));
}

TEST_F(Page, AnUnsolvedProblemShowsItsEnds) {
  const json data = pageOf(
      {"plan", kRook, "home", "0.2,0.4,0,1.2,0,0.8,0", "--group", "arm", "--scene", kSlot}, 1);
  EXPECT_EQ(data["tone"], "bad");
  EXPECT_EQ(data["headline"], "not solved: goal is in collision");
  EXPECT_THAT(data["reason"].get<std::string>(),
              testing::StartsWith("goal is in collision: link5 - plate_left ("));
  EXPECT_TRUE(data["motions"].empty());
  EXPECT_EQ(data["states"].size(), 2u);
  EXPECT_EQ(data["opens_at"], 1);
}

/// However many goals there are, the headline stays a line.
TEST_F(Page, AnUnsolvedProblemOfManyGoalsCountsThem) {
  const std::string hit = "0.2,0.4,0,1.2,0,0.8,0", also = "0.21,0.4,0,1.2,0,0.8,0";
  const std::vector<std::string> slot{"--group", "arm", "--scene", kSlot};
  const auto headlineOf = [&](const std::vector<std::string>& states) {
    std::vector<std::string> command{"plan", kRook};
    command.insert(command.end(), states.begin(), states.end());
    command.insert(command.end(), slot.begin(), slot.end());
    return pageOf(command, 1);
  };
  const json several = headlineOf({"home", hit, also, hit});
  EXPECT_EQ(several["headline"], "not solved: 3 ends are in collision");
  EXPECT_EQ(several["opens_at"], 1);
  const json both = headlineOf({hit, also});
  EXPECT_EQ(both["headline"], "not solved: start and goal are in collision");
  EXPECT_EQ(both["opens_at"], 0);
}

TEST_F(Page, HasTheTreeThatTheRobotIs) {
  const std::string urdf =
      folder_.write("r.urdf",
                    "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
                    "<joint name='spin' type='revolute'><parent link='a'/><child link='b'/>"
                    "<origin xyz='0.1 0.2 0.3' rpy='0 0 1.5707963267948966'/><axis xyz='0 0 2'/>"
                    "<limit lower='-1' upper='2' effort='1' velocity='1'/></joint>"
                    "<joint name='slave' type='prismatic'><parent link='b'/><child link='c'/>"
                    "<limit lower='-9' upper='9' effort='1' velocity='1'/>"
                    "<mimic joint='spin' multiplier='3' offset='0.5'/></joint></robot>");
  const json tree = pageOf({"info", urdf})["tree"];
  EXPECT_EQ(tree["links"], json({"a", "b", "c"}));
  ASSERT_EQ(tree["joints"].size(), 2u);
  const json& spin = tree["joints"][0];
  EXPECT_EQ(spin["parent"], 0);
  EXPECT_EQ(spin["child"], 1);
  EXPECT_EQ(spin["position"], json({0.1, 0.2, 0.3}));
  EXPECT_EQ(spin["axis"], json({0.0, 0.0, 1.0}));
  EXPECT_NEAR(spin["turn"][2].get<double>(), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(spin["variable"], 0);
  EXPECT_TRUE(spin["mimic"].is_null());
  EXPECT_EQ(tree["joints"][1]["variable"], 0);
  EXPECT_EQ(tree["joints"][1]["mimic"],
            json({{"joint", "spin"}, {"multiplier", 3.0}, {"offset", 0.5}}));
  ASSERT_EQ(tree["variables"].size(), 1u);
  EXPECT_EQ(tree["variables"][0]["upper"], 2.0);
  EXPECT_EQ(tree["variables"][0]["unit"], "rad");
  EXPECT_EQ(tree["reference"], json({0.0}));
}

TEST_F(Page, SaysWhatACloudsProofIsFor) {
  const json data =
      pageOf({"check", kRook, "ready", "--group", "arm", "--cloud", "models/clouds/shelf.bt"});
  EXPECT_EQ(data["clouds"], "body shelf is 6107 balls of radius 0.0173205 m and 12 boxes\n");
  std::size_t balls = 0, boxes = 0;
  for (const json& part : data["bodies"].back()["parts"]) {
    const json& geometry = data["geometries"][part["geometry"].get<std::size_t>()];
    if (geometry["kind"] == "balls") balls += floats(geometry["balls"]).size() / 4;
    boxes += geometry["kind"] == "box";
  }
  EXPECT_EQ(balls, 6107u);
  EXPECT_EQ(boxes, 12u);
}

/// Few enough of a large cloud, from all over it; distances are to all of it.
TEST_F(Page, DrawsSomeOfALargeCloud) {
  std::string points;
  constexpr int kPoints = 150'001;
  for (int i = 0; i < kPoints - 1; ++i) {
    const int row = i / 500, column = i % 500;
    points += std::to_string(1.5 + column * 0.002) + " " + std::to_string(row * 0.002) + " 0.5\n";
  }
  const std::string cloud = folder_.write("large.xyz", points + "0.6 0 0.2\n");
  const std::vector<std::string> command{"check",   kRook, "ready",          "--group", "arm",
                                         "--cloud", cloud, "--point-radius", "0.001"};
  const json data = pageOf(command);
  const json& part = data["bodies"].back()["parts"][0];
  const json& shape = data["geometries"][part["geometry"].get<std::size_t>()];
  const std::vector<float> balls = floats(shape["balls"]);
  EXPECT_EQ(shape["of"], kPoints);
  EXPECT_EQ(shape["drawn"], balls.size() / 4);
  EXPECT_LE(balls.size() / 4, 100'000u);
  EXPECT_GT(balls.size() / 4, 50'000u);
  std::array<int, 5> perFifth{};
  for (std::size_t i = 0; i < balls.size(); i += 4)
    if (balls[i] > 1.4f)
      ++perFifth.at(std::min<std::size_t>(4, std::size_t((balls[i] - 1.5f) * 5)));
  for (const int count : perFifth) EXPECT_NEAR(count, double(balls.size()) / 20, 1500);
  // The one ball that is near may not be drawn.
  const float nearest = floats(data["clearances"]["distance"]).back();
  EXPECT_GT(nearest, 0.1f);
  EXPECT_LT(nearest, 0.6f);
}

TEST_F(Page, ShowsPaddedAndScaledBodiesAsTheyAreChecked) {
  const std::vector<std::string> plain{"check", kRook,     "ready", "--group",
                                       "arm",   "--scene", kShelf};
  std::vector<std::string> larger = plain;
  larger.insert(larger.end(), {"--scale", "board_1=1.5", "--pad", "hand=0.01"});
  const auto sizeOf = [](const json& data) {
    for (const json& body : data["bodies"])
      if (body["name"] == "board_1")
        return data["geometries"][body["parts"][0]["geometry"].get<std::size_t>()]["size"];
    return json();
  };
  const json before = sizeOf(pageOf(plain)), after = pageOf(larger);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(sizeOf(after)[axis].get<double>(), 1.5 * before[axis].get<double>(), 1e-12);
  for (const json& body : after["bodies"])
    EXPECT_EQ(body["padding"].get<double>(), body["name"] == "hand" ? 0.01 : 0.0);
}

/// A name that would end the script element, and bytes that are no text.
TEST_F(Page, NamesCannotBreakOut) {
  const std::string name = "</script><script>alert(1)</script>&amp;\\\"<!--";
  const std::string quoted = json(name).dump();
  const std::string scene = folder_.write(
      "s.yaml",
      "world:\n  collision_objects:\n    - id: " + quoted +
          "\n      header: {frame_id: world}\n      primitives:\n        - {type: sphere, "
          "dimensions: [0.1]}\n      primitive_poses:\n        - {position: [2, 0, 0], "
          "orientation: [0, 0, 0, 1]}\n      operation: add\n");
  const json data = pageOf({"check", kRook, "ready", "--group", "arm", "--scene", scene});
  EXPECT_EQ(namesOf(data["bodies"]).back(), name);
  const std::string html = folder_.read("p.html");
  const std::string text = between(html, "<script id=\"data\" type=\"application/json\">", "\n");
  EXPECT_THAT(text, testing::EndsWith("}</script>"));
  EXPECT_EQ(text.find_first_of("<>&"), text.size() - std::string("</script>").size());
}

/// Pasted into a shell, the command of a page makes the same page.
TEST_F(Page, ItsCommandMakesItAgain) {
  const json data = pageOf({"check", kRook, "ready", "--group", "arm", "--scene", kShelf, "--allow",
                            "*,board_1", "--pad", "hand=0.01", "--package", "it's=models"});
  const std::string command = factOf(data, "command");
  EXPECT_THAT(command, testing::HasSubstr(" --allow '*,board_1' "));
  std::filesystem::remove(folder_.path("p.html"));
  EXPECT_EQ(runShell(command).exitCode, 0);
  EXPECT_EQ(pageData(folder_.read("p.html")), data);
}

TEST_F(Page, ViewWritesOrOpens) {
  const std::string page = folder_.path("v.html");
  const Outcome written = runSwept({"view", kRook, "--scene", kShelf, "-o", page});
  EXPECT_EQ(written.exitCode, 0) << written.err;
  EXPECT_EQ(written.out, "page written to " + page + "\n");
  EXPECT_EQ(pageData(folder_.read("v.html"))["title"], "swept view");

  folder_.write("xdg-open", "#!/bin/sh\nprintf %s \"$1\" > \"${0%/*}/opened\"\n");
  std::filesystem::permissions(folder_.path("xdg-open"), std::filesystem::perms::owner_all);
  const Outcome opened = runShell("export PATH='" + folder_.path() + "':\"$PATH\" TMPDIR='" +
                                  folder_.path() + "'; swept view " + kRook + " ready --group arm");
  EXPECT_EQ(opened.exitCode, 0) << opened.err;
  const std::string name = folder_.read("opened");
  EXPECT_EQ(opened.out, "page written to " + name + "\n");
  EXPECT_THAT(name, testing::MatchesRegex(".*/swept-......\\.html"));
  const std::string file = std::filesystem::path(name).filename().string();
  EXPECT_EQ(pageData(folder_.read(file))["states"][0]["label"], "state 1 (ready)");
}

/// An empty page stayed behind.
TEST_F(Page, ViewThatCannotWriteLeavesNoPage) {
  const std::string temporary = folder_.path("temporary");
  std::filesystem::create_directory(temporary);
  const Outcome run = runShell("ulimit -f 1; TMPDIR='" + temporary + "' swept view " + kRook);
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_THAT(run.err, testing::MatchesRegex("swept: error: cannot write '" + temporary +
                                             "/swept-......\\.html': File too large\n"));
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
}

TEST_F(Page, WhatCannotBeAPageIsRefusedAtOnce) {
  const auto errorOf = [](const std::vector<std::string>& arguments) {
    const Outcome run = runSwept(arguments);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  const std::vector<std::string> check{"check", kRook, "ready", "--group", "arm", "--html"};
  const auto with = [&](const std::string& file) {
    std::vector<std::string> arguments = check;
    arguments.push_back(file);
    return arguments;
  };
  EXPECT_EQ(errorOf(with("page.txt")), "swept: error: 'page.txt': a page ends in .html or .htm\n");
  EXPECT_EQ(errorOf(with("no/such/page.html")),
            "swept: error: cannot write 'no/such/page.html': No such file or directory\n");
  EXPECT_EQ(errorOf({"plan", kRook, "--group", "arm", "--problems", "models/problems.json",
                     "--html", folder_.path("p.html")}),
            "swept: error: --html shows one problem: it needs --set and --index\n");
  EXPECT_THAT(folder_.names(), testing::IsEmpty());
}

TEST_F(Page, JsonOutputStaysJson) {
  const Outcome run = runSwept(
      {"check", kRook, "ready", "--group", "arm", "--json", "--html", folder_.path("p.html")});
  EXPECT_EQ(jsonOf(run)["states"].size(), 1u);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("p.html"));
}

TEST_F(Page, IsNotWhereStandardOutputGoes) {
  const std::string page = folder_.path("p.html");
  runShell(std::string("swept check ") + kRook + " ready --group arm --html '" + page + "' >'" +
           page + "' 2>&1");
  EXPECT_EQ(folder_.read("p.html"),
            "swept: error: page '" + page + "' is the file that standard output goes to\n");
}

}  // namespace
}  // namespace swept::test
