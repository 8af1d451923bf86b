// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/planning_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input_files.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
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
  test::Warnings warnings;
  const auto file = folder.write("r.yaml", kStart + kPose);
  const PlanningRequest request = PlanningRequest::load(file, warnings.options());
  EXPECT_THAT(request.goals, ElementsAre());
  ASSERT_EQ(request.poseGoals.size(), 1u);
  const PlanningRequest::PoseGoal& goal = request.poseGoals.front();
  EXPECT_EQ(goal.link, "hand");
  EXPECT_EQ(goal.model_from_link.translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d halfTurn = Eigen::Vector3d(1, -1, -1).asDiagonal();
  EXPECT_LE((goal.model_from_link.linear() - halfTurn).norm(), 1e-15);
  EXPECT_EQ(goal.positionTolerance, 0.01) << "half the box's least side";
  EXPECT_EQ(goal.orientationTolerance, 0.2);
  EXPECT_THAT(warnings.lines, ElementsAre(file.string() + ":8: warning: goal_constraints[0]."
                                                          "position_constraints[0].header.frame_id "
                                                          "'base' is taken for the robot's model "
                                                          "frame"));
}

TEST(PlanningRequest, WhatIsMissingIsNamed) {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    const auto file = folder.write("r.yaml", text);
    const std::string error = test::inputError([&] { PlanningRequest::load(file); });
    return error.starts_with(file.string()) ? error.substr(file.string().size()) : error;
  };
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
            ":7: error: goal_constraints[0] its position is of link 'hand', its orientation of "
            "another");
}

}  // namespace
}  // namespace swept
