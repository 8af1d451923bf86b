// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "program.hpp"

/// Sensed worlds: clouds and OctoMaps.
namespace swept::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr auto kRobot = "models/robots/rook7/rook7.urdf";
constexpr auto kCloud = "models/clouds/shelf.pcd";
constexpr auto kMap = "models/clouds/shelf.bt";

Words rook7(const std::string& command, const Words& more) {
  Words words{command, kRobot, "--group", "arm"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Behind the divider of the shelf, where the straight way is blocked.
const Words kAroundTheShelf{"-0.9,0.4,0,1.9,0,0.8,0", "0.9,0.4,0,1.9,0,0.8,0"};

std::string valuesOf(const nlohmann::json& state) {
  std::string text;
  for (const double value : state) text += (text.empty() ? "" : ",") + nlohmann::json(value).dump();
  return text;
}

void expectAPlan(const Words& world, std::size_t balls, double radius) {
  Words words = rook7("plan", {"--json"});
  words.insert(words.end(), world.begin(), world.end());
  words.insert(words.end(), kAroundTheShelf.begin(), kAroundTheShelf.end());
  const Outcome run = runSwept(words);
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const auto json = jsonOf(run);
  EXPECT_EQ(json["proven"], true);
  ASSERT_EQ(json["clouds"].size(), 1u);
  EXPECT_EQ(json["clouds"][0]["body"], "shelf");
  EXPECT_EQ(json["clouds"][0]["balls"], balls);
  EXPECT_NEAR(json["clouds"][0]["least_radius"], radius, 1e-12);
  EXPECT_NEAR(json["clouds"][0]["largest_radius"], radius, 1e-12);
  EXPECT_GE(json["motions_refused"], 1) << "the straight way is blocked";
  // The same motions in a world read anew.
  Words motions = rook7("motion", {"--json"});
  motions.insert(motions.end(), world.begin(), world.end());
  for (const auto& state : json["states"]) motions.push_back(valuesOf(state));
  EXPECT_EQ(runSwept(motions).exitCode, 0);
}

TEST(Cloud, APlanIsProvenForItsBalls) {
  expectAPlan({"--cloud", kCloud, "--point-radius", "0.015"}, 12493, 0.015);
}

TEST(Cloud, APlanIsProvenForTheCubesOfAnOctomap) {
  expectAPlan({"--cloud", kMap}, 6107, 0.01 * std::sqrt(3.0));
}

TEST(Cloud, TextAndPathFileSayWhatIsProven) {
  const TemporaryFolder folder;
  const std::string path = folder.path("path.json");
  Words words = rook7("plan", {"--cloud", kCloud, "--point-radius", "0.015", "-o", path});
  words.insert(words.end(), kAroundTheShelf.begin(), kAroundTheShelf.end());
  const Outcome run = runSwept(words);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out, HasSubstr("\nbody shelf is 12493 balls of radius 0.015 m\nsolved: "));
  EXPECT_THAT(run.err, EndsWith("shelf.pcd: warning: 8243 of 20736 points are not finite and left "
                                "out\n"));
  const auto json = nlohmann::json::parse(folder.read("path.json"));
  EXPECT_EQ(json["clouds"][0]["balls"], 12493);
}

TEST(Cloud, StandsWhereItIsPlaced) {
  const Words apart{"--cloud", kCloud, "--point-radius", "0.015"};
  Words words = rook7("check", apart);
  words.emplace_back("home");
  EXPECT_EQ(runSwept(words).exitCode, 0);
  words.insert(words.end(), {"--cloud-pose", "-0.5,0,0.1,0,0,0,1"});
  const Outcome moved = runSwept(words);
  EXPECT_EQ(moved.exitCode, 1) << moved.out << moved.err;
  EXPECT_THAT(moved.out, HasSubstr(" - shelf: "));
}

TEST(Cloud, PointsOfTheRobotAreLeftOut) {
  const TemporaryFolder folder;
  // In the arm, which stands straight up, and far from it.
  const std::string cloud = folder.write("seen.xyz", "0 0 0.6\n0 0 0.65\n2 2 2\n");
  Words words = rook7("check", {"upright", "--cloud", cloud, "--point-radius", "0.01"});
  EXPECT_EQ(runSwept(words).exitCode, 1);
  words.insert(words.end(), {"--self-filter", "0.02"});
  const Outcome run = runSwept(words);
  EXPECT_EQ(run.exitCode, 0) << run.out;
  EXPECT_EQ(run.err,
            cloud + ": warning: 2 of 3 points are within 0.02 m of the robot and left out\n");
}

TEST(Cloud, WhatPointsHideIsOccupied) {
  const TemporaryFolder folder;
  // A wall between the sensor and the arm's pedestal.
  std::string wall;
  for (int y = -20; y <= 20; ++y) {
    for (int z = -20; z <= 20; ++z)
      wall.append("1 " + std::to_string(0.02 * y) + " " + std::to_string(0.02 * z) + "\n");
  }
  const std::string cloud = folder.write("wall.xyz", wall);
  Words words = rook7("check", {"home", "--cloud", cloud, "--point-radius", "0.015", "--cloud-pose",
                                "-2,0,0.2,0,0,0,1"});
  EXPECT_EQ(runSwept(words).exitCode, 0);
  words.insert(words.end(), {"--occluded", "1.5"});
  EXPECT_EQ(runSwept(words).exitCode, 0) << "half a metre in front of the arm";
  words.back() = "2.5";
  const Outcome run = runSwept(words);
  EXPECT_EQ(run.exitCode, 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr(" - wall: "));
}

/// A ball on three slides. A point 1 m above the origin of the cloud's frame, and a sensor that is
/// there or 1 m above the point: what it hides is above the point, or below.
TEST(Cloud, PointsHideWhatIsBehindThemFromTheirSensor) {
  const TemporaryFolder folder;
  std::string robot = "<robot name='probe'><link name='base'/>";
  std::string parent = "base";
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string shape =
        axis == "z" ? "<collision><geometry><sphere radius='0.02'/></geometry></collision>" : "";
    robot += "<link name='l" + axis + "'>" + shape + "</link><joint name='" + axis +
             "' type='prismatic'><parent link='" + parent + "'/><child link='l" + axis +
             "'/><axis xyz='" +
             (axis == "x"   ? "1 0 0"
              : axis == "y" ? "0 1 0"
                            : "0 0 1") +
             "'/><limit lower='-10' upper='10' effort='1' velocity='1'/></joint>";
    parent = "l" + axis;
  }
  const std::string urdf = folder.write("probe.urdf", robot + "</robot>");
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "VIEWPOINT ? 1 0 0 0\nPOINTS 1\nDATA ascii\n0 0 1\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement camera 1\nproperty float view_px\nproperty float view_py\n"
      "property float view_pz\nend_header\n0 0 1\n?\n";
  const auto write = [&](const std::string& name, std::string text, const std::string& sensor) {
    return folder.write(name, text.replace(text.find('?'), 1, sensor));
  };
  const auto check = [&](const std::string& cloud, const std::string& pose,
                         const std::string& state) {
    return runSwept({"check", urdf, "--cloud", cloud, "--point-radius", "0.1", "--occluded", "5",
                     "--cloud-pose", pose, "--", state})
        .exitCode;
  };
  const std::string still = "0,0,0,0,0,0,1", moved = "3,0,0,0,1,0,0";  // half a turn about y
  for (const auto& [low, high] :
       {std::pair{write("low.pcd", pcd, "0 0 0"), write("high.pcd", pcd, "0 0 2")},
        std::pair{write("low.ply", ply, "0 0 0"), write("high.ply", ply, "0 0 2")}}) {
    EXPECT_EQ(check(low, still, "0,0,0.5"), 0);
    EXPECT_EQ(check(low, still, "0,0,1.5"), 1);
    EXPECT_EQ(check(high, still, "0,0,0.5"), 1);
    EXPECT_EQ(check(high, still, "0,0,1.5"), 0);
    // The sensor goes with the points.
    EXPECT_EQ(check(high, moved, "3,0,-0.5"), 1);
    EXPECT_EQ(check(high, moved, "3,0,-1.5"), 0);
    EXPECT_EQ(check(high, moved, "0,0,0.5"), 0);
  }
}

