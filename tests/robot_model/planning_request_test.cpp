// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/planning_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "input_files.hpp"
#include "message_of.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::Pair;

const std::string kStart = R"(group_name: arm
start_state:
  joint_state:
    name: [a, b]
    position: [0.5, -1]
)";

const std::string kPose = R"(goal_constraints:
  - position_constraints:
      - header: {frame_id: base}
        link_name: hand
        constraint_region:
          primitives: [{type: box, dimensions: [0.02, 0.04, 0.06]}]
          primitive_poses: [{position: [1, 2, 3], orientation: [0, 0, 0, 1]}]
    orientation_constraints:
      - link_name: hand
        orientation: {x: 1, y: 0, z: 0, w: 0}
        absolute_x_axis_tolerance: 0.3
        absolute_y_axis_tolerance: 0.2
        absolute_z_axis_tolerance: 0.4
)";

TEST(PlanningRequest, ReadsJointGoals) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("r.yaml", kStart + R"(goal_constraints:
  - joint_constraints:
      - {joint_name: a, position: 1.5, tolerance_above: 0.01, weight: 1}
      - {joint_name: b, position: 2}
  - joint_constraints: [{joint_name: a, position: 3}]
)");
  const PlanningRequest request = PlanningRequest::load(file);
  EXPECT_EQ(request.group, "arm");
  EXPECT_THAT(request.start, ElementsAre(Pair("a", 0.5), Pair("b", -1.0)));
  EXPECT_THAT(request.goals, ElementsAre(ElementsAre(Pair("a", 1.5), Pair("b", 2.0)),
                                         ElementsAre(Pair("a", 3.0))));
  EXPECT_THAT(request.poseGoals, ElementsAre());
}

TEST(PlanningRequest, ReadsAPoseGoal) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("r.yaml", kStart + kPose);
  LoadOptions options;
  options.modelFrame = "base";
  const PlanningRequest request = PlanningRequest::load(file, options);
  EXPECT_THAT(request.goals, ElementsAre());
  ASSERT_EQ(request.poseGoals.size(), 1u);
  const PlanningRequest::PoseGoal& goal = request.poseGoals.front();
  EXPECT_EQ(goal.link, "hand");
  EXPECT_EQ(goal.model_from_link.translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d halfTurn = Eigen::Vector3d(1, -1, -1).asDiagonal();
  EXPECT_LE((goal.model_from_link.linear() - halfTurn).norm(), 1e-15);
  EXPECT_EQ(goal.positionTolerance, 0.01) << "half the box's least side";
  EXPECT_EQ(goal.orientationTolerance, 0.2);
  EXPECT_EQ(test::inputError([&] { PlanningRequest::load(file); }),
            file.string() +
                ":8: error: goal_constraints[0].position_constraints[0].header.frame_id is 'base', "
                "which is no frame of the file; those of a robot's links need "
                "PlanningRequest::load with a robot; the model frame is 'world'");
}

