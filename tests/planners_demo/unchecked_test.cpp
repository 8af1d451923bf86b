// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page_data.hpp"
#include "program.hpp"

/// What an answer is not about, though it may be taken to be, is said: with -q too, and in every
/// output.
namespace swept::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string kBox = "<geometry><box size='0.2 0.2 0.2'/></geometry>";

/// Two sliders, 2 m apart. The geometry of the left one is `left`.
std::string twoSliders(const std::string& left, const std::string& right) {
  const auto slider = [](const std::string& name, const std::string& x, const std::string& inside) {
    return "<link name='" + name + "'>" + inside + "</link><joint name='j_" + name +
           "' type='prismatic'><parent link='base'/><child link='" + name + "'/><origin xyz='" + x +
           " 0 0'/><axis xyz='1 0 0'/><limit lower='-3' upper='3'/></joint>";
  };
  return "<robot name='two'>\n<link name='base'/><link name='tool0'/><joint name='t' type='fixed'>"
         "<parent link='l'/><child link='tool0'/></joint>" +
         slider("l", "-1", left) + slider("r", "1", right) + "</robot>";
}

const std::string kVisual = "<visual>" + kBox + "</visual>";
const std::string kCollision = "<collision>" + kBox + "</collision>";

TEST(Unchecked, ALinkThatIsOnlyShownIsNamedEverywhere) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("two.urdf", twoSliders(kVisual, kVisual + kCollision));
  const std::string scene = folder.write(
      "post.scene", "posts\n* post\n1\nbox\n0.1 0.1 0.1\n0 2 0\n0 0 0 1\n0 0 0 0\n.\n");
  const std::string warning = urdf +
                              ":2: warning: link 'l' has a <visual> and no <collision>: nothing is "
                              "checked against it\n";
  // The two would overlap if both could.
  const Outcome check =
      runSwept({"check", urdf, "--scene", scene, "-q", "--html", folder.path("p.html"), "1,-1"});
  EXPECT_EQ(check.exitCode, 0);
  EXPECT_EQ(check.err, warning);
  EXPECT_THAT(check.out, HasSubstr("\nnot checked, no collision geometry: l\n"));
  EXPECT_THAT(folder.read("p.html"), HasSubstr("not checked (no collision geometry)"));
  for (const std::string command : {"check", "motion", "plan"}) {
    const Outcome run = runSwept({command, urdf, "--scene", scene, "-q", "--json", "0,0", "1,-1"});
    EXPECT_EQ(run.err, warning) << command;
    const auto json = jsonOf(run);
    EXPECT_THAT(json["links_without_geometry"], ElementsAre("l")) << command;
    EXPECT_EQ(json["warnings"][0].get<std::string>() + "\n", warning) << command;
    EXPECT_EQ(json["nothing_checked"], false) << command;
  }
}

TEST(Unchecked, FramesWithoutAnythingAreOrdinary) {
  const TemporaryFolder folder;
  const std::string urdf =
      folder.write("two.urdf", twoSliders(kVisual + kCollision, kVisual + kCollision));
  const Outcome run = runSwept({"check", urdf, "--json", "0,0"});
  EXPECT_EQ(run.err, "");
  const auto json = jsonOf(run);
  EXPECT_TRUE(json["links_without_geometry"].empty());
  EXPECT_TRUE(json["warnings"].empty());
  EXPECT_EQ(json["nothing_checked"], false);
}

TEST(Unchecked, NothingIsNotProvenFree) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("two.urdf", twoSliders(kVisual, kVisual));
  const std::string path = folder.path("path.json");
  const Outcome run = runSwept(
      {"plan", urdf, "-q", "--embed", "-o", path, "--html", folder.path("p.html"), "0,0", "1,-1"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out, HasSubstr(" segment, nothing was checked\n"));
  EXPECT_THAT(run.out, Not(HasSubstr("proven")));
  EXPECT_THAT(run.err, HasSubstr("links 'l', 'r' have a <visual> and no <collision>"));
  EXPECT_THAT(run.err, HasSubstr("swept: warning: nothing is checked: group 'all' moves"));
  const auto file = nlohmann::json::parse(folder.read("path.json"));
  EXPECT_EQ(file["nothing_checked"], true);
  EXPECT_EQ(file["warnings"].size(), 2U);
  EXPECT_THAT(folder.read("p.html"), Not(HasSubstr("all proven free")));
  const Outcome verified = runSwept({"verify", path, "-q"});
  EXPECT_EQ(verified.err, run.err);

  const auto json = jsonOf(runSwept({"plan", urdf, "-q", "--json", "0,0", "1,-1"}));
  EXPECT_EQ(json["solved"], true);
  EXPECT_EQ(json["proven"], false);
  EXPECT_EQ(json["nothing_checked"], true);
}

/// A pair out of reach is proven, though no query looks at it.
TEST(Unchecked, WhatIsOutOfReachIsProven) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("two.urdf", twoSliders("", kCollision));
  const std::string scene = folder.write(
      "post.scene", "posts\n* post\n1\nbox\n0.1 0.1 0.1\n0 50 0\n0 0 0 1\n0 0 0 0\n.\n");
  const auto json = jsonOf(runSwept({"plan", urdf, "--scene", scene, "--json", "0,0", "1,-1"}));
  EXPECT_EQ(json["proven"], true);
  EXPECT_EQ(json["nothing_checked"], false);
}

TEST(Unchecked, ASceneWithoutABodyIsSaidToBeOne) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("two.urdf", twoSliders(kCollision, kCollision));
  for (const auto& [name, text] :
       {std::pair{"empty.yaml", std::string("name: x\nworld: {collision_objects: []}\n")},
        {"empty.scene", "empty\n.\n"},
        {"frames.urdf", "<robot name='w'><link name='a'/></robot>"}}) {
    const std::string scene = folder.write(name, text);
    const Outcome run = runSwept({"check", urdf, "--scene", scene, "-q", "0,0"});
    EXPECT_EQ(run.err, scene +
                           ": warning: no body of the scene has geometry: the robot is checked in "
                           "an empty world\n");
  }
  const std::string shown = folder.write(
      "shown.urdf", "<robot name='w'><link name='wall'>" + kVisual + "</link></robot>");
  EXPECT_THAT(runSwept({"check", urdf, "--scene", shown, "-q", "0,0"}).err,
              HasSubstr("shown.urdf:1: warning: link 'wall' has a <visual> and no <collision>"));
}

}  // namespace
}  // namespace swept::test
