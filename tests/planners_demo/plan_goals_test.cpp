// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "../robot_model/model_robots.hpp"
#include "gantry.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

/// Goals other than one state, and what a link carries.
namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kArm = "models/robots/rook7/rook7.urdf";

std::vector<std::string> armPlan(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{
      "plan", kArm, "ready", "--group", "arm", "--scene", "models/scenes/table_objects.yaml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(PlanGoals, AGoalPoseIsReached) {
  const auto json = jsonOf(
      runSwept(armPlan({"--goal-pose", "0.45,0.2,0.6,1,0,0,0", "--link", "hand", "--json"})));
  ASSERT_EQ(json["proven"], true) << json["failure"];
  const InverseKinematics kinematics(modelRobot("rook7"), "arm", "hand");
  const auto q = json["states"].back().get<std::vector<double>>();
  Eigen::Isometry3d wanted = Eigen::Isometry3d::Identity();
  wanted.translation() = Eigen::Vector3d(0.45, 0.2, 0.6);
  wanted.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();  // half a turn about x
  const PoseError error = poseError(kinematics.pose(q), wanted);
  EXPECT_LE(error.position, 1e-3);
  EXPECT_LE(error.angle, 1e-2);
}

TEST(PlanGoals, TheSeedDecidesAboutAGoalPoseToo) {
  const auto path = [](const std::string& seed) {
    return jsonOf(runSwept(armPlan({"--goal-pose", "0.45,0.2,0.6,1,0,0,0", "--link", "hand",
                                    "--json", "--seed", seed})))["states"];
  };
  EXPECT_EQ(path("3"), path("3"));
  EXPECT_NE(path("3"), path("4"));
}

TEST(PlanGoals, AGoalPoseThatCannotBeReachedIsExplained) {
  const Outcome far = runSwept(armPlan({"--goal-pose", "0.45,0.2,3,1,0,0,0", "--link", "hand"}));
  EXPECT_EQ(far.exitCode, 1);
  EXPECT_THAT(far.out, HasSubstr("not solved: no configuration puts hand at the goal pose: none "
                                 "found in 300 searches\n"));
  const Outcome blocked =
      runSwept(armPlan({"--goal-pose", "0.45,0.2,0.3,1,0,0,0", "--link", "hand"}));
  EXPECT_EQ(blocked.exitCode, 1);
  EXPECT_THAT(blocked.out, testing::ContainsRegex(
                               "not solved: no free configuration puts hand at the goal pose: "
                               "[0-9]+ of 300 searches reach it, and the best of them is in "
                               "collision: .* m deep, at \\["));
}

TEST(PlanGoals, WrongGoalsAreNamed) {
  const auto message = [](const std::vector<std::string>& more) {
    const Outcome run = runSwept(armPlan(more));
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_EQ(message({"--goal-pose", "0,0,0,0,0,0"}),
            "swept: error: --goal-pose: 6 values, expected 7: x,y,z,qx,qy,qz,qw\n");
  EXPECT_EQ(message({"--goal-pose", "0,0,0,0,0,0,2"}),
            "swept: error: --goal-pose: the quaternion has norm 2, allowed is 1\n");
  EXPECT_THAT(message({"--goal-pose", "0,0,0,0,0,0,1", "--link", "nose"}),
              StartsWith("swept: error: --goal-pose: "));
  EXPECT_EQ(message({"home", "--link", "hand"}), "swept: error: --link needs --goal-pose\n");
  EXPECT_EQ(message({"home", "--goal-pose", "0,0,0,0,0,0,1"}),
            "swept: error: plan: with --goal-pose a start is needed, and no other state\n");
  EXPECT_EQ(message({}), "swept: error: plan: a start and a goal are needed\n");
}

TEST(PlanGoals, AnyOfSeveralGoalsWillDo) {
  const Gantry gantry;
  const auto json = jsonOf(gantry.run("plan", {"left", "inside", "2.2,0.5", "--json"}));
  ASSERT_EQ(json["proven"], true) << json["failure"];
  EXPECT_EQ(json["states"].back(), nlohmann::json({2.2, 0.5}));
  const Outcome none = gantry.run("plan", {"left", "inside", "1,0"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_THAT(none.out, HasSubstr("not solved: goal 1 (inside) is in collision: cube - post (0.1 m "
                                  "deep, at "));
  EXPECT_THAT(none.out, HasSubstr("; goal 2 is in collision: cube - post (0.2 m deep, at "));
}

TEST(PlanGoals, ThreadsFindAProvenPath) {
  const Gantry gantry;
  for (const std::string planner : {"RRTConnect", "pRRT", "CForest"}) {
    const auto json =
        jsonOf(gantry.plan({"left", "right", "--threads", "3", "--planner", planner, "--json"}));
    EXPECT_EQ(json["proven"], true) << planner << ": " << json["failure"];
  }
}

/// A box of 0.2 m below the cube makes it 0.2 m higher: it has to keep that much more.
TEST(PlanGoals, WhatALinkCarriesCounts) {
  const Gantry gantry;
  const auto clearance = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"1,0.9", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return jsonOf(gantry.run("check", arguments))["states"][0]["clearance"].get<double>();
  };
  const double bare = clearance({});
  EXPECT_NEAR(bare, 0.7, 1e-6);
  EXPECT_NEAR(clearance({"--attach", "box:0.2,0.2,0.2@cube:0,0,-0.2"}), 0.5, 1e-6);
  EXPECT_NEAR(clearance({"--attach", "sphere:0.2@cube:0,0,-0.2,0,0,0,1"}), 0.4, 1e-6);
  EXPECT_NEAR(clearance({"--attach", "cylinder:0.1,0.6@cube"}), 0.5, 1e-6);
  EXPECT_NEAR(clearance({"--attach", "sphere:0.2@cube:0,0,-0.2", "--attach",
                         "sphere:0.3@cube:0,0,-0.2", "--allow", "sphere 2,post"}),
              0.4, 1e-6);
  // A pyramid without its base, point down, as a mesh file.
  const std::string mesh = gantry.folder().write(
      "tip.obj", "v -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0 0.1 0\nv 0 0 -0.3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  EXPECT_NEAR(clearance({"--attach", mesh + "@cube:0,0,-0.1", "-q"}), 0.4, 1e-6);
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(
      gantry.run("plan", {"left", "right", "--attach", mesh + "@cube:0,0,-0.1", "-q", "-o", file})
          .exitCode,
      0);
  EXPECT_EQ(runSwept({"verify", file, "-q"}).exitCode, 0);
  gantry.folder().write(
      "tip.obj", "v -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0 0.1 0\nv 0 0 -0.4\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  EXPECT_EQ(runSwept({"verify", file, "-q"}).out,
            "refused: body tip: is not as it was when the path was certified\n");
}

TEST(PlanGoals, WrongAttachmentsAreNamed) {
  const Gantry gantry;
  const auto message = [&](const std::string& text) {
    const Outcome run = gantry.run("check", {"left", "--attach", text});
    EXPECT_EQ(run.exitCode, 3);
    return run.err;
  };
  EXPECT_EQ(message("box:1,1,1"),
            "swept: error: --attach 'box:1,1,1': expected SHAPE@LINK or "
            "SHAPE@LINK:X,Y,Z[,QX,QY,QZ,QW]\n");
  EXPECT_EQ(message("box:1,1@cube"),
            "swept: error: --attach 'box:1,1@cube': 2 values, expected 3: x,y,z\n");
  EXPECT_EQ(message("sphere:-1@cube"),
            "swept: error: --attach 'sphere:-1@cube': radius is -1, allowed is from 0 m\n");
  EXPECT_EQ(message("sphere:1@hook"),
            "swept: error: --attach 'sphere:1@hook': robot 'gantry' has no link 'hook'\n");
  EXPECT_EQ(message("no.stl@cube"), "no.stl: error: file not found\n");
}

TEST(PlanGoals, AttachmentsWithoutASizeAreSurfacesAndPoints) {
  const Gantry gantry;
  // The cube's face and the post's are 0.8 m apart; the sheet stands 0.5 m ahead of the cube.
  const auto run = [&](const std::string& shape) {
    return gantry.run("check", {"left", "--attach", shape + "@cube:0.5,0,0"});
  };
  const Outcome solid = run("box:0.0001,0.1,0.1");
  for (const std::string shape : {"box:0,0.1,0.1", "sphere:0", "cylinder:0,0"}) {
    const Outcome flat = run(shape);
    EXPECT_EQ(flat.exitCode, solid.exitCode) << flat.err;
    EXPECT_EQ(flat.err, "swept: warning: --attach '" + shape +
                            "@cube:0.5,0,0': a shape with a size of 0 is checked as the point, "
                            "segment or surface that it is\n");
  }
}

/// Joints in another order than the group's.
TEST(PlanGoals, APlanningRequestIsTheSameAsStates) {
  const Gantry gantry;
  const std::string request = gantry.folder().write(
      "request.yaml",
      "group_name: both\nstart_state: {joint_state: {name: [lift, slide], position: [0, 0]}}\n"
      "goal_constraints:\n  - joint_constraints:\n    - {joint_name: lift, position: 0}\n"
      "    - {joint_name: slide, position: 2}\n");
  const auto json = jsonOf(gantry.run("plan", {"--request", request, "--json"}));
  EXPECT_EQ(json["proven"], true) << json["failure"];
  EXPECT_EQ(json["states"], jsonOf(gantry.run("plan", {"left", "right", "--json"}))["states"]);
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"--request", request, "-o", file}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 0);
  EXPECT_EQ(
      gantry.run("plan", {"left", "--request", request}).err,
      "swept: error: --request cannot be combined with states or --problems: it has its own\n");
  const std::string bad = gantry.folder().write(
      "bad.yaml",
      "start_state: {joint_state: {name: [lift], position: [0]}}\n"
      "goal_constraints:\n  - joint_constraints:\n    - {joint_name: lift, position: 0}\n");
  EXPECT_EQ(gantry.run("plan", {"--request", bad}).err,
            "swept: error: " + bad + ", start: it has no value for slide\n");
}

TEST(PlanGoals, APlanningRequestHasGoalPosesAndOtherJoints) {
  const TemporaryFolder folder;
  // The fingers' joint is outside the group: open, it stays open.
  const std::string request = folder.write(
      "request.yaml",
      "group_name: arm\nstart_state:\n  joint_state:\n"
      "    name: [joint1, joint2, joint3, joint4, joint5, joint6, joint7, finger_joint]\n"
      "    position: [0, -0.3, 0, 1.9, 0, 1.54, 0, 0.01]\n"
      "goal_constraints:\n  - position_constraints:\n      - link_name: hand\n"
      "        constraint_region:\n          primitives: [{type: sphere, dimensions: [0.002]}]\n"
      "          primitive_poses: [{position: [0.45, 0.2, 0.6], orientation: [0, 0, 0, 1]}]\n"
      "    orientation_constraints:\n      - {link_name: hand, orientation: [1, 0, 0, 0]}\n");
  const Outcome run = runSwept({"plan", kArm, "--scene", "models/scenes/table_objects.yaml", "-o",
                                folder.path("path.json"), "--embed", "--request", request});
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const auto path = nlohmann::json::parse(folder.read("path.json"));
  int fingers = 0;
  for (const auto& joint : path["model"]["joints"]) {
    if (joint["name"] != "finger_joint") continue;
    ++fingers;
    EXPECT_EQ(joint["values"], nlohmann::json({0.01}));
  }
  EXPECT_EQ(fingers, 1);
  EXPECT_EQ(runSwept({"verify", folder.path("path.json"), "--files"}).exitCode, 0);
}

/// The post as a URDF, on a joint that puts it where the scene has it.
TEST(PlanGoals, AUrdfIsASceneToo) {
  const Gantry gantry;
  const std::string urdf = gantry.folder().write(
      "around.urdf",
      "<robot name='around'><link name='floor'/><link name='post'><collision><origin xyz='0.5 0 "
      "0'/><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link><joint name='mount' "
      "type='fixed'><parent link='floor'/><child link='post'/><origin xyz='0.5 0 0'/></joint>"
      "</robot>");
  for (const std::string state : {"left", "1,0.5", "inside"}) {
    const Outcome scene = gantry.run("check", {state});
    EXPECT_EQ(runSwept({"check", gantry.urdf, state, "--group", "both", "--scene", urdf}).out,
              scene.out);
    EXPECT_THAT(scene.out, HasSubstr("cube - post"));
  }
}

}  // namespace
}  // namespace swept::test
