// SPDX-License-Identifier: BSD-3-Clause
// A continuous joint is modulo 2 pi, and a joint that mimics it times 0.5 is not: after a turn it
// is half a turn away. A motion from 3 to -3 went on by 0.28 rad, Free past a post that the arm is
// in at its end, where the same configuration given as a state was in collision.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "input_files.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
constexpr double kPi = std::numbers::pi;

/// A continuous joint `drive` without geometry, and what follows it; `follower` is of this type,
/// with these limits, and has a ball on its arm, 1 m from the axis z.
std::string geared(const std::string& type, const std::string& multiplier,
                   const std::string& limits = "") {
  return "<robot name='g'><link name='base'/><link name='wheel'/>\n"
         "<link name='arm'><collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/>"
         "</geometry></collision></link>\n"
         "<joint name='drive' type='continuous'><parent link='base'/><child link='wheel'/>"
         "<axis xyz='0 0 1'/></joint>\n"
         "<joint name='follower' type='" +
         type + "'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>" + limits +
         "\n<mimic joint='drive' multiplier='" + multiplier + "'/></joint></robot>";
}

const std::string kWide = "<limit lower='-10' upper='10'/>";

std::shared_ptr<const Robot> parse(const std::string& text, test::Warnings& warnings) {
  return Robot::parse(text, "g.urdf", {}, {}, warnings.options());
}

TEST(GearedJoints, AMasterThatDoesNotBringItsFollowersBackHasLimits) {
  for (const auto& [type, multiplier] : {std::pair{"continuous", "0.5"},
                                         {"revolute", "-1.5"},
                                         {"prismatic", "1"},
                                         {"continuous", "1.0000000000000002"},
                                         {"prismatic", "0.01"}}) {
    SCOPED_TRACE(std::string(type) + " " + multiplier);
    test::Warnings warnings;
    const auto robot = parse(geared(type, multiplier, kWide), warnings);
    const Variable& drive = robot->variables().at(0);
    EXPECT_FALSE(drive.cyclic);
    EXPECT_EQ(drive.lower, -kPi);
    EXPECT_EQ(drive.upper, kPi);
    EXPECT_EQ(robot->joints()[drive.joint].type, JointType::Revolute);
    EXPECT_THAT(warnings.lines,
                ElementsAre("g.urdf:5: warning: joint 'follower' mimics 'drive' times " +
                            std::string(multiplier) +
                            " and is elsewhere after a turn of it: 'drive', which is continuous, "
                            "is read as revolute with limits [-3.141592653589793, "
                            "3.141592653589793]"));
  }
}

TEST(GearedJoints, AMasterThatBringsItsFollowersBackStaysCyclic) {
  for (const auto& [type, multiplier] : {std::pair{"continuous", "1"},
                                         {"continuous", "-3"},
                                         {"revolute", "2"},
                                         {"continuous", "0"}}) {
    SCOPED_TRACE(std::string(type) + " " + multiplier);
    test::Warnings warnings;
    const auto robot = parse(geared(type, multiplier, kWide), warnings);
    EXPECT_TRUE(robot->variables().at(0).cyclic);
    EXPECT_EQ(robot->joints()[robot->variables()[0].joint].type, JointType::Continuous);
    EXPECT_THAT(warnings.lines, IsEmpty());
  }
}

/// Both of the chain's joints follow `drive`: the first by half, the second by twice that.
TEST(GearedJoints, MultipliersOfAChainCount) {
  std::string text = geared("continuous", "0.5");
  text.replace(text.find("</robot>"), 8,
               "<link name='tip'/><joint name='third' type='continuous'><parent link='arm'/>"
               "<child link='tip'/>\n<mimic joint='follower' multiplier='2'/></joint></robot>");
  test::Warnings warnings;
  EXPECT_FALSE(parse(text, warnings)->variables().at(0).cyclic);
  EXPECT_EQ(warnings.lines.size(), 1u);
}

TEST(GearedJoints, AMotionEndsInTheStateThatItIsTo) {
  test::Warnings warnings;
  const auto robot = parse(geared("continuous", "0.5"), warnings);
  World world;
  Eigen::Isometry3d post = Eigen::Isometry3d::Identity();
  post.translation() << std::cos(-1.5), std::sin(-1.5), 0.0;
  world.add("post", makeSphere(0.1), post);
  const Checker checker(robot, "all", std::make_shared<const World>(std::move(world)));
  Workspace workspace(checker);
  const std::vector<double> from{3.0}, to{-3.0};
  EXPECT_EQ(checker.checkState(from, workspace), Verdict::Free);
  EXPECT_EQ(checker.checkState(to, workspace), Verdict::Collision);
  EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Collision);
  EXPECT_NEAR(checker.interpolate(from, to, 0.5)[0], 0.0, 1e-12);
  EXPECT_FALSE(checker.withinLimits(std::vector<double>{3.2}));
}

}  // namespace
}  // namespace swept
