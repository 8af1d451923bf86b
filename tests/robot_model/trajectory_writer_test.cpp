// SPDX-License-Identifier: BSD-3-Clause
// What is in files of trajectories, and which trajectories have none.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "message_of.hpp"
#include "model_robots.hpp"
#include "path_robot.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

TrajectoryPoint pointAt(double time, std::vector<double> positions,
                        std::vector<double> velocities = {},
                        std::vector<double> accelerations = {}) {
  return {.time = time,
          .positions = std::move(positions),
          .velocities = std::move(velocities),
          .accelerations = std::move(accelerations)};
}

JointTrajectory twoPoints() {
  JointTrajectory trajectory{.variables = {"turn", "wheel"}, .points = {}};
  trajectory.points.push_back(pointAt(0.0, {1.0, -1e-7}, {0.0, 0.1}, {2.0, 1e20}));
  trajectory.points.push_back(pointAt(1.25, {0.5, 1e-7}));
  return trajectory;
}

/// The trajectory of the base and one joint.
JointTrajectory mobile() {
  JointTrajectory trajectory{.variables = {"vj/x", "vj/y", "vj/theta", "turn"}, .points = {}};
  trajectory.points.push_back(pointAt(0.5, {1.0, 2.0, 0.0, 0.25}, {1.0, 2.0, 3.0, 4.0}));
  return trajectory;
}

class TrajectoryWriter : public testing::Test {
 protected:
  std::string written(const std::string& name, const JointTrajectory& trajectory) const {
    writeTrajectory(folder_.path() / name, trajectory);
    return readTextFile(folder_.path() / name);
  }
  std::string writtenAs(TrajectoryMessage message, const JointTrajectory& trajectory) const {
    writeTrajectory(folder_.path() / "t.yaml", trajectory, *test::pathRobot(), message);
    return readTextFile(folder_.path() / "t.yaml");
  }
  /// The UsageError, without the folder.
  std::string refusal(const std::string& name, const JointTrajectory& trajectory,
                      const std::shared_ptr<const Robot>& robot = nullptr,
                      TrajectoryMessage message = TrajectoryMessage::Robot) const {
    try {
      if (robot)
        writeTrajectory(folder_.path() / name, trajectory, *robot, message);
      else
        writeTrajectory(folder_.path() / name, trajectory);
    } catch (const UsageError& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_.path() / name));
      std::string text = error.what();
      const std::string folder = folder_.path().string() + "/";
      if (const auto at = text.find(folder); at != std::string::npos) text.erase(at, folder.size());
      return text;
    }
    return "nothing was thrown";
  }
  test::TemporaryFolder folder_;
};

TEST_F(TrajectoryWriter, WritesCsv) {
  EXPECT_EQ(written("t.csv", twoPoints()),
            "time,turn,wheel,turn_velocity,wheel_velocity,turn_acceleration,wheel_acceleration\n"
            "0,1,-1e-07,0,0.1,2,1e+20\n"
            "1.25,0.5,1e-07,,,,\n");
  JointTrajectory positionsOnly{.variables = {" a,\"b\""}, .points = {}};
  positionsOnly.points.push_back(pointAt(0.1, {0.2}));
  EXPECT_EQ(written("t.csv", positionsOnly), "time,\" a,\"\"b\"\"\"\n0.1,0.2\n");
  positionsOnly.variables = {"a\t"};
  EXPECT_EQ(written("t.csv", positionsOnly), "time,\"a\t\"\n0.1,0.2\n");
}

TEST_F(TrajectoryWriter, WritesJson) {
  EXPECT_EQ(written("t.json", twoPoints()),
            "{\"trajectory\": {\n"
            " \"variables\": [\"turn\",\"wheel\"],\n"
            " \"points\": [\n"
            "  {\"time\":0.0,\"positions\":[1.0,-1e-07],\"velocities\":[0.0,0.1],"
            "\"accelerations\":[2.0,1e+20]},\n"
            "  {\"time\":1.25,\"positions\":[0.5,1e-07]}\n"
            " ]}}\n");
}

/// Numbers have a point, without which PyYAML reads some as text.
TEST_F(TrajectoryWriter, WritesAJointTrajectory) {
  const std::string text =
      "header:\n"
      "  stamp:\n"
      "    sec: 0\n"
      "    nanosec: 0\n"
      "  frame_id: \"\"\n"
      "joint_names: [\"turn\", \"wheel\"]\n"
      "points:\n"
      "- positions: [1.0, -1.0e-07]\n"
      "  velocities: [0.0, 0.1]\n"
      "  accelerations: [2.0, 1.0e+20]\n"
      "  effort: []\n"
      "  time_from_start:\n"
      "    sec: 0\n"
      "    nanosec: 0\n"
      "- positions: [0.5, 1.0e-07]\n"
      "  velocities: []\n"
      "  accelerations: []\n"
      "  effort: []\n"
      "  time_from_start:\n"
      "    sec: 1\n"
      "    nanosec: 250000000\n"
      "---\n";
  EXPECT_EQ(written("t.yaml", twoPoints()), text);
  EXPECT_EQ(written("t.yml", twoPoints()), text);
  EXPECT_EQ(writtenAs(TrajectoryMessage::Joint, twoPoints()), text);
}

