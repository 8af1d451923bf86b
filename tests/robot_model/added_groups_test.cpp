// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "message_of.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using test::messageOf;
using ::testing::ElementsAre;

const char* const kUrdf = R"(<robot name="twin">
  <link name="base"/><link name="torso"/><link name="l1"/><link name="l2"/><link name="r1"/>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="torso"/><limit lower="0.5" upper="1"/></joint>
  <joint name="lj1" type="revolute"><parent link="torso"/><child link="l1"/><limit lower="-2" upper="2"/></joint>
  <joint name="lj2" type="fixed"><parent link="l1"/><child link="l2"/></joint>
  <joint name="rj1" type="revolute"><parent link="torso"/><child link="r1"/><limit lower="-2" upper="2"/>
    <mimic joint="lj1"/></joint>
</robot>)";

std::shared_ptr<const Robot> load(const std::string& srdf = {}) {
  return Robot::parse(kUrdf, "t.urdf",
                      srdf.empty() ? "" : "<robot name='twin'>" + srdf + "</robot>",
                      srdf.empty() ? "" : "t.srdf");
}

std::vector<std::string> jointsOf(const Robot& robot, const char* group) {
  std::vector<std::string> names;
  for (const int j : robot.findGroup(group)->joints) names.push_back(robot.joints()[j].name);
  return names;
}

TEST(AddedGroups, HaveTheJointsInTheRobotsOrder) {
  const auto robot = load();
  const auto more = robot->withGroup("mine", std::vector<std::string>{"lj1", "lift"});
  EXPECT_THAT(jointsOf(*more, "mine"), ElementsAre("lift", "lj1"));
  EXPECT_EQ(more->links()[more->findGroup("mine")->tipLink].name, "l1");
  EXPECT_EQ(robot->groups().size(), 1U);
  ASSERT_EQ(more->groups().size(), 2U);
  EXPECT_EQ(more->groups()[0].name, "all");
}

/// As the SRDF's chain between the same links.
TEST(AddedGroups, AChainIsThatOfAnSrdf) {
  for (const auto& [base, tip] : {std::pair{"base", "l2"}, {"l2", "base"}, {"l1", "torso"}}) {
    const auto robot = load("<passive_joint name='lift'/><group name='srdf'><chain base_link='" +
                            std::string(base) + "' tip_link='" + tip + "'/></group>");
    const auto more = robot->withChain("mine", base, tip);
    EXPECT_EQ(jointsOf(*more, "mine"), jointsOf(*more, "srdf"));
    EXPECT_EQ(more->findGroup("mine")->tipLink, more->findGroup("srdf")->tipLink);
    EXPECT_THAT(jointsOf(*more, "mine"), ElementsAre("lj1"));
  }
}

TEST(AddedGroups, WhatCannotBeIsAnError) {
  const auto robot = load("<passive_joint name='lift'/>");
  const auto joints = [&](const std::string& name, const std::string& joint) {
    return messageOf([&] { (void)robot->withGroup(name, std::vector<std::string>{joint}); });
  };
  EXPECT_EQ(joints("all", "lj1"), "robot 'twin' has a group 'all' already");
  EXPECT_EQ(joints("g", "lj3"), "robot 'twin' has no joint 'lj3'");
  EXPECT_EQ(joints("g", "lj2"), "joint 'lj2' has no value of its own: nothing moves in it");
  EXPECT_EQ(joints("g", "rj1"), "joint 'rj1' has no value of its own: it follows joint 'lj1'");
  EXPECT_EQ(joints("g", "lift"), "joint 'lift' is passive: nothing drives it");
  EXPECT_EQ(messageOf([&] { (void)robot->withChain("g", "base", "l3"); }),
            "robot 'twin' has no link 'l3'");
}

TEST(AddedGroups, EachGroupHasADefaultState) {
  const auto robot = load();
  EXPECT_THAT(namedConfiguration(*robot, robot->groups()[0], "default"), ElementsAre(0.75, 0.0));
  const auto own = load(
      "<group name='g'><joint name='lj1'/></group>"
      "<group_state name='default' group='g'><joint name='lj1' value='1'/></group_state>");
  EXPECT_THAT(namedConfiguration(*own, *own->findGroup("g"), "default"), ElementsAre(1.0));
}

TEST(AddedGroups, WhatIsLeftOutSaysWhyWhenItIsAskedFor) {
  const auto robot = load(
      "<group name='g'><joint name='lj1'/></group><group name='h'><joint name='x'/></group>"
      "<group_state name='s' group='h'><joint name='x' value='1'/></group_state>");
  EXPECT_EQ(messageOf([&] { (void)Checker(robot, "h", std::make_shared<const World>()); }),
            "Checker: group 'h' of robot 'twin' is left out: t.srdf:1: joint 'x' does not exist");
}

}  // namespace
}  // namespace swept
