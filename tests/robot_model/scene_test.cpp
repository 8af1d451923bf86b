// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "input_files.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;

Eigen::Isometry3d pose(const Eigen::Vector3d& p, double aboutZ) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() << std::cos(aboutZ), -std::sin(aboutZ), 0, std::sin(aboutZ), std::cos(aboutZ), 0,
      0, 0, 1;
  result.translation() = p;
  return result;
}

double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

World load(const std::string& name, const std::string& text, const LoadOptions& options = {}) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  return World::load(folder.write(name, text), options);
}

// 0.6, 0.8 is the half-angle sine and cosine of this angle about z.
const double kTurn = 2.0 * std::atan2(0.6, 0.8);

TEST(SceneYaml, ListsAndMappingsAndCodesMeanTheSame) {
  const World lists = load("s.yaml", R"(
name: test
robot_state: {joint_state: {name: [a], position: [1]}}
world:
  collision_objects:
    - id: can
      header: {frame_id: world}
      pose: {position: [1, 0, 0], orientation: [0, 0, 0.6, 0.8]}
      primitives:
        - {type: cylinder, dimensions: [0.4, 0.1]}
      primitive_poses:
        - {position: [0, 2, 0], orientation: [0, 0, 0.6, 0.8]}
  octomap: {octomap: {id: OcTree, data: []}}
)");
  const World maps = load("s.yml", R"(
collision_objects:
  - id: can
    operation: 0
    pose:
      position: {x: 1, y: 0, z: 0}
      orientation: {x: 0, y: 0, z: 0.6, w: 0.8}
    primitives: [{type: 3, dimensions: [0.4, 0.1]}]
    primitive_poses: [{position: {x: 0, y: 2, z: 0}, orientation: {x: 0, y: 0, z: 0.6, w: 0.8}}]
)");
  const Eigen::Isometry3d expected = pose({1, 0, 0}, kTurn) * pose({0, 2, 0}, kTurn);
  for (const World* world : {&lists, &maps}) {
    ASSERT_EQ(world->bodies().size(), 1u);
    const WorldBody::Part& part = world->find("can")->parts.at(0);
    EXPECT_EQ(std::get<Cylinder>(part.shape).radius, 0.1);
    EXPECT_EQ(std::get<Cylinder>(part.shape).halfLength, 0.2);
    EXPECT_LT(difference(part.world_from_shape, expected), 1e-15);
  }
}

TEST(SceneYaml, ObjectsMayHoldSeveralShapesAndNoPoses) {
  const World world = load("s.yaml", R"(
world:
  collision_objects:
    - id: one
      primitives:
        - {type: BOX, dimensions: [1, 2, 3]}
        - {type: 2, dimensions: [0.5]}
      primitive_poses:
        - {position: [0, 0, 1]}
        - {orientation: [0, 0, 0.6001, 0.8]}
    - id: two
      pose: {position: [7, 0, 0]}
      primitives: [{type: sphere, dimensions: [1]}]
)");
  ASSERT_EQ(world.bodies().size(), 2u);
  const auto& parts = world.find("one")->parts;
  EXPECT_EQ(std::get<Box>(parts[0].shape).halfExtents, Eigen::Vector3d(0.5, 1, 1.5));
  EXPECT_LT(difference(parts[0].world_from_shape, pose({0, 0, 1}, 0)), 1e-15);
  EXPECT_EQ(std::get<Sphere>(parts[1].shape).radius, 0.5);
  const Eigen::Matrix3d r = parts[1].world_from_shape.linear();
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_EQ(world.find("two")->parts[0].world_from_shape.translation(), Eigen::Vector3d(7, 0, 0));
}

