// SPDX-License-Identifier: BSD-3-Clause
// A configuration up to 1e-5 beyond a limit is answered for as it is: whatever rests on the limits,
// reach, tables and pairs that never meet, holds that far out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// rad or m, beyond a limit.
constexpr std::array kHairs{2e-9, 1e-6, 9e-6, 1e-5};
constexpr std::array kOutside{1.1e-5, 1e-3};

std::string ball(const std::string& name, double radius) {
  return "<link name='" + name + "'><collision><geometry><sphere radius='" +
         std::to_string(radius) + "'/></geometry></collision></link>";
}

/// A ball of 0.1 m that slides along x, from -0.5 to 1 m.
std::shared_ptr<const Robot> slider() {
  return Robot::parse(
      "<robot name='s'><link name='rail'/>" + ball("ball", 0.1) +
          test::joint("slide", "prismatic", "rail", "ball", test::limited("1 0 0", -0.5, 1.0)) +
          "</robot>",
      "s.urdf");
}

std::shared_ptr<const World> wallAt(double x) {
  World world;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = x + 0.5;
  world.add("wall", makeBox(Eigen::Vector3d(1.0, 1.0, 1.0)), pose);
  return std::make_shared<const World>(std::move(world));
}

TEST(StatesBeyond, AHairAreAnsweredForAsTheyAre) {
  const auto robot = slider();
  // Where the limit leaves 5e-6 m to the wall.
  const Checker checker(robot, "all", wallAt(1.1 + 5e-6));
  Workspace workspace(checker);
  const auto at = [](double x) { return std::vector<double>{x}; };
  for (const double hair : kHairs) {
    SCOPED_TRACE(hair);
    const std::vector<double> low = at(-0.5 - hair), high = at(1.0 + hair);
    for (const auto& q : {low, high}) {
      EXPECT_TRUE(checker.withinLimits(q));
      EXPECT_THAT(checker.reportState(q, workspace).outsideLimits, IsEmpty());
      EXPECT_EQ(linkPose(*robot, "all", "ball", q).translation().x(), q[0]);
    }
    EXPECT_EQ(checker.checkState(low, workspace), Verdict::Free);
    const bool touches = hair > 5e-6;
    const Verdict expected = touches ? Verdict::Collision : Verdict::Free;
    EXPECT_EQ(checker.checkState(high, workspace), expected);
    EXPECT_EQ(checker.reportState(high, workspace).verdict, expected);
    EXPECT_NEAR(checker.signedClearance(high, workspace).lower, 5e-6 - hair, 1e-8);
    std::vector<Verdict> batch(8);
    checker.checkStates(std::vector<double>(8, high[0]), batch, workspace);
    EXPECT_EQ(batch[5], expected);
    EXPECT_EQ(checker.certifyMotion(low, at(0.5), workspace).verdict, Verdict::Free);
    // Within the tolerance of the wall it need not be decided.
    const Verdict motion = checker.certifyMotion(at(0.5), high, workspace).verdict;
    EXPECT_NE(motion, touches ? Verdict::Free : Verdict::Collision);
    const double near = checker.motionClearance(low, at(0.5), 1e-6, workspace).lower;
    EXPECT_NEAR(near, 0.5 + 5e-6, 2e-6);
  }
  for (const double beyond : kOutside) {
    for (const auto& q : {at(-0.5 - beyond), at(1.0 + beyond)}) {
      EXPECT_FALSE(checker.withinLimits(q));
      EXPECT_THAT(checker.reportState(q, workspace).outsideLimits, ElementsAre("slide"));
      EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided);
      EXPECT_EQ(checker.certifyMotion(q, at(0.0), workspace).verdict, Verdict::Undecided);
      EXPECT_THROW(linkPose(*robot, "all", "ball", q), std::invalid_argument);
    }
  }
}

/// What reaches no farther than its limits lets it is not looked at; a hair beyond it is.
TEST(StatesBeyond, WhatIsReachedAHairBeyondIsSeen) {
  const auto robot = slider();
  const Checker checker(robot, "all", wallAt(1.1 + 8e-6));
  Workspace workspace(checker);
  EXPECT_EQ(checker.checkState(std::vector<double>{1.0 + 9e-6}, workspace), Verdict::Collision);
  EXPECT_EQ(checker.checkState(std::vector<double>{1.0 + 7e-6}, workspace), Verdict::Free);
}

