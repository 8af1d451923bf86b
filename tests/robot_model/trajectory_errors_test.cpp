// SPDX-License-Identifier: BSD-3-Clause
// Broken trajectories in tables and objects and the exact messages they give.
#include <gtest/gtest.h>

#include <string>

#include "broken_trajectory.hpp"
#include "model_robots.hpp"
#include "trajectory_reading.hpp"

namespace swept {
namespace {

using test::BrokenTrajectory;
using test::kHas;

class BrokenTrajectories : public testing::TestWithParam<BrokenTrajectory> {};

TEST_P(BrokenTrajectories, AreNamedWithTheirPlace) {
  const test::TrajectoryReading reading(GetParam().name, GetParam().text, "whole");
  EXPECT_EQ(reading.message, GetParam().message);
}

/// The whole group's joints in a table; a base at rest costs three columns.
const std::string kNames = "time,vj/x,vj/y,vj/theta,turn,wheel,slide";
const std::string kZeros = "0,0,0,0,0,0";

std::string csv(const std::string& names, const std::string& lines) {
  return kNames + names + "\n" + lines;
}

INSTANTIATE_TEST_SUITE_P(
    Csv, BrokenTrajectories,
    testing::Values(
        BrokenTrajectory{
            "t.csv", "",
            "t.csv: error: it is empty; its first line must have 'time' and the names of the "
            "joints"},
        BrokenTrajectory{"t.csv", csv("", ""),
                         "t.csv: error: it has no line of values below that of the names"},
        BrokenTrajectory{"t.csv", "0,0,0\n1,1,1\n",
                         "t.csv:1: error: the first line has values; it must have the names of the "
                         "joints"},
        BrokenTrajectory{"t.csv", "vj/x,vj/y,vj/theta,turn,wheel,slide\n" + kZeros + "\n",
                         "t.csv:1: error: there is no column 'time', which a trajectory needs"},
        BrokenTrajectory{
            "t.csv", "time,turn,wheel\n0,0,0\n",
            "t.csv:1: error: there are no values of vj/x, vj/y, vj/theta, slide, which "
            "group 'whole' moves"},
        BrokenTrajectory{"t.csv", csv(",time", ""),
                         "t.csv:1: error: column 8 is 'time' a second time"},
        BrokenTrajectory{"t.csv", csv(",turn", ""),
                         "t.csv:1: error: column 8 is 'turn' a second time"},
        BrokenTrajectory{
            "t.csv", csv(",elbow", ""),
            "t.csv:1: error: column 8 is 'elbow', which is no joint of robot 'kinds'" + kHas},
        BrokenTrajectory{"t.csv", csv(",elbow_velocity", ""),
                         "t.csv:1: error: column 8 is 'elbow_velocity', which is no joint of robot "
                         "'kinds'" +
                             kHas},
        BrokenTrajectory{
            "t.csv", csv(",", ""),
            "t.csv:1: error: column 8 is '', which is no joint of robot 'kinds'" + kHas},
        BrokenTrajectory{"t.csv", csv(",vj", ""),
                         "t.csv:1: error: column 8 is 'vj', a joint of several values, which are "
                         "called vj/x and so on"},
        BrokenTrajectory{"t.csv", csv(",turn_velocity,turn_velocity", ""),
                         "t.csv:1: error: column 9 is 'turn_velocity' a second time"},
        BrokenTrajectory{"t.csv", csv(",turn_velocity,wheel_velocity", ""),
                         "t.csv:1: error: there are velocities of turn, wheel, but none of vj/x, "
                         "vj/y, vj/theta, slide, which the group moves, too"},
        BrokenTrajectory{
            "t.csv", csv(",slide_acceleration", ""),
            "t.csv:1: error: there are accelerations of slide, but none of vj/x, vj/y, "
            "vj/theta, turn, wheel, which the group moves, too"},
        BrokenTrajectory{"t.csv", csv(",head_velocity", ""),
                         "t.csv:1: error: column 8, head_velocity, needs a column 'head'"},
        BrokenTrajectory{"t.csv", csv(",\"turn_velocity", ""),
                         "t.csv:1: error: a quote is not closed"},
        BrokenTrajectory{"t.csv", csv("", "0," + kZeros + "\n1,0,0\n"),
                         "t.csv:3: error: there are 3 values; the first line names 7"},
        BrokenTrajectory{"t.csv", csv("", "0," + kZeros + ",0\n"),
                         "t.csv:2: error: there are 8 values; the first line names 7"},
        BrokenTrajectory{"t.csv", csv("", "0,0,0,0,0,zero,0\n"),
                         "t.csv:2: error: column 6, wheel, is 'zero'; it must be a finite number"},
        BrokenTrajectory{"t.csv", csv("", "0,0,0,0,,0,0\n"),
                         "t.csv:2: error: column 5, turn, is ''; it must be a finite number"},
        BrokenTrajectory{
            "t.csv", csv("", "0,0,0,nan,0,0,0\n"),
            "t.csv:2: error: column 4, vj/theta, is 'nan'; it must be a finite number"},
        BrokenTrajectory{"t.csv", csv("", "inf," + kZeros + "\n"),
                         "t.csv:2: error: column 1, time, is 'inf'; it must be a finite number"},
        BrokenTrajectory{"t.csv", csv("", "," + kZeros + "\n"),
                         "t.csv:2: error: column 1, time, is ''; it must be a finite number"},
        BrokenTrajectory{"t.csv", csv("", "-0.5," + kZeros + "\n"),
                         "t.csv:2: error: the time is -0.5 s; it must be 0 or more"},
        BrokenTrajectory{
            "t.csv", csv("", "0.5," + kZeros + "\n0.5," + kZeros + "\n"),
            "t.csv:3: error: the time is 0.5 s; it must be more than 0.5 s, that of the point "
            "before"},
        BrokenTrajectory{
            "t.csv", csv("", "1.5," + kZeros + "\n2," + kZeros + "\n1," + kZeros + "\n"),
            "t.csv:4: error: the time is 1 s; it must be more than 2 s, that of the point before"},
        BrokenTrajectory{
            "t.csv",
            csv(",slide_velocity,wheel_velocity,turn_velocity,vj/x_velocity,vj/y_velocity,"
                "vj/theta_velocity",
                "0," + kZeros + "," + kZeros + "\n1," + kZeros + ",0,0,,0,0,0\n"),
            "t.csv:3: error: column 10, turn_velocity, is empty, but slide_velocity is not; a line "
            "has all of them or none"},
        BrokenTrajectory{
            "t.csv",
            csv(",slide_velocity,wheel_velocity,turn_velocity,vj/x_velocity,vj/y_velocity,"
                "vj/theta_velocity",
                "0," + kZeros + ",0,0,1e999,0,0,0\n"),
            "t.csv:2: error: column 10, turn_velocity, is '1e999'; it must be a finite number"},
        BrokenTrajectory{"t.csv", csv(",head", "0," + kZeros + ",0.5\n"),
                         "t.csv:2: error: head is 0.5, but group 'whole' does not move it: it has "
                         "to stay at 0"},
        BrokenTrajectory{"t.csv", csv(",finger", "0," + kZeros + ",0.25\n"),
                         "t.csv:2: error: finger is 0.25, but the joint follows 'turn' to 0"},
        BrokenTrajectory{"t.csv", csv(",bolt", "0," + kZeros + ",0.25\n"),
                         "t.csv:2: error: bolt is 0.25, but the joint does not move"},
        BrokenTrajectory{
            "t.csv",
            csv(",bolt,slide_velocity,wheel_velocity,turn_velocity,vj/x_velocity,vj/y_velocity,"
                "vj/theta_velocity,bolt_velocity",
                "0," + kZeros + ",0," + kZeros + ",0.5\n"),
            "t.csv:2: error: the velocity of bolt is 0.5, but the joint does not move"},
        BrokenTrajectory{
            "t.csv",
            csv(",head,slide_acceleration,wheel_acceleration,turn_acceleration,vj/x_acceleration,"
                "vj/y_acceleration,vj/theta_acceleration,head_acceleration",
                "0," + kZeros + ",0," + kZeros + ",0.5\n"),
            "t.csv:2: error: the acceleration of head is 0.5, but group 'whole' does not move it: "
            "it has to be 0"},
        BrokenTrajectory{"t.txt", kNames,
                         "t.txt: error: a trajectory file ends in .csv, .yaml, .yml or .json"}));

const std::string kVariables =
    R"("variables": ["vj/x", "vj/y", "vj/theta", "turn", "wheel", "slide"])";

/// A file with these points.
std::string json(const std::string& points) {
  return R"({"trajectory": {)" + kVariables + R"(, "points": [)" + points + "]}}";
}

/// A point at rest, with `more` keys.
std::string jsonPoint(const std::string& time, const std::string& more = "") {
  return R"({"time": )" + time + R"(, "positions": [0, 0, 0, 0, 0, 0])" + more + "}";
}

INSTANTIATE_TEST_SUITE_P(
    Json, BrokenTrajectories,
    testing::Values(
        BrokenTrajectory{"t.json", " ",
                         "t.json:1: error: malformed JSON: syntax error while parsing value - "
                         "unexpected end of input; expected '[', '{', or a literal"},
        BrokenTrajectory{"t.json", "[]",
                         "t.json: error: a file with a trajectory must be an object"},
        BrokenTrajectory{"t.json", "{}", "t.json: error: trajectory is missing"},
        BrokenTrajectory{
            "t.json", R"({"trajectory": {}, "state": []})",
            "t.json: error: the file has the unknown key 'state'; allowed are "
            "trajectory, robot, group, planner, seed, margin, margin_self, "
            "margin_world, tolerance, clouds, joint_names, constraints, clock, states, "
            "segments, nothing_checked, links_without_geometry, warnings, inputs, "
            "model and proof"},
        BrokenTrajectory{"t.json", R"({"trajectory": []})",
                         "t.json: error: trajectory must be an object"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"points": []}})",
                         "t.json: error: trajectory.variables is missing"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"joint_names": []}})",
                         "t.json: error: trajectory has the unknown key 'joint_names'; allowed are "
                         "variables and points"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"variables": "turn"}})",
                         "t.json: error: trajectory.variables must be a list"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"variables": ["turn", 1]}})",
                         "t.json: error: trajectory.variables[1] is 1; it must be text"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"variables": ["turn"]}})",
                         "t.json: error: trajectory: there are no values of vj/x, vj/y, vj/theta, "
                         "wheel, slide, which group 'whole' moves"},
        BrokenTrajectory{"t.json", R"({"trajectory": {"variables": ["turn", "elbow"]}})",
                         "t.json: error: trajectory.variables[1] is 'elbow', which is no joint of "
                         "robot 'kinds'" +
                             kHas},
        BrokenTrajectory{"t.json", R"({"trajectory": {"variables": ["turn", "turn"]}})",
                         "t.json: error: trajectory.variables[1] is 'turn' a second time"},
        BrokenTrajectory{"t.json", R"({"trajectory": {)" + kVariables + "}}",
                         "t.json: error: trajectory.points is missing"},
        BrokenTrajectory{"t.json", json(""),
                         "t.json: error: trajectory.points has no point; one is needed"},
        BrokenTrajectory{"t.json", json("1"),
                         "t.json: error: trajectory.points[0] must be an object"},
        BrokenTrajectory{"t.json", json(R"({"positions": [0, 0, 0, 0, 0, 0]})"),
                         "t.json: error: trajectory.points[0].time is missing"},
        BrokenTrajectory{"t.json", json(R"({"time": 0})"),
                         "t.json: error: trajectory.points[0].positions is missing"},
        BrokenTrajectory{"t.json", json(jsonPoint("\"0\"")),
                         "t.json: error: trajectory.points[0].time is \"0\"; it must be a finite "
                         "number"},
        BrokenTrajectory{"t.json", json(jsonPoint("-1")),
                         "t.json: error: trajectory.points[0]: the time is -1 s; it must be 0 or "
                         "more"},
        BrokenTrajectory{"t.json", json(jsonPoint("1") + ", " + jsonPoint("1")),
                         "t.json: error: trajectory.points[1]: the time is 1 s; it must be more "
                         "than 1 s, that of the point before"},
        BrokenTrajectory{"t.json", json(R"({"time": 0, "positions": [0, 0, null, 0, 0, 0]})"),
                         "t.json: error: trajectory.points[0].positions[2] is null; it must be a "
                         "finite number"},
        BrokenTrajectory{"t.json", json(R"({"time": 0, "positions": [0, 0]})"),
                         "t.json: error: trajectory.points[0].positions holds 2 values; it must "
                         "hold 6"},
        BrokenTrajectory{"t.json", json(jsonPoint("0", R"(, "velocities": [1])")),
                         "t.json: error: trajectory.points[0].velocities holds 1 values; it must "
                         "hold 6"},
        BrokenTrajectory{"t.json", json(jsonPoint("0", R"(, "accelerations": null)")),
                         "t.json: error: trajectory.points[0].accelerations must be a list"},
        BrokenTrajectory{
            "t.json", json(jsonPoint("0", R"(, "effort": [])")),
            "t.json: error: trajectory.points[0] has the unknown key 'effort'; allowed "
            "are time, positions, velocities and accelerations"},
        BrokenTrajectory{"t.json", json(jsonPoint("0", R"(, "time": 1)")),
                         "t.json: error: trajectory.points.time is given twice"},
        BrokenTrajectory{"t.json", json(jsonPoint("1e999")),
                         "t.json: error: malformed JSON: number overflow parsing '1e999'"}));