/// What the robot hid from the sensor was free.
TEST(Cloud, WhatTheRobotHidesIsOccupied) {
  const TemporaryFolder folder;
  // The arm, which stands straight up, as a sensor sees it from 2 m behind; a point far away.
  std::string seen = "0 8 8\n";
  for (int z = 1; z <= 50; ++z) seen.append("2 0 " + std::to_string(0.02 * z) + "\n");
  const std::string cloud = folder.write("seen.xyz", seen);
  Words words = rook7("check", {"upright", "0,0.8,0,0.8,0,0,0", "--cloud", cloud, "--point-radius",
                                "0.03", "--self-filter", "0.05", "--cloud-pose", "-2,0,0,0,0,0,1"});
  const Outcome open = runSwept(words);
  EXPECT_EQ(open.exitCode, 0) << open.out;
  EXPECT_EQ(open.err,
            cloud + ": warning: 50 of 51 points are within 0.05 m of the robot and left out\n");
  words.insert(words.end(), {"--occluded", "4"});
  const Outcome run = runSwept(words);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, testing::StartsWith("state 1 (upright): free"));
  EXPECT_THAT(run.out, HasSubstr("\nstate 2: collision"));
  EXPECT_THAT(run.out, HasSubstr(" - seen: "));
  EXPECT_THAT(run.err, testing::ContainsRegex(
                           "seen.xyz: warning: [0-9]+ of [0-9]+ balls of what the robot hides are "
                           "within 0.05 m of the robot and left out\n"));
}

