// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_folder.hpp"
#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// torso (lift) with two arms of two joints each; the right hand's finger mimics the left hand's.
const char* const kUrdf = R"(<robot name="twin">
  <link name="base"/><link name="torso"/>
  <link name="l1"/><link name="l2"/><link name="lf"/><link name="r1"/><link name="r2"/><link name="rf"/>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="torso"/><limit upper="1"/></joint>
  <joint name="lj1" type="revolute"><parent link="torso"/><child link="l1"/><limit lower="-2" upper="2"/></joint>
  <joint name="lj2" type="continuous"><parent link="l1"/><child link="l2"/></joint>
  <joint name="lfj" type="prismatic"><parent link="l2"/><child link="lf"/><limit upper="0.1"/></joint>
  <joint name="rj1" type="revolute"><parent link="torso"/><child link="r1"/><limit lower="-2" upper="2"/></joint>
  <joint name="rj2" type="fixed"><parent link="r1"/><child link="r2"/></joint>
  <joint name="rfj" type="prismatic"><parent link="r2"/><child link="rf"/><limit upper="0.1"/>
    <mimic joint="lfj"/></joint>
</robot>)";

std::shared_ptr<const Robot> load(const std::string& srdf, const LoadOptions& options = {}) {
  return Robot::parse(kUrdf, "twin.urdf", "<robot name='twin'>\n" + srdf + "</robot>", "twin.srdf",
                      options);
}

std::vector<std::string> jointsOf(const Robot& robot, const char* group) {
  std::vector<std::string> names;
  for (const int j : robot.findGroup(group)->joints) names.push_back(robot.joints()[j].name);
  return names;
}

std::string tipOf(const Robot& robot, const char* group) {
  return robot.links()[robot.findGroup(group)->tipLink].name;
}

