// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "format_keys.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "trajectory_reading.hpp"

namespace swept {
namespace {

using test::KeyCase;

/// The trajectories that a file with this ending has for `whole`, whose base may move, or for
/// `arm`.
std::string answer(const std::string& ending, const std::string& text, const char* group) {
  const test::TemporaryFolder folder;
  const auto robot = test::pathRobot();
  return test::shown(readTrajectories(folder.write("trajectory" + ending, text), *robot,
                                      *robot->findGroup(group)));
}

TEST(TrajectoryKeys, OfCsv) {
  const std::string names = "time,turn,wheel,slide";
  const std::string plain = names + "\n0,0,0,0\n";
  const auto rates = [&](const std::string& kind) {
    return names + ",turn_" + kind + ",wheel_" + kind + ",slide_" + kind + "\n0,0,0,0";
  };
  test::walkFormat("Trajectory (.csv)",
                   {{"first line", plain, "time,wheel,turn,slide\n0,1,0,0\n"},
                    {"line", plain, plain + "1,0,0,0\n"},
                    {"time", plain, names + "\n1,0,0,0\n"},
                    {"JOINT_velocity", plain, rates("velocity") + ",0,0,0\n"},
                    {"JOINT_acceleration", plain, rates("acceleration") + ",0,0,0\n"},
                    {"empty cell", rates("velocity") + ",0,0,0\n", rates("velocity") + ",,,\n"},
                    {"quote", plain, "\"time\",\"turn\",wheel,\"slide\"\n0,0,0,0\n"},
                    {"other column", plain, names + ",elbow\n0,0,0,0,0\n"},
                    {"joint to stay", plain, names + ",head\n0,0,0,0,0.5\n"}},
                   [](const std::string& text) { return answer(".csv", text, "arm"); });
}

TEST(TrajectoryKeys, OfJson) {
  const auto point = [](const std::string& inside) {
    return R"({"trajectory": {"variables": ["turn", "wheel", "slide"], "points": [{)" + inside +
           "}]}}";
  };
  const std::string plain = point(R"("time": 0, "positions": [1, 0, 0])");
  const auto with = [&](const std::string& key) {
    return KeyCase{"trajectory/points/" + key, plain,
                   point(R"("time": 0, "positions": [1, 0, 0], ")" + key + R"(": [1, 2, 3])")};
  };
  const std::string turned =
      R"({"trajectory": {"variables": ["wheel", "turn", "slide"], "points": [{"time": 0, )"
      R"("positions": [1, 0, 0]}]}})";
  std::vector<KeyCase> cases{
      {"trajectory", plain, turned},
      {"trajectory/variables", plain, turned},
      {"trajectory/points", plain,
       point(R"("time": 0, "positions": [1, 0, 0]}, {"time": 1, "positions": [1, 0, 0])")},
      {"trajectory/points/time", plain, point(R"("time": 1, "positions": [1, 0, 0])")},
      {"trajectory/points/positions", plain, point(R"("time": 0, "positions": [0, 0, 0])")},
      with("velocities"),
      with("accelerations")};
  for (const char* claim : {"robot",    "group",       "planner",         "seed",
                            "margin",   "margin_self", "margin_world",    "tolerance",
                            "clouds",   "clock",       "joint_names",     "constraints",
                            "states",   "segments",    "nothing_checked", "links_without_geometry",
                            "warnings", "inputs",      "model",           "proof"})
    cases.push_back(
        {claim, plain, "{\"" + std::string(claim) + "\": [\"other\"], " + plain.substr(1)});
  test::walkFormat("Trajectory (.json)", cases,
                   [](const std::string& text) { return answer(".json", text, "arm"); });
  test::expectKeysOf("Trajectory (.json)", {"trajectory_json.cpp"});
}

const std::string kNames = "[vj/x, vj/y, vj/theta, turn, wheel, slide]";

/// A JointTrajectory in flow style.
std::string joints(const std::string& time, const std::string& inPoint, const std::string& more) {
  return "{joint_names: " + kNames +
         ", points: [{positions: [0, 0, 0, 1, 0, 0], time_from_start: " + time + inPoint + "}]" +
         more + "}";
}

/// A RobotTrajectory whose base has this pose.
std::string bases(const std::string& pose, const std::string& inPoint, const std::string& more,
                  const std::string& inJoints = "", const std::string& time = "1") {
  return "joint_trajectory: {joint_names: [turn, wheel, slide], points: [{positions: [1, 0, 0], "
         "time_from_start: 1" +
         inJoints +
         "}]}\nmulti_dof_joint_trajectory: {joint_names: [vj], points: [{transforms: "
         "[{translation: " +
         pose + "}], time_from_start: " + time + inPoint + "}]" + more + "}\n";
}

std::vector<KeyCase> jointCases() {
  const std::string plain = joints("0", "", "");
  const auto duration = [](const std::string& key, const std::string& without) {
    return KeyCase{"points/time_from_start/" + key, joints("{" + without + "}", "", ""),
                   joints("{" + without + ", " + key + ": 5}", "", "")};
  };
  return {{"header", plain, joints("0", "", ", header: {frame_id: other}")},
          {"joint_names", plain,
           "{joint_names: [vj/x, vj/y, vj/theta, wheel, turn, slide], points: [{positions: [0, 0, "
           "0, 1, 0, 0], time_from_start: 0}]}"},
          {"points/positions", plain,
           "{joint_names: " + kNames +
               ", points: [{positions: [0, 0, 0, 1, 0, 0.5], time_from_start: 0}]}"},
          {"points/velocities", plain, joints("0", ", velocities: [0, 0, 0, 0, 0, 1]", "")},
          {"points/accelerations", plain, joints("0", ", accelerations: [0, 0, 0, 0, 0, 1]", "")},
          {"points/effort", plain, joints("0", ", effort: [1]", "")},
          {"points/time_from_start", plain, joints("1", "", "")},
          duration("sec", "nanosec: 1"),
          duration("nanosec", "sec: 1"),
          duration("secs", "nsecs: 1"),
          duration("nsecs", "secs: 1"),
          {"joint_trajectory", "joint_trajectory: " + plain,
           "joint_trajectory: " + joints("2", "", "")}};
}

std::vector<KeyCase> baseCases() {
  const std::string place = "multi_dof_joint_trajectory/";
  const std::string still = bases("[0, 0, 0]", "", "");
  const auto rates = [](const std::string& key, const std::string& twist) {
    return bases("[0, 0, 0]", ", " + key + ": [" + twist + "]", "", ", " + key + ": [0, 0, 0]");
  };
  return {{place + "header", still, bases("[0, 0, 0]", "", ", header: {frame_id: t}")},
          {place + "joint_names", "joint_trajectory: " + joints("1", "", ""),
           bases("[1, 0, 0]", "", "")},
          {place + "points/transforms", still, bases("[1, 0, 0]", "", "")},
          {place + "points/velocities", still, rates("velocities", "{}")},
          {place + "points/velocities/linear", rates("velocities", "{}"),
           rates("velocities", "{linear: [1, 0, 0]}")},
          {place + "points/velocities/angular", rates("velocities", "{}"),
           rates("velocities", "{angular: [0, 0, 1]}")},
          {place + "points/accelerations", still, rates("accelerations", "{linear: [1, 0, 0]}")},
          {place + "points/time_from_start", still, bases("[0, 0, 0]", "", "", "", "2")}};
}

std::vector<KeyCase> displayCases() {
  const auto shown = [](const std::string& trajectories, const std::string& more) {
    return "trajectory: [" + trajectories + "]\n" + more;
  };
  const std::string one = "{joint_trajectory: " + joints("0", "", "") + "}";
  const auto start = [&](const std::string& state) {
    return shown(one, "trajectory_start: {" + state + "}");
  };
  return {{"model_id", shown(one, ""), shown(one, "model_id: other")},
          {"trajectory", shown(one, ""), shown(one + ", " + one, "")},
          {"trajectory_start", shown(one, ""), start("joint_state: {name: [turn], position: [0]}")},
          {"trajectory_start/attached_collision_objects", shown(one, ""),
           start("attached_collision_objects: [{link_name: t}]")},
          {"trajectory_start/is_diff", shown(one, ""), start("is_diff: true")}};
}

TEST(TrajectoryKeys, OfYaml) {
  std::vector<KeyCase> cases = jointCases();
  for (const std::vector<KeyCase>& more : {baseCases(), displayCases()})
    cases.insert(cases.end(), more.begin(), more.end());
  test::walkFormat("Trajectory (.yaml)", cases,
                   [](const std::string& text) { return answer(".yaml", text, "whole"); });
  test::expectKeysOf(
      "Trajectory (.yaml)",
      {"trajectory_message.cpp", "trajectory_yaml.cpp", "message_rates.cpp",
       "robot_state_yaml.cpp"},
      {"joint_state", "multi_dof_joint_state", "name", "position", "velocity", "twist", "wrench"});
}

}  // namespace
}  // namespace swept
