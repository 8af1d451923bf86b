// SPDX-License-Identifier: BSD-3-Clause
// Limits of rates, from URDFs and from files of MoveIt.
#include "swept/robot_model/rate_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "format_keys.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

using testing::ElementsAre;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// A planar base with an arm: `turn` at up to 2 rad/s, `wheel` at 3, `slide` without a limit,
/// `finger`, which follows `turn`, `head` at 0.5 and the fixed `bolt`. A second robot flies.
std::shared_ptr<const Robot> limitedRobot(const std::string& base = "planar") {
  const auto one = [](const std::string& name, const std::string& type, const std::string& more) {
    return "<link name='of_" + name + "'/>" +
           test::joint(name, type, "base", "of_" + name, "<axis xyz='0 0 1'/>" + more);
  };
  const std::string range = "<limit lower='-1' upper='1' effort='1' velocity=";
  return Robot::parse(
      "<robot name='r'><link name='base'/>" + one("turn", "revolute", range + "'2'/>") +
          one("wheel", "continuous", "<limit effort='1' velocity='-3'/>") +
          one("slide", "prismatic", range + "'0'/>") +
          one("finger", "revolute", range + "'0.25'/><mimic joint='turn'/>") +
          one("head", "revolute", range + "'0.5'/>") + one("bolt", "fixed", "") + "</robot>",
      "r.urdf",
      "<robot name='r'><virtual_joint name='vj' type='" + base +
          "' parent_frame='odom' child_link='base'/>"
          "<group name='arm'><joint name='turn'/><joint name='wheel'/>"
          "<joint name='slide'/></group><group name='whole'><joint name='vj'/>"
          "<joint name='turn'/></group></robot>",
      "r.srdf");
}

/// What RateLimits::read makes of a text.
struct Reading {
  explicit Reading(const std::string& text, const std::string& group = "arm",
                   const std::string& base = "planar") {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.write("l.yaml", text);
    const auto robot = limitedRobot(base);
    test::Warnings heard;
    const std::size_t prefix = folder.path().string().size() + 1;
    message = test::inputError([&] {
      limits = RateLimits::read(file, *robot, *robot->findGroup(group), heard.options());
    });
    if (!message.empty()) message.erase(0, prefix);
    for (const std::string& line : heard.lines) warnings.push_back(line.substr(prefix));
  }
  RateLimits limits;
  std::string message;
  std::vector<std::string> warnings;
};

TEST(RateLimits, OfAUrdfAreItsVelocities) {
  const auto robot = limitedRobot();
  const RateLimits limits = RateLimits::of(*robot, *robot->findGroup("arm"));
  EXPECT_THAT(limits.velocity, ElementsAre(2.0, 3.0, kNone));
  EXPECT_THAT(limits.acceleration, ElementsAre(kNone, kNone, kNone));
  EXPECT_THAT(limits.jerk, ElementsAre(kNone, kNone, kNone));
  EXPECT_THAT(RateLimits::of(*robot, *robot->findGroup("whole")).velocity,
              ElementsAre(kNone, kNone, kNone, 2.0));
}

TEST(RateLimits, OfAFileReplaceThoseOfTheUrdf) {
  const Reading reading(
      "# as the setup assistant writes it\n"
      "default_velocity_scaling_factor: 0.5\n"
      "default_acceleration_scaling_factor: 0.25\n"
      "joint_limits:\n"
      "  turn:\n"
      "    has_velocity_limits: true\n"
      "    max_velocity: 1.5\n"
      "    has_acceleration_limits: true\n"
      "    max_acceleration: 8\n"
      "    has_jerk_limits: true\n"
      "    max_jerk: 100\n"
      "  slide:\n"
      "    has_velocity_limits: false\n"
      "    max_velocity: 0\n"
      "    has_acceleration_limits: true\n"
      "    max_acceleration: 8\n"
      "    has_deceleration_limits: true\n"
      "    max_deceleration: -4\n"
      "  head:\n"
      "    has_velocity_limits: true\n"
      "    max_velocity: 7\n"
      "  finger: {has_acceleration_limits: true, max_acceleration: 1}\n"
      "  bolt: {}\n");
  EXPECT_EQ(reading.message, "");
  EXPECT_THAT(reading.limits.velocity, ElementsAre(0.75, 1.5, kNone));
  EXPECT_THAT(reading.limits.acceleration, ElementsAre(2.0, kNone, 1.0));
  EXPECT_THAT(reading.limits.jerk, ElementsAre(100.0, kNone, kNone));
  EXPECT_THAT(reading.warnings, ElementsAre());

  const Reading base(
      "joint_limits:\n  vj/y: {has_velocity_limits: true, max_velocity: 4}\n"
      "  vj/theta: {has_acceleration_limits: true, max_acceleration: 5}\n"
      "  turn: {has_velocity_limits: false}\n",
      "whole");
  EXPECT_THAT(base.limits.velocity, ElementsAre(kNone, 4.0, kNone, kNone));
  EXPECT_THAT(base.limits.acceleration, ElementsAre(kNone, kNone, 5.0, kNone));
}

