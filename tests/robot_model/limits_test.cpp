// SPDX-License-Identifier: BSD-3-Clause
// What is up to 1e-5 beyond a limit stands for the limit, and is taken to it with a remark; farther
// beyond is outside.
#include "swept/robot_model/limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "input_files.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// rad or m, beyond a limit.
constexpr std::array kHairs{2e-9, 1e-6, 9e-6, 1e-5};

/// All kinds of variables, and a turn `wide` whose limits are those of pi in five digits.
std::shared_ptr<const Robot> allKinds() {
  using test::joint;
  return Robot::parse(
      "<robot name='k'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>"
      "<link name='e'/>" +
          joint("wide", "revolute", "a", "b", test::limited("0 0 1", -3.14159, 3.14159)) +
          joint("turn", "continuous", "b", "c", "<axis xyz='0 0 1'/>") +
          joint("slide", "prismatic", "c", "d", test::limited("0 0 1", 0.0, 0.38615)) +
          joint("free", "floating", "d", "e", "") + "</robot>",
      "k.urdf");
}

TEST(Limits, NumbersThatDifferAreToldApart) {
  EXPECT_THAT(distinctNumbers(std::array{2.6, -0.5, 2.5}), ElementsAre("2.6", "-0.5", "2.5"));
  EXPECT_THAT(distinctNumbers(std::array{0.1, 0.1}), ElementsAre("0.1", "0.1"));
  EXPECT_THAT(distinctNumbers(std::array{3.14159265, 3.14159}),
              ElementsAre("3.1415927", "3.14159"));
  EXPECT_THAT(distinctNumbers(std::array{1.0, std::nextafter(1.0, 2.0)}),
              ElementsAre("1", "1.0000000000000002"));
  EXPECT_THAT(distinctNumbers(std::array{1e6 + 1.1e-5, -1e6, 1e6}),
              ElementsAre("1000000.000011", "-1000000", "1000000"));
  std::mt19937 random(1);
  int alike = 0;
  for (int i = 0; i < 2000; ++i) {
    const double limit = std::uniform_real_distribution(-100.0, 100.0)(random);
    const double value = limit + std::ldexp(limit, -static_cast<int>(random() % 52));
    const auto texts = distinctNumbers(std::array{value, limit});
    alike += value == limit ? 1 : 0;
    EXPECT_EQ(texts[0] == texts[1], value == limit) << texts[0];
  }
  EXPECT_LT(alike, 20);
}

TEST(Limits, TextsSayHowFarBeyond) {
  EXPECT_EQ(outsideText("slide", 2.6, -0.5, 2.5, "m"), "slide is 2.6, allowed is -0.5 to 2.5 m");
  EXPECT_EQ(outsideText("turn", 3.141602, -3.14159, 3.14159, "rad"),
            "turn is 3.141602, allowed is -3.14159 to 3.14159 rad (1.2e-05 beyond)");
  EXPECT_EQ(outsideText("turn", -3.141592, -3.14159, 3.14159, ""),
            "turn is -3.141592, allowed is -3.14159 to 3.14159 (2e-06 beyond)");
  EXPECT_EQ(outsideText("base", kNan, 0.0, 1.0, "m"), "base is nan, allowed is 0 to 1 m");
  EXPECT_EQ(limitRemark({"torso", static_cast<double>(0.38615F), 0.38615, "m"}),
            "torso is 0.3861500025 m, 2.48e-09 beyond its limit 0.38615: taken to the limit");
  EXPECT_EQ(limitRemark({"turn", -3.1416, -3.14159, ""}, "left"),
            "turn is -3.1416, 1e-05 beyond its limit -3.14159: left");
}

