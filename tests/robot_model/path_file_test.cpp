// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "path_robot.hpp"

namespace swept {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using States = std::vector<std::vector<double>>;

/// What readPath() makes of a text, for a group of test::pathRobot().
class Reading {
 public:
  explicit Reading(const std::string& name, const std::string& text,
                   const std::string& group = "arm",
                   const std::optional<Eigen::VectorXd>& reference = {}) {
    const std::filesystem::path file = folder_.write(name, text);
    const auto robot = test::pathRobot();
    LoadOptions options;
    options.warn = [&](const std::string& line) { warnings.push_back(shortened(line)); };
    options.warnOfUnchecked = [&](const std::string& line) {
      unchecked.push_back(shortened(line));
    };
    try {
      states = readPath(file, *robot, *robot->findGroup(group), reference, options);
    } catch (const InputError& error) {
      message = shortened(error.what());
    }
  }
  States states;
  std::string message;
  std::vector<std::string> warnings, unchecked;

 private:
  /// Without the folder.
  std::string shortened(const std::string& line) const {
    return line.substr(
        line.starts_with(folder_.path().string()) ? folder_.path().string().size() + 1 : 0);
  }
  test::TemporaryFolder folder_;
};

const States kTwo{{0.5, -0.25, 0.125}, {1.0, 3.0, 0.75}};

TEST(PathFile, CsvHasColumnsInAnyOrder) {
  EXPECT_EQ(Reading("p.csv", "slide,turn,wheel\n0.125,0.5,-0.25\n0.75,1,3\n").states, kTwo);
  EXPECT_EQ(
      Reading("p.csv", "\xef\xbb\xbf \"turn\" , wheel,slide\r\n\r\n.5, -25e-2 ,0.125\r\n1,+3,0.75")
          .states,
      kTwo);
}

TEST(PathFile, EveryFormatSaysTheSame) {
  const std::string trajectory =
      "joint_names: [slide, turn, wheel]\npoints:\n- positions: [0.125, 0.5, -0.25]\n"
      "  time_from_start: {sec: 0, nanosec: 0}\n- positions: [0.75, 1.0, 3.0]\n"
      "  time_from_start: {sec: 1, nanosec: 0}\n";
  const auto indented = [](const std::string& text, const std::string& by) {
    std::string result = by;
    for (const char c : text) result += c == '\n' ? "\n" + by : std::string(1, c);
    return result + "\n";
  };
  EXPECT_EQ(Reading("p.yaml", trajectory + "---\n").states, kTwo);
  const std::string robot = "joint_trajectory:\n" + indented(trajectory, "  ") +
                            "multi_dof_joint_trajectory: {joint_names: [], points: []}\n";
  EXPECT_EQ(Reading("p.yml", robot).states, kTwo);
  const std::string display =
      "model_id: kinds\ntrajectory:\n- joint_trajectory:\n" + indented(trajectory, "    ") +
      "trajectory_start: {joint_state: {name: [head, turn, finger], position: [0, 0.5, 0.25]}}\n";
  const Reading shown("p.yaml", display);
  EXPECT_EQ(shown.message, "");
  EXPECT_EQ(shown.states, kTwo);
  EXPECT_EQ(Reading("p.json",
                    R"({"joint_names": ["slide", "turn", "wheel"],
                        "states": [[0.125, 0.5, -0.25], [0.75, 1, 3]]})")
                .states,
            kTwo);
}