TEST(RateLimits, RemarkOnPositionsThatAreNotUsed) {
  EXPECT_THAT(
      Reading("joint_limits:\n"
              "  turn:\n"
              "    has_position_limits: true\n"
              "    min_position: -1.0000001\n"
              "    max_position: 0.5\n"
              "  head: {min_position: -2}\n"
              "  wheel: {max_position: 3}\n"
              "  slide: {has_position_limits: false, min_position: 0}\n")
          .warnings,
      ElementsAre("l.yaml:5: warning: joint_limits.turn.max_position is not used: the limit of "
                  "the URDF counts, 1",
                  "l.yaml:6: warning: joint_limits.head.min_position is not used: the limit of "
                  "the URDF counts, -1",
                  "l.yaml:7: warning: joint_limits.wheel.max_position is not used: the joint has "
                  "no limits"));
}

TEST(RateLimits, NameWhatAFileHasWrong) {
  const auto of = [](const std::string& text) { return Reading(text).message; };
  const auto turn = [&](const std::string& keys) {
    return of("joint_limits:\n  turn:\n    " + keys + "\n");
  };
  EXPECT_EQ(of(""), "l.yaml:1: error: limits of joints must be a mapping with 'joint_limits'");
  EXPECT_EQ(of("default_velocity_scaling_factor: 1\n"), "l.yaml:1: error: joint_limits is missing");
  EXPECT_EQ(of("joint_limits: 3\n"), "l.yaml:1: error: joint_limits must be a mapping");
  EXPECT_EQ(of("joint_limits: {}\nscale: 1\n"),
            "l.yaml:2: error: the file has the unknown key 'scale'; allowed are joint_limits, "
            "default_velocity_scaling_factor and default_acceleration_scaling_factor");
  EXPECT_EQ(of("joint_limits:\n  turn: {}\n  tunr: {}\n"),
            "l.yaml:3: error: joint_limits has 'tunr', which is no joint of robot 'r'; did you "
            "mean 'turn'?");
  EXPECT_EQ(of("joint_limits:\n  turn: {}\n  turn: {}\n"),
            "l.yaml:3: error: joint_limits has the key 'turn' twice");
  EXPECT_EQ(of("joint_limits:\n  [a]: {}\n"),
            "l.yaml:2: error: joint_limits has a key that is not a single value");
  EXPECT_EQ(of("joint_limits:\n  vj: {}\n"),
            "l.yaml:2: error: joint_limits has 'vj', a joint of several values, which are called "
            "vj/x and so on");
  EXPECT_EQ(Reading("joint_limits:\n  vj/rot_x: {}\n", "whole", "floating").message,
            "l.yaml:2: error: joint_limits has 'vj/rot_x', a component of an orientation, which "
            "has no limits");
  EXPECT_EQ(of("joint_limits:\n  turn: fast\n"),
            "l.yaml:2: error: joint_limits.turn must be a mapping");
  EXPECT_EQ(turn("max_speed: 1"),
            "l.yaml:3: error: joint_limits.turn has the unknown key 'max_speed'; allowed are "
            "has_position_limits, min_position, max_position, has_velocity_limits, max_velocity, "
            "has_acceleration_limits, max_acceleration, has_deceleration_limits, "
            "max_deceleration, has_jerk_limits, max_jerk, has_effort_limits, max_effort and "
            "angle_wraparound");
  EXPECT_EQ(turn("max_velocity: 1"),
            "l.yaml:3: error: joint_limits.turn.max_velocity has no effect without "
            "has_velocity_limits");
  EXPECT_EQ(turn("has_jerk_limits: true"),
            "l.yaml:3: error: joint_limits.turn.max_jerk is missing");
  EXPECT_EQ(turn("has_velocity_limits: yes"),
            "l.yaml:3: error: joint_limits.turn.has_velocity_limits is 'yes'; allowed are true "
            "and false");
  EXPECT_EQ(turn("has_velocity_limits: true\n    max_velocity: 0"),
            "l.yaml:4: error: joint_limits.turn.max_velocity is '0'; it must be positive");
  EXPECT_EQ(turn("has_velocity_limits: true\n    max_velocity: .inf"),
            "l.yaml:4: error: joint_limits.turn.max_velocity is '.inf'; it must be a finite "
            "number");
  EXPECT_EQ(turn("has_deceleration_limits: true\n    max_deceleration: 4"),
            "l.yaml:4: error: joint_limits.turn.max_deceleration is '4'; it must be negative");
  EXPECT_EQ(of("joint_limits: {}\ndefault_velocity_scaling_factor: 1.5\n"),
            "l.yaml:2: error: default_velocity_scaling_factor is '1.5'; it must be above 0 and at "
            "most 1");
  EXPECT_EQ(of("joint_limits: {}\ndefault_acceleration_scaling_factor: 0\n"),
            "l.yaml:2: error: default_acceleration_scaling_factor is '0'; it must be above 0 and "
            "at most 1");
  EXPECT_EQ(of("joint_limits: {turn: {has_velocity_limits: true, max_velocity: 1\n"),
            "l.yaml:2: error: malformed YAML: end of map flow not found");
}