/// A ball on an arm of 1 m, whose limit is 5e-6 rad away from a post of its own robot: neither that
/// the two never meet, nor a table of where they do, may be said of what is beyond.
TEST(StatesBeyond, LinksThatMeetAHairBeyondAreSeen) {
  using test::joint;
  // At the angle 0.5 the ball is 5e-6 m off the post, which is another ball.
  const double apart = 0.2 + 5e-6;
  const double angle = 0.5 + 2.0 * std::asin(0.5 * apart);
  std::ostringstream post;
  post.precision(17);
  post << "<link name='base'><collision><origin xyz='" << std::cos(angle) << " " << std::sin(angle)
       << " 0'/><geometry><sphere radius='0.1'/></geometry></collision></link>";
  for (const char* parent : {"base", "mid"}) {
    SCOPED_TRACE(parent);
    const auto robot = Robot::parse(
        "<robot name='a'>" + post.str() + "<link name='mid'/>" + "<link name='arm'/>" +
            ball("ball", 0.1) + joint("still", "fixed", "base", "mid", "") +
            joint("turn", "revolute", parent, "arm", test::limited("0 0 1", -0.5, 0.5)) +
            joint("rod", "fixed", "arm", "ball", "<origin xyz='1 0 0'/>") + "</robot>",
        "a.urdf");
    const Checker checker(robot, "all", std::make_shared<World>());
    Workspace workspace(checker);
    int contacts = 0, free = 0;
    for (double hair = 0.0; hair < 9.5e-6; hair += 0.5e-6) {
      if (std::abs(hair - 5e-6) < 0.4e-6) continue;
      const std::vector<double> q{0.5 + hair};
      const Verdict expected = hair > 5e-6 ? Verdict::Collision : Verdict::Free;
      (hair > 5e-6 ? contacts : free) += 1;
      EXPECT_TRUE(checker.withinLimits(q));
      EXPECT_EQ(checker.checkState(q, workspace), expected) << hair;
      std::vector<Verdict> batch(8);
      checker.checkStates(std::vector<double>(8, q[0]), batch, workspace);
      EXPECT_EQ(batch[2], expected) << hair;
      const Verdict motion = checker.certifyMotion(std::vector<double>{0.0}, q, workspace).verdict;
      EXPECT_NE(motion, hair > 5e-6 ? Verdict::Free : Verdict::Collision) << hair;
    }
    EXPECT_GE(contacts, 8);
    EXPECT_GE(free, 8);
  }
}

/// Whatever the limits, and what follows a variable: all that isWithin() accepts is answered for,
/// as a state and as the end of a motion.
TEST(StatesBeyond, AllThatIsWithinIsDecided) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  int states = 0, beyond = 0;
  for (int i = 0; i < 300; ++i) {
    const double lower = uniform(-100.0, 100.0);
    const double upper = i % 5 == 0 ? lower : lower + uniform(0.0, 3.0);
    const double multiplier = i % 7 == 0 ? 0.0 : std::ldexp(uniform(-1.0, 1.0), i % 12);
    std::ostringstream urdf;
    urdf.precision(17);
    urdf << "<robot name='r'><link name='a'/><link name='b'/>" << ball("c", 0.1)
         << "<joint name='j' type='prismatic'><parent link='a'/><child link='b'/>"
         << "<axis xyz='0 1 0'/><limit lower='" << lower << "' upper='" << upper << "'/></joint>"
         << "<joint name='m' type='prismatic'><parent link='b'/><child link='c'/>"
         << "<axis xyz='1 0 0'/><limit lower='-1' upper='1'/><mimic joint='j' multiplier='"
         << multiplier << "' offset='" << uniform(-1e3, 1e3) << "'/></joint></robot>";
    const auto robot = Robot::parse(urdf.str(), "r.urdf");
    World far;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().z() = 1.0;
    far.add("roof", makeBox(Eigen::Vector3d(1e6, 1e6, 0.1)), pose);
    const Checker checker(robot, "all", std::make_shared<const World>(std::move(far)));
    Workspace workspace(checker);
    const Variable& variable = robot->variables()[0];
    ASSERT_EQ(variable.lower, lower);
    // The outermost of all that are within.
    double low = lower - tolerance::kLimit, high = upper + tolerance::kLimit;
    while (isWithin(std::nextafter(high, kInfinity), lower, upper))
      high = std::nextafter(high, kInfinity);
    while (isWithin(std::nextafter(low, -kInfinity), lower, upper))
      low = std::nextafter(low, -kInfinity);
    beyond += high > upper && low < lower ? 1 : 0;
    for (const double end : {low, high, static_cast<double>(static_cast<float>(lower)),
                             static_cast<double>(static_cast<float>(upper))}) {
      const std::vector<double> q{end};
      ASSERT_TRUE(isWithin(end, lower, upper)) << end;
      ++states;
      EXPECT_TRUE(checker.withinLimits(q));
      EXPECT_EQ(checker.checkState(q, workspace), Verdict::Free) << urdf.str() << " at " << end;
      for (int k = 0; k < 10; ++k) {
        const std::vector<double> from{uniform(lower, upper)};
        EXPECT_EQ(checker.certifyMotion(from, q, workspace).verdict, Verdict::Free)
            << urdf.str() << " from " << from[0] << " to " << end;
      }
    }
  }
  EXPECT_EQ(beyond, 300);
  EXPECT_EQ(states, 1200);
}