const std::string kRobotTrajectory =
    "  joint_trajectory:\n"
    "    header:\n"
    "      stamp:\n"
    "        sec: 0\n"
    "        nanosec: 0\n"
    "      frame_id: \"\"\n"
    "    joint_names: [\"turn\"]\n"
    "    points:\n"
    "    - positions: [0.25]\n"
    "      velocities: [4.0]\n"
    "      accelerations: []\n"
    "      effort: []\n"
    "      time_from_start:\n"
    "        sec: 0\n"
    "        nanosec: 500000000\n"
    "  multi_dof_joint_trajectory:\n"
    "    header:\n"
    "      stamp:\n"
    "        sec: 0\n"
    "        nanosec: 0\n"
    "      frame_id: \"odom\"\n"
    "    joint_names: [\"vj\"]\n"
    "    points:\n"
    "    - transforms:\n"
    "      - translation: {x: 1.0, y: 2.0, z: 0.0}\n"
    "        rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n"
    "      velocities:\n"
    "      - linear: {x: 1.0, y: 2.0, z: 0.0}\n"
    "        angular: {x: 0.0, y: 0.0, z: 3.0}\n"
    "      accelerations: []\n"
    "      time_from_start:\n"
    "        sec: 0\n"
    "        nanosec: 500000000\n";

TEST_F(TrajectoryWriter, WritesARobotTrajectory) {
  std::string text = writtenAs(TrajectoryMessage::Robot, mobile());
  EXPECT_TRUE(text.ends_with("---\n"));
  text.resize(text.size() - 4);
  std::string further = "  ";
  for (const char c : text) further += c == '\n' ? "\n  " : std::string(1, c);
  EXPECT_EQ(further, kRobotTrajectory + "  ");
}

TEST_F(TrajectoryWriter, WritesADisplayTrajectory) {
  std::string item = kRobotTrajectory;
  item.front() = '-';
  EXPECT_EQ(writtenAs(TrajectoryMessage::Display, mobile()),
            "model_id: \"kinds\"\ntrajectory:\n" + item +
                "trajectory_start:\n"
                "  joint_state:\n"
                "    name: [\"turn\"]\n"
                "    position: [0.25]\n"
                "  multi_dof_joint_state:\n"
                "    header:\n"
                "      stamp:\n"
                "        sec: 0\n"
                "        nanosec: 0\n"
                "      frame_id: \"odom\"\n"
                "    joint_names: [\"vj\"]\n"
                "    transforms:\n"
                "    - translation: {x: 1.0, y: 2.0, z: 0.0}\n"
                "      rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n"
                "  is_diff: true\n"
                "---\n");
}

TEST_F(TrajectoryWriter, PartsWithoutJointsAreEmpty) {
  const std::string text = writtenAs(TrajectoryMessage::Robot, twoPoints());
  EXPECT_NE(text.find("  frame_id: \"\"\n  joint_names: []\n  points: []\n---\n"),
            std::string::npos);
}

TEST_F(TrajectoryWriter, TimesAreRoundedToTheNanosecond) {
  JointTrajectory trajectory = twoPoints();
  trajectory.points[0].time = 0.99999999951;
  trajectory.points[1].time = 1.0000000010;
  const std::string text = written("t.yaml", trajectory);
  EXPECT_NE(text.find("    sec: 1\n    nanosec: 0\n"), std::string::npos);
  EXPECT_NE(text.find("    sec: 1\n    nanosec: 1\n"), std::string::npos);
  trajectory.points[1].time = 1.0000000004;
  EXPECT_EQ(refusal("close.yaml", trajectory),
            "'close.yaml': the points at 0.99999999951 and 1.0000000004 s are at the same "
            "nanosecond, which is the least that a message tells apart; use .json or .csv");
  for (const char* name : {"t.csv", "t.json"}) EXPECT_NO_THROW(written(name, trajectory));
}

TEST_F(TrajectoryWriter, RefusesWhatAFormatCannotHold) {
  JointTrajectory late = twoPoints();
  late.points[1].time = 2147483647.0;
  EXPECT_EQ(refusal("t.yaml", late),
            "'t.yaml': a point is at 2147483647 s, and a message holds less than 2147483647 s; use "
            ".json or .csv");
  EXPECT_EQ(refusal("t.txt", twoPoints()),
            "'t.txt': a trajectory file ends in .csv, .yaml, .yml or .json");
  JointTrajectory named = twoPoints();
  named.variables = {"turn", "time"};
  EXPECT_EQ(refusal("t.csv", named),
            "'t.csv': two columns would have the name 'time'; use .json or .yaml");
  named.variables = {"x", "x_velocity"};
  EXPECT_EQ(refusal("t.csv", named),
            "'t.csv': two columns would have the name 'x_velocity'; use .json or .yaml");
  named.variables = {"x", "x\ny"};
  EXPECT_EQ(refusal("t.csv", named),
            "'t.csv': a name has a line end, which a .csv file cannot have; use .json");
  named.variables = {"x", "\xff"};
  for (const char* name : {"t.json", "t.yaml"})
    EXPECT_EQ(refusal(name, named), "'" + std::string(name) +
                                        "': the name '\xff' is not UTF-8, which all text in the "
                                        "file has to be");
  EXPECT_EQ(refusal("missing/t.csv", twoPoints()),
            "cannot write 'missing/t.csv': No such file or directory");
}