TEST(Limits, TakeWhatIsAHairBeyondAndNothingElse) {
  const auto robot = allKinds();
  const Group& group = robot->groups().front();
  const std::vector<double> good{0.5, 3.0, 0.2, 7.0, -7.0, 1e9, 0.0, 0.0, 0.0, 1.0};
  const std::array<double, 2> lower{-3.14159, 0.0}, upper{3.14159, 0.38615};
  const std::array<std::size_t, 2> places{0, 2};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t i = places[k];
    const auto at = [&](double value) {
      std::vector<double> q = good;
      q[i] = value;
      return q;
    };
    for (const double hair : kHairs) {
      for (const bool above : {false, true}) {
        const double limit = above ? upper[k] : lower[k];
        std::vector<double> q = at(above ? limit + hair : limit - hair);
        const double given = q[i];
        const auto taken = takeToLimits(*robot, group, q);
        ASSERT_THAT(taken, SizeIs(1)) << hair;
        EXPECT_EQ(taken[0].variable, i == 0 ? "wide" : "slide");
        EXPECT_EQ(taken[0].value, given);
        EXPECT_EQ(taken[0].limit, limit);
        EXPECT_EQ(taken[0].unit, i == 0 ? "rad" : "m");
        EXPECT_EQ(q, at(limit));
        EXPECT_THAT(takeToLimits(*robot, group, q), IsEmpty()) << "once";
      }
    }
    for (const double value :
         {lower[k] - 1.1e-5, upper[k] + 1.1e-5, upper[k] + 1e-3, lower[k], upper[k],
          std::nextafter(upper[k], 0.0), std::nextafter(lower[k], 1.0), kInfinity, -kInfinity}) {
      std::vector<double> q = at(value);
      EXPECT_THAT(takeToLimits(*robot, group, q), IsEmpty()) << value;
      EXPECT_EQ(q, at(value));
    }
    std::vector<double> q = at(kNan);
    EXPECT_THAT(takeToLimits(*robot, group, q), IsEmpty());
  }
  // An angle without limits, and a quaternion, are no nearer to a limit there than elsewhere.
  std::vector<double> free{0.5, -kPi - 1e-7, 0.2, 7.0, -7.0, 1e9, 0.0, 0.0, 1e-7, 1.000001};
  const std::vector<double> before = free;
  EXPECT_THAT(takeToLimits(*robot, group, free), IsEmpty());
  EXPECT_EQ(free, before);
  free.pop_back();
  EXPECT_THROW(takeToLimits(*robot, group, free), std::invalid_argument);
}

TEST(Limits, NamedStatesAreTakenToThem) {
  const auto load = [](const std::string& value, test::Warnings& warnings) {
    return Robot::parse(
        "<robot name='k'><link name='a'/><link name='b'/><link name='c'/>" +
            test::joint("turn", "revolute", "a", "b", test::limited("0 0 1", -1.5, 1.5)) +
            test::joint("roll", "continuous", "b", "c", "<axis xyz='0 0 1'/>") + "</robot>",
        "k.urdf",
        "<robot name='k'><group name='g'><joint name='turn'/><joint name='roll'/></group>\n"
        "<group_state name='up' group='g'><joint name='turn' value='" +
            value + "'/><joint name='roll' value='3.1415927'/></group_state></robot>",
        "k.srdf", warnings.options());
  };
  for (const auto& [text, value, warning] :
       {std::tuple{"1.5000090", 1.5, "1.500009 rad, 9e-06 beyond its limit 1.5"},
        std::tuple{"-1.500000002", -1.5, "-1.500000002 rad, 2e-09 beyond its limit -1.5"}}) {
    test::Warnings warnings;
    const auto robot = load(text, warnings);
    EXPECT_EQ(robot->findNamedState("up", "g")->values[0].second, value);
    EXPECT_EQ(robot->findNamedState("up", "g")->values[1].second, 3.1415927);
    EXPECT_THAT(warnings.lines, ElementsAre("k.srdf:2: warning: state 'up': turn is " +
                                            std::string(warning) + ": taken to the limit"));
  }
  test::Warnings outside, exact;
  EXPECT_EQ(load("1.500011", outside)->findNamedState("up", "g")->values[0].second, 1.500011);
  EXPECT_THAT(outside.lines, ElementsAre("k.srdf:2: warning: state 'up': turn = 1.500011 is "
                                         "outside its limits [-1.5, 1.5]"));
  EXPECT_EQ(load("1.5", exact)->findNamedState("up", "g")->values[0].second, 1.5);
  EXPECT_THAT(exact.lines, IsEmpty());
}

/// Of a joint that mimics, nothing can be taken to a limit: what it misses one by is remarked on
/// from where it is more than that.
TEST(Limits, AMimicMayMissItsOwnByAHair) {
  const auto warnings = [](const std::string& offset) {
    test::Warnings found;
    Robot::parse(
        "<robot name='m'><link name='a'/><link name='b'/><link name='c'/>" +
            test::joint("turn", "revolute", "a", "b", test::limited("0 0 1", -1, 1)) +
            test::joint("two", "revolute", "b", "c",
                        test::limited("0 0 1", -2, 2) +
                            "<mimic joint='turn' multiplier='2' offset='" + offset + "'/>") +
            "</robot>",
        "m.urdf", {}, {}, found.options());
    return found.lines;
  };
  for (const char* hair : {"2e-9", "-1e-6", "9e-6", "0"}) EXPECT_THAT(warnings(hair), IsEmpty());
  EXPECT_THAT(warnings("1.1e-5"),
              ElementsAre(testing::EndsWith("takes values in [-1.999989, 2.000011], beyond its "
                                            "limits [-2, 2]")));
}

}  // namespace
}  // namespace swept
