// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/trajectory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model_robots.hpp"
#include "trajectory_reading.hpp"

namespace swept {
namespace {

using test::shown;
using test::TrajectoryReading;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string kTwo =
    "turn wheel slide\n"
    "0 [0.5 -0.25 0.125] v [1 2 3]\n"
    "1.5 [1 3 0.75] v [0.5 0 -1] a [-1 -2 -3]\n";

std::string indented(const std::string& text, const std::string& by) {
  std::string result = by;
  for (const char c : text) result += c == '\n' ? "\n" + by : std::string(1, c);
  return result + "\n";
}

/// kTwo as a message, with times as ROS 2 has them.
const std::string kMessage =
    "header: {stamp: {sec: 3, nanosec: 0}, frame_id: ''}\n"
    "joint_names: [slide, turn, wheel]\npoints:\n- positions: [0.125, 0.5, -0.25]\n"
    "  velocities: [3, 1, 2]\n  accelerations: []\n  effort: [9, 9, 9]\n"
    "  time_from_start:\n    sec: 0\n    nanosec: 0\n"
    "- positions: [0.75, 1.0, 3.0]\n  velocities: [-1, 0.5, 0]\n  accelerations: [-3, -1, -2]\n"
    "  effort: []\n  time_from_start:\n    sec: 1\n    nanosec: 500000000\n";

TEST(TrajectoryFile, EveryFormatSaysTheSame) {
  const auto read = [](const std::string& name, const std::string& text) {
    const TrajectoryReading reading(name, text);
    EXPECT_EQ(reading.message, "");
    EXPECT_THAT(reading.warnings, IsEmpty());
    return shown(reading.trajectories);
  };
  EXPECT_EQ(read("t.yaml", kMessage + "---\n"), kTwo);
  EXPECT_EQ(read("t.yml", "joint_trajectory:\n" + indented(kMessage, "  ") +
                              "multi_dof_joint_trajectory: {joint_names: [], points: []}\n"),
            kTwo);
  EXPECT_EQ(read("t.yaml", "model_id: kinds\ntrajectory:\n- joint_trajectory:\n" +
                               indented(kMessage, "    ") +
                               "trajectory_start: {joint_state: {name: [head, turn, finger], "
                               "position: [0, 0.5, 0.25]}}\n"),
            kTwo);
  EXPECT_EQ(read("t.csv",
                 "slide_velocity,\"turn\",time,wheel,slide,turn_acceleration,turn_velocity,"
                 "wheel_velocity,slide_acceleration,wheel_acceleration\n"
                 "3,0.5,0,-0.25,0.125,,1,2, ,\t\n"
                 "-1,1,1.5,3,.75,-1,0.5,0,-3,-2\n"),
            kTwo);
  EXPECT_EQ(read("t.json", R"({"trajectory": {"variables": ["wheel", "slide", "turn"], "points": [
                 {"time": 0, "positions": [-0.25, 0.125, 0.5], "velocities": [2, 3, 1],
                  "accelerations": []},
                 {"positions": [3, 0.75, 1], "velocities": [0, -1, 0.5],
                  "accelerations": [-2, -3, -1], "time": 1.5}]}})"),
            kTwo);
}

TEST(TrajectoryFile, TimesAreTheNearestDoubles) {
  const auto timeOf = [](const std::string& duration) {
    const TrajectoryReading reading(
        "t.yaml",
        "joint_names: [turn, wheel, slide]\npoints:\n- {positions: [0, 0, 0], time_from_start: " +
            duration + "}\n");
    EXPECT_EQ(reading.message, "");
    return reading.trajectories.at(0).points.at(0).time;
  };
  EXPECT_EQ(timeOf("{sec: 0, nanosec: 1}"), 1e-9);
  EXPECT_EQ(timeOf("{secs: 7, nsecs: 123456789}"), 7.123456789);
  EXPECT_EQ(timeOf("{sec: 2147483647, nanosec: 999999999}"), 2147483647.999999999);
  EXPECT_EQ(timeOf("{nanosec: 300000000}"), 0.3);
  EXPECT_EQ(timeOf("{secs: 3}"), 3.0);
  EXPECT_EQ(timeOf("0.1"), 0.1);
}

