// SPDX-License-Identifier: BSD-3-Clause
// path_constraints of requests; request_keys_test.cpp has a line for each of their fields.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "input_files.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

std::shared_ptr<const Robot> robot() {
  return Robot::parse(
      "<robot name='two'><link name='base'/><link name='post'/><link name='upper'/>"
      "<link name='hand'/>" +
          test::joint("up", "fixed", "base", "post", "<origin xyz='0 0 0.5'/>") +
          test::joint("a", "revolute", "post", "upper", test::limited("0 1 0", -2, 2)) +
          test::joint("b", "continuous", "upper", "hand",
                      "<origin xyz='1 0 0'/><axis xyz='0 0 1'/>") +
          "</robot>",
      "two.urdf");
}

/// A request with these path_constraints, which begin in its fifth line.
std::string requestWith(const std::string& constraints) {
  return "group_name: all\n"
         "start_state: {joint_state: {name: [a, b], position: [0, 0]}}\n"
         "goal_constraints: [{joint_constraints: [{joint_name: a, position: 1}]}]\n"
         "path_constraints:\n" +
         constraints;
}

TaskConstraint read(const std::string& constraints) {
  const test::TemporaryFolder folder;
  return PlanningRequest::load(folder.write("r.yaml", requestWith(constraints)), *robot())
      .pathConstraints;
}

/// The message without the name of the file.
std::string message(const std::string& constraints) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("r.yaml", requestWith(constraints));
  const std::string error = test::inputError([&] { PlanningRequest::load(file, *robot()); });
  return error.starts_with(file.string()) ? error.substr(file.string().size()) : error;
}

const std::string kJoint =
    "  joint_constraints: [{joint_name: a, position: 0.5, tolerance_above: "
    "0.25, tolerance_below: 0.125, weight: 2}]\n";
const std::string kPosition =
    "  position_constraints:\n"
    "    - header: {frame_id: post}\n"
    "      link_name: hand\n"
    "      target_point_offset: [0.1, 0.2, 0.3]\n"
    "      weight: 1\n"
    "      constraint_region:\n"
    "        primitives: [{type: box, dimensions: [1, 2, 3]}, {type: 2, dimensions: [0.5]}, "
    "{type: CYLINDER, dimensions: [0.75, 0.25]}]\n"
    "        primitive_poses: [{position: [1, 0, 0]}, {position: [0, 1, 0]}, {position: [0, 0, "
    "1]}]\n";
const std::string kOrientation =
    "  orientation_constraints:\n"
    "    - header: {frame_id: base}\n"
    "      link_name: hand\n"
    "      orientation: [0, 0, 0.6, 0.8]\n"
    "      absolute_x_axis_tolerance: 0.1\n"
    "      absolute_y_axis_tolerance: 0.2\n"
    "      absolute_z_axis_tolerance: 3.5\n"
    "      parameterization: 1\n"
    "      weight: 1\n";

