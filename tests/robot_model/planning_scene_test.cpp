// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/planning_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "scene_summary.hpp"

namespace swept {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kNoWorld = "world: {collision_objects: []}\n";

PlanningScene load(const std::string& text, const LoadOptions& options = {}) {
  const test::TemporaryFolder folder;
  return PlanningScene::load(folder.write("s.yaml", text), *test::twoArms(), options);
}

/// The message behind the name of the file.
std::string refusal(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("s.yaml", text);
  const std::string error = test::inputError([&] { PlanningScene::load(file, *test::twoArms()); });
  return error.starts_with(file) ? error.substr(file.size()) : error;
}

Checker checkerOf(const PlanningScene& scene, const std::string& group,
                  const CheckerOptions& own = {}) {
  return {test::twoArms(), group, std::make_shared<const World>(scene.world),
          scene.checkerOptions(own)};
}

/// m. Of the group's joint at `x`.
double clearance(const Checker& checker, double x) {
  Workspace workspace(checker);
  return checker.clearance(std::vector{x}, workspace);
}

Verdict verdict(const Checker& checker, double x) {
  Workspace workspace(checker);
  return checker.checkState(std::vector{x}, workspace);
}

/// Of a ball of radius 0.1 m, as entries of a list have it.
std::string ball(const std::string& id, const std::string& frame, const std::string& at) {
  return "{id: " + id + ", header: {frame_id: " + frame +
         "}, primitives: [{type: sphere, dimensions: [0.1]}], primitive_poses: [{position: " + at +
         "}]}";
}

std::string worldOf(const std::vector<std::string>& objects) {
  std::string text = "collision_objects:\n";
  for (const std::string& object : objects) text += "  - " + object + "\n";
  return text;
}

std::string stateOf(const std::string& joints) {
  return "robot_state:\n  joint_state: " + joints + "\n";
}

std::string attach(const std::string& link, const std::string& object,
                   const std::string& more = "") {
  return "robot_state:\n  attached_collision_objects: [{link_name: " + link +
         ", object: " + object + more + "}]\n";
}

const std::string kChecked =
    "allowed_collision_matrix: {entry_names: [l, r], entry_values: [[true, false], [false, "
    "true]]}\n";

/// The other arm stood at its default state, whatever the scene said.
TEST(PlanningScene, JointsOutsideTheGroupAreWhereTheSceneHasThem) {
  const PlanningScene scene =
      load(kChecked + stateOf("{name: [jl, jr], position: [0, -1.5]}") + kNoWorld);
  // The arms' balls of radius 0.1 m are around x = -1 + jl and x = 1 - 1.5.
  EXPECT_NEAR(clearance(checkerOf(scene, "left"), 0.0), 0.3, 1e-9);
  EXPECT_EQ(verdict(checkerOf(scene, "left"), 0.45), Verdict::Collision);
  const PlanningScene without = load(kChecked + kNoWorld);
  EXPECT_FALSE(without.state);
  EXPECT_NEAR(clearance(checkerOf(without, "left"), 0.0), 1.8, 1e-9);
  CheckerOptions own;
  own.reference = test::twoArms()->defaultState();
  EXPECT_NEAR(clearance(checkerOf(scene, "left", own), 0.0), 1.8, 1e-9) << "the program's counts";
}

TEST(PlanningScene, ValuesThatARobotCannotHaveAreRefused) {
  const auto joints = [](const std::string& text) { return refusal(stateOf(text) + kNoWorld); };
  EXPECT_EQ(joints("{name: [elbow], position: [1]}"),
            ":2: error: robot_state.joint_state.name[0] is 'elbow', which is no joint of robot "
            "'two'");
  EXPECT_EQ(joints("{name: [jl, jr], position: [1]}"),
            ":2: error: robot_state.joint_state has 2 names and 1 positions");
  EXPECT_EQ(joints("{name: [jl, jl], position: [1, 1]}"),
            ":2: error: robot_state.joint_state.name[1] is 'jl' a second time");
  EXPECT_EQ(joints("{name: [vj], position: [1]}"),
            ":2: error: robot_state.joint_state.name[0] is 'vj', a joint of several values; "
            "multi_dof_joint_state has those");
  EXPECT_EQ(joints("{name: [jl, jf], position: [1, 0.75]}"),
            ":2: error: robot_state.joint_state.position[1] of 'jf' is 0.75, but the joint follows "
            "'jl' to 0.5");
  EXPECT_EQ(joints("{name: [jf, jl], position: [0.5, 1]}"), "");
  EXPECT_EQ(joints("{name: [screw], position: [0.1]}"),
            ":2: error: robot_state.joint_state.position[0] of 'screw' is 0.1, but the joint does "
            "not move");
}

TEST(PlanningScene, ValuesALittleBeyondALimitAreTakenToIt) {
  test::Warnings warnings;
  const PlanningScene scene =
      load(stateOf("{name: [jl, jr], position: [3.000002, 4]}") + kNoWorld, warnings.options());
  const auto robot = test::twoArms();
  EXPECT_EQ((*scene.state)[*robot->findVariable("jl")], 3.0);
  EXPECT_EQ((*scene.state)[*robot->findVariable("jr")], 4.0) << "as it is given";
  ASSERT_EQ(warnings.lines.size(), 2U);
  EXPECT_THAT(warnings.lines[0],
              HasSubstr("position[0] is beyond: jl is 3.000002 m, 2e-06 beyond"));
  EXPECT_THAT(warnings.lines[1], HasSubstr("no body of the scene has geometry"));
}

TEST(PlanningScene, TheBaseIsWhereTheSceneHasIt) {
  const auto moved = [](const std::string& rest) {
    return "robot_state:\n  multi_dof_joint_state: {" + rest + "}\n" +
           worldOf({ball("a", "world", "[4, 0, 0]")});
  };
  const std::string transform = "transforms: [{translation: [5, 0, 0]}]";
  const PlanningScene scene = load(moved("joint_names: [vj], " + transform));
  EXPECT_EQ(verdict(checkerOf(scene, "left"), 0.0), Verdict::Collision);
  EXPECT_NEAR(clearance(checkerOf(scene, "left"), 1.0), 0.8, 1e-9);
  EXPECT_EQ(refusal(moved("joint_names: [cart], " + transform)),
            ":2: error: the state: multi_dof_joint_state of 'cart': robot "
            "'two' has no such joint");
  EXPECT_THAT(refusal(moved("joint_names: [jl], " + transform)),
              HasSubstr("the joint is neither planar nor floating"));
  EXPECT_THAT(refusal(moved("header: {frame_id: l}, joint_names: [vj], " + transform)),
              HasSubstr("header.frame_id is 'l'; poses of bases have to be in the robot's model"));
}

TEST(PlanningScene, AttachedObjectsAreCarried) {
  // A rod of 4 m across the motion of `l`, along z.
  const std::string rod =
      "{id: rod, header: {frame_id: l}, primitives: [{type: box, dimensions: [0.1, 0.1, 4]}]}";
  const std::string world = worldOf({ball("a", "odom", "[0, 0, 1.5]")});
  const PlanningScene scene = load(attach("l", rod) + world);
  // The rod's side is at x = -1 + jl + 0.05.
  EXPECT_NEAR(clearance(checkerOf(scene, "left"), 0.0), 0.85, 1e-9);
  EXPECT_EQ(verdict(checkerOf(scene, "left"), 1.0), Verdict::Collision);
  EXPECT_EQ(verdict(checkerOf(scene, "left"), 2.0), Verdict::Collision) << "with the other arm";
  const PlanningScene touching = load(attach("l", rod, ", touch_links: [r]") + world);
  EXPECT_EQ(verdict(checkerOf(touching, "left"), 2.0), Verdict::Free);
}

/// As when a gripper takes what the scene has on a table.
TEST(PlanningScene, AnObjectWithoutGeometryIsTakenOutOfTheWorld) {
  const std::string world =
      worldOf({ball("can", "odom", "[-1, 0, 0.5]"), ball("a", "odom", "[1, 0, 0.5]")});
  const PlanningScene scene = load(attach("l", "{id: can}", ", touch_links: [r]") + world);
  EXPECT_EQ(scene.world.bodies().size(), 1U);
  ASSERT_EQ(scene.attached.size(), 1U);
  EXPECT_EQ(scene.attached[0].touchLinks, std::vector<std::string>{"r"});
  EXPECT_EQ(scene.attached[0].parts[0].link_from_shape.translation(), Eigen::Vector3d(0, 0, 0.5));
  EXPECT_NEAR(clearance(checkerOf(scene, "left"), 0.5), 1.3, 1e-9);
  EXPECT_THAT(refusal(attach("l", "{id: jug}") + world),
              EndsWith("attached object 'jug': object has no primitives and no meshes, and the "
                       "world has no object of this id"));
}

TEST(PlanningScene, WhatCannotBeAttachedIsRefused) {
  const std::string shape = "primitives: [{type: sphere, dimensions: [1]}]";
  const auto refused = [](const std::string& link, const std::string& object) {
    return refusal(attach(link, object) + worldOf({ball("a", "odom", "[0, 0, 9]")}));
  };
  EXPECT_THAT(
      refused("hand", "{id: b, header: {frame_id: l}, " + shape + "}"),
      EndsWith("attached object 'b': link_name is 'hand', which is no link of robot 'two'"));
  EXPECT_THAT(refused("l", "{id: b, " + shape + "}"),
              EndsWith("header has to name the frame_id of the object's pose, such as its link's "
                       "'l'"));
  EXPECT_THAT(refused("l", "{id: b, header: {frame_id: l}, planes: [{coef: [0, 0, 1, 0]}]}"),
              EndsWith("has planes, which no link can carry"));
  EXPECT_THAT(refused("l", "{id: r, header: {frame_id: l}, " + shape + "}"),
              EndsWith("a link of the robot has this name"));
  EXPECT_THAT(refused("l", "{id: a, header: {frame_id: l}, " + shape + "}"),
              EndsWith("object 'a': an attached object has this id"));
  EXPECT_THAT(refused("l", "{id: b, operation: 1, header: {frame_id: l}, " + shape + "}"),
              EndsWith("operation is '1'; a scene file allows only add (0)"));
}

/// A ball of radius 0.1 m from `from` to `to` in 2 s, in a frame.
std::string rollingBall(const std::string& id, const std::string& frame, const std::string& from,
                        const std::string& to) {
  return "{id: " + id + ", header: {frame_id: " + frame +
         "}, primitives: [{type: sphere, dimensions: [0.1]}], motion: [{time: 1, position: " +
         from + "}, {time: 3, position: " + to + ", orientation: [0, 0, 1, 0]}]}";
}

TEST(PlanningScene, AnObjectWithAMotionIsAMovingObstacle) {
  // `lid` is 0.2 m above `l`, at x = -1 + jl. With primitive_poses, of the ball in the object.
  std::string object = rollingBall("b", "lid", "[0, 0, 0.5]", "[0, 2, 0.5]");
  object.insert(object.find(", motion"), ", primitive_poses: [{position: [0.25, 0, 0]}]");
  const PlanningScene scene = load(stateOf("{name: [jl], position: [0.25]}") +
                                   worldOf({object, ball("c", "l", "[0,9,0]")}));
  EXPECT_EQ(scene.world.bodies().size(), 1U);
  ASSERT_EQ(scene.world.obstacles().size(), 1U);
  const MovingObstacle& moving = scene.world.obstacles().front();
  EXPECT_EQ(moving.name, "b");
  ASSERT_EQ(moving.parts.size(), 1U);
  EXPECT_EQ(moving.parts[0].body_from_shape.translation(), Eigen::Vector3d(0.25, 0, 0));
  ASSERT_EQ(moving.waypoints.size(), 2U);
  EXPECT_EQ(moving.waypoints[0].time, 1.0);
  EXPECT_EQ(moving.waypoints[1].time, 3.0);
  const auto ballAt = [&](double time) -> Eigen::Vector3d {
    return moving.poseAt(time) * moving.parts[0].body_from_shape.translation();
  };
  EXPECT_LT((ballAt(0) - Eigen::Vector3d(-0.5, 0, 0.7)).norm(), 1e-12) << "before the first";
  EXPECT_LT((ballAt(2) - Eigen::Vector3d(-0.75, 1.25, 0.7)).norm(), 1e-12) << "a quarter turn";
  EXPECT_LT((ballAt(9) - Eigen::Vector3d(-1.0, 2, 0.7)).norm(), 1e-12) << "after the last";
}

TEST(PlanningScene, AMovingObstacleIsCheckedAtItsTime) {
  // Across the way of `l`, whose ball is at x = -1 + jl: there at 2 s.
  const PlanningScene scene = load(worldOf({rollingBall("b", "odom", "[0, -1, 0]", "[0, 1, 0]")}));
  const Checker checker = checkerOf(scene, "left");
  Workspace workspace(checker);
  ASSERT_EQ(checker.dimension(), 2);
  EXPECT_EQ(checker.checkState(std::vector{1.0, 2.0}, workspace), Verdict::Collision);
  EXPECT_EQ(checker.checkState(std::vector{1.0, 1.0}, workspace), Verdict::Free);
  EXPECT_EQ(checker.checkState(std::vector{0.0, 2.0}, workspace), Verdict::Free);
}

TEST(PlanningScene, WhatMovesIsNothingThatALinkCarries) {
  const std::string rolling = rollingBall("can", "odom", "[0, 0, 5]", "[0, 1, 5]");
  EXPECT_THAT(refusal(attach("l", "{id: can}") + worldOf({rolling})),
              EndsWith("attached object 'can': object is an object of the world that moves, which "
                       "no link can take"));
  EXPECT_THAT(refusal(attach("l", rollingBall("jug", "l", "[0, 0, 5]", "[0, 1, 5]")) +
                      worldOf({ball("a", "odom", "[0, 0, 9]")})),
              EndsWith("attached object 'jug': object.motion is of an object that a link carries; "
                       "it moves with the link"));
  EXPECT_THAT(refusal(worldOf({rollingBall("l", "odom", "[0, 0, 5]", "[0, 1, 5]")})),
              EndsWith("object 'l': a link of the robot has this name, which an object that moves "
                       "cannot have"));
  EXPECT_THAT(refusal(worldOf({rolling, ball("a", "can", "[0, 0, 1]")})),
              EndsWith("header.frame_id is 'can', an object that moves; a frame has to stand"));
}

TEST(PlanningScene, FramesAreLinksObjectsAndTheirSubframes) {
  // `l` is 0.2 m below `lid`, at x = -1 + jl.
  const std::string world = worldOf(
      {ball("a", "lid", "[0, 0, 0.5]"),
       "{id: b, header: {frame_id: a}, pose: {position: [0, 1, 0]}, primitives: [{type: sphere, "
       "dimensions: [0.1]}, {type: sphere, dimensions: [0.1]}], subframe_names: [top], "
       "subframe_poses: [{position: [0, 0, 3]}]}",
       ball("c", "b/top", "[1, 0, 0]"), ball("d", "rod", "[0, 0, 1]")});
  const std::string attached =
      "  attached_collision_objects: [{link_name: r, object: {id: rod, header: {frame_id: r}, "
      "primitives: [{type: sphere, dimensions: [0.1]}], primitive_poses: [{position: [0, 5, "
      "0]}]}}]\n";
  const PlanningScene scene =
      load(stateOf("{name: [jl, jr], position: [0.25, 0.5]}") + attached + world);
  const auto at = [&](const char* id) -> Eigen::Vector3d {
    return scene.world.find(id)->parts[0].world_from_shape.translation();
  };
  EXPECT_LT((at("a") - Eigen::Vector3d(-0.75, 0, 0.7)).norm(), 1e-12);
  EXPECT_LT((at("b") - Eigen::Vector3d(-0.75, 1, 0.7)).norm(), 1e-12);
  EXPECT_LT((at("c") - Eigen::Vector3d(0.25, 1, 3.7)).norm(), 1e-12);
  EXPECT_LT((at("d") - Eigen::Vector3d(1.5, 5, 1)).norm(), 1e-12);
  const PlanningScene without = load(worldOf({ball("a", "l", "[0, 0, 0.15]")}));
  EXPECT_EQ(verdict(checkerOf(without, "left"), 0.0), Verdict::Collision) << "the default state's";
}

TEST(PlanningScene, TheModelFramesNameIsItsOwn) {
  const PlanningScene scene =
      load(worldOf({ball("odom", "l", "[0, 0, 5]"), ball("b", "odom", "[0, 0, 1]")}));
  EXPECT_EQ(scene.world.find("b")->parts[0].world_from_shape.translation(),
            Eigen::Vector3d(0, 0, 1));
}

TEST(PlanningScene, AFrameThatNobodyKnowsIsRefused) {
  EXPECT_EQ(refusal(worldOf({ball("a", "camera", "[0, 0, 0]")})),
            ":2: error: object 'a': header.frame_id is 'camera', which is no frame of the robot or "
            "of the file; the model frame is 'odom'");
  EXPECT_THAT(refusal("fixed_frame_transforms: [{header: {frame_id: l}, child_frame_id: odom, "
                      "transform: {translation: [0, 0, 1]}}]\n" +
                      kNoWorld),
              EndsWith("fixed_frame_transforms[0] moves 'l', which is a link of the robot: "
                       "robot_state says where it is"));
}

}  // namespace
}  // namespace swept