TEST(TrajectoryFile, SeveralMessagesAreSeveralTrajectories) {
  const std::string other =
      "joint_names: [turn, wheel, slide]\npoints:\n- {positions: [0, 0, 0], time_from_start: 2}\n";
  const std::string otherShown = "turn wheel slide\n2 [0 0 0]\n";
  const TrajectoryReading documents(
      "t.yaml", "---\n" + kMessage + "---\n---\n" + other + "...\n---\n" + other);
  EXPECT_EQ(documents.message, "");
  EXPECT_EQ(shown(documents.trajectories), kTwo + otherShown + otherShown);

  const auto display = [](const std::string& begin) {
    const std::string names = "{joint_trajectory: {joint_names: [turn, wheel, slide], points: ";
    return "trajectory:\n- " + names +
           "[{positions: [0, 0, 0], time_from_start: 0}, {positions: [1, 0, 0], time_from_start: "
           "1}]}}\n- " +
           names + "[{positions: [" + begin + ", 0, 0], time_from_start: 0.5}]}}\n";
  };
  EXPECT_EQ(shown(TrajectoryReading("t.yaml", display("1")).trajectories),
            "turn wheel slide\n0 [0 0 0]\n1 [1 0 0]\nturn wheel slide\n0.5 [1 0 0]\n");
  EXPECT_EQ(TrajectoryReading("t.yaml", display("1.1")).message,
            "t.yaml:3: error: trajectory[1] begins elsewhere than the one before it ends; a path "
            "goes on where it is");
  // Those of two documents were two motions.
  EXPECT_EQ(TrajectoryReading("t.yaml", display("1") + "---\n" + display("1")).trajectories.size(),
            4U);
}

TEST(TrajectoryFile, OnlyValuesAtALimitAreMoved) {
  const TrajectoryReading reading(
      "t.csv",
      "time,turn,wheel,slide,turn_velocity,wheel_velocity,slide_velocity\n"
      "0,2.000001,70,0,1e6,0,0\n"
      "1,2.5,-70,-0.000003,,,\n"
      "2,-2.000002,0,1.5,0,0,0\n");
  EXPECT_EQ(reading.message, "");
  EXPECT_EQ(shown(reading.trajectories),
            "turn wheel slide\n"
            "0 [2 70 0] v [1e+06 0 0]\n"
            "1 [2.5 -70 0]\n"
            "2 [-2 0 1.5] v [0 0 0]\n");
  EXPECT_THAT(reading.warnings,
              ElementsAre("t.csv:3: warning: slide is -3e-06 m, 3e-06 beyond its limit 0: taken to "
                          "the limit",
                          "t.csv:2: warning: turn is 2.000001 rad, 1e-06 beyond its limit 2: taken "
                          "to the limit; likewise at 1 further point"));
}

TEST(TrajectoryFile, WhatIsOutsideOfTheGroupStays) {
  const auto robot = test::pathRobot();
  Eigen::VectorXd reference = robot->defaultState();
  reference[*robot->findVariable("head")] = 0.25;
  const std::string names =
      "time,turn,wheel,slide,head,finger,bolt,turn_velocity,wheel_velocity,slide_velocity,"
      "head_velocity,finger_velocity\n";
  const TrajectoryReading reading("t.csv", names + "0,0.5,0,0,0.25,0.25,0,2,0,0,0,1\n", "arm",
                                  robot, reference);
  EXPECT_EQ(reading.message, "");
  EXPECT_EQ(shown(reading.trajectories), "turn wheel slide\n0 [0.5 0 0] v [2 0 0]\n");
  EXPECT_EQ(TrajectoryReading("t.csv", names + "0,0.5,0,0,0.25,0.25,0,2,0,0,0,1\n").message,
            "t.csv:2: error: head is 0.25, but group 'arm' does not move it: it has to stay at 0");
  EXPECT_EQ(TrajectoryReading("t.csv", names + "0,0.5,0,0,0,0.25,0,2,0,0,0.5,1\n").message,
            "t.csv:2: error: the velocity of head is 0.5, but group 'arm' does not move it: it has "
            "to be 0");
  EXPECT_EQ(TrajectoryReading("t.csv", names + "0,0.5,0,0,0,0.25,0,2,0,0,0,2\n").message,
            "t.csv:2: error: the velocity of finger is 2, but the joint follows 'turn' at 1");
}

TEST(TrajectoryFile, AJointsOwnNameCountsBeforeAVelocity) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='x' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>"
      "</joint><joint name='x_velocity' type='continuous'><parent link='b'/><child link='c'/>"
      "<axis xyz='0 0 1'/></joint></robot>",
      "r.urdf");
  const auto read = [&](const std::string& text) {
    return TrajectoryReading("t.csv", text, "all", robot);
  };
  EXPECT_EQ(shown(read("time,x,x_velocity\n0,1,2\n").trajectories), "x x_velocity\n0 [1 2]\n");
  EXPECT_EQ(read("time,x,x_velocity,x_velocity_velocity\n0,1,2,3\n").message,
            "t.csv:1: error: there are velocities of x_velocity, but none of x, which the group "
            "moves, too");
}

