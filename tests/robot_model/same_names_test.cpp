// SPDX-License-Identifier: BSD-3-Clause
// A body of the world may have the name of a link. Reports told the two apart by their names alone:
// of a contact with each, they had one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;

/// A cube (0.2 m) that slides along x between a wall of the robot at x = 1 and, at x = -1, what
/// the world has.
std::shared_ptr<const Robot> slider() {
  const std::string cube = test::box(0.2, 0.2, 0.2);
  return Robot::parse(
      R"(<robot name="slider">)" + test::urdfLink("rail", {}) +
          test::urdfLink("cube", {{cube, {0, 0, 0}}}) +
          test::urdfLink("wall", {{cube, {1, 0, 0}}}) +
          test::urdfJoint("slide", "prismatic", "rail", "cube",
                          R"(<axis xyz="1 0 0"/>)"
                          R"(<limit lower="-2" upper="2" effort="1" velocity="1"/>)") +
          test::urdfJoint("stand", "fixed", "rail", "wall", "") + "</robot>",
      "slider.urdf");
}

Checker amongWalls(double x) {
  World world;
  world.add("wall", makeBox({0.2, 0.2, 0.2}), at(x, 0, 0));
  return Checker(slider(), "all", std::make_shared<const World>(world));
}

TEST(SameNames, BothAreReported) {
  const Checker checker = amongWalls(1.15);
  Workspace workspace(checker);
  const StateReport report = checker.reportState(std::vector<double>{1.05}, workspace);
  ASSERT_EQ(report.contacts.size(), 2U);
  std::vector<bool> self;
  for (const Witness& contact : report.contacts) {
    EXPECT_EQ(contact.bodyA, "cube");
    EXPECT_EQ(contact.bodyB, "wall");
    self.push_back(contact.selfPair);
  }
  EXPECT_THAT(self, testing::UnorderedElementsAre(false, true));
}

TEST(SameNames, AreToldApart) {
  const Checker checker = amongWalls(-1);
  Workspace workspace(checker);
  for (const double side : {1.0, -1.0}) {
    const bool self = side > 0;
    const StateReport near = checker.reportState(std::vector<double>{0.5 * side}, workspace);
    EXPECT_EQ(near.nearestB, "wall");
    EXPECT_EQ(near.nearestSelfPair, self);
    const StateReport touching = checker.reportState(std::vector<double>{0.9 * side}, workspace);
    ASSERT_EQ(touching.contacts.size(), 1U);
    EXPECT_EQ(touching.contacts[0].selfPair, self);
    for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
      const MotionCertificate motion = checker.certifyMotion(
          std::vector<double>{0.0}, std::vector<double>{1.1 * side}, workspace, query);
      ASSERT_TRUE(motion.witness);
      EXPECT_EQ(motion.witness->bodyB, "wall");
      EXPECT_EQ(motion.witness->selfPair, self);
    }
  }
}

TEST(SameNames, MovingObstaclesAreNoPartOfTheRobot) {
  World world;
  world.add(MovingObstacle{.name = "drone",
                           .parts = {{makeBox({0.2, 0.2, 0.2}), at(0, 0, 0)}},
                           .waypoints = {{.time = 0.0, .world_from_body = at(-1, 0, 0)}}});
  const Checker checker(slider(), "all", std::make_shared<const World>(world));
  Workspace workspace(checker);
  const StateReport report = checker.reportState(std::vector<double>{-0.9, 0.0}, workspace);
  ASSERT_EQ(report.contacts.size(), 1U);
  EXPECT_EQ(report.contacts[0].bodyB, "drone");
  EXPECT_FALSE(report.contacts[0].selfPair);
  EXPECT_FALSE(report.nearestSelfPair);
}

}  // namespace
}  // namespace swept
