// SPDX-License-Identifier: BSD-3-Clause
// Broken messages with trajectories and the exact messages they give.
#include <gtest/gtest.h>

#include <string>

#include "broken_trajectory.hpp"
#include "model_robots.hpp"
#include "trajectory_reading.hpp"

namespace swept {
namespace {

using test::BrokenTrajectory;
using test::kHas;

class BrokenMessages : public testing::TestWithParam<BrokenTrajectory> {};

TEST_P(BrokenMessages, AreNamedWithTheirPlace) {
  const test::TrajectoryReading reading(GetParam().name, GetParam().text, "whole");
  EXPECT_EQ(reading.message, GetParam().message);
}

/// A message whose point at line 3 has this.
std::string point(const std::string& inside) {
  return "joint_names: [vj/x, vj/y, vj/theta, turn, wheel, slide]\npoints:\n- {" + inside + "}\n";
}

const std::string kRest = "positions: [0, 0, 0, 0, 0, 0]";

std::string timed(const std::string& duration) {
  return point(kRest + ", time_from_start: " + duration);
}

INSTANTIATE_TEST_SUITE_P(
    Yaml, BrokenMessages,
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
    Bases, BrokenMessages,
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

}  // namespace
}  // namespace swept
