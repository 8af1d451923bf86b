// SPDX-License-Identifier: BSD-3-Clause
// Broken trajectories and the exact messages they give.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "model_robots.hpp"
#include "swept/robot_model/path_file.hpp"
#include "trajectory_reading.hpp"

namespace swept {
namespace {

struct BrokenTrajectory {
  const char* name;
  std::string text;
  std::string message;
};

void PrintTo(const BrokenTrajectory& broken, std::ostream* out) {
  *out << broken.text;
}

class BrokenTrajectories : public testing::TestWithParam<BrokenTrajectory> {};

TEST_P(BrokenTrajectories, AreNamedWithTheirPlace) {
  const test::TrajectoryReading reading(GetParam().name, GetParam().text, "whole");
  EXPECT_EQ(reading.message, GetParam().message);
}

/// The whole group's joints in a table; a base at rest costs three columns.
const std::string kNames = "time,vj/x,vj/y,vj/theta,turn,wheel,slide";
const std::string kHas = "; group 'whole' has vj/x, vj/y, vj/theta, turn, wheel, slide";
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
        BrokenTrajectory{"t.json", "",
                         "t.json:1: error: malformed JSON: syntax error while parsing value - "
                         "unexpected end of input; expected '[', '{', or a literal"},
        BrokenTrajectory{"t.json", "[]",
                         "t.json: error: a file with a trajectory must be an object"},
        BrokenTrajectory{"t.json", "{}", "t.json: error: trajectory is missing"},
        BrokenTrajectory{"t.json", R"({"trajectory": {}, "states": []})",
                         "t.json: error: the file has the unknown key 'states'; allowed are "
                         "trajectory"},
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

/// A message whose point at line 3 has this.
std::string point(const std::string& inside) {
  return "joint_names: [vj/x, vj/y, vj/theta, turn, wheel, slide]\npoints:\n- {" + inside + "}\n";
}

const std::string kRest = "positions: [0, 0, 0, 0, 0, 0]";

std::string timed(const std::string& duration) {
  return point(kRest + ", time_from_start: " + duration);
}

INSTANTIATE_TEST_SUITE_P(
    Yaml, BrokenTrajectories,
    testing::Values(
        BrokenTrajectory{"t.yaml", "", "t.yaml: error: it is empty; it must have a trajectory"},
        BrokenTrajectory{"t.yaml", "---\n---\n",
                         "t.yaml: error: it is empty; it must have a trajectory"},
        BrokenTrajectory{"t.yaml", "- 1\n", "t.yaml:1: error: a trajectory must be a mapping"},
        BrokenTrajectory{"t.yaml", "points: [}\n",
                         "t.yaml:1: error: malformed YAML: illegal flow end"},
        BrokenTrajectory{"t.yaml", "positions: [0]\n",
                         "t.yaml:1: error: the file has the unknown key 'positions'; allowed are "
                         "joint_trajectory and multi_dof_joint_trajectory"},
        BrokenTrajectory{"t.yaml", "joint_names: [vj/x, vj/y, vj/theta, turn, wheel, slide]\n",
                         "t.yaml:1: error: there is no point; one is needed"},
        BrokenTrajectory{"t.yaml", "trajectory: []\n",
                         "t.yaml:1: error: trajectory has no point; one is needed"},
        BrokenTrajectory{"t.yaml",
                         "trajectory:\n- joint_trajectory: {joint_names: [turn], points: []}\n",
                         "t.yaml:2: error: trajectory[0] has no point; one is needed"},
        BrokenTrajectory{"t.yaml", "joint_names: [turn]\npoints: 5\n",
                         "t.yaml:2: error: points must be a list"},
        BrokenTrajectory{"t.yaml", "joint_names: [turn]\npoints: [5]\n",
                         "t.yaml:1: error: there are no values of vj/x, vj/y, vj/theta, wheel, "
                         "slide, which group 'whole' moves"},
        BrokenTrajectory{"t.yaml", "joint_names: [turn, turn]\npoints: [{}]\n",
                         "t.yaml:1: error: joint_names[1] is 'turn' a second time"},
        BrokenTrajectory{"t.yaml", "joint_names: [turn, elbow]\npoints: [{}]\n",
                         "t.yaml:1: error: joint_names[1] is 'elbow', which is no joint of robot "
                         "'kinds'" +
                             kHas},
        BrokenTrajectory{"t.yaml", point("velocities: [0, 0, 0, 0, 0, 0], time_from_start: 0"),
                         "t.yaml:3: error: points[0] has 0 positions and 6 joint_names"},
        BrokenTrajectory{"t.yaml", point("positions: [0, 0], time_from_start: 0"),
                         "t.yaml:3: error: points[0] has 2 positions and 6 joint_names"},
        BrokenTrajectory{"t.yaml", point("positions: [0, .nan, 0, 0, 0, 0], time_from_start: 0"),
                         "t.yaml:3: error: points[0].positions[1] is '.nan'; it must be a finite "
                         "number"},
        BrokenTrajectory{"t.yaml", point(kRest + ", time_from_start: 0, velocities: [0, 0]"),
                         "t.yaml:3: error: points[0] has 2 velocities and 6 joint_names"},
        BrokenTrajectory{"t.yaml", point(kRest + ", time_from_start: 0, accelerations: [0]"),
                         "t.yaml:3: error: points[0] has 1 accelerations and 6 joint_names"},
        BrokenTrajectory{
            "t.yaml", point(kRest + ", time_from_start: 0, velocities: [0, 0, 0, .inf, 0, 0]"),
            "t.yaml:3: error: points[0].velocities[3] is '.inf'; it must be a finite number"},
        BrokenTrajectory{"t.yaml", point(kRest + ", time_from_start: 0, jerks: []"),
                         "t.yaml:3: error: points[0] has the unknown key 'jerks'; allowed are "
                         "positions, velocities, accelerations, effort and time_from_start"},
        BrokenTrajectory{"t.yaml", point(kRest),
                         "t.yaml:3: error: points[0].time_from_start is missing"},
        BrokenTrajectory{"t.yaml", timed("[1, 0]"),
                         "t.yaml:3: error: points[0].time_from_start must be a single value"},
        BrokenTrajectory{
            "t.yaml", timed("soon"),
            "t.yaml:3: error: points[0].time_from_start is 'soon'; it must be a finite "
            "number"},
        BrokenTrajectory{
            "t.yaml", timed("{}"),
            "t.yaml:3: error: points[0].time_from_start has no value; it must have sec "
            "and nanosec, or secs and nsecs"},
        BrokenTrajectory{
            "t.yaml", timed("{seconds: 1}"),
            "t.yaml:3: error: points[0].time_from_start has the unknown key 'seconds'; "
            "allowed are sec and nanosec"},
        BrokenTrajectory{
            "t.yaml", timed("{secs: 1, nanosec: 5}"),
            "t.yaml:3: error: points[0].time_from_start has the unknown key 'nanosec'; "
            "allowed are secs and nsecs"},
        BrokenTrajectory{"t.yaml", timed("{sec: 1.5, nanosec: 0}"),
                         "t.yaml:3: error: points[0].time_from_start.sec is '1.5'; it must be a "
                         "whole number from 0 to 2147483647"},
        BrokenTrajectory{"t.yaml", timed("{sec: -1, nanosec: 0}"),
                         "t.yaml:3: error: points[0].time_from_start.sec is '-1'; it must be a "
                         "whole number from 0 to 2147483647"},
        BrokenTrajectory{"t.yaml", timed("{sec: 0, nanosec: 1000000000}"),
                         "t.yaml:3: error: points[0].time_from_start.nanosec is '1000000000'; it "
                         "must be a whole number from 0 to 999999999"},
        BrokenTrajectory{"t.yaml", timed("-0.5"),
                         "t.yaml:3: error: points[0]: the time is -0.5 s; it must be 0 or more"},
        BrokenTrajectory{"t.yaml",
                         timed("{sec: 1, nanosec: 5}") + "- {" + kRest +
                             ", time_from_start: {sec: 1, nanosec: 4}}\n",
                         "t.yaml:4: error: points[1]: the time is 1.000000004 s; it must be more "
                         "than 1.000000005 s, that of the point before"},
        BrokenTrajectory{"t.yaml", timed("0") + "---\n" + timed("-1"),
                         "t.yaml:7: error: points[0]: the time is -1 s; it must be 0 or more"},
        BrokenTrajectory{"t.yaml", timed("0") + "---\npath: []\n",
                         "t.yaml:5: error: the file has the unknown key 'path'; allowed are "
                         "joint_trajectory and multi_dof_joint_trajectory"},
        BrokenTrajectory{"t.yaml",
                         "trajectory:\n- joint_trajectory: {joint_names: [vj/x, vj/y, vj/theta, "
                         "turn, wheel, slide], points: [{" +
                             kRest +
                             ", time_from_start: 0}]}\ntrajectory_start: {joint_state: {name: "
                             "[turn], position: [0.5]}}\n",
                         "t.yaml:3: error: trajectory_start: turn is 0.5, and the first point has "
                         "it at 0"},
        BrokenTrajectory{
            "t.yaml",
            "trajectory:\n- joint_trajectory: {joint_names: [vj/x, vj/y, vj/theta, "
            "turn, wheel, slide], points: [{" +
                kRest +
                ", time_from_start: 0}]}\ntrajectory_start: {attached_collision_objects: "
                "[{link_name: t}]}\n",
            "t.yaml:3: error: trajectory_start.attached_collision_objects[0] is not "
            "taken from a path; attached objects are those of the scene"}));

/// A trajectory of a base, the point at line 4.
std::string based(const std::string& inPoint, const std::string& more = "") {
  return "joint_trajectory: {joint_names: [turn, wheel, slide], points: [{positions: [0, 0, 0], "
         "time_from_start: 1}]}\nmulti_dof_joint_trajectory:\n  joint_names: [vj]\n  points: [{" +
         inPoint + "}]\n" + more;
}

const std::string kAt = "multi_dof_joint_trajectory.points[0]";

INSTANTIATE_TEST_SUITE_P(
    Bases, BrokenTrajectories,
    testing::Values(
        BrokenTrajectory{"t.yaml", based("transforms: [{}], time_from_start: 2"),
                         "t.yaml:4: error: " + kAt +
                             ".time_from_start is 2 s, and that of joint_trajectory.points[0] is 1 "
                             "s; both must be the same"},
        BrokenTrajectory{"t.yaml", based("transforms: [{}]"),
                         "t.yaml:4: error: " + kAt + ".time_from_start is missing"},
        BrokenTrajectory{"t.yaml",
                         based("transforms: [{}], time_from_start: 1}, {transforms: [{}]"),
                         "t.yaml:3: error: multi_dof_joint_trajectory has 2 points and 1 are those "
                         "of joint_trajectory"},
        BrokenTrajectory{"t.yaml", based("transforms: [], time_from_start: 1"),
                         "t.yaml:4: error: " + kAt + " has 0 transforms and 1 joint_names"},
        BrokenTrajectory{"t.yaml",
                         based("transforms: [{rotation: [0, 0.5, 0, 0.8660254037844386]}], "
                               "time_from_start: 1"),
                         "t.yaml:4: error: " + kAt +
                             ": multi_dof_joint_state of 'vj': the joint is planar, and the pose "
                             "is not in its plane"},
        BrokenTrajectory{"t.yaml",
                         based("transforms: [{translation: [0, 0, 0.1]}], time_from_start: 1"),
                         "t.yaml:4: error: " + kAt +
                             ": multi_dof_joint_state of 'vj': the joint is planar, and the pose "
                             "is not in its plane"},
        BrokenTrajectory{"t.yaml",
                         based("transforms: [{rotation: [0, 0, 0, 0]}], time_from_start: 1"),
                         "t.yaml:4: error: " + kAt +
                             ".transforms[0].rotation is a quaternion (x, y, z, w) of length 0; it "
                             "must be 1 to within 0.01"},
        BrokenTrajectory{"t.yaml", based("transforms: [{position: [0, 0, 0]}], time_from_start: 1"),
                         "t.yaml:4: error: " + kAt +
                             ".transforms[0] has the unknown key 'position'; allowed are "
                             "translation and rotation"},
        BrokenTrajectory{
            "t.yaml", based("transforms: [{}], time_from_start: 1", "  header: {frame_id: turn}\n"),
            "t.yaml:5: error: multi_dof_joint_trajectory.header.frame_id is 'turn', "
            "which is no frame of the robot or of the file; the model frame is 'odom'"},
        BrokenTrajectory{"t.yaml",
                         based("transforms: [{}], time_from_start: 1, velocities: [{}, {}]"),
                         "t.yaml:1: error: joint_trajectory.points[0] has no velocities, but " +
                             kAt + " has; both have them or none"}));

/// Only the base, at line 2, with these rates.
std::string twisted(const std::string& velocities) {
  return "multi_dof_joint_trajectory: {joint_names: [floor], points: [\n  {transforms: [{}], "
         "time_from_start: 0, velocities: [" +
         velocities + "]}]}\n";
}

TEST(BrokenTwists, AreNamedWithTheirPlace) {
  const auto cart = test::modelRobot("rook6_cart");
  const auto message = [&](const std::string& velocities) {
    return test::TrajectoryReading("t.yaml", twisted(velocities), "base", cart).message;
  };
  const std::string place = "t.yaml:2: error: " + kAt;
  const std::string moves = "; a planar joint moves in linear.x, linear.y and angular.z";
  EXPECT_EQ(message("{linear: [1, 2, 0], angular: [0, 0, 3]}"), "");
  EXPECT_EQ(message("{}, {}"), place + " has 2 velocities and 1 joint_names");
  EXPECT_EQ(message("1"), place + ".velocities[0] must be a mapping");
  EXPECT_EQ(message("{linear: [0, 0, 0.5]}"), place + ".velocities[0] has linear.z 0.5" + moves);
  EXPECT_EQ(message("{angular: [0.5, 0, 0]}"), place + ".velocities[0] has angular.x 0.5" + moves);
  EXPECT_EQ(message("{angular: [0, 0.5, 0]}"), place + ".velocities[0] has angular.y 0.5" + moves);
  EXPECT_EQ(message("{liner: [0, 0, 0]}"),
            place + ".velocities[0] has the unknown key 'liner'; allowed are linear and angular");
  std::string flight = twisted("{}");
  flight.replace(flight.find("floor"), 5, "flight");
  EXPECT_EQ(test::TrajectoryReading("t.yaml", flight, "body", test::modelRobot("drifter")).message,
            place +
                ".velocities[0] is of 'flight', a floating joint, whose velocities and "
                "accelerations are not read");
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