TEST(SceneYaml, ConesAndPlanes) {
  const World world = load("s.yaml", R"(
world:
  collision_objects:
    - id: hat
      primitives: [{type: cone, dimensions: [0.4, 0.1]}, {type: 4, dimensions: [0.4, 0.1]}]
    - id: floor
      planes: [{coef: [0, 0, 2, 1]}]
      plane_poses: [{position: [0, 0, 3]}]
)");
  for (const WorldBody::Part& part : world.find("hat")->parts) {
    EXPECT_EQ(std::get<Cone>(part.shape).radius, 0.1);
    EXPECT_EQ(std::get<Cone>(part.shape).halfLength, 0.2);
  }
  const WorldBody::Part& floor = world.find("floor")->parts.at(0);
  EXPECT_EQ(std::get<Plane>(floor.shape).normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(std::get<Plane>(floor.shape).offset, -0.5);
  EXPECT_EQ(floor.world_from_shape.translation(), Eigen::Vector3d(0, 0, 3));
}

TEST(SceneYaml, MeshesFromNumbersAndFiles) {
  test::Warnings warnings;
  const World world = load("s.yaml", R"(
world:
  collision_objects:
    - id: tetra
      meshes:
        - vertices: [[0, 0, 0], {x: 1, y: 0, z: 0}, [0, 1, 0], [0, 0, 1]]
          triangles: [[0, 2, 1], {vertex_indices: [0, 1, 3]}, [1, 2, 3], [2, 0, 3]]
      mesh_poses: [{position: [5, 0, 0]}]
    - id: cube
      meshes: [{resource: cube.obj, scale: [2, 2, 2]}]
    - id: sheet
      meshes: [{vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}]
    - id: brick
      meshes: [{resource: cube.obj, dimensions: [3, 1, 1]}]
)",
                           warnings.options());
  const auto& tetra = world.find("tetra")->parts[0];
  EXPECT_TRUE(std::get<TriangleMesh>(tetra.shape).isClosed());
  EXPECT_EQ(tetra.world_from_shape.translation(), Eigen::Vector3d(5, 0, 0));
  const auto& cube = std::get<TriangleMesh>(world.find("cube")->parts[0].shape);
  EXPECT_TRUE(cube.encloses({1.5, 1.5, 1.5}));
  const auto& brick = std::get<TriangleMesh>(world.find("brick")->parts[0].shape);
  EXPECT_TRUE(brick.encloses({2.5, 0.5, 0.5}));
  EXPECT_FALSE(brick.encloses({0.5, 1.5, 0.5}));
  ASSERT_EQ(warnings.lines.size(), 1u);
  EXPECT_THAT(warnings.lines[0],
              ::testing::EndsWith("s.yaml:12: warning: mesh 'sheet' is an open surface (1 open "
                                  "component): its interior is not solid"));
}

/// MoveIt keeps them the other way round than tf does: read as tf has them, objects stood on the
/// wrong side of the robot.
TEST(SceneYaml, FixedTransformsPlaceObjects) {
  test::Warnings warnings;
  const auto sphere = [](const std::string& id, const std::string& frame) {
    return "    - {id: " + id + ", header: {frame_id: " + frame +
           "}, pose: {position: [1, 0, 0]}, primitives: [{type: sphere, dimensions: [1]}]}\n";
  };
  const World world = load("s.yaml",
                           "fixed_frame_transforms:\n"
                           "  - {header: {frame_id: base}, child_frame_id: base, transform: {}}\n"
                           "  - header: {frame_id: table}\n"
                           "    child_frame_id: base\n"
                           "    transform: {translation: [0, 0, 1], rotation: [0, 0, 0.6, 0.8]}\n"
                           "  - header: {frame_id: /tray}\n"
                           "    child_frame_id: base\n"
                           "    transform: {translation: {x: 0, y: 3, z: 0}}\n"
                           "world:\n  collision_objects:\n" +
                               sphere("on_table", "table") + sphere("on_tray", "tray") +
                               sphere("in_base", "base") + sphere("in_world", "world"),
                           warnings.options());
  const auto at = [&](const char* id) { return world.find(id)->parts[0].world_from_shape; };
  EXPECT_LT(difference(at("on_table"), pose({0, 0, 1}, kTurn) * pose({1, 0, 0}, 0)), 1e-15);
  EXPECT_LT(difference(at("on_tray"), pose({1, 3, 0}, 0)), 1e-15);
  for (const char* id : {"in_base", "in_world"}) {
    EXPECT_LT(difference(at(id), pose({1, 0, 0}, 0)), 1e-15) << id;
  }
  EXPECT_THAT(
      warnings.lines,
      ElementsAre(EndsWith("s.yaml:4: warning: fixed_frame_transforms[1].child_frame_id 'base' is "
                           "taken for the robot's model frame")));
}

/// As MotionBenchMaker, Robowflex and MoveIt's own programs write them.
TEST(SceneYaml, TransformsOfThePlanningFrameSayNothing) {
  test::Warnings warnings;
  LoadOptions options = warnings.options();
  options.modelFrame = "base_link";
  for (const char* transform :
       {"{child_frame_id: base_link, transform: {translation: [0, 0, 0], rotation: [0, 0, 0, 1]}}",
        "{child_frame_id: world, transform: {translation: [0, 0, 0]}}",
        "{header: {frame_id: odom}, child_frame_id: base_link, transform: {}}",
        "{header: {frame_id: base_link}, child_frame_id: world, transform: {}}"}) {
    const std::string text =
        "fixed_frame_transforms: [" + std::string(transform) + "]\ncollision_objects:\n" +
        "  - {id: ball, header: {frame_id: base_link}, pose: {position: [1, 0, 0]}, primitives: "
        "[{type: sphere, dimensions: [1]}]}\n";
    const World world = load("s.yaml", text, options);
    EXPECT_EQ(world.find("ball")->parts[0].world_from_shape.translation(),
              Eigen::Vector3d(1, 0, 0));
  }
  EXPECT_THAT(warnings.lines, IsEmpty());
}