TEST(StatesBeyond, InverseKinematicsTakesLimitsAHairBeyond) {
  const auto robot = slider();
  const InverseKinematics kinematics(robot, "all", "ball");
  EXPECT_EQ(kinematics.pose(std::vector<double>{1.0 + 9e-6}).translation().x(), 1.0 + 9e-6);
  EXPECT_FALSE(kinematics.findPose(std::vector<double>{1.0 + 1.1e-5}));
  const auto end = [&](double low, double high) {
    const InverseKinematics narrow =
        kinematics.within(std::vector<double>{low}, std::vector<double>{high});
    InverseKinematics::Workspace scratch(narrow);
    std::vector<double> q{0.0};
    InverseKinematicsOptions options;
    narrow.solve(Eigen::Isometry3d::Identity(), q, options, scratch);
    return q[0];
  };
  EXPECT_EQ(end(1.0 + 2e-9, 1.0 + 9e-6), 1.0);
  EXPECT_EQ(end(-0.5 - 9e-6, -0.5 - 2e-9), -0.5);
  EXPECT_THROW(end(1.0 + 9e-6, 1.0 + 2e-9), std::invalid_argument);
  EXPECT_THROW(end(1.0 + 1.1e-5, 2.0), std::invalid_argument);
}

/// A ball of 0.1 m on a slide that follows a joint of far limits, most of which its offset takes
/// back: what is left of a value rounds by as much as that rounded.
struct TakenBack {
  double limit, multiplier, offset;
  double upper;  ///< m, farthest that a computed value is accepted

  explicit TakenBack(std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0.5, 1.0);
    limit = 1e9 * share(random);
    multiplier = 2.0 * share(random);
    offset = -multiplier * (limit - 1.0);
    const double rounding = 0x1p-50 * (multiplier * limit + std::abs(offset));
    upper = multiplier * limit + offset + multiplier * tolerance::kLimit + rounding;
  }
  double computed(double q) const { return multiplier * q + offset; }
  long double exact(double q) const {
    return static_cast<long double>(multiplier) * static_cast<long double>(q) +
           static_cast<long double>(offset);
  }
  /// That goes farthest of those that are accepted, to a few roundings.
  double farthest() const {
    double best = limit;
    double q = (upper - offset) / multiplier;
    for (int i = 0; i < 40; ++i) q = std::nextafter(q, 0.0);
    for (int i = 0; i < 80; ++i, q = std::nextafter(q, kInfinity))
      if (computed(q) <= upper && exact(q) > exact(best)) best = q;
    return best;
  }
  std::shared_ptr<const Robot> robot() const {
    std::ostringstream text;
    text.precision(17);
    text << "<robot name='s'><link name='rail'/><link name='wheel'/>" << ball("ball", 0.1)
         << test::joint("turn", "revolute", "rail", "wheel",
                        test::limited("1 0 0", limit - 1.0, limit))
         << "<joint name='slide' type='prismatic'><parent link='rail'/><child link='ball'/>"
         << "<axis xyz='1 0 0'/><limit lower='-10' upper='10' effort='1' velocity='1'/>"
         << "<mimic joint='turn' multiplier='" << multiplier << "' offset='" << offset
         << "'/></joint></robot>";
    return Robot::parse(text.str(), "s.urdf");
  }
};

/// Reach holds for values in truth, not for those that are left of them.
TEST(LimitStates, WhatAnOffsetTakesBackReachesAsFarAsItDoes) {
  std::mt19937_64 random(44);
  int beyond = 0;
  int touching = 0;
  for (int i = 0; i < 1000; ++i) {
    const TakenBack slide(random);
    const double q = slide.farthest();
    const auto over = static_cast<double>(slide.exact(q) - static_cast<long double>(slide.upper));
    if (!(over > 1e-8)) continue;
    ++beyond;
    const auto world = std::make_shared<World>();
    const double at = slide.upper + 0.2 + 0.3 * over;
    world->add("post", makeSphere(0.1), Eigen::Isometry3d(Eigen::Translation3d(at, 0.0, 0.0)));
    const Checker checker(slide.robot(), "all", world);
    Workspace workspace(checker);
    EXPECT_NE(checker.checkState(std::vector{q}, workspace), Verdict::Free) << i;
    touching += checker.explain("ball", "post").find("out of reach") == std::string::npos ? 1 : 0;
  }
  EXPECT_GT(beyond, 20);
  EXPECT_EQ(touching, beyond);
}

}  // namespace
}  // namespace swept