/// A base that moves beside the arm, at two times.
std::string mobile(const std::string& velocitiesOfArm, const std::string& velocitiesOfBase) {
  return "joint_trajectory: {joint_names: [turn, wheel, slide], points: [\n"
         "  {positions: [0.5, -0.25, 0.125], time_from_start: {sec: 0, nanosec: 0}" +
         velocitiesOfArm +
         "},\n"
         "  {positions: [1, 3, 0.75], time_from_start: {sec: 1, nanosec: 0}" +
         velocitiesOfArm +
         "}]}\n"
         "multi_dof_joint_trajectory:\n  header: {frame_id: odom}\n  joint_names: [vj]\n  points:\n"
         "  - transforms: [{translation: {x: 1, y: 2, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}}]\n"
         "    time_from_start: 0\n" +
         velocitiesOfBase +
         "  - transforms: [{translation: {x: 1, y: 3, z: 0}, rotation: {x: 0, y: 0, z: 1, w: 0}}]\n"
         "    time_from_start: 1\n" +
         velocitiesOfBase;
}

TEST(TrajectoryFile, BasesMoveByTheirTransforms) {
  EXPECT_EQ(shown(TrajectoryReading("t.yaml", mobile("", ""), "whole").trajectories),
            "vj/x vj/y vj/theta turn wheel slide\n"
            "0 [1 2 0 0.5 -0.25 0.125]\n"
            "1 [1 3 3.141592653589793 1 3 0.75]\n");
  // The base is not the arm's to move.
  EXPECT_EQ(TrajectoryReading("t.yaml", mobile("", "")).message,
            "t.yaml:2: error: joint_trajectory.points[0]: vj/x is 1, but group 'arm' does not move "
            "it: it has to stay at 0");
}

TEST(TrajectoryFile, TwistsOfPlanarBasesAreTheRatesOfTheirValues) {
  const std::string ofArm = ", velocities: [4, 5, 6]";
  const std::string ofBase =
      "    velocities: [{linear: {x: 1, y: 2, z: 0}, angular: {x: 0, y: 0, z: 3}}]\n";
  EXPECT_EQ(shown(TrajectoryReading("t.yaml", mobile(ofArm, ofBase), "whole").trajectories),
            "vj/x vj/y vj/theta turn wheel slide\n"
            "0 [1 2 0 0.5 -0.25 0.125] v [1 2 3 4 5 6]\n"
            "1 [1 3 3.141592653589793 1 3 0.75] v [1 2 3 4 5 6]\n");
  EXPECT_EQ(TrajectoryReading("t.yaml", mobile(ofArm, ""), "whole").message,
            "t.yaml:8: error: multi_dof_joint_trajectory.points[0] has no velocities, but "
            "joint_trajectory.points[0] has; both have them or none");
  EXPECT_EQ(TrajectoryReading("t.yaml", mobile("", ofBase), "whole").message,
            "t.yaml:2: error: joint_trajectory.points[0] has no velocities, but "
            "multi_dof_joint_trajectory.points[0] has; both have them or none");
}

TEST(TrajectoryFile, BasesTurnTheShorterWay) {
  std::string turns = "multi_dof_joint_trajectory:\n  joint_names: [floor]\n  points:\n";
  for (int i = 0; i < 12; ++i) {
    const double theta = 0.9 * i;
    turns += "  - transforms: [{rotation: [0, 0, " + std::to_string(std::sin(theta / 2)) + ", " +
             std::to_string(std::cos(theta / 2)) +
             "]}]\n    time_from_start: " + std::to_string(i) + "\n";
  }
  const auto cart = test::modelRobot("rook6_cart");
  const TrajectoryReading planar("t.yaml", turns, "base", cart);
  ASSERT_EQ(planar.message, "");
  ASSERT_EQ(planar.trajectories.at(0).points.size(), 12U);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(planar.trajectories[0].points[static_cast<std::size_t>(i)].positions[2], 0.9 * i,
                1e-5);

  for (std::size_t at; (at = turns.find("floor")) != std::string::npos;)
    turns.replace(at, 5, "flight");
  const TrajectoryReading floating("t.yaml", turns, "body", test::modelRobot("drifter"));
  ASSERT_EQ(floating.message, "");
  for (int i = 0; i < 12; ++i) {
    const std::vector<double>& q =
        floating.trajectories.at(0).points.at(static_cast<std::size_t>(i)).positions;
    EXPECT_NEAR(q[5], std::sin(0.45 * i), 1e-5);
    EXPECT_NEAR(q[6], std::cos(0.45 * i), 1e-5);
  }
}

TEST(TrajectoryFile, RefusesAReferenceOfAnotherRobot) {
  const auto robot = test::pathRobot();
  EXPECT_THROW(readTrajectories("t.csv", *robot, robot->groups().front(), Eigen::VectorXd::Zero(1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace swept