TEST(PlanningRequest, ReadsBasesOfTheStart) {
  const test::TemporaryFolder folder;
  const PlanningRequest request = PlanningRequest::load(folder.write("r.yaml", R"(start_state:
  multi_dof_joint_state:
    header: {frame_id: world}
    joint_names: [base]
    transforms: [{translation: [1, 2, 3], rotation: [0, 0, 1, 0]}]
goal_constraints: [{joint_constraints: [{joint_name: base/x, position: 1}]}]
)"));
  EXPECT_THAT(request.start, ElementsAre());
  ASSERT_EQ(request.bases.size(), 1u);
  EXPECT_EQ(request.bases[0].joint, "base");
  EXPECT_EQ(request.bases[0].parent_from_child.translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d halfTurn = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  EXPECT_LE((request.bases[0].parent_from_child.linear() - halfTurn).norm(), 1e-15);
}

/// A base stood at the origin whatever the request said.
TEST(PlanningRequest, BasesAreValuesOfTheRobotsJoints) {
  const auto robotOn = [](const std::string& type) {
    return Robot::parse("<robot name='r'><link name='a'/></robot>", "r.urdf",
                        "<robot name='r'><virtual_joint name='base' type='" + type +
                            "' parent_frame='odom' child_link='a'/></robot>",
                        "r.srdf");
  };
  PlanningRequest request;
  request.start = {{"a", 1.0}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1, 2, 0;
  pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  request.bases.push_back({"base", pose});
  const auto planar = request.startOf(*robotOn("planar"));
  EXPECT_THAT(planar, ElementsAre(Pair("a", 1.0), Pair("base/x", 1.0), Pair("base/y", 2.0),
                                  Pair("base/theta", std::numbers::pi / 2.0)));
  const auto floating = request.startOf(*robotOn("floating"));
  ASSERT_EQ(floating.size(), 8u);
  EXPECT_EQ(floating[2], std::pair(std::string("base/trans_y"), 2.0));
  EXPECT_EQ(floating[7].first, "base/rot_w");
  EXPECT_NEAR(floating[7].second, std::sqrt(0.5), 1e-15);
  const auto refused = [&](const std::string& type) {
    return test::messageOf([&] { (void)request.startOf(*robotOn(type)); });
  };
  EXPECT_EQ(refused("fixed"),
            "multi_dof_joint_state of 'base': the joint is neither planar nor floating");
  request.bases[0].parent_from_child.translation().z() = 0.1;
  EXPECT_EQ(
      refused("planar"),
      "multi_dof_joint_state of 'base': the joint is planar, and the pose is not in its plane");
  request.bases[0].joint = "cart";
  EXPECT_EQ(refused("planar"), "multi_dof_joint_state of 'cart': robot 'r' has no such joint");
  request.bases[0].parent_from_child.setIdentity();
  EXPECT_EQ(request.startOf(*robotOn("planar")).size(), 1u);
}

/// As MoveIt and Robowflex write it.
TEST(PlanningRequest, WhatMoveItWritesIsAllowed) {
  const test::TemporaryFolder folder;
  test::Warnings warnings;
  const auto file = folder.write("r.yaml", R"(workspace_parameters:
  header: {frame_id: ''}
  min_corner: [-1, -1, -1]
  max_corner: {x: 1, y: 1, z: 1}
start_state:
  joint_state: {header: {seq: 0, stamp: 0, frame_id: base}, name: [a], position: [0], velocity: [], effort: []}
  multi_dof_joint_state: {header: {frame_id: ''}, joint_names: [], transforms: [], twist: [], wrench: []}
  attached_collision_objects: []
  is_diff: False
goal_constraints:
  - name: ''
    joint_constraints: [{joint_name: a, position: 1, tolerance_above: 1, tolerance_below: 1, weight: 1}]
    position_constraints: []
    orientation_constraints: []
    visibility_constraints: []
path_constraints: {name: '', joint_constraints: [], position_constraints: [], orientation_constraints: [], visibility_constraints: []}
trajectory_constraints: {constraints: []}
reference_trajectories: []
pipeline_id: ''
planner_id: RRTConnect
group_name: arm
num_planning_attempts: 2
allowed_planning_time: 60
max_velocity_scaling_factor: 0
max_acceleration_scaling_factor: 0
cartesian_speed_end_effector_link: ''
cartesian_speed_limited_link: ''
max_cartesian_speed: 0
)");
  const PlanningRequest request = PlanningRequest::load(file, warnings.options());
  EXPECT_EQ(request.goals.size(), 1u);
  ASSERT_TRUE(request.workspace);
  EXPECT_EQ(request.workspace->min(), Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(request.workspace->max(), Eigen::Vector3d(1, 1, 1));
  EXPECT_THAT(warnings.lines, ElementsAre());
}

/// The message without the name of the file.
std::string message(const std::string& text) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("r.yaml", text);
  const std::string error = test::inputError([&] { PlanningRequest::load(file); });
  return error.starts_with(file.string()) ? error.substr(file.string().size()) : error;
}

/// A path was planned and proven as if it were not there.
TEST(PlanningRequest, NothingIsLeftOutInSilence) {
  const std::string goal =
      "goal_constraints: [{joint_constraints: [{joint_name: a, position: 1}]}]\n";
  EXPECT_EQ(message(kStart + goal + "path_constraints:\n  orientation_constraints: [{}]\n"),
            ":8: error: path_constraints is read with a robot alone; PlanningRequest::load takes one");
  EXPECT_EQ(message(kStart + goal + "trajectory_constraints: {constraints: [{}]}\n"),
            ":7: error: trajectory_constraints.constraints[0] cannot be kept: a path is "
            "constrained as a whole, by path_constraints");
  EXPECT_EQ(message(kStart + "goal_constraints:\n  - visibility_constraints: [{}]\n"),
            ":7: error: goal_constraints[0].visibility_constraints[0] is not supported");
  EXPECT_EQ(message(kStart + "  attached_collision_objects: [{link_name: hand}]\n" + goal),
            ":6: error: start_state.attached_collision_objects[0] is read with a robot alone; "
            "PlanningRequest::load takes one");
  EXPECT_EQ(message(kStart + "  multi_dof_joint_state: {joint_names: [base]}\n" + goal),
            ":6: error: start_state.multi_dof_joint_state has 1 names and 0 transforms");
  EXPECT_EQ(message("start_state: {joint_state: {name: [a, a], position: [0, 1]}}\n" + goal),
            ":1: error: start_state.joint_state.name[1] is 'a' a second time");
  EXPECT_EQ(message(kStart + goal + "group: arm\n").substr(0, 55),
            ":7: error: the file has the unknown key 'group'; allowe");
  EXPECT_EQ(message(kStart + goal + goal),
            ":7: error: the file has the key 'goal_constraints' twice");
  EXPECT_EQ(message(kStart + "goal_constraints: [{joint_constraint: []}]\n"),
            ":6: error: goal_constraints[0] has the unknown key 'joint_constraint'; allowed are "
            "name, joint_constraints, position_constraints, orientation_constraints and "
            "visibility_constraints");
  EXPECT_EQ(message("[]\n"), ":1: error: a planning request must be a mapping");
}

TEST(PlanningRequest, WhatIsMissingIsNamed) {
  EXPECT_EQ(message("group_name: arm\n"), ":1: error: start_state must be a mapping");
  EXPECT_EQ(message("start_state: {joint_state: {name: [a], position: [1, 2]}}\n"),
            ":1: error: start_state.joint_state it has 1 names and 2 positions");
  EXPECT_EQ(message(kStart), ":1: error: goal_constraints there is no goal");
  EXPECT_EQ(message(kStart + "goal_constraints:\n  - {}\n"),
            ":7: error: goal_constraints[0] a goal is either joint_constraints, or one of "
            "position_constraints and one of orientation_constraints");
  EXPECT_EQ(message(kStart + "goal_constraints:\n  - joint_constraints: [{joint_name: a, position: "
                             "far}]\n"),
            ":7: error: goal_constraints[0].joint_constraints[0].position is 'far'; it must be a "
            "finite number");
  std::string other = kPose;
  other.replace(other.rfind("hand"), 4, "arm2");
  EXPECT_EQ(message(kStart + other),
            ":14: error: goal_constraints[0].orientation_constraints[0].link_name is 'arm2'; the "
            "goal's position is of link 'hand'");
}

std::string attachedTo(const std::string& link, const std::string& object) {
  return "start_state:\n  joint_state: {name: [jl], position: [1]}\n"
         "  attached_collision_objects:\n    - {link_name: " +
         link + ", object: {" + object +
         ", primitives: [{type: sphere, dimensions: [0.1]}], primitive_poses: [{position: [0, 0, "
         "2]}]}, touch_links: [r]}\n"
         "goal_constraints: [{joint_constraints: [{joint_name: jl, position: 2}]}]\n";
}

TEST(PlanningRequest, WithARobotAttachedObjectsAreRead) {
  const test::TemporaryFolder folder;
  const auto robot = test::twoArms();
  const auto read = [&](const std::string& text) {
    return PlanningRequest::load(folder.write("r.yaml", text), *robot);
  };
  const PlanningRequest request = read(attachedTo("l", "id: can, header: {frame_id: l}"));
  ASSERT_EQ(request.attached.size(), 1u);
  EXPECT_EQ(request.attached[0].link, "l");
  EXPECT_EQ(request.attached[0].touchLinks, std::vector<std::string>{"r"});
  EXPECT_EQ(request.attached[0].parts[0].link_from_shape.translation(), Eigen::Vector3d(0, 0, 2));
  const auto refusal = [&](const std::string& text) {
    return test::inputError([&] { read(text); });
  };
  EXPECT_THAT(refusal(attachedTo("l", "id: can, header: {frame_id: odom}")),
              EndsWith("object.header has to name the frame_id 'l', the link's, in a request"));
  EXPECT_THAT(refusal(attachedTo("hand", "id: can, header: {frame_id: hand}")),
              EndsWith("link_name is 'hand', which is no link of robot 'two'"));
}

TEST(PlanningRequest, WithARobotItsNamesAreLookedUp) {
  const test::TemporaryFolder folder;
  const auto robot = test::twoArms();
  const auto refusal = [&](const std::string& joints, const std::string& frame) {
    std::string goal = kPose;
    goal.replace(goal.find("base"), 4, frame);
    for (const char* way : {"link_name: hand", "link_name: hand"})
      goal.replace(goal.find(way), 15, "link_name: lid ");
    const auto file = folder.write("r.yaml", "start_state: {joint_state: " + joints + "}\n" + goal);
    return test::inputError([&] { PlanningRequest::load(file, *robot); });
  };
  EXPECT_EQ(refusal("{name: [jl], position: [1]}", "odom"), "");
  EXPECT_THAT(refusal("{name: [elbow], position: [1]}", "odom"),
              EndsWith("name[0] is 'elbow', which is no joint of robot 'two'"));
  EXPECT_THAT(refusal("{name: [jl, jf], position: [1, 1]}", "odom"),
              EndsWith("position[1] of 'jf' is 1, but the joint follows 'jl' to 0.5"));
  // The base moves, and what hangs on it.
  EXPECT_THAT(refusal("{name: [jl], position: [1]}", "base"),
              EndsWith("header.frame_id is 'base', which is no frame of the robot or of the file; "
                       "the model frame is 'odom'"));
}

}  // namespace
}  // namespace swept