TEST_F(TrajectoryWriter, RefusesWhatAMessageOfMoveItCannotHold) {
  const auto drifter = test::modelRobot("drifter");
  JointTrajectory floating;
  for (const Variable& variable : drifter->variables()) floating.variables.push_back(variable.name);
  floating.points.push_back(pointAt(0.0, {0, 0, 0, 0, 0, 0, 1}, std::vector<double>(7, 0.0)));
  const std::string message =
      "'t.yaml': 'flight' is a floating joint, of which a message has no velocities and "
      "accelerations; use .json or .csv";
  EXPECT_EQ(refusal("t.yaml", floating, drifter), message);
  EXPECT_EQ(refusal("t.yaml", floating, drifter, TrajectoryMessage::Display), message);
  EXPECT_NO_THROW(
      writeTrajectory(folder_.path() / "j.yaml", floating, *drifter, TrajectoryMessage::Joint));

  const auto tilted = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'/><joint name='p' type='planar'>"
      "<parent link='a'/><child link='b'/><axis xyz='0 1 0'/></joint></robot>",
      "r.urdf");
  JointTrajectory planar{.variables = {"p/x", "p/y", "p/theta"}, .points = {}};
  planar.points.push_back(pointAt(0.0, {0, 0, 0}));
  EXPECT_EQ(refusal("t.yaml", planar, tilted),
            "'t.yaml': the axis of planar joint 'p' is not z, and a message has no other; use "
            ".json or .csv");
}

TEST_F(TrajectoryWriter, RefusesWhatIsNoTrajectory) {
  const auto refused = [&](const JointTrajectory& trajectory) {
    return test::messageOf([&] { writeTrajectory(folder_.path() / "t.csv", trajectory); });
  };
  JointTrajectory trajectory = twoPoints();
  trajectory.points[1].velocities = {1.0};
  EXPECT_EQ(refused(trajectory), "writeTrajectory: point 1 has 1 velocities, expected 2");
  trajectory = twoPoints();
  trajectory.points[0].positions[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(trajectory), "writeTrajectory: point 0 has positions that are not finite");
  trajectory = twoPoints();
  trajectory.points[1].time = 0.0;
  EXPECT_EQ(refused(trajectory), "writeTrajectory: point 1 is at 0 s, allowed is more than 0");
  trajectory.points.clear();
  EXPECT_EQ(refused(trajectory), "writeTrajectory: the trajectory has no point");
  trajectory = twoPoints();
  trajectory.variables[1] = "turn";
  EXPECT_EQ(refused(trajectory), "writeTrajectory: 'turn' is there twice");
  JointTrajectory nothing;
  nothing.points.emplace_back();
  EXPECT_EQ(refused(nothing), "writeTrajectory: there is no variable");
}

TEST_F(TrajectoryWriter, RefusesVariablesThatAreNotTheRobots) {
  const auto refused = [&](const std::vector<std::string>& variables) {
    JointTrajectory trajectory{.variables = variables, .points = {}};
    trajectory.points.push_back(pointAt(0.0, std::vector<double>(variables.size(), 0.0)));
    return test::messageOf([&] { writtenAs(TrajectoryMessage::Robot, trajectory); });
  };
  EXPECT_EQ(refused({"turn", "elbow"}), "writeTrajectory: robot 'kinds' has no variable 'elbow'");
  const std::string together =
      "writeTrajectory: the variables of joint 'vj' must follow each other in the robot's order; ";
  EXPECT_EQ(refused({"vj/x", "vj/y"}), together + "'vj/theta' is not there");
  EXPECT_EQ(refused({"vj/x", "turn", "vj/y", "vj/theta"}), together + "'vj/y' is not there");
  EXPECT_EQ(refused({"vj/theta", "vj/x", "vj/y"}), together + "'vj/x' is not there");
}

TEST_F(TrajectoryWriter, WritesNoFileThatCannotBeReadAgain) {
  JointTrajectory trajectory{.variables = {}, .points = {}};
  for (int i = 0; i < 4000; ++i) trajectory.variables.push_back("joint" + std::to_string(i));
  for (int i = 0; i < 1000; ++i)
    trajectory.points.push_back(pointAt(i, std::vector<double>(4000, 1.0 / 3.0)));
  EXPECT_EQ(refusal("t.csv", trajectory),
            "'t.csv': the trajectory takes 76042785 bytes, and files of more than 67108864 are not "
            "read");
}

}  // namespace
}  // namespace swept
