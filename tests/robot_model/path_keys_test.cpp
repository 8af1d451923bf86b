// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "format_table.hpp"
#include "input_files.hpp"
#include "path_robot.hpp"
#include "swept/robot_model/path_file.hpp"

namespace swept {
namespace {

using test::KeyCase;

/// The states that a file with this ending has for `whole`, whose base may move, or for `arm`.
std::string answer(const std::string& ending, const std::string& text, const char* group) {
  const test::TemporaryFolder folder;
  const auto robot = test::pathRobot();
  std::ostringstream states;
  for (const std::vector<double>& q :
       readPath(folder.write("path" + ending, text), *robot, *robot->findGroup(group))) {
    for (const double value : q) states << value << ' ';
    states << '\n';
  }
  return states.str();
}

TEST(PathKeys, OfCsv) {
  const std::string path = "turn,wheel,slide\n0,0,0\n";
  test::walkFormat("Path (.csv)",
                   {{"first line", path, "wheel,turn,slide\n0,1,0\n"},
                    {"line", path, path + "1,0,0\n"},
                    {"quote", path, "\"turn\",wheel,\"slide\"\n0,0,0\n"},
                    {"other column", path, "turn,wheel,slide,time\n0,0,0,0\n"},
                    {"joint to stay", path, "turn,wheel,slide,head\n0,0,0,0.5\n"}},
                   [](const std::string& text) { return answer(".csv", text, "arm"); });
}

TEST(PathKeys, OfJson) {
  const auto with = [](const std::string& more) {
    return R"({"joint_names": ["turn", "wheel", "slide"], "states": [[0.5, 0.25, 0]])" + more + "}";
  };
  std::vector<KeyCase> cases{
      {"joint_names", with(""),
       R"({"joint_names": ["wheel", "turn", "slide"], "states": [[0.5, 0.25, 0]]})"},
      {"states", with(""),
       R"({"joint_names": ["turn", "wheel", "slide"], "states": [[0.5, 0.5, 0]]})"}};
  for (const char* key : {"robot",
                          "group",
                          "planner",
                          "tool",
                          "deviation",
                          "deviation_angle",
                          "seed",
                          "margin",
                          "margin_self",
                          "margin_world",
                          "tolerance",
                          "clouds",
                          "clock",
                          "constraints",
                          "lines",
                          "trajectory",
                          "segments",
                          "nothing_checked",
                          "links_without_geometry",
                          "warnings",
                          "inputs",
                          "model",
                          "proof"})
    cases.push_back({key, with(""), with(std::string(", \"") + key + "\": \"other\"")});
  test::walkFormat("Path (.json)", cases,
                   [](const std::string& text) { return answer(".json", text, "arm"); });
}

TEST(PathKeys, OfYaml) {
  const std::string names = "[vj/x, vj/y, vj/theta, turn, wheel, slide]";
  const auto joints = [&](const std::string& more, const std::string& inPoint) {
    return "{joint_names: " + names + ", points: [{positions: [0, 0, 0, 1, 0, 0]" + inPoint + "}]" +
           more + "}";
  };
  const auto point = [&](const std::string& key) {
    return KeyCase{"points/" + key, joints("", ""), joints("", ", " + key + ": [1]")};
  };
  const auto bases = [](const std::string& pose, const std::string& inPoint,
                        const std::string& more) {
    return "joint_trajectory: {joint_names: [turn, wheel, slide], points: [{positions: [1, 0, "
           "0]}]}\nmulti_dof_joint_trajectory: {joint_names: [vj], points: [{transforms: "
           "[{translation: " +
           pose + "}]" + inPoint + "}]" + more + "}\n";
  };
  const std::string still = bases("[0, 0, 0]", "", "");
  const auto basePoint = [&](const std::string& key) {
    return KeyCase{"multi_dof_joint_trajectory/points/" + key, still,
                   bases("[0, 0, 0]", ", " + key + ": [1]", "")};
  };
  const auto shown = [&](const std::string& trajectories, const std::string& more) {
    return "trajectory: [" + trajectories + "]\n" + more;
  };
  const std::string one = "{joint_trajectory: " + joints("", "") + "}";
  const auto start = [&](const std::string& state) {
    return shown(one, "trajectory_start: {" + state + "}");
  };
  test::walkFormat(
      "Path (.yaml)",
      {{"header", joints("", ""), joints(", header: {frame_id: other}", "")},
       {"joint_names", joints("", ""),
        "{joint_names: [vj/x, vj/y, vj/theta, wheel, turn, slide], points: [{positions: [0, 0, 0, "
        "1, 0, 0]}]}"},
       {"points/positions", joints("", ""),
        "{joint_names: " + names + ", points: [{positions: [0, 0, 0, 1, 0, 0.5]}]}"},
       point("velocities"),
       point("accelerations"),
       point("effort"),
       point("time_from_start"),
       {"joint_trajectory", "joint_trajectory: " + joints("", ""),
        "joint_trajectory: {joint_names: " + names +
            ", points: [{positions: [0, 0, 0, 1, 2, 0]}]}"},
       {"multi_dof_joint_trajectory/header", still,
        bases("[0, 0, 0]", "", ", header: {frame_id: t}")},
       {"multi_dof_joint_trajectory/joint_names", "joint_trajectory: " + joints("", ""),
        bases("[1, 0, 0]", "", "")},
       {"multi_dof_joint_trajectory/points/transforms", still, bases("[1, 0, 0]", "", "")},
       basePoint("velocities"),
       basePoint("accelerations"),
       basePoint("time_from_start"),
       {"model_id", shown(one, ""), shown(one, "model_id: other")},
       {"trajectory", shown(one, ""), shown(one + ", " + one, "")},
       {"trajectory_start", shown(one, ""), start("joint_state: {name: [turn], position: [0]}")},
       {"trajectory_start/attached_collision_objects", shown(one, ""),
        start("attached_collision_objects: [{link_name: t}]")},
       {"trajectory_start/is_diff", shown(one, ""), start("is_diff: true")}},
      [](const std::string& text) { return answer(".yaml", text, "whole"); });
}

}  // namespace
}  // namespace swept