/// As large as this: the points' balls, but not the cubes of a map beside them.
TEST(Cloud, PointRadiusIsForPoints) {
  const TemporaryFolder folder;
  const std::string far = folder.write("far.xyz", "8 8 8\n");
  const auto json = jsonOf(runSwept(rook7("plan", {"home", "home", "--cloud", far, "--cloud", kMap,
                                                   "--point-radius", "0.005", "--json"})));
  ASSERT_EQ(json["clouds"].size(), 2u);
  EXPECT_EQ(json["clouds"][0]["least_radius"], 0.005);
  EXPECT_NEAR(json["clouds"][1]["least_radius"], 0.01 * std::sqrt(3.0), 1e-12);
}

TEST(Cloud, RulesAreForItsBallsAndCubes) {
  for (const Words& world :
       {Words{"--cloud", kCloud, "--point-radius", "0.015"}, {"--cloud", kMap}}) {
    Words words = rook7("check", {"home", "--pad", "shelf=0.05"});
    words.insert(words.end(), world.begin(), world.end());
    EXPECT_EQ(runSwept(words).exitCode, 0);
    words.insert(words.end(), {"--pad", "shelf=1"});
    EXPECT_EQ(runSwept(words).exitCode, 1);
    words.insert(words.end(), {"--allow", "*,shelf"});
    EXPECT_EQ(runSwept(words).exitCode, 0);
  }
}

TEST(Cloud, InfoListsIt) {
  const auto json = jsonOf(runSwept({"info", kRobot, "--cloud", kMap, "--json"}));
  ASSERT_EQ(json["world"].size(), 1u);
  EXPECT_EQ(json["world"][0]["name"], "shelf");
}

struct Refusal {
  Words arguments;
  std::string message;
};

TEST(Cloud, WhatItCannotUseIsNamed) {
  const TemporaryFolder folder;
  const std::string one = folder.write("one.xyz", "0 0 0.1\n");
  const std::vector<Refusal> refusals{
      {{"--cloud", one},
       "swept: error: --cloud " + one +
           " needs --point-radius: how many metres the surface may be from a point"},
      {{"--point-radius", "0.01"}, "swept: error: --point-radius needs --cloud"},
      {{"--cloud-pose", "0,0,0,0,0,0,1"}, "swept: error: --cloud-pose needs --cloud"},
      {{"--self-filter", "0.01"}, "swept: error: --self-filter needs --cloud"},
      {{"--occluded", "2"}, "swept: error: --occluded needs --cloud"},
      {{"--cloud", kMap, "--occluded", "2"},
       std::string("swept: error: --occluded is for points; an OctoMap says itself what is "
                   "occupied: ") +
           kMap},
      {{"--cloud", kMap, "--point-radius", "0.01"},
       std::string("swept: error: --point-radius is for points; the cubes of an OctoMap are as "
                   "large as it says: ") +
           kMap},
      {{"--cloud", one, "--point-radius", "0", "--occluded", "2"},
       one + ": error: radius of the occluded space is 0; allowed: finite and above zero"},
      {{"--cloud", one, "--point-radius", "0.01", "--cloud-pose", "0,0,1"},
       "swept: error: --cloud-pose: 3 values, expected 7: x,y,z,qx,qy,qz,qw"},
      {{"--cloud", one, "--point-radius", "0.01", "--cloud-pose", "0,0,1,0,0,0,2"},
       "swept: error: --cloud-pose: the quaternion has norm 2, allowed is 1"},
      {{"--cloud", one, "--cloud", one, "--point-radius", "0.01"},
       one + ": error: World: a second body is named 'one'"},
      {{"--cloud", one, "--point-radius", "0.01", "--self-filter", "0.05"},
       one + ": error: --self-filter leaves nothing of it"},
  };
  for (const Refusal& refusal : refusals) {
    Words words = rook7("check", refusal.arguments);
    words.insert(words.end(), {"home", "-q"});
    const Outcome run = runSwept(words);
    EXPECT_EQ(run.exitCode, 3) << refusal.message;
    EXPECT_EQ(run.err, refusal.message + "\n");
  }
}

}  // namespace
}  // namespace swept::test