TEST(RequestConstraints, AreReadAsTheyAre) {
  const TaskConstraint task = read("  name: all\n" + kJoint + kPosition + kOrientation);
  ASSERT_EQ(task.size(), 3U);
  EXPECT_EQ(task.joints[0].joint, "a");
  EXPECT_EQ(task.joints[0].position, 0.5);
  EXPECT_EQ(task.joints[0].above, 0.25);
  EXPECT_EQ(task.joints[0].below, 0.125);
  const PositionConstraint& position = task.positions[0];
  EXPECT_EQ(position.frame.body, "hand");
  EXPECT_EQ(position.reference.body, "post");
  EXPECT_EQ(position.frame.body_from_frame.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  ASSERT_EQ(position.regions.size(), 3U);
  EXPECT_EQ(position.regions[0].size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(position.regions[1].type, ConstraintRegion::Type::Sphere);
  EXPECT_EQ(position.regions[1].size.x(), 0.5);
  EXPECT_EQ(position.regions[2].type, ConstraintRegion::Type::Cylinder);
  EXPECT_EQ(position.regions[2].size, Eigen::Vector3d(0.25, 0.75, 0));
  EXPECT_EQ(position.regions[2].reference_from_region.translation(), Eigen::Vector3d::UnitZ());
  const OrientationConstraint& turned = task.orientations[0];
  EXPECT_EQ(turned.reference.body, "");
  EXPECT_EQ(turned.parameterization, OrientationConstraint::Parameterization::RotationVector);
  EXPECT_EQ(turned.tolerance, Eigen::Vector3d(0.1, 0.2, 3.5));
  EXPECT_NEAR(turned.orientation.z(), 0.6, 1e-15);
}

/// A name, what is put in place of what, and the message.
struct Broken {
  const char* before;
  const char* after;
  const char* message;
};

TEST(RequestConstraints, BrokenOnesAreRefused) {
  const std::string all = kJoint + kPosition + kOrientation;
  const std::array broken{
      Broken{
          "joint_name: a", "joint_name: c",
          ":5: error: path_constraints.joint_constraints[0].joint_name is 'c', which is no joint "
          "of robot 'two'"},
      Broken{"joint_name: a", "joint_name: up",
             ":5: error: path_constraints.joint_constraints[0].joint_name is 'up', which does not "
             "move"},
      Broken{"joint_name: a, ", "",
             ":5: error: path_constraints.joint_constraints[0].joint_name is missing"},
      Broken{"position: 0.5,", "position: high,",
             ":5: error: path_constraints.joint_constraints[0].position is 'high'; it must be a "
             "finite number"},
      Broken{"position: 0.5,", "position: 2.5,",
             ":5: error: path_constraints.joint_constraints[0].position is 2.5 with tolerances "
             "0.125 below and 0.25 above, of which nothing is within the joint's limits -2 to 2"},
      Broken{
          "tolerance_above: 0.25", "tolerance_above: -0.25",
          ":5: error: path_constraints.joint_constraints[0].tolerance_above is -0.25; allowed is "
          "from 0"},
      Broken{"tolerance_below: 0.125", "tolerance_below: -1",
             ":5: error: path_constraints.joint_constraints[0].tolerance_below is -1; allowed is "
             "from 0"},
      Broken{"weight: 2", "weight: much",
             ":5: error: path_constraints.joint_constraints[0].weight is 'much'; it must be a "
             "finite number"},
      Broken{"frame_id: post", "frame_id: table",
             ":7: error: path_constraints.position_constraints[0].header.frame_id"},
      Broken{"post}\n      link_name: hand", "post}\n      link_name: palm",
             ":8: error: path_constraints.position_constraints[0].link_name is 'palm', which is no "
             "link of robot 'two'"},
      Broken{"type: box", "type: cone",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[0]"
             ".type is 'cone'; a region is a box (1), a sphere (2) or a cylinder (3)"},
      Broken{"type: 2", "type: 4",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[1]"
             ".type is '4'; a region is a box (1), a sphere (2) or a cylinder (3)"},
      Broken{"[1, 2, 3]", "[1, 2]",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[0]"
             ".dimensions has 2 numbers; allowed are three: x, y and z"},
      Broken{"[0.5]", "[0.5, 1]",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[1]"
             ".dimensions has 2 numbers; allowed are one: the radius"},
      Broken{"[0.75, 0.25]", "[0.75]",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[2]"
             ".dimensions has 1 numbers; allowed are two: height and radius"},
      Broken{"[1, 2, 3]", "[1, -2, 3]",
             ":12: error: path_constraints.position_constraints[0].constraint_region.primitives[0]"
             ".dimensions[1] is -2; allowed is from 0"},
      Broken{", {position: [0, 0, 1]}", "",
             ":12: error: path_constraints.position_constraints[0].constraint_region has 3 "
             "primitives and 2 primitive_poses"},
      Broken{"        primitives:", "        meshes: [{}]\n        primitives:",
             ":12: error: path_constraints.position_constraints[0].constraint_region.meshes[0] is "
             "not supported; a region is a primitive"},
      Broken{
          "base}\n      link_name: hand", "base}\n      link_name: palm",
          ":16: error: path_constraints.orientation_constraints[0].link_name is 'palm', which is "
          "no link of robot 'two'"},
      Broken{"[0, 0, 0.6, 0.8]", "[0, 0, 0, 0]",
             ":17: error: path_constraints.orientation_constraints[0].orientation"},
      Broken{"x_axis_tolerance: 0.1", "x_axis_tolerance: -0.1",
             ":18: error: path_constraints.orientation_constraints[0].absolute_x_axis_tolerance is "
             "-0.1; allowed is from 0"},
      Broken{"y_axis_tolerance: 0.2", "y_axis_tolerance: .nan",
             ":19: error: path_constraints.orientation_constraints[0].absolute_y_axis_tolerance is "
             "'.nan'; it must be a finite number"},
      Broken{
          "parameterization: 1", "parameterization: 2",
          ":21: error: path_constraints.orientation_constraints[0].parameterization is 2; allowed "
          "are 0 (Euler angles) and 1 (a rotation vector)"},
      Broken{"parameterization: 1", "parametrization: 1",
             ":21: error: path_constraints.orientation_constraints[0] has the unknown key "
             "'parametrization'"},
      Broken{"  orientation_constraints:\n",
             "  visibility_constraints: [{}]\n  "
             "orientation_constraints:\n",
             ":14: error: path_constraints.visibility_constraints[0] is not supported: no proof is "
             "known of what a sensor sees along a motion"},
      Broken{"  orientation_constraints:\n", "  orientation_constraint:\n",
             ":14: error: path_constraints has the unknown key 'orientation_constraint'"},
  };
  for (const Broken& own : broken) {
    std::string text = all;
    const std::size_t at = text.find(own.before);
    ASSERT_NE(at, std::string::npos) << own.before;
    text.replace(at, std::string(own.before).size(), own.after);
    const std::string found = message(text);
    EXPECT_EQ(found.substr(0, std::string(own.message).size()), own.message) << found;
  }
  EXPECT_EQ(message("  position_constraints: [{link_name: hand, constraint_region: {}}]\n"),
            ":5: error: path_constraints.position_constraints[0].constraint_region has no "
            "primitive: no point is in it");
}

/// The constraints go to the checker as they are.
TEST(RequestConstraints, AreProven) {
  const auto two = robot();
  Checker checker =
      Checker(two, "all", std::make_shared<const World>())
          .withConstraints(read("  orientation_constraints: [{link_name: hand, header: {frame_id: "
                                "base}, absolute_x_axis_tolerance: 0.1, absolute_y_axis_tolerance: "
                                "0.2, absolute_z_axis_tolerance: 4}]\n"));
  Workspace workspace(checker);
  const auto verdict = [&](const std::vector<double>& from, const std::vector<double>& to) {
    return checker.certifyMotion(from, to, workspace).verdict;
  };
  // z of the hand tilts about y of the base, while the hand turns about it.
  EXPECT_EQ(verdict({-0.09, -2.0}, {0.09, 1.0}), Verdict::Free);
  EXPECT_EQ(verdict({0.0, 0.0}, {0.21, 0.0}), Verdict::Violation);
}

}  // namespace
}  // namespace swept