/// `world` is where the robot is not, if the scene says so.
TEST(SceneYaml, TheWorldMayBeElsewhereThanTheRobot) {
  LoadOptions options;
  options.modelFrame = "base_link";
  const World world = load("s.yaml", R"(
fixed_frame_transforms:
  - {header: {frame_id: world}, child_frame_id: base_link, transform: {translation: [0, 0, -1]}}
collision_objects:
  - {id: ball, header: {frame_id: world}, primitives: [{type: sphere, dimensions: [1]}]}
)",
                           options);
  EXPECT_EQ(world.find("ball")->parts[0].world_from_shape.translation(), Eigen::Vector3d(0, 0, -1));
}

TEST(SceneYaml, TheModelFrameIsAKnownFrameAndNoOtherIs) {
  const std::string text =
      "world:\n  collision_objects:\n    - {id: ball, header: {frame_id: base_link}, "
      "pose: {position: [1, 0, 0]}, primitives: [{type: sphere, dimensions: [1]}]}\n";
  LoadOptions options;
  options.modelFrame = "base_link";
  EXPECT_EQ(load("s.yaml", text, options).bodies().size(), 1u);
  options.modelFrame = "pedestal";
  EXPECT_THAT(
      test::inputError([&] { load("s.yaml", text, options); }),
      EndsWith("s.yaml:3: error: object 'ball': header.frame_id is 'base_link', which is no "
               "frame of the file; those of a robot's links need PlanningScene::load; the "
               "model frame is 'pedestal'"));
}

/// A proof in the world alone would be about less than the file says.
TEST(SceneYaml, WhatMakesMoreToCollideWithThanTheWorldIsRefused) {
  const auto refusal = [](const std::string& text) {
    return test::inputError([&] { load("s.yaml", text + "collision_objects: []\n"); });
  };
  const std::string instead = ": PlanningScene::load reads it, World::load reads the world alone";
  EXPECT_THAT(refusal("robot_state:\n  attached_collision_objects:\n    - {link_name: hand}\n"),
              EndsWith("s.yaml:3: error: robot_state.attached_collision_objects[0] is carried by a "
                       "link" +
                       instead));
  EXPECT_THAT(
      refusal("robot_state:\n  multi_dof_joint_state: {joint_names: [base], transforms: "
              "[{translation: [1, 0, 0]}]}\n"),
      EndsWith("s.yaml:2: error: robot_state.multi_dof_joint_state moves 'base'" + instead));
  EXPECT_THAT(refusal("allowed_collision_matrix: {entry_names: [a], entry_values: [[true]]}\n"),
              EndsWith("s.yaml:1: error: allowed_collision_matrix stands in place of the SRDF's" +
                       instead));
  EXPECT_EQ(
      refusal("robot_state: {multi_dof_joint_state: {joint_names: [base], transforms: [{}]}}\n"
              "allowed_collision_matrix: {entry_names: [], entry_values: []}\n"),
      "");
}

/// What messages that ROS prints have besides, down to the line that begins another one.
TEST(SceneYaml, WhatMoveItWritesIsAllowed) {
  test::Warnings warnings;
  const World world = load("s.yaml", R"(
name: ''
robot_state:
  joint_state: {header: {seq: 0, stamp: {secs: 0, nsecs: 0}, frame_id: ''}, name: [], position: [], velocity: [], effort: []}
  multi_dof_joint_state: {header: {frame_id: ''}, joint_names: [], transforms: [], twist: [], wrench: []}
  attached_collision_objects: []
  is_diff: False
robot_model_name: fetch
fixed_frame_transforms: []
allowed_collision_matrix: {entry_names: [], entry_values: [], default_entry_names: [], default_entry_values: []}
link_padding: [{link_name: hand, padding: 0.0}]
link_scale: [{link_name: hand, scale: 1.0}]
object_colors: [{id: can, color: {r: 1, g: 0, b: 0, a: 1}}]
world:
  collision_objects:
    - header: {seq: 0, stamp: {secs: 0, nsecs: 0}, frame_id: world}
      pose: {position: {x: 0.0, y: 0.0, z: 0.0}, orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}
      id: can
      type: {key: '', db: ''}
      primitives: [{type: 3, dimensions: [0.4, 0.1], polygon: {points: []}}]
      primitive_poses: [{position: {x: 0.0, y: 0.0, z: 0.0}, orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}]
      meshes: []
      mesh_poses: []
      planes: []
      plane_poses: []
      subframe_names: []
      subframe_poses: []
      operation: 0
  octomap: {header: {frame_id: ''}, origin: {position: {x: 0, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}, octomap: {header: {frame_id: ''}, binary: False, id: '', resolution: 0.0, data: []}}
is_diff: False
---
)",
                           warnings.options());
  EXPECT_EQ(world.bodies().size(), 1u);
  EXPECT_THAT(warnings.lines, IsEmpty());
}

