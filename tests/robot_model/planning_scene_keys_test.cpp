// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "format_keys.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/planning_scene.hpp"

namespace swept {
namespace {

/// Says something by each key that may say something.
const std::string kScene = R"(name: s
is_diff: false
robot_model_name: two
robot_state:
  joint_state: {header: {frame_id: base}, name: [jl, jr], position: [0.5, -0.25], velocity: [], effort: []}
  multi_dof_joint_state: {header: {frame_id: odom}, joint_names: [vj], transforms: [{translation: [1, 2, 0], rotation: [0, 0, 0.6, 0.8]}], twist: [], wrench: []}
  attached_collision_objects:
    - {link_name: l, object: {id: rod, header: {frame_id: l}, primitives: [{type: box, dimensions: [0.1, 0.2, 4]}]}, touch_links: [r], detach_posture: {}, weight: 0}
  is_diff: false
fixed_frame_transforms:
  - {header: {frame_id: table}, child_frame_id: odom, transform: {translation: [0, 0, 1], rotation: [0, 0, 0, 1]}}
  - {header: {frame_id: bench}, child_frame_id: odom, transform: {translation: [0, 0, 9]}}
allowed_collision_matrix: {entry_names: [l, r, rod, one], entry_values: [{enabled: [true, false, false, true]}, [false, true, false, false], [false, false, true, false], [true, false, false, true]], default_entry_names: [two], default_entry_values: [true]}
link_padding: [{link_name: l, padding: 0}]
link_scale: [{link_name: l, scale: 1}]
object_colors: []
world:
  octomap: {header: {frame_id: odom}, origin: {position: [0, 0, 0]}, octomap: {header: {frame_id: odom}, binary: false, id: '', resolution: 0, data: []}}
  collision_objects:
    - header: {seq: 0, stamp: 0, frame_id: table}
      id: one
      type: {key: '', db: ''}
      pose: {position: [1, 0, 0], orientation: [0, 0, 0, 1]}
      primitives: [{type: cylinder, dimensions: [2, 0.1], polygon: {points: []}}]
      primitive_poses: [{position: [0, 3, 0]}]
      subframe_names: [top, side]
      subframe_poses: [{position: [0, 0, 1]}, {position: [0, 4, 0]}]
      operation: add
    - {id: two, header: {frame_id: one/top}, planes: [{coef: [0, 0, 1, 2]}], plane_poses: [{position: [0, 0, 5]}]}
    - {id: three, meshes: [{resource: cube.obj, scale: [1, 2, 3]}], mesh_poses: [{position: [0, 0, 7]}]}
    - {id: four, meshes: [{resource: cube.obj, dimensions: [1, 2, 3]}]}
    - {id: five, meshes: [{vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], triangles: [[0, 2, 1], [0, 1, 3], {vertex_indices: [1, 2, 3]}, [2, 0, 3]]}]}
    - {id: six, primitives: [{type: sphere, dimensions: [0.5]}], motion: [{time: 1, position: [9, 0, 0]}, {time: 2, position: [9, 1, 0], orientation: [0, 0, 0.6, 0.8]}]}
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kScene;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

/// A key, a place of the scene, and what stands there instead.
using Change = std::array<const char*, 3>;

const std::vector<Change> kChanges = {
    {"name", "name: s", "name: another"},
    {"is_diff", "\nis_diff: false", "\nis_diff: true"},
    {"robot_model_name", "robot_model_name: two", "robot_model_name: three"},
    {"robot_state/is_diff", "  is_diff: false", "  is_diff: true"},
    {"robot_state/joint_state/header", "{frame_id: base}, name", "{frame_id: r}, name"},
    {"robot_state/joint_state/name", "[jl, jr]", "[jr, jl]"},
    {"robot_state/joint_state/name", "[jl, jr]", "[jl, vj/y]"},
    {"robot_state/joint_state/position", "[0.5, -0.25]", "[0.5, -0.125]"},
    {"robot_state/joint_state/velocity", "velocity: []", "velocity: [1, 2]"},
    {"robot_state/joint_state/effort", "effort: []", "effort: [1, 2]"},
    {"robot_state/multi_dof_joint_state/header/frame_id", "{frame_id: odom}, joint_names",
     "{frame_id: table}, joint_names"},
    {"robot_state/multi_dof_joint_state/joint_names",
     "joint_names: [vj], transforms: [{translation: [1, 2, 0], rotation: [0, 0, 0.6, 0.8]}]",
     "joint_names: [], transforms: []"},
    {"robot_state/multi_dof_joint_state/transforms", "[1, 2, 0]", "[1, 3, 0]"},
    {"robot_state/multi_dof_joint_state/twist", "twist: []", "twist: [{}]"},
    {"robot_state/multi_dof_joint_state/wrench", "wrench: []", "wrench: [{}]"},
    {"robot_state/attached_collision_objects/link_name", "link_name: l, object",
     "link_name: lid, object"},
    {"robot_state/attached_collision_objects/object", "{id: rod,",
     "{id: rod, pose: {position: [1, 0, 0]},"},
    {"robot_state/attached_collision_objects/touch_links", "touch_links: [r]", "touch_links: []"},
    {"robot_state/attached_collision_objects/detach_posture", "detach_posture: {}",
     "detach_posture: {points: []}"},
    {"robot_state/attached_collision_objects/weight", "weight: 0", "weight: 9"},
    {"fixed_frame_transforms/header",
     "table}, child_frame_id: odom, transform: {translation: [0, 0, 1], rotation: [0, 0, 0, 1]}}\n "
     " - {header: {frame_id: bench}",
     "bench}, child_frame_id: odom, transform: {translation: [0, 0, 1], rotation: [0, 0, 0, 1]}}\n "
     " - {header: {frame_id: table}"},
    {"fixed_frame_transforms/child_frame_id", "child_frame_id: odom", "child_frame_id: l"},
    {"fixed_frame_transforms/transform",
     "transform: {translation: [0, 0, 1], rotation: [0, 0, 0, 1]}", "transform: {}"},
    {"fixed_frame_transforms/transform/translation", "translation: [0, 0, 1]",
     "translation: [0, 0, 2]"},
    {"fixed_frame_transforms/transform/rotation", "rotation: [0, 0, 0, 1]",
     "rotation: [0, 0, 1, 0]"},
    {"allowed_collision_matrix/entry_names", "[l, r, rod, one]", "[l, r, rod, three]"},
    {"allowed_collision_matrix/entry_values",
     "[{enabled: [true, false, false, true]}, [false, true, false, false], [false, false, true, "
     "false], [true, false, false, true]]",
     "[[1, 1, 1, 1], [1, 1, 1, 1], [1, 1, 1, 1], [1, 1, 1, 1]]"},
    {"allowed_collision_matrix/entry_values/enabled",
     "{enabled: [true, false, false, true]}, [false, true",
     "{enabled: [true, true, false, true]}, [true, true"},
    {"allowed_collision_matrix/default_entry_names", "default_entry_names: [two]",
     "default_entry_names: [three]"},
    {"allowed_collision_matrix/default_entry_values", "default_entry_values: [true]",
     "default_entry_values: [false]"},
    {"link_padding", "padding: 0}", "padding: 0.03}"},
    {"link_padding/link_name", "{link_name: l, padding", "{link_name: r, padding"},
    {"link_padding/padding", "padding: 0}", "padding: -0.03}"},
    {"link_scale", "scale: 1}", "scale: 1.1}"},
    {"link_scale/scale", "scale: 1}", "scale: 0.9}"},
    {"object_colors", "object_colors: []", "object_colors: [{id: one, color: {r: 1}}]"},
    {"world/octomap", "data: []", "data: [1]"},
    {"world/octomap/header", "octomap: {header: {frame_id: odom}, origin",
     "octomap: {header: {frame_id: l}, origin"},
    {"world/octomap/origin", "origin: {position: [0, 0, 0]}", "origin: {position: [1, 0, 0]}"},
    {"world/octomap/octomap/header", "{header: {frame_id: odom}, binary",
     "{header: {frame_id: l}, binary"},
    {"world/octomap/octomap/binary", "binary: false", "binary: true"},
    {"world/octomap/octomap/id", "id: '', resolution", "id: OcTree, resolution"},
    {"world/octomap/octomap/resolution", "resolution: 0", "resolution: 0.1"},
    {"world/octomap/octomap/data", "data: []", "data: [0, 1]"},
    {"collision_objects/header", "header: {seq: 0, stamp: 0, frame_id: table}",
     "header: {seq: 0, stamp: 0, frame_id: r}"},
    {"collision_objects/header/seq", "seq: 0", "seq: 1"},
    {"collision_objects/header/stamp", "stamp: 0", "stamp: {sec: 1, nanosec: 2}"},
    {"collision_objects/header/frame_id", "frame_id: table}\n", "frame_id: rod}\n"},
    {"collision_objects/header/frame_id", "frame_id: table}\n", "frame_id: ''}\n"},
    {"collision_objects/id", "{id: four", "{id: tetra"},
    {"collision_objects/type", "{key: '', db: ''}", "{key: can, db: ''}"},
    {"collision_objects/pose", "pose: {position: [1, 0, 0], orientation: [0, 0, 0, 1]}\n",
     "pose: {}\n"},
    {"collision_objects/pose/position", "{position: [1, 0, 0],", "{position: [2, 0, 0],"},
    {"collision_objects/pose/orientation", "[1, 0, 0], orientation: [0, 0, 0, 1]",
     "[1, 0, 0], orientation: [0, 0, 1, 0]"},
    {"collision_objects/primitives",
     "[{type: cylinder, dimensions: [2, 0.1], polygon: {points: []}}]",
     "[{type: sphere, dimensions: [2]}]"},
    {"collision_objects/primitives/type", "type: cylinder", "type: cone"},
    {"collision_objects/primitives/dimensions", "[2, 0.1]", "[2, 0.2]"},
    {"collision_objects/primitives/polygon", "{points: []}", "{points: [0]}"},
    {"collision_objects/primitive_poses", "[{position: [0, 3, 0]}]", "[]"},
    {"collision_objects/meshes", "{resource: cube.obj, scale: [1, 2, 3]}", "{resource: cube.obj}"},
    {"collision_objects/meshes/resource", "resource: cube.obj, scale",
     "resource: tetra.obj, scale"},
    {"collision_objects/meshes/scale", "scale: [1, 2, 3]", "scale: [1, 2, 4]"},
    {"collision_objects/meshes/dimensions", "dimensions: [1, 2, 3]", "dimensions: [1, 2, 4]"},
    {"collision_objects/meshes/vertices", "[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
     "[2, 0, 0], [0, 1, 0], [0, 0, 1]]"},
    {"collision_objects/meshes/triangles", "[0, 1, 3], {vertex", "{vertex"},
    {"collision_objects/meshes/triangles/vertex_indices", ", {vertex_indices: [1, 2, 3]}", ""},
    {"collision_objects/mesh_poses", "[0, 0, 7]", "[0, 0, 8]"},
    {"collision_objects/planes", "[{coef: [0, 0, 1, 2]}]", "[{coef: [0, 1, 0, 2]}]"},
    {"collision_objects/planes/coef", "[0, 0, 1, 2]", "[0, 0, 1, 3]"},
    {"collision_objects/plane_poses", "[0, 0, 5]", "[0, 0, 6]"},
    {"collision_objects/subframe_names", "[top, side]", "[side, top]"},
    {"collision_objects/subframe_poses", "[{position: [0, 0, 1]}, ", "[{position: [0, 0, 2]}, "},
    {"collision_objects/operation", "operation: add", "operation: remove"},
    {"collision_objects/motion",
     "motion: [{time: 1, position: [9, 0, 0]}, {time: 2, position: [9, 1, 0], orientation: [0, 0, "
     "0.6, 0.8]}]",
     "pose: {position: [9, 0, 0]}"},
    {"collision_objects/motion/time", "{time: 1, position", "{time: 1.5, position"},
    {"collision_objects/motion/position", "position: [9, 1, 0]", "position: [9, 2, 0]"},
    {"collision_objects/motion/orientation", "[9, 1, 0], orientation: [0, 0, 0.6, 0.8]",
     "[9, 1, 0], orientation: [0, 0.6, 0, 0.8]"},
};

TEST(PlanningSceneKeys, EachIsAppliedRefusedOrWithoutMeaning) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  folder.write("tetra.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto robot = test::twoArms();
  std::map<std::string, std::string> answers;
  const auto answer = [&](const std::string& text) {
    const auto known = answers.find(text);
    if (known != answers.end()) return known->second;
    return answers[text] =
               test::summaryOf(PlanningScene::load(folder.write("s.yaml", text), *robot));
  };
  std::vector<test::KeyCase> cases;
  for (const auto& [key, from, to] : kChanges)
    cases.push_back({.key = key, .without = kScene, .with = changed(from, to)});
  const std::string top =
      "collision_objects: [{id: a, primitives: [{type: sphere, dimensions: [1]}]}]";
  cases.push_back({"collision_objects", "collision_objects: []", top});
  cases.push_back({"world", "world: {}", "world: {" + top + "}"});
  test::walkFormat("Planning scene (.yaml, .yml)", cases, answer);
}

TEST(PlanningSceneKeys, TheTableHasTheReadersKeys) {
  test::expectKeysOf(
      "Planning scene (.yaml, .yml)",
      {"scene_yaml.cpp", "scene_extras.cpp", "scene_objects.cpp", "scene_motion.cpp",
       "scene_frames.cpp", "scene_matrix.cpp", "attached_objects.cpp", "robot_state_yaml.cpp"});
}

}  // namespace
}  // namespace swept