/// What follows is nlohmann-json's own, and differs from 3.11.2 to 3.11.3.
TEST(EmptyTrajectory, IsNoJson) {
  const test::TrajectoryReading reading("t.json", "", "whole");
  const std::string begin = "t.json:1: error: malformed JSON: ";
  EXPECT_EQ(reading.message.substr(0, begin.size()), begin);
  EXPECT_NE(reading.message.find(" input"), std::string::npos);
}

TEST(BrokenQuaternions, AreNoOrientation) {
  const std::string names =
      "time,flight/trans_x,flight/trans_y,flight/trans_z,flight/rot_x,flight/rot_y,flight/rot_z,"
      "flight/rot_w\n";
  const auto drifter = test::modelRobot("drifter");
  EXPECT_EQ(test::TrajectoryReading("t.csv", names + "0,0,0,0,0,0,0,0\n", "body", drifter).message,
            "t.csv:2: error: the quaternion of joint flight has norm 0, allowed is 1");
  const test::TrajectoryReading rounded("t.csv", names + "0,0,0,0,0,0,0.6,0.8001\n", "body",
                                        drifter);
  ASSERT_EQ(rounded.message, "");
  const std::vector<double>& q = rounded.trajectories.at(0).points.at(0).positions;
  EXPECT_NEAR(q[5] * q[5] + q[6] * q[6], 1.0, 1e-15);
}

}  // namespace
}  // namespace swept