TEST(SceneText, OlderFormatHasNoObjectPoses) {
  const World world = load("s.scene",
                           "(noname)+++\n"
                           "* the can\n2\n"
                           "cylinder\n0.1 0.4\n1 2 3\n0 0 0.6 0.8\n0 0 0 0\n"
                           "box\n1 2 3\n0 0 0\n0 0 0 1\n0.1 0.2 0.3 1\n"
                           "* ball\n1\nsphere\n0.5\n0 0 1\n0 0 0 1\n0 0 0 0\n.\n");
  ASSERT_EQ(world.bodies().size(), 2u);
  const auto& parts = world.find("the can")->parts;
  ASSERT_EQ(parts.size(), 2u);
  // Text holds radius, then length: the other way round than the messages.
  EXPECT_EQ(std::get<Cylinder>(parts[0].shape).radius, 0.1);
  EXPECT_EQ(std::get<Cylinder>(parts[0].shape).halfLength, 0.2);
  EXPECT_LT(difference(parts[0].world_from_shape, pose({1, 2, 3}, kTurn)), 1e-15);
  EXPECT_EQ(std::get<Box>(parts[1].shape).halfExtents, Eigen::Vector3d(0.5, 1, 1.5));
  EXPECT_EQ(std::get<Sphere>(world.find("ball")->parts[0].shape).radius, 0.5);
}

TEST(SceneText, NewerFormatHasPosesAndSubframes) {
  const World world = load("s.scene",
                           "scene with a name\n"
                           "* a\n1 0 0\n0 0 0.6 0.8\n1\nsphere\n0.5\n0 2 0\n0 0 0 1\n0 0 0 0\n"
                           "2\ntop\n0 0 1\n0 0 0 1\nside\n1 0 0\n0 0 0 1\n"
                           "* m\n0 0 0\n0 0 0 1\n1\nmesh\n4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                           "0 2 1\n0 1 3\n1 2 3\n2 0 3\n0 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n");
  ASSERT_EQ(world.bodies().size(), 2u);
  EXPECT_LT(difference(world.find("a")->parts[0].world_from_shape,
                       pose({1, 0, 0}, kTurn) * pose({0, 2, 0}, 0)),
            1e-15);
  EXPECT_TRUE(std::get<TriangleMesh>(world.find("m")->parts[0].shape).isClosed());
}

TEST(SceneText, ConesAndPlanes) {
  const World world = load("s.scene",
                           "(noname)+++\n"
                           "* a\n2\n"
                           "cone\n0.1 0.4\n1 2 3\n0 0 0 1\n0 0 0 0\n"
                           "plane\n0 0 2 1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n");
  const auto& parts = world.find("a")->parts;
  EXPECT_EQ(std::get<Cone>(parts.at(0).shape).radius, 0.1);
  EXPECT_EQ(std::get<Cone>(parts.at(0).shape).halfLength, 0.2);
  EXPECT_EQ(std::get<Plane>(parts.at(1).shape).offset, -0.5);
}

TEST(SceneText, EmptyScenesAndScenesWithoutANameLoad) {
  EXPECT_THAT(load("s.scene", "name\n.\n").bodies(), IsEmpty());
  EXPECT_EQ(load("s.scene", "* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n").bodies().size(), 1u);
}

TEST(Worlds, RefuseTakenNamesAndPosesThatAreNoneAtAll) {
  World world;
  world.add("a", makeSphere(1), pose({1, 2, 3}, 0.5));
  EXPECT_THROW(world.add("a", makeSphere(1), pose({0, 0, 0}, 0)), std::invalid_argument);
  Eigen::Isometry3d scaled = pose({0, 0, 0}, 0), mirrored = scaled, lost = scaled, torn = scaled;
  scaled.linear() *= 1.001;
  mirrored.linear()(0, 0) = -1;
  lost.translation().x() = std::numeric_limits<double>::infinity();
  torn.linear()(1, 2) = std::numeric_limits<double>::quiet_NaN();
  for (const auto& bad : {scaled, mirrored, lost, torn}) {
    EXPECT_THROW(world.add("b", makeSphere(1), bad), std::invalid_argument);
  }
  EXPECT_EQ(world.bodies().size(), 1u);
  EXPECT_EQ(world.find("b"), nullptr);
}

}  // namespace
}  // namespace swept