TEST(Srdf, WithoutGroupsThereIsOneOfAllJoints) {
  for (const auto& robot : {Robot::parse(kUrdf, "twin.urdf"), load("")}) {
    ASSERT_EQ(robot->groups().size(), 1u);
    EXPECT_THAT(jointsOf(*robot, "all"), ElementsAre("lift", "lj1", "lj2", "lfj", "rj1"));
    EXPECT_THAT(robot->findGroup("all")->variables, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(tipOf(*robot, "all"), "rf");
    EXPECT_EQ(robot->findGroup("none"), nullptr);
  }
}

TEST(Srdf, TheOneBesideAUrdfHasItsName) {
  const test::TemporaryFolder folder;
  const auto urdf = folder.write("twin.v2.urdf", kUrdf);
  folder.write("twin.srdf", "<robot name='twin'/>");
  EXPECT_EQ(Robot::srdfBeside(urdf), "");
  EXPECT_EQ(Robot::load(urdf, Robot::srdfBeside(urdf))->groups()[0].name, "all");
  const auto srdf = folder.write(
      "twin.v2.srdf", "<robot name='twin'><group name='g'><joint name='lift'/></group></robot>");
  EXPECT_EQ(Robot::srdfBeside(urdf), srdf);
  EXPECT_EQ(Robot::load(urdf, Robot::srdfBeside(urdf))->groups()[0].name, "g");
  EXPECT_EQ(Robot::srdfBeside(srdf), "") << "no file is beside itself";
}

TEST(Srdf, ChainsFollowTheTreeEitherWay) {
  const auto robot = load(
      "<group name='down'><chain base_link='torso' tip_link='lf'/></group>\n"
      "<group name='up'><chain base_link='l2' tip_link='base'/></group>\n"
      "<group name='across'><chain base_link='l2' tip_link='rf'/></group>\n"
      "<group name='none'><chain base_link='l2' tip_link='l2'/></group>\n");
  EXPECT_THAT(jointsOf(*robot, "down"), ElementsAre("lj1", "lj2", "lfj"));
  EXPECT_EQ(tipOf(*robot, "down"), "lf");
  EXPECT_THAT(jointsOf(*robot, "up"), ElementsAre("lift", "lj1", "lj2"));
  EXPECT_EQ(tipOf(*robot, "up"), "base");
  EXPECT_THAT(jointsOf(*robot, "across"), ElementsAre("lj1", "lj2", "rj1"));
  EXPECT_EQ(tipOf(*robot, "across"), "rf");
  EXPECT_THAT(jointsOf(*robot, "none"), IsEmpty());
}

TEST(Srdf, LinksMeanTheirParentJointAndSubgroupsMayComeLater) {
  const auto robot = load(
      "<group name='both'><group name='left'/><joint name='rj1'/></group>\n"
      "<group name='left'><link name='l2'/><link name='l1'/><link name='base'/></group>\n"
      "<group name='all_of_it'><group name='both'/><group name='left'/><joint "
      "name='lift'/></group>\n");
  EXPECT_THAT(jointsOf(*robot, "left"), ElementsAre("lj1", "lj2"));
  EXPECT_EQ(tipOf(*robot, "left"), "l2");
  EXPECT_THAT(jointsOf(*robot, "both"), ElementsAre("lj1", "lj2", "rj1"));
  EXPECT_THAT(jointsOf(*robot, "all_of_it"), ElementsAre("lift", "lj1", "lj2", "rj1"));
  EXPECT_EQ(robot->groups()[0].name, "both");
}

TEST(Srdf, PassiveFixedAndMimickingJointsDropOutOfGroups) {
  test::Warnings warnings;
  const auto robot = load(
      "<group name='hands'><joint name='lfj'/><joint name='rfj'/><joint name='rj2'/>"
      "<joint name='lj2'/></group>\n"
      "<passive_joint name='lj2'/><passive_joint name='nobody'/>\n"
      "<group name='empty'><joint name='rj2'/><passive_joint name='lift'/></group>\n",
      warnings.options());
  EXPECT_THAT(jointsOf(*robot, "hands"), ElementsAre("lfj"));
  EXPECT_THAT(
      warnings.lines,
      ElementsAre("twin.srdf:3: warning: <passive_joint>: joint 'nobody' does not exist",
                  "twin.srdf:4: warning: group 'empty' has no joint that can be planned for"));
}

TEST(Srdf, NamedStatesHoldVariablesAndWarnOfLimits) {
  test::Warnings warnings;
  const auto robot = load(
      "<group name='left'><chain base_link='torso' tip_link='l2'/></group>\n"
      "<group_state name='up' group='left'><joint name='lj2' value='7'/>\n"
      "<joint name='lj1' value='2.5'/><joint name='rj2' value='1'/></group_state>\n",
      warnings.options());
  const NamedState* state = robot->findNamedState("up", "left");
  ASSERT_NE(state, nullptr);
  EXPECT_THAT(state->values, ElementsAre(std::pair(2, 7.0), std::pair(1, 2.5)));
  EXPECT_EQ(robot->findNamedState("up", "right"), nullptr);
  EXPECT_THAT(
      warnings.lines,
      ElementsAre("twin.srdf:4: warning: state 'up': lj1 = 2.5 is outside its limits [-2, 2]"));
}

TEST(Srdf, VirtualJointsComeFirstAndMoveTheRoot) {
  const auto robot = load(
      "<virtual_joint name='v' type='floating' parent_frame='world' child_link='base'/>\n"
      "<group_state name='s' group='all'><joint name='v' value='1 2 3 0 0 0.6 "
      "0.8004'/></group_state>\n");
  const Joint& joint = robot->joints()[0];
  EXPECT_EQ(joint.name, "v");
  EXPECT_EQ(joint.type, JointType::Floating);
  EXPECT_EQ(joint.parentLink, -1);
  EXPECT_EQ(joint.childLink, 0);
  EXPECT_EQ(robot->links()[0].parentJoint, 0);
  EXPECT_EQ(robot->variables()[6].name, "v/rot_w");
  EXPECT_EQ(robot->defaultState()[6], 1.0);
  EXPECT_THAT(jointsOf(*robot, "all"), ElementsAre("v", "lift", "lj1", "lj2", "lfj", "rj1"));
  const auto& values = robot->findNamedState("s", "all")->values;
  ASSERT_EQ(values.size(), 7u);
  EXPECT_EQ(values[2].second, 3.0);
  EXPECT_NEAR(std::hypot(values[5].second, values[6].second), 1.0, 1e-15);
  EXPECT_EQ(robot->joints()[*robot->findJoint("rfj")].mimic->master, *robot->findJoint("lfj"));

  const auto planar = load("<virtual_joint name='v' type='planar' child_link='base'/>");
  EXPECT_EQ(planar->joints()[0].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(planar->variables()[2].name, "v/theta");
  const auto fixed = load("<virtual_joint name='v' type='fixed' child_link='base'/>");
  EXPECT_EQ(fixed->variables().size(), 5u);
  EXPECT_EQ(fixed->joints()[0].parentLink, -1);
}

TEST(Srdf, EnabledPairsAreTakenBackWhereverTheyStand) {
  test::Warnings warnings;
  const auto robot = load(
      "<enable_collisions link1='l1' link2='base'/>\n"
      "<disable_collisions link1='base' link2='l1' reason='Never'/>\n"
      "<disable_collisions link1='r1' link2='torso' reason='Adjacent'/>\n"
      "<disable_collisions link1='torso' link2='r1' reason='Again'/>\n"
      "<disable_collisions link1='torso' link2='ghost' reason='Never'/>\n"
      "<disable_collisions link1='torso' link2='torso'/>\n"
      "<disable_collisions link1='torso' link2='ghost' reason='Never'/>\n",
      warnings.options());
  ASSERT_EQ(robot->disabledPairs().size(), 1u);
  EXPECT_EQ(robot->disabledPairs()[0].linkA, *robot->findLink("torso"));
  EXPECT_EQ(robot->disabledPairs()[0].linkB, *robot->findLink("r1"));
  EXPECT_EQ(robot->disabledPairs()[0].reason, "Adjacent");
  ASSERT_EQ(robot->enabledPairs().size(), 1u);
  EXPECT_EQ(robot->enabledPairs()[0].linkA, *robot->findLink("base"));
  EXPECT_EQ(robot->enabledPairs()[0].linkB, *robot->findLink("l1"));
  EXPECT_THAT(
      warnings.lines,
      ElementsAre("twin.srdf:3: warning: <disable_collisions>: the pair 'base' - 'l1' is enabled, "
                  "too; it stays checked",
                  "twin.srdf:6: warning: <disable_collisions>: 2 pairs name link 'ghost', which "
                  "does not exist (first at line 6)",
                  "twin.srdf:7: warning: <disable_collisions> names link 'torso' twice"));
}

std::vector<std::string> disabledWith(const Robot& robot, const char* link) {
  std::vector<std::string> others;
  const int index = *robot.findLink(link);
  for (const DisabledPair& pair : robot.disabledPairs()) {
    if (pair.linkA == index) others.push_back(robot.links()[pair.linkB].name);
    if (pair.linkB == index) others.push_back(robot.links()[pair.linkA].name);
  }
  return others;
}

TEST(Srdf, ALinkThatIsOffByDefaultIsInPairsThatAreEnabled) {
  test::Warnings warnings;
  const auto robot = load(
      "<disable_default_collisions link='l1'/>\n"
      "<disable_collisions link1='r1' link2='l1' reason='Never'/>\n"
      "<enable_collisions link1='l1' link2='rf'/>\n",
      warnings.options());
  EXPECT_THAT(disabledWith(*robot, "l1"),
              testing::UnorderedElementsAre("r1", "base", "torso", "l2", "lf", "r2"));
  EXPECT_THAT(disabledWith(*robot, "rf"), IsEmpty());
  EXPECT_EQ(robot->disabledPairs()[0].reason, "Never");
  EXPECT_EQ(robot->disabledPairs()[1].reason, "disable_default_collisions");
  EXPECT_THAT(warnings.lines, ElementsAre(HasSubstr(
                                  "twin.srdf:2: warning: <disable_default_collisions> leaves link "
                                  "'l1' out against other links; against the world, and what is "
                                  "attached, this is not supported: it stays checked")));
}

TEST(Srdf, AGroupThatTheUrdfLacksSomethingOfIsLeftOutWithItsStates) {
  test::Warnings warnings;
  const auto robot = load(
      "<group name='arm'><joint name='lj1'/></group>\n"
      "<group name='tail'><joint name='lj2'/>\n<joint name='wag'/><link name='tip'/></group>\n"
      "<group name='more'><group name='tail'/></group>\n"
      "<group name='odd'><group name='nowhere'/></group>\n"
      "<group name='far'><chain base_link='base' tip_link='moon'/></group>\n"
      "<group_state name='home' group='tail'><joint name='lj2' value='0'/></group_state>\n"
      "<group_state name='home' group='arm'><joint name='root_joint' value='0 0 0 0 0 0 1'/>\n"
      "<joint name='lj1' value='1'/></group_state>\n",
      warnings.options());
  ASSERT_EQ(robot->groups().size(), 1u);
  EXPECT_EQ(robot->groups()[0].name, "arm");
  ASSERT_EQ(robot->namedStates().size(), 1u);
  EXPECT_EQ(robot->namedStates()[0].values.size(), 1u);
  EXPECT_EQ(robot->namedStates()[0].values[0].second, 1.0);
  std::vector<std::string> out;
  for (const LeftOut& left : robot->leftOut())
    out.push_back(left.group + "/" + left.state + " " + left.reason);
  EXPECT_THAT(out, ElementsAre("tail/ twin.srdf:4: joint 'wag' does not exist",
                               "more/ twin.srdf:5: its group 'tail' is left out: joint 'wag' does "
                               "not exist",
                               "odd/ twin.srdf:6: group 'nowhere' does not exist",
                               "far/ twin.srdf:7: link 'moon' does not exist",
                               "tail/home twin.srdf:8: group 'tail' is left out"));
  EXPECT_THAT(
      warnings.lines,
      Contains("twin.srdf:4: warning: group 'tail' is left out: joint 'wag' does not exist"));
  EXPECT_THAT(warnings.lines,
              Contains("twin.srdf:9: warning: state 'home': joint 'root_joint' does "
                       "not exist; its value is left out"));
  // Nothing takes the place of groups that are all left out.
  EXPECT_THAT(load("<group name='g'><joint name='wag'/></group>")->groups(), IsEmpty());
}

TEST(Srdf, AGroupThatMovesInAnotherWayIsLeftOut) {
  const std::string joint =
      "<virtual_joint name='v' type='planar' child_link='base'/>"
      "<joint_property joint_name='v' property_name='angular_distance_weight' value='2'/>"
      "<group name='arm'><joint name='lj1'/></group><group name='base'><joint name='v'/></group>"
      "<joint_property joint_name='v' property_name='motion_model' value='";
  EXPECT_NE(load(joint + "holonomic'/>")->findGroup("base"), nullptr);
  const auto robot = load(joint + "diff_drive'/>");
  EXPECT_EQ(robot->findGroup("base"), nullptr);
  EXPECT_NE(robot->findGroup("arm"), nullptr);
  ASSERT_EQ(robot->leftOut().size(), 1u);
  EXPECT_THAT(robot->leftOut()[0].reason, HasSubstr("joint 'v' has the motion_model 'diff_drive'"));
}

TEST(Srdf, ManyWarningsOfAKindAreOneWithTheirNumber) {
  std::string pairs;
  for (int i = 0; i < 40; ++i)
    pairs += "<disable_collisions link1='" + std::string(i % 4 == 0 ? "ghost" : "gone") +
             "' link2='base'/>\n";
  test::Warnings few;
  load(pairs, few.options());
  EXPECT_THAT(few.lines, ElementsAre("twin.srdf:2: warning: <disable_collisions>: 10 pairs name "
                                     "link 'ghost', which does not exist (first at line 2)",
                                     "twin.srdf:3: warning: <disable_collisions>: 30 pairs name "
                                     "link 'gone', which does not exist (first at line 3)"));
  test::Warnings all;
  LoadOptions options = all.options();
  options.everyWarning = true;
  load(pairs, options);
  ASSERT_EQ(all.lines.size(), 40u);
  EXPECT_EQ(all.lines[39],
            "twin.srdf:41: warning: <disable_collisions>: link 'gone' does not exist");
  // Others go by what they have in common.
  std::string groups;
  for (int i = 0; i < 9; ++i)
    groups += "<group name='g" + std::to_string(i) + "'><joint name='x'/></group>\n";
  test::Warnings kinds;
  load(groups, kinds.options());
  ASSERT_EQ(kinds.lines.size(), 3u);
  EXPECT_EQ(kinds.lines[2],
            "twin.srdf:4: warning: group 'g2' is left out: joint 'x' does not exist (and 6 more of "
            "this kind)");
}

TEST(Srdf, ForAnotherRobotIsAWarning) {
  test::Warnings warnings;
  Robot::parse(kUrdf, "twin.urdf", "<robot name='single'/>", "s.srdf", warnings.options());
  EXPECT_THAT(warnings.lines,
              ElementsAre("s.srdf:1: warning: the SRDF is for robot 'single', the URDF is 'twin'"));
}

class RealRobots : public ::testing::Test {
 protected:
  std::filesystem::path robots;
  test::Warnings warnings;
  void SetUp() override {
    const auto data = dataFolder();
    if (!data || !std::filesystem::is_directory(*data / "robots")) {
      GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
    }
    robots = *data / "robots";
  }
  static int triangles(const Robot& robot) {
    std::size_t count = 0;
    for (const Link& link : robot.links()) {
      for (const CollisionGeometry& geometry : link.collision) {
        const auto* mesh = std::get_if<TriangleMesh>(&geometry.shape);
        if (mesh != nullptr) count += mesh->triangles().size();
      }
    }
    return static_cast<int>(count);
  }
};

TEST_F(RealRobots, Panda) {
  const auto robot =
      Robot::load(robots / "panda/panda.urdf", robots / "panda/panda.srdf", warnings.options());
  EXPECT_EQ(robot->joints()[0].type, JointType::Floating);
  EXPECT_EQ(robot->variables().size(), 14u);
  EXPECT_THAT(jointsOf(*robot, "panda_arm"),
              ElementsAre("panda_joint1", "panda_joint2", "panda_joint3", "panda_joint4",
                          "panda_joint5", "panda_joint6", "panda_joint7"));
  EXPECT_EQ(tipOf(*robot, "panda_arm"), "panda_link8");
  EXPECT_EQ(jointsOf(*robot, "panda_arm_hand"), jointsOf(*robot, "panda_arm"));
  EXPECT_THAT(jointsOf(*robot, "hand"), IsEmpty());
  ASSERT_NE(robot->findNamedState("ready", "panda_arm"), nullptr);
  EXPECT_EQ(robot->findNamedState("ready", "panda_arm")->values.size(), 7u);
  EXPECT_EQ(robot->disabledPairs().size(), 34u);
  EXPECT_GT(triangles(*robot), 1000);
}

TEST_F(RealRobots, Ur5) {
  const auto robot =
      Robot::load(robots / "ur5/ur5.urdf", robots / "ur5/ur5.srdf", warnings.options());
  EXPECT_EQ(jointsOf(*robot, "manipulator").size(), 6u);
  EXPECT_EQ(tipOf(*robot, "manipulator"), "ee_link");
  EXPECT_NE(robot->findNamedState("home", "manipulator"), nullptr);
  EXPECT_GT(triangles(*robot), 1000);
}

TEST_F(RealRobots, Pr2LoadsWithWarnings) {
  LoadOptions options = warnings.options();
  options.packages = {{"moveit_resources_pr2_description/urdf", robots / "pr2"}};
  const auto robot = Robot::load(robots / "pr2/pr2.urdf", robots / "pr2/pr2.srdf", options);
  EXPECT_EQ(robot->links().size(), 95u);
  EXPECT_EQ(robot->joints().size(), 95u);  // 94 and the virtual joint
  EXPECT_EQ(robot->joints()[0].type, JointType::Planar);
  EXPECT_EQ(jointsOf(*robot, "left_arm").size(), 7u);
  EXPECT_EQ(jointsOf(*robot, "arms").size(), 14u);
  EXPECT_THAT(jointsOf(*robot, "base"), IsEmpty());  // its joint is passive
  EXPECT_EQ(robot->disabledPairs().size(), 1035u);
  EXPECT_THAT(warnings.lines, Contains(HasSubstr(", which does not exist (first at line ")));
  EXPECT_LT(warnings.lines.size(), 20U);
  const Joint& tip = robot->joints()[*robot->findJoint("l_gripper_r_finger_tip_joint")];
  ASSERT_TRUE(tip.mimic);
  EXPECT_EQ(tip.mimic->master, *robot->findJoint("l_gripper_l_finger_joint"));
  const auto arm = robot->links()[*robot->findLink("r_upper_arm_link")];
  ASSERT_EQ(arm.collision.size(), 1u);
  EXPECT_EQ(arm.collision[0].source,
            "package://moveit_resources_pr2_description/urdf/meshes/upper_arm_v0/upper_arm.stl");
}

}  // namespace
}  // namespace swept