TEST(PathFile, SeveralTrajectoriesAreOnePathThatGoesOn) {
  const auto display = [](const std::string& begin) {
    const std::string names = "{joint_trajectory: {joint_names: [turn, wheel, slide], points: ";
    return "trajectory:\n- " + names + "[{positions: [0, 0, 0]}, {positions: [1, 0, 0]}]}}\n- " +
           names + "[{positions: [" + begin + ", 0, 0]}, {positions: [1, 1, 0]}]}}\n";
  };
  EXPECT_EQ(Reading("p.yaml", display("1")).states,
            (States{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(Reading("p.yaml", display("1.1")).message,
            "p.yaml:3: error: trajectory[1] begins elsewhere than the one before it ends; a path "
            "goes on where it is");
}

TEST(PathFile, BasesMoveByTheirTransforms) {
  const std::string base =
      "multi_dof_joint_trajectory:\n  header: {frame_id: odom}\n  joint_names: [vj]\n  points:\n"
      "  - transforms: [{translation: {x: 1, y: 2, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}}]\n"
      "  - transforms: [{translation: {x: 1, y: 3, z: 0}, rotation: {x: 0, y: 0, z: 1, w: 0}}]\n";
  const std::string arm =
      "joint_trajectory: {joint_names: [turn, wheel, slide], points: [{positions: [0.5, -0.25, "
      "0.125]}, {positions: [1, 3, 0.75]}]}\n";
  const Reading both("p.yaml", arm + base, "whole");
  EXPECT_EQ(both.message, "");
  EXPECT_EQ(both.states,
            (States{{1, 2, 0, 0.5, -0.25, 0.125}, {1, 3, std::numbers::pi, 1, 3, 0.75}}));
  // The base is not the arm's to move.
  EXPECT_EQ(Reading("p.yaml", arm + base).message,
            "p.yaml:1: error: joint_trajectory.points[0]: vj/x is 1, but group 'arm' does not move "
            "it: it has to stay at 0");
  EXPECT_EQ(
      Reading("p.yaml", base, "whole").message,
      "p.yaml:1: error: there are no values of turn, wheel, slide, which group 'whole' moves");
}

TEST(PathFile, WhatIsOutsideOfTheGroupStaysWhereTheReferenceHasIt) {
  const std::string path =
      "turn,wheel,slide,head,finger,bolt\n0.5,0,0,0.25,0.25,0\n1,0,0,0.25,0.5,0\n";
  const auto robot = test::pathRobot();
  Eigen::VectorXd reference = robot->defaultState();
  reference[*robot->findVariable("head")] = 0.25;
  EXPECT_EQ(Reading("p.csv", path, "arm", reference).states, (States{{0.5, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(Reading("p.csv", path).message,
            "p.csv:2: error: head is 0.25, but group 'arm' does not move it: it has to stay at 0");
}

TEST(PathFile, ValuesAreJudgedAsThoseOfTheCommandLine) {
  const Reading path("p.csv", "turn,wheel,slide\n2.000001,7,0\n2.000002,7,-0.000003\n");
  EXPECT_THAT(path.states, testing::SizeIs(2));
  EXPECT_EQ(path.states[0],
            (std::vector<double>{2.0, std::remainder(7.0, 2.0 * std::numbers::pi), 0.0}));
  EXPECT_EQ(path.states[1][2], 0.0);
  EXPECT_THAT(path.warnings,
              ElementsAre("p.csv:3: warning: slide is -3e-06 m, 3e-06 beyond its limit 0: taken to "
                          "the limit",
                          "p.csv:2: warning: turn is 2.000001 rad, 1e-06 beyond its limit 2: taken "
                          "to the limit; likewise at 1 further point"));
}

TEST(PathFile, SaysWhatIsNotProven) {
  const Reading far("p.csv", "turn,wheel,slide\n0,0,0\n0,4,0\n0,0,0\n");
  EXPECT_THAT(far.unchecked,
              ElementsAre("p.csv:3: warning: wheel turns by 4 rad, more than half a turn, from the "
                          "point before: what is looked at is the shorter way; likewise at 1 "
                          "further point"));
  const Reading curve("p.yaml",
                      "joint_names: [turn, wheel, slide]\npoints:\n- positions: [0, 0, 0]\n"
                      "  velocities: [0, 0, 0]\n- positions: [1, 0, 0]\n  velocities: [0, 0, 0]\n");
  EXPECT_THAT(curve.unchecked,
              ElementsAre("p.yaml:4: warning: points have velocities or accelerations: what is "
                          "looked at is the straight motion between the points, not the curve of a "
                          "controller"));
}

TEST(PathFile, OneStateIsAPath) {
  EXPECT_EQ(Reading("p.csv", "turn,wheel,slide\n0,0,0").states, (States{{0, 0, 0}}));
}

TEST(PathFile, RefusesAReferenceOfAnotherRobot) {
  const auto robot = test::pathRobot();
  EXPECT_THROW(readPath("p.csv", *robot, robot->groups().front(), Eigen::VectorXd::Zero(1)),
               std::invalid_argument);
}

struct Broken {
  const char* name;
  std::string text;
  std::string message;
};

class BrokenPath : public testing::TestWithParam<Broken> {};

TEST_P(BrokenPath, IsNamedWithItsPlace) {
  EXPECT_EQ(Reading(GetParam().name, GetParam().text).message, GetParam().message);
}

const std::string kNames = "turn,wheel,slide\n";
const std::string kHas = "; group 'arm' has turn, wheel, slide";

INSTANTIATE_TEST_SUITE_P(
    Csv, BrokenPath,
    testing::Values(
        Broken{"p.csv", "",
               "p.csv: error: it is empty; its first line must have the names of the joints"},
        Broken{"p.csv", kNames, "p.csv: error: it has no line of values below that of the names"},
        Broken{"p.csv", "0,0,0\n1,1,1\n",
               "p.csv:1: error: the first line has values; it must have the names of the joints"},
        Broken{"p.csv", "turn,slide\n0,0\n",
               "p.csv:1: error: there are no values of wheel, which group 'arm' moves"},
        Broken{"p.csv", "time,turn,wheel,slide\n0,0,0,0\n",
               "p.csv:1: error: column 1 is 'time', which is no joint of robot 'kinds'" + kHas},
        Broken{"p.csv", "turn,wheel,slide,turn\n0,0,0,0\n",
               "p.csv:1: error: column 4 is 'turn' a second time"},
        Broken{"p.csv", "turn,wheel,slide,\n0,0,0,0\n",
               "p.csv:1: error: column 4 is '', which is no joint of robot 'kinds'" + kHas},
        Broken{"p.csv", "vj,turn,wheel,slide\n0,0,0,0\n",
               "p.csv:1: error: column 1 is 'vj', a joint of several values, which are called vj/x "
               "and so on"},
        Broken{"p.csv", "\"turn,wheel\n0,0\n", "p.csv:1: error: a quote is not closed"},
        Broken{"p.csv", "\"turn\"s,wheel\n0,0\n", "p.csv:1: error: text follows the quoted 'turn'"},
        Broken{"p.csv", kNames + "0,0,0\n0,0\n",
               "p.csv:3: error: there are 2 values; the first line names 3"},
        Broken{"p.csv", kNames + "0,0,0,0\n",
               "p.csv:2: error: there are 4 values; the first line names 3"},
        Broken{"p.csv", kNames + "0,zero,0\n",
               "p.csv:2: error: column 2, wheel, is 'zero'; it must be a finite number"},
        Broken{"p.csv", kNames + "0,0,\n",
               "p.csv:2: error: column 3, slide, is ''; it must be a finite number"},
        Broken{"p.csv", kNames + "nan,0,0\n",
               "p.csv:2: error: column 1, turn, is 'nan'; it must be a finite number"},
        Broken{"p.csv", kNames + "0,inf,0\n",
               "p.csv:2: error: column 2, wheel, is 'inf'; it must be a finite number"},
        Broken{"p.csv", kNames + "0,1e999,0\n",
               "p.csv:2: error: column 2, wheel, is '1e999'; it must be a finite number"},
        Broken{"p.csv", kNames + "\n# no remark\n",
               "p.csv:3: error: column 1, turn, is '# no remark'; it must be a finite number"},
        Broken{"p.csv", kNames + "2.1,0,0\n",
               "p.csv:2: error: turn is 2.1, allowed is -2 to 2 rad"},
        Broken{"p.csv", kNames + "0,0,1.0001\n",
               "p.csv:2: error: slide is 1.0001, allowed is 0 to 1 m (0.0001 beyond)"},
        Broken{"p.csv", "turn,wheel,slide,finger\n1,0,0,0.25\n",
               "p.csv:2: error: finger is 0.25, but the joint follows 'turn' to 0.5"},
        Broken{"p.csv", "turn,wheel,slide,bolt\n1,0,0,0.25\n",
               "p.csv:2: error: bolt is 0.25, but the joint does not move"},
        Broken{"p.txt", kNames, "p.txt: error: a path file ends in .csv, .yaml, .yml or .json"}));

INSTANTIATE_TEST_SUITE_P(
    Json, BrokenPath,
    testing::Values(
        Broken{"p.json", "[]", "p.json: error: a path must be an object"},
        Broken{"p.json", "{}", "p.json: error: joint_names is missing"},
        Broken{"p.json", R"({"joint_names": ["turn", "wheel", "slide"]})",
               "p.json: error: states is missing"},
        Broken{"p.json", R"({"joint_names": ["turn", "wheel", "slide"], "states": []})",
               "p.json: error: states has no state; one is needed"},
        Broken{"p.json", R"({"joint_names": ["turn", "wheel", "slide"], "states": [[0, 0]]})",
               "p.json: error: states[0] holds 2 values; it must hold 3"},
        Broken{"p.json", R"({"joint_names": ["turn", "wheel", "slide"], "states": [[0, null, 0]]})",
               "p.json: error: states[0][1] is null; it must be a finite number"},
        Broken{"p.json", R"({"joint_names": ["turn", "wheel", "slide"], "states": [[0, 0, 2]]})",
               "p.json: error: states[0]: slide is 2, allowed is 0 to 1 m"},
        Broken{"p.json", R"({"joint_names": ["turn", "arm"], "states": [[0, 0]]})",
               "p.json: error: joint_names[1] is 'arm', which is no joint of robot 'kinds'" + kHas},
        Broken{"p.json", R"({"joint_names": ["turn"], "states": [[0]]})",
               "p.json: error: there are no values of wheel, slide, which group 'arm' moves"},
        Broken{"p.json", R"({"points": []})",
               "p.json: error: the path has the unknown key 'points'; allowed are robot, group, "
               "planner, tool, deviation, deviation_angle, seed, margin, margin_self, "
               "margin_world, tolerance, clouds, clock, joint_names, constraints, "
               "lines, states, trajectory, segments, nothing_checked, links_without_geometry, "
               "warnings, inputs, model and proof"}));

INSTANTIATE_TEST_SUITE_P(
    Yaml, BrokenPath,
    testing::Values(
        Broken{"p.yaml", "", "p.yaml:1: error: a trajectory must be a mapping"},
        Broken{"p.yaml", "positions: [0]\n",
               "p.yaml:1: error: the file has the unknown key 'positions'; allowed are "
               "joint_trajectory and multi_dof_joint_trajectory"},
        Broken{"p.yaml", "joint_names: [turn, wheel, slide]\npoints: []\n",
               "p.yaml:1: error: there is no point; one is needed"},
        Broken{"p.yaml", "joint_names: [turn, wheel, slide]\npoints:\n- positions: [0, 0]\n",
               "p.yaml:3: error: points[0] has 2 positions and 3 joint_names"},
        Broken{"p.yaml", "joint_names: [turn, wheel, slide]\npoints:\n- positions: [0, .nan, 0]\n",
               "p.yaml:3: error: points[0].positions[1] is '.nan'; it must be a finite number"},
        Broken{"p.yaml", "joint_names: [turn, wheel, slide]\npoints:\n- positions: [0, 0, 3]\n",
               "p.yaml:3: error: points[0]: slide is 3, allowed is 0 to 1 m"},
        Broken{"p.yaml", "joint_names: [turn, wheel, head2]\npoints:\n- positions: [0, 0, 3]\n",
               "p.yaml:1: error: joint_names[2] is 'head2', which is no joint of robot 'kinds'" +
                   kHas},
        Broken{"p.yaml", "joint_names: [turn, wheel]\npoints:\n- positions: [0, 0]\n",
               "p.yaml:1: error: there are no values of slide, which group 'arm' moves"},
        Broken{"p.yaml",
               "joint_names: [turn, wheel, slide]\npoints:\n- {positions: [0, 0, 0], jerks: []}\n",
               "p.yaml:3: error: points[0] has the unknown key 'jerks'; allowed are positions, "
               "velocities, accelerations, effort and time_from_start"},
        Broken{"p.yaml",
               "joint_names: [turn, wheel, slide]\npoints:\n- positions: [0, 0, 0]\n---\n"
               "joint_names: []\n",
               "p.yaml:5: error: a second document begins; one is allowed"},
        Broken{"p.yaml",
               "trajectory:\n- joint_trajectory: {joint_names: [turn, wheel, slide], points: "
               "[{positions: [0, 0, 0]}]}\ntrajectory_start:\n  joint_state: {name: [turn], "
               "position: [0.5]}\n",
               "p.yaml:4: error: trajectory_start: turn is 0.5, and the first point has it at 0"},
        Broken{"p.yaml",
               "trajectory:\n- joint_trajectory: {joint_names: [turn, wheel, slide], points: "
               "[{positions: [0, 0, 0]}]}\ntrajectory_start:\n  joint_state: {name: [head], "
               "position: [0.5]}\n",
               "p.yaml:4: error: trajectory_start: head is 0.5, but group 'arm' does not move it: "
               "it has to stay at 0"},
        Broken{"p.yaml",
               "trajectory:\n- joint_trajectory: {joint_names: [turn, wheel, slide], points: "
               "[{positions: [0, 0, 0]}]}\ntrajectory_start:\n  attached_collision_objects: "
               "[{link_name: t}]\n",
               "p.yaml:4: error: trajectory_start.attached_collision_objects[0] is not taken from "
               "a path; attached objects are those of the scene"},
        Broken{"p.yaml",
               "joint_trajectory: {joint_names: [turn, wheel, slide], points: [{positions: [0, 0, "
               "0]}]}\nmulti_dof_joint_trajectory: {joint_names: [float], points: [{transforms: "
               "[{translation: [1, 0, 0]}]}]}\n",
               "p.yaml:2: error: multi_dof_joint_trajectory.points[0]: multi_dof_joint_state of "
               "'float': robot 'kinds' has no such joint"}));

}  // namespace
}  // namespace swept