TEST(RateLimits, KeysAreWhatTheTableSays) {
  const std::string format = "Joint limits (.yaml)";
  const auto with = [](const std::string& keys) { return "joint_limits: {turn: {" + keys + "}}"; };
  const std::string none = with("");
  std::vector<test::KeyCase> cases{
      {"joint_limits", "joint_limits: {}", with("has_velocity_limits: false")},
      {"has_velocity_limits", none, with("has_velocity_limits: false")},
      {"max_velocity", with("has_velocity_limits: true, max_velocity: 1"),
       with("has_velocity_limits: true, max_velocity: 3")},
      {"has_position_limits", none, with("has_position_limits: true")},
      {"min_position", none, with("has_position_limits: true, min_position: 0.5")},
      {"max_position", none, with("has_position_limits: true, max_position: 0.5")},
      {"has_effort_limits", none, with("has_effort_limits: true")},
      {"max_effort", none, with("max_effort: 1")},
      {"angle_wraparound", none, with("angle_wraparound: true")},
      {"default_velocity_scaling_factor", none, none + "\ndefault_velocity_scaling_factor: 0.1"},
      {"default_acceleration_scaling_factor",
       with("has_acceleration_limits: true, max_acceleration: 1"),
       with("has_acceleration_limits: true, max_acceleration: 1") +
           "\ndefault_acceleration_scaling_factor: 0.1"}};
  for (const std::string rate : {"acceleration", "deceleration", "jerk"}) {
    const auto limit = [&](const std::string& value) {
      return with("has_" + rate + "_limits: true, max_" + rate + ": " +
                  (rate == "deceleration" ? "-" : "") + value);
    };
    cases.push_back({"has_" + rate + "_limits", none, limit("1")});
    cases.push_back({"max_" + rate, limit("1"), limit("3")});
  }
  test::walkFormat(format, cases, [](const std::string& text) {
    const test::TemporaryFolder folder;
    const auto robot = limitedRobot();
    const RateLimits limits =
        RateLimits::read(folder.write("l.yaml", text), *robot, *robot->findGroup("arm"));
    std::ostringstream described;
    for (const auto& values : {limits.velocity, limits.acceleration, limits.jerk})
      for (const double value : values) described << value << ' ';
    return described.str();
  });
  test::expectKeysOf(format, {"rate_limits.cpp"});
}

}  // namespace
}  // namespace swept
