// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "format_keys.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/planning_request.hpp"

namespace swept {
namespace {

/// Says something by each key that may say something. The robot stands on a plate, `plate`.
const std::string kRequest = R"(group_name: arm
workspace_parameters: {header: {frame_id: world}, min_corner: [-1, -1, -1], max_corner: [1, 1, 1]}
start_state:
  joint_state: {header: {frame_id: plate}, name: [jl, jr], position: [0.5, -0.25], velocity: [], effort: []}
  multi_dof_joint_state: {header: {frame_id: world}, joint_names: [vj], transforms: [{translation: [1, 2, 0]}], twist: [], wrench: []}
  attached_collision_objects:
    - {link_name: l, object: {id: rod, header: {frame_id: l}, primitives: [{type: sphere, dimensions: [0.1]}]}, touch_links: [r], detach_posture: {}, weight: 0}
  is_diff: false
goal_constraints:
  - name: one
    joint_constraints: [{joint_name: jl, position: 1.5, tolerance_above: 0.1, tolerance_below: 0.1, weight: 1}]
    visibility_constraints: []
  - position_constraints:
      - header: {seq: 0, stamp: 0, frame_id: plate}
        link_name: l
        target_point_offset: [0, 0, 0]
        constraint_region: {primitives: [{type: box, dimensions: [0.1, 0.2, 0.3], polygon: {}}], primitive_poses: [{position: [1, 2, 3]}], meshes: [], mesh_poses: []}
        weight: 1
    orientation_constraints:
      - header: {frame_id: plate}
        orientation: [0, 0, 0.6, 0.8]
        link_name: l
        absolute_x_axis_tolerance: 0.1
        absolute_y_axis_tolerance: 0.2
        absolute_z_axis_tolerance: 0.3
        parameterization: 0
        weight: 1
path_constraints:
  name: way
  joint_constraints: [{joint_name: jr, position: 0.75, tolerance_above: 0.3, tolerance_below: 0.4, weight: 5}]
  position_constraints:
    - header: {frame_id: r}
      link_name: base
      target_point_offset: [0, 0, 0.25]
      constraint_region: {primitives: [{type: cylinder, dimensions: [0.5, 0.75]}], primitive_poses: [{position: [4, 5, 6]}], meshes: [], mesh_poses: []}
      weight: 6
  orientation_constraints:
    - header: {frame_id: base}
      link_name: plate
      orientation: [0, 0, 0.8, 0.6]
      absolute_x_axis_tolerance: 0.4
      absolute_y_axis_tolerance: 0.5
      absolute_z_axis_tolerance: 4
      parameterization: 1
      weight: 7
  visibility_constraints: []
trajectory_constraints: {constraints: []}
reference_trajectories: []
pipeline_id: a
planner_id: b
num_planning_attempts: 1
allowed_planning_time: 1
max_velocity_scaling_factor: 1
max_acceleration_scaling_factor: 1
cartesian_speed_end_effector_link: a
cartesian_speed_limited_link: a
max_cartesian_speed: 1
)";

/// twoArms(), whose base is a plate that stands still half a metre up, and carries what moves.
std::shared_ptr<const Robot> robot() {
  const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  const auto slide = [](const std::string& name, const std::string& child) {
    return "<joint name='" + name + "' type='prismatic'><parent link='base'/><child link='" +
           child +
           "'/><axis xyz='1 0 0'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>";
  };
  return Robot::parse(
      "<robot name='two'><link name='root'/><link name='plate'/><link name='base'/><link "
      "name='l'>" +
          ball + "</link><link name='r'>" + ball + "</link>" + slide("jl", "l") + slide("jr", "r") +
          "<joint name='up' type='fixed'><parent link='root'/><child link='plate'/>"
          "<origin xyz='0 0 0.5'/></joint>"
          "<joint name='vj' type='planar'><parent link='plate'/><child link='base'/>"
          "<axis xyz='0 0 1'/></joint></robot>",
      "two.urdf");
}

void addValues(const PlanningRequest::JointValues& values, std::ostream& text) {
  for (const auto& [name, value] : values) text << ' ' << name << ' ' << value;
  text << '\n';
}

void addFrame(const ConstraintFrame& frame, std::ostream& text) {
  text << ' ' << frame.body;
  test::addPose(frame.body_from_frame, text);
}

void addConstraints(const TaskConstraint& task, std::ostream& text) {
  for (const JointConstraint& own : task.joints)
    text << own.joint << ' ' << own.position << ' ' << own.above << ' ' << own.below << '\n';
  for (const PositionConstraint& own : task.positions) {
    addFrame(own.frame, text);
    addFrame(own.reference, text);
    for (const ConstraintRegion& region : own.regions) {
      text << static_cast<int>(region.type) << ' ' << region.size.transpose();
      test::addPose(region.reference_from_region, text);
    }
  }
  for (const OrientationConstraint& own : task.orientations) {
    addFrame(own.frame, text);
    addFrame(own.reference, text);
    text << own.orientation.coeffs().transpose() << ' ' << own.tolerance.transpose() << ' '
         << static_cast<int>(own.parameterization) << '\n';
  }
}

std::string summaryOf(const PlanningRequest& request) {
  std::ostringstream text;
  text << request.group << '\n';
  addValues(request.start, text);
  for (const PlanningRequest::BasePose& base : request.bases) {
    text << base.joint;
    test::addPose(base.parent_from_child, text);
  }
  for (const PlanningRequest::JointValues& goal : request.goals) addValues(goal, text);
  for (const PlanningRequest::PoseGoal& goal : request.poseGoals) {
    text << goal.link << ' ' << goal.positionTolerance << ' ' << goal.orientationTolerance;
    test::addPose(goal.model_from_link, text);
  }
  if (request.workspace)
    text << "\nin " << request.workspace->min().transpose() << ' '
         << request.workspace->max().transpose();
  text << '\n';
  test::addAttached(request.attached, text);
  test::addRules(request.rules, text);
  addConstraints(request.pathConstraints, text);
  return text.str();
}

/// A key, a place of the request, and what stands there instead.
using Change = std::array<const char*, 3>;

const std::vector<Change> kChanges = {
    {"group_name", "group_name: arm", "group_name: other"},
    {"workspace_parameters/header", "{header: {frame_id: world}, min", "{min"},
    {"workspace_parameters/min_corner", "[-1, -1, -1]", "[-2, -1, -1]"},
    {"workspace_parameters/max_corner", "[1, 1, 1]", "[1, 1, 2]"},
    {"start_state/joint_state/header", "{frame_id: plate}, name", "{frame_id: l}, name"},
    {"start_state/joint_state/name", "[jl, jr]", "[jr, jl]"},
    {"start_state/joint_state/position", "[0.5, -0.25]", "[0.5, -0.125]"},
    {"start_state/joint_state/velocity", "velocity: []", "velocity: [1]"},
    {"start_state/joint_state/effort", "effort: []", "effort: [1]"},
    {"start_state/multi_dof_joint_state/header/frame_id", "{frame_id: world}, joint_names",
     "{frame_id: plate}, joint_names"},
    {"start_state/multi_dof_joint_state/joint_names",
     "joint_names: [vj], transforms: [{translation: [1, 2, 0]}]", "joint_names: []"},
    {"start_state/multi_dof_joint_state/transforms", "[1, 2, 0]", "[1, 3, 0]"},
    {"start_state/multi_dof_joint_state/twist", "twist: []", "twist: [{}]"},
    {"start_state/multi_dof_joint_state/wrench", "wrench: []", "wrench: [{}]"},
    {"start_state/attached_collision_objects", "id: rod", "id: pole"},
    {"start_state/attached_collision_objects/link_name",
     "link_name: l, object: {id: rod, header: {frame_id: l}",
     "link_name: plate, object: {id: rod, header: {frame_id: plate}"},
    {"start_state/attached_collision_objects/object", "dimensions: [0.1]", "dimensions: [0.2]"},
    {"start_state/attached_collision_objects/touch_links", "touch_links: [r]", "touch_links: []"},
    {"start_state/attached_collision_objects/detach_posture", "detach_posture: {}",
     "detach_posture: {points: []}"},
    {"start_state/attached_collision_objects/weight", "weight: 0}", "weight: 2}"},
    {"start_state/is_diff", "is_diff: false", "is_diff: true"},
    {"goal_constraints", "position: 1.5", "position: 2.5"},
    {"goal_constraints/name", "name: one", "name: two"},
    {"goal_constraints/joint_constraints/joint_name", "joint_name: jl", "joint_name: jr"},
    {"goal_constraints/joint_constraints/position", "position: 1.5", "position: 2"},
    {"goal_constraints/joint_constraints/tolerance_above", "tolerance_above: 0.1",
     "tolerance_above: 0.2"},
    {"goal_constraints/joint_constraints/tolerance_below", "tolerance_below: 0.1",
     "tolerance_below: 0.2"},
    {"goal_constraints/joint_constraints/weight", "0.1, weight: 1}", "0.1, weight: 2}"},
    {"goal_constraints/position_constraints/header/frame_id", "stamp: 0, frame_id: plate}",
     "stamp: 0, frame_id: world}"},
    {"goal_constraints/position_constraints/header/seq", "seq: 0", "seq: 1"},
    {"goal_constraints/position_constraints/header/stamp", "stamp: 0", "stamp: 1"},
    {"goal_constraints/position_constraints/target_point_offset", "target_point_offset: [0, 0, 0]",
     "target_point_offset: [0, 0, 1]"},
    {"goal_constraints/position_constraints/constraint_region", "[{position: [1, 2, 3]}]",
     "[{position: [1, 2, 4]}]"},
    {"goal_constraints/position_constraints/constraint_region/primitives",
     "[{type: box, dimensions: [0.1, 0.2, 0.3], polygon: {}}]", "[{type: 2, dimensions: [0.1]}]"},
    {"goal_constraints/position_constraints/constraint_region/primitives/type", "type: box",
     "type: cone"},
    {"goal_constraints/position_constraints/constraint_region/primitives/dimensions",
     "[0.1, 0.2, 0.3]", "[0.2, 0.2, 0.3]"},
    {"goal_constraints/position_constraints/constraint_region/primitives/polygon", "polygon: {}",
     "polygon: {points: []}"},
    {"goal_constraints/position_constraints/constraint_region/primitive_poses",
     "[{position: [1, 2, 3]}]", "[{position: [2, 2, 3]}]"},
    {"goal_constraints/position_constraints/constraint_region/mesh_poses", "mesh_poses: []",
     "mesh_poses: [{}]"},
    {"goal_constraints/position_constraints/constraint_region/meshes", "meshes: [],",
     "meshes: [{}],"},
    {"goal_constraints/position_constraints/weight", "weight: 1\n    orientation_constraints",
     "weight: 2\n    orientation_constraints"},
    {"goal_constraints/orientation_constraints/header/frame_id", "header: {frame_id: plate}\n",
     "header: {frame_id: l}\n"},
    {"goal_constraints/orientation_constraints/link_name", "link_name: l\n        absolute",
     "link_name: r\n        absolute"},
    {"goal_constraints/orientation_constraints/orientation", "[0, 0, 0.6, 0.8]", "[0, 0, 0, 1]"},
    {"goal_constraints/orientation_constraints/absolute_x_axis_tolerance",
     "absolute_x_axis_tolerance: 0.1", "absolute_x_axis_tolerance: 0.15"},
    {"goal_constraints/orientation_constraints/absolute_y_axis_tolerance",
     "absolute_y_axis_tolerance: 0.2", "absolute_y_axis_tolerance: 0.05"},
    {"goal_constraints/orientation_constraints/absolute_z_axis_tolerance",
     "absolute_z_axis_tolerance: 0.3", "absolute_z_axis_tolerance: 0.05"},
    {"goal_constraints/orientation_constraints/parameterization", "parameterization: 0",
     "parameterization: 2"},
    {"goal_constraints/orientation_constraints/weight", "weight: 1\npath", "weight: 2\npath"},
    {"goal_constraints/visibility_constraints", "visibility_constraints: []",
     "visibility_constraints: [{}]"},
    {"path_constraints/name", "name: way", "name: path"},
    {"path_constraints/joint_constraints/joint_name", "joint_name: jr, position: 0.75",
     "joint_name: jl, position: 0.75"},
    {"path_constraints/joint_constraints/position", "position: 0.75", "position: 0.5"},
    {"path_constraints/joint_constraints/tolerance_above", "above: 0.3", "above: 0.2"},
    {"path_constraints/joint_constraints/tolerance_below", "below: 0.4", "below: 0.2"},
    {"path_constraints/joint_constraints/weight", "weight: 5", "weight: 2"},
    {"path_constraints/position_constraints/header/frame_id", "{frame_id: r}\n", "{frame_id: l}\n"},
    {"path_constraints/position_constraints/link_name", "link_name: base", "link_name: l"},
    {"path_constraints/position_constraints/target_point_offset", "[0, 0, 0.25]", "[0, 0, 0]"},
    {"path_constraints/position_constraints/constraint_region/primitives",
     "[{type: cylinder, dimensions: [0.5, 0.75]}]", "[{type: 2, dimensions: [0.5]}]"},
    {"path_constraints/position_constraints/constraint_region/primitive_poses", "[4, 5, 6]",
     "[4, 5, 7]"},
    {"path_constraints/position_constraints/constraint_region/meshes",
     "[{position: [4, 5, 6]}], meshes: []", "[{position: [4, 5, 6]}], meshes: [{}]"},
    {"path_constraints/position_constraints/weight", "weight: 6", "weight: 2"},
    {"path_constraints/orientation_constraints/header/frame_id", "{frame_id: base}\n",
     "{frame_id: l}\n"},
    {"path_constraints/orientation_constraints/link_name", "link_name: plate", "link_name: l"},
    {"path_constraints/orientation_constraints/orientation", "[0, 0, 0.8, 0.6]", "[0, 0, 0, 1]"},
    {"path_constraints/orientation_constraints/absolute_x_axis_tolerance", "tolerance: 0.4",
     "tolerance: 0.1"},
    {"path_constraints/orientation_constraints/absolute_y_axis_tolerance", "tolerance: 0.5",
     "tolerance: 0.1"},
    {"path_constraints/orientation_constraints/absolute_z_axis_tolerance", "tolerance: 4",
     "tolerance: 1"},
    {"path_constraints/orientation_constraints/parameterization", "parameterization: 1",
     "parameterization: 0"},
    {"path_constraints/orientation_constraints/weight", "weight: 7", "weight: 2"},
    {"path_constraints/visibility_constraints", "  visibility_constraints: []\ntraj",
     "  visibility_constraints: [{}]\ntraj"},
    {"trajectory_constraints/constraints", "{constraints: []}", "{constraints: [{}]}"},
    {"reference_trajectories", "reference_trajectories: []", "reference_trajectories: [{}]"},
    {"pipeline_id", "pipeline_id: a", "pipeline_id: c"},
    {"planner_id", "planner_id: b", "planner_id: c"},
    {"num_planning_attempts", "num_planning_attempts: 1", "num_planning_attempts: 2"},
    {"allowed_planning_time", "allowed_planning_time: 1", "allowed_planning_time: 2"},
    {"max_velocity_scaling_factor", "max_velocity_scaling_factor: 1",
     "max_velocity_scaling_factor: 0.5"},
    {"max_acceleration_scaling_factor", "max_acceleration_scaling_factor: 1",
     "max_acceleration_scaling_factor: 0.5"},
    {"cartesian_speed_end_effector_link", "cartesian_speed_end_effector_link: a",
     "cartesian_speed_end_effector_link: b"},
    {"cartesian_speed_limited_link", "cartesian_speed_limited_link: a",
     "cartesian_speed_limited_link: b"},
    {"max_cartesian_speed", "max_cartesian_speed: 1", "max_cartesian_speed: 2"},
};

TEST(RequestKeys, EachIsAppliedRefusedOrWithoutMeaning) {
  std::vector<test::KeyCase> cases;
  for (const auto& [key, from, to] : kChanges) {
    std::string text = kRequest;
    const std::string what = from;
    ASSERT_NE(text.find(what), std::string::npos) << what;
    cases.push_back({key, kRequest, text.replace(text.find(what), what.size(), to)});
  }
  std::string other = kRequest;
  for (std::size_t at = 0; (at = other.find("link_name: l\n")) != std::string::npos;)
    other.replace(at, 13, "link_name: r\n");
  cases.push_back({"goal_constraints/position_constraints/link_name", kRequest, other});
  const test::TemporaryFolder folder;
  const auto which = robot();
  test::walkFormat("Request (.yaml)", cases, [&](const std::string& text) {
    return summaryOf(PlanningRequest::load(folder.write("r.yaml", text), *which));
  });
}

TEST(RequestKeys, TheTableHasTheReadersKeys) {
  test::expectKeysOf("Request (.yaml)",
                     {"planning_request.cpp", "request_constraints.cpp", "attached_objects.cpp",
                      "robot_state_yaml.cpp", "scene_frames.cpp"},
                     {"child_frame_id", "transform"});
}

}  // namespace
}  // namespace swept
