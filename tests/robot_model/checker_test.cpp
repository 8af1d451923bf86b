// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/checker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::Checker;
using swept::CheckerOptions;
using swept::MotionCertificate;
using swept::MotionQuery;
using swept::Verdict;
using swept::Workspace;
using swept::World;

/// A pendulum: a pole of radius 2 cm from 0.1 to 1.1 m along x, turning about z at the origin.
constexpr const char* kPole = R"(<robot name="pole">
  <link name="base"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="pole"><collision><origin xyz="0.6 0 0" rpy="0 1.5707963267948966 0"/>
    <geometry><cylinder radius="0.02" length="1.0"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="pole"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

/// Three links with a slide, a continuous joint and a mimic, links of all primitive kinds.
constexpr const char* kArm = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.2"/>
    <geometry><cylinder radius="0.04" length="0.35"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0 0 0.2"/>
    <geometry><box size="0.06 0.05 0.36"/></geometry></collision>
    <collision><origin xyz="0.05 0 0.3"/><geometry><sphere radius="0.04"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0 0 0.08"/>
    <geometry><box size="0.12 0.02 0.1"/></geometry></collision></link>
  <link name="finger"><collision><origin xyz="0.03 0 0.16"/>
    <geometry><box size="0.01 0.02 0.06"/></geometry></collision></link>
  <joint name="yaw" type="continuous"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.08"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0 0.09 0.4"/><axis xyz="0 1 0"/>
    <limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="fore"/><child link="hand"/>
    <origin xyz="0 0 0.42"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
  <joint name="finger_turn" type="revolute"><parent link="hand"/><child link="finger"/>
    <origin xyz="0 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
    <mimic joint="elbow" multiplier="0.5" offset="0.1"/></joint>
</robot>)";

Isometry3d at(double x, double y, double z) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = Vector3d(x, y, z);
  return pose;
}

std::shared_ptr<const World> worldOf(swept::Shape shape, const Isometry3d& pose) {
  auto world = std::make_shared<World>();
  world->add("obstacle", std::move(shape), pose);
  return world;
}

std::shared_ptr<const World> clutter(unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> place(-0.9, 0.9);
  std::uniform_real_distribution<double> size(0.02, 0.15);
  auto world = std::make_shared<World>();
  for (int i = 0; i < 8; ++i) {
    // In an order of its own: that of a call's arguments is the compiler's.
    const double z = place(engine), y = place(engine), x = place(engine);
    const double axisY = place(engine), axisX = place(engine), angle = place(engine);
    Isometry3d pose = at(x, y, 0.3 + 0.6 * z);
    pose.linear() =
        Eigen::AngleAxisd(angle, Vector3d(axisX, axisY, 1.0).normalized()).toRotationMatrix();
    const std::string name = "body" + std::to_string(i);
    if (i % 3 == 0) world->add(name, swept::Box{{size(engine), size(engine), size(engine)}}, pose);
    if (i % 3 == 1) world->add(name, swept::Cylinder{size(engine), size(engine)}, pose);
    if (i % 3 == 2) world->add(name, swept::Sphere{size(engine)}, pose);
  }
  return world;
}

Checker makeChecker(const char* urdf, std::shared_ptr<const World> world,
                    const CheckerOptions& options = {}) {
  return Checker(swept::Robot::parse(urdf, "test.urdf"), "all", std::move(world), options);
}

class RandomArm {
 public:
  explicit RandomArm(unsigned seed) : engine_(seed) {}
  std::vector<double> configuration() {
    return {uniform(-3.1, 3.1), uniform(-2.5, 2.5), uniform(0.0, 0.2)};
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

 private:
  std::mt19937 engine_;
};

TEST(Checker, AThinRodBetweenTwoFreeStatesIsHit) {
  // 2 mm rod in the pole's way; at both ends the pole is half a radian from it.
  const Checker checker =
      makeChecker(kPole, worldOf(swept::Cylinder{0.001, 0.2}, at(1.0, 0.0, 0.0)));
  Workspace workspace(checker);
  const std::vector<double> from{-0.5};
  const std::vector<double> to{0.5};
  EXPECT_EQ(checker.checkState(from, workspace), Verdict::Free);
  EXPECT_EQ(checker.checkState(to, workspace), Verdict::Free);
  const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
  ASSERT_EQ(certificate.verdict, Verdict::Collision);
  // Pole of radius 0.02 meets a rod of radius 0.001 at distance 1: sin(angle) = 0.021.
  const double contact = 0.5 - std::asin(0.021);
  EXPECT_LE(certificate.freeUntil, contact);
  EXPECT_GT(certificate.freeUntil, contact - 2e-3);
  ASSERT_TRUE(certificate.witness);
  EXPECT_EQ(certificate.witness->bodyA, "pole");
  EXPECT_EQ(certificate.witness->bodyB, "obstacle");
  EXPECT_GE(certificate.witness->t, contact);
  EXPECT_LE(certificate.witness->distance, 1e-12);
  EXPECT_NEAR(std::hypot(certificate.witness->pointB.x() - 1.0, certificate.witness->pointB.y()),
              0.0, 0.001 + 1e-9);
}

/// Fingers that close: the second mimics the first backwards, from 0.08 m to 0.
constexpr const char* kGripper = R"(<robot name="gripper">
  <link name="palm"/>
  <link name="left"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <link name="right"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <joint name="close" type="prismatic"><parent link="palm"/><child link="left"/>
    <axis xyz="1 0 0"/><limit lower="-0.08" upper="0" effort="1" velocity="1"/></joint>
  <joint name="follow" type="prismatic"><parent link="palm"/><child link="right"/>
    <origin xyz="0 0.1 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.08" effort="1" velocity="1"/><mimic joint="close" multiplier="-1"/></joint>
</robot>)";

TEST(Checker, AFingerMayMimicTheOtherBackwards) {
  const std::vector<double> open{-0.08};
  const std::vector<double> closed{0.0};
  const auto ask = [](double x, const std::vector<double>& from, const std::vector<double>& to) {
    const Checker checker = makeChecker(kGripper, worldOf(swept::Sphere{0.01}, at(x, 0.1, 0.0)));
    Workspace workspace(checker);
    return checker.certifyMotion(from, to, workspace);
  };
  // 1 mm from where the finger is when it is open.
  EXPECT_EQ(ask(0.101, open, closed).verdict, Verdict::Free);
  EXPECT_EQ(ask(0.101, closed, open).verdict, Verdict::Free);
  // In the middle of its way; the balls touch after a quarter of it.
  for (const MotionCertificate& met : {ask(0.04, open, closed), ask(0.04, closed, open)}) {
    ASSERT_EQ(met.verdict, Verdict::Collision);
    EXPECT_LE(met.freeUntil, 0.25);
    EXPECT_GT(met.freeUntil, 0.24);
    EXPECT_EQ(met.witness->bodyA, "right");
  }
}

TEST(Checker, GrazingWithinTheToleranceIsUndecidedAndBeyondItIsFree) {
  // A ball above the pole's plane of motion: the pole passes 'gap' below it.
  const auto verdict = [](double gap, double tolerance) {
    CheckerOptions options;
    options.tolerance = tolerance;
    const Checker checker =
        makeChecker(kPole, worldOf(swept::Sphere{0.1}, at(0.7, 0.0, 0.12 + gap)), options);
    Workspace workspace(checker);
    const std::vector<double> from{-1.0};
    const std::vector<double> to{1.0};
    return checker.certifyMotion(from, to, workspace).verdict;
  };
  EXPECT_EQ(verdict(1.1e-3, 1e-3), Verdict::Free);
  EXPECT_EQ(verdict(1.1e-6, 1e-6), Verdict::Free);
  EXPECT_EQ(verdict(1e-9, 1e-3), Verdict::Undecided);
  EXPECT_EQ(verdict(-1e-3, 1e-3), Verdict::Collision);
}

/// The pole, of radius 0.02, turns about z: over a floor, and from one side of a wall to the other.
TEST(Checker, UnboundedBodiesAreProvenToo) {
  const auto sweep = [](const swept::Shape& body, const Eigen::Isometry3d& pose) {
    const Checker checker = makeChecker(kPole, worldOf(body, pose));
    Workspace workspace(checker);
    const std::vector<double> from{-1.0};
    const std::vector<double> to{1.0};
    return checker.certifyMotion(from, to, workspace).verdict;
  };
  const Eigen::Isometry3d far = at(1e3, -1e3, 0.0);
  EXPECT_EQ(sweep(swept::makePlane({0, 0, 1}, -0.0215), far), Verdict::Free);
  EXPECT_EQ(sweep(swept::makePlane({0, 0, 1}, -0.0185), far), Verdict::Collision);
  EXPECT_EQ(sweep(swept::makeHalfSpace({0, 0, 1}, -0.0215), far), Verdict::Free);
  EXPECT_EQ(sweep(swept::makeHalfSpace({0, 0, -1}, 0.0215), far), Verdict::Collision);
  EXPECT_EQ(sweep(swept::makePlane({1, 0, 0}, 0.5), at(0, 0, 0)), Verdict::Collision);
  EXPECT_EQ(sweep(swept::makePlane({1, 0, 0}, -0.5), at(0, 0, 0)), Verdict::Free);
}

TEST(Checker, TheMarginIsKeptAndItsViolationWitnessed) {
  CheckerOptions options;
  options.margin = 0.05;
  const auto world = worldOf(swept::Sphere{0.1}, at(0.7, 0.0, 0.16));  // 4 cm above the pole
  const Checker strict = makeChecker(kPole, world, options);
  const Checker plain = makeChecker(kPole, world);
  Workspace workspace(strict);
  Workspace plainWorkspace(plain);
  const std::vector<double> q{0.0};
  EXPECT_EQ(plain.checkState(q, plainWorkspace), Verdict::Free);
  EXPECT_EQ(strict.checkState(q, workspace), Verdict::Collision);
  const swept::StateReport report = strict.reportState(q, workspace);
  ASSERT_EQ(report.contacts.size(), 1U);
  EXPECT_LE(report.contacts[0].distance, options.margin + 1e-12);
  EXPECT_NEAR(report.clearance, 0.04, 1e-8);
  EXPECT_EQ(report.nearestA, "pole");
  EXPECT_EQ(report.nearestB, "obstacle");
}

TEST(Checker, StatesAreDecidedNextToTheMargin) {
  const auto world = clutter(3);
  const Checker checker = makeChecker(kArm, world);
  Workspace workspace(checker);
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> value(-2.0, 2.0);
  int seen = 0;
  for (int i = 0; i < 24; ++i) {
    const std::vector<double> q{value(engine), value(engine), 0.1};
    const double clearance = checker.clearance(q, workspace);
    if (!(clearance > 0.001)) continue;
    ++seen;
    constexpr double kStep = 1e-7;  // m
    CheckerOptions options;
    for (const double side : {-kStep, kStep}) {
      options.margin = clearance + side;
      const Checker near = makeChecker(kArm, world, options);
      Workspace own(near);
      EXPECT_EQ(near.checkState(q, own), side < 0.0 ? Verdict::Free : Verdict::Collision) << i;
    }
  }
  EXPECT_GT(seen, 8);
}

TEST(Checker, SaysWhatItChecksAndWhatItLeavesOut) {
  auto world = std::make_shared<World>();
  world->add("near", swept::Sphere{0.1}, at(0.5, 0.5, 0.0));
  world->add("far", swept::Sphere{0.1}, at(5.0, 0.0, 0.0));
  world->add("floor", swept::Box{{1.0, 1.0, 0.01}}, at(0.0, 0.0, -0.055));
  const Checker checker = makeChecker(kPole, world);
  const auto pair = [](const char* a, const char* b, const char* reason) {
    return testing::AllOf(testing::Field(&Checker::Pair::bodyA, a),
                          testing::Field(&Checker::Pair::bodyB, b),
                          testing::Field(&Checker::Pair::reason, reason));
  };
  EXPECT_THAT(checker.checkedPairs(),
              testing::UnorderedElementsAre(pair("pole", "near", ""), pair("pole", "floor", "")));
  EXPECT_THAT(checker.skippedPairs(),
              testing::UnorderedElementsAre(pair("pole", "far", "out of reach"),
                                            pair("base", "pole", "adjacent: joint turn"),
                                            pair("base", "near", "not moved by the group"),
                                            pair("base", "far", "not moved by the group"),
                                            pair("base", "floor", "not moved by the group")));
  EXPECT_THAT(checker.staticContacts(),
              testing::ElementsAre(pair("base", "floor", "not moved by the group")));
}

TEST(Checker, CyclicJointsGoTheShorterWay) {
  // An obstacle behind the arm at yaw = pi: a motion across the wrap hits it.
  const Checker checker = makeChecker(kArm, worldOf(swept::Sphere{0.05}, at(0.0, -0.09, 0.6)));
  Workspace workspace(checker);
  const std::vector<double> from{2.8, 0.0, 0.0};
  const std::vector<double> to{-2.8, 0.0, 0.0};
  EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Collision);
  const std::vector<double> other{-0.1, 0.0, 0.0};
  const std::vector<double> zero{0.1, 0.0, 0.0};
  EXPECT_EQ(checker.certifyMotion(zero, other, workspace).verdict, Verdict::Free);
  const Eigen::VectorXd middle = checker.interpolate(from, to, 0.5);
  EXPECT_NEAR(std::abs(middle[0]), std::numbers::pi, 1e-12);
  std::vector<double> same(3);
  checker.interpolate(from, to, 0.5, same);
  EXPECT_THAT(same, testing::ElementsAreArray(middle.data(), 3));
}

TEST(Checker, NoResultDependsOnWhatTheWorkspaceHeldBefore) {
  const Checker checker = makeChecker(kArm, clutter(1));
  Workspace used(checker);
  RandomArm random(2);
  int free = 0, collision = 0;
  for (int i = 0; i < 300; ++i) {
    const auto from = random.configuration();
    const auto to = random.configuration();
    Workspace fresh(checker);
    const MotionCertificate a = checker.certifyMotion(from, to, used);
    const MotionCertificate b = checker.certifyMotion(from, to, fresh);
    ASSERT_EQ(a.verdict, b.verdict);
    ASSERT_EQ(a.freeUntil, b.freeUntil);
    ASSERT_EQ(a.effort.distances, b.effort.distances);
    ASSERT_EQ(a.witness.has_value(), b.witness.has_value());
    if (a.witness) {
      ASSERT_EQ(a.witness->t, b.witness->t);
      ASSERT_EQ(a.witness->bodyA, b.witness->bodyA);
      ASSERT_EQ(a.witness->bodyB, b.witness->bodyB);
    }
    ASSERT_EQ(checker.clearance(from, used), checker.clearance(from, fresh));
    free += a.verdict == Verdict::Free ? 1 : 0;
    collision += a.verdict == Verdict::Collision ? 1 : 0;
  }
  EXPECT_GT(free, 40);
  EXPECT_GT(collision, 40);
}

/// The promises that need no outside oracle: Free means a positive clearance; more clearance than
/// the tolerance means Free; a prefix that is called free is; both ways of asking agree.
TEST(Checker, VerdictsClearancesAndPrefixesAgree) {
  RandomArm random(3);
  int free = 0;
  int collision = 0;
  int undecided = 0;
  for (unsigned scene = 0; scene < 6; ++scene) {
    const Checker checker = makeChecker(kArm, clutter(scene));
    Workspace workspace(checker);
    for (int i = 0; i < 150; ++i) {
      const auto from = random.configuration();
      const auto to = random.configuration();
      const MotionCertificate whole = checker.certifyMotion(from, to, workspace);
      const MotionCertificate quick =
          checker.certifyMotion(from, to, workspace, MotionQuery::VerdictOnly);
      const swept::MotionClearance clearance = checker.motionClearance(from, to, 1e-3, workspace);
      EXPECT_EQ(whole.verdict, quick.verdict);
      EXPECT_LE(clearance.lower, clearance.upper);
      EXPECT_LE(clearance.upper - clearance.lower, 1e-3 + 1e-9);
      if (clearance.upper >= 2e-5) {
        EXPECT_GE(clearance.lower, 0.5 * clearance.upper - 1e-9);
      }
      free += whole.verdict == Verdict::Free;
      collision += whole.verdict == Verdict::Collision;
      undecided += whole.verdict == Verdict::Undecided;
      if (whole.verdict == Verdict::Free) {
        EXPECT_GT(clearance.upper, 0.0);
        EXPECT_EQ(whole.freeUntil, 1.0);
      }
      if (clearance.lower > checker.options().tolerance) {
        EXPECT_EQ(whole.verdict, Verdict::Free);
      }
      if (clearance.upper == 0.0) {
        EXPECT_NE(whole.verdict, Verdict::Free);
      }
      if (whole.verdict != Verdict::Collision) continue;
      ASSERT_TRUE(whole.witness);
      EXPECT_LE(whole.freeUntil, whole.witness->t);
      const Eigen::VectorXd hit = checker.interpolate(from, to, whole.witness->t);
      EXPECT_NE(checker.checkState({hit.data(), 3}, workspace), Verdict::Free);
      if (whole.freeUntil == 0.0) continue;
      const Eigen::VectorXd last = checker.interpolate(from, to, whole.freeUntil * (1 - 1e-9));
      EXPECT_EQ(checker.checkState({last.data(), 3}, workspace), Verdict::Free);
    }
  }
  EXPECT_GT(free, 150);
  EXPECT_GT(collision, 150);
  EXPECT_LE(undecided, 9);
}

TEST(Checker, NonFiniteAndImpossibleStatesAreNeverFree) {
  const Checker checker = makeChecker(kArm, std::make_shared<World>());
  Workspace workspace(checker);
  const std::vector<double> good{0.0, 0.5, 0.1};
  EXPECT_EQ(checker.checkState(good, workspace), Verdict::Free);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> q = good;
      q[i] = bad;
      EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided);
      EXPECT_EQ(checker.certifyMotion(good, q, workspace).verdict, Verdict::Undecided);
      EXPECT_EQ(checker.clearance(q, workspace), 0.0);
      EXPECT_FALSE(checker.reportState(q, workspace).finite);
      EXPECT_FALSE(checker.withinLimits(q));
    }
  }
  const std::vector<double> outside{0.0, 2.6, 0.1};
  EXPECT_THAT(checker.reportState(outside, workspace).outsideLimits, testing::ElementsAre("elbow"));
  EXPECT_EQ(checker.certifyMotion(good, good, workspace).verdict, Verdict::Free);
}

TEST(Checker, MisuseIsAnError) {
  const auto robot = swept::Robot::parse(kArm, "test.urdf");
  const auto world = std::make_shared<const World>();
  CheckerOptions options;
  const auto message = [&](auto&& action) -> std::string {
    try {
      action();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_EQ(message([&] { Checker(robot, "legs", world); }),
            "Checker: robot 'arm' has no group 'legs'; its groups are: all");
  options.margin = -1e-9;
  EXPECT_EQ(message([&] { Checker(robot, "all", world, options); }),
            "Checker: margin -1e-09 m must be a finite number that is not negative");
  options.margin = 0.0;
  options.tolerance = 0.0;
  EXPECT_EQ(message([&] { Checker(robot, "all", world, options); }),
            "Checker: tolerance 0 m must be a finite number greater than zero");
  options.tolerance = 1e-3;
  options.reference = Eigen::VectorXd::Zero(2);
  EXPECT_EQ(message([&] { Checker(robot, "all", world, options); }),
            "Checker: the reference has 2 values instead of 3");
  options.reference.reset();
  options.maxPairs = 7;
  EXPECT_EQ(message([&] { Checker(robot, "all", clutter(1), options); }),
            "Checker: more than 7 pairs of bodies to check: the group has 6 shapes, the world 8");
  options.maxPairs = 50;
  auto balls = std::make_shared<World>();
  swept::WorldBody many{.name = "balls"};
  for (int i = 0; i < 20; ++i) many.parts.push_back({swept::Sphere{0.01}, at(0.02 * i, 0.5, 0.5)});
  balls->add(many);
  EXPECT_EQ(message([&] { Checker(robot, "all", balls, options); }),
            "Checker: more than 50 pairs of shapes to check: the group has 6 shapes, the world 20");
  const Checker checker(robot, "all", world);
  Workspace workspace(checker);
  const std::vector<double> tooShort{0.0};
  std::vector<double> three(3), two(2);
  EXPECT_EQ(message([&] { (void)checker.motionClearance(three, three, -1e-9, workspace); }),
            "Checker: accuracy -1e-09 m must be greater than zero");
  EXPECT_EQ(message([&] { (void)checker.checkState(tooShort, workspace); }),
            "Checker: a configuration of group 'all' has 3 values, not 1");
  EXPECT_EQ(message([&] { checker.interpolate(three, three, 0.5, two); }),
            "Checker: a configuration of group 'all' has 3 values, not 2");
}

/// A plate 0.1 m above the floor that slides, or turns about an axis beside it.
std::string plateOn(const std::string& joint) {
  return R"(<robot name="plate"><link name="base"/><link name="plate"><collision>
    <origin xyz="0.4 0 0.15"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision></link>
    <joint name="j" type=")" +
         joint + R"("><parent link="base"/><child link="plate"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>)";
}

TEST(Checker, WhatSlidesAlongAnotherKeepsItsClearanceInFewIntervals) {
  const auto floor = worldOf(swept::Box{Vector3d(4.0, 4.0, 0.5)}, at(0.0, 0.0, -0.5));
  std::string slide = plateOn("prismatic");
  slide.replace(slide.find("0 0 1\"/><limit"), 5, "1 0 0");
  for (const auto& [urdf, most] : {std::pair(slide, 60), std::pair(plateOn("revolute"), 20'000)}) {
    const Checker checker = makeChecker(urdf.c_str(), floor);
    Workspace workspace(checker);
    const std::vector<double> from{-1.5};
    const std::vector<double> to{1.5};
    constexpr double kAccuracy = 1e-8;
    const auto found = checker.motionClearance(from, to, kAccuracy, workspace);
    EXPECT_LE(found.lower, 0.1);
    EXPECT_NEAR(found.upper, 0.1, 1e-12);
    EXPECT_LE(found.upper - found.lower, kAccuracy);
    EXPECT_LE(found.intervals, most) << urdf;
  }
}

TEST(Checker, TheCapOnIntervalsEndsInUndecided) {
  CheckerOptions options;
  options.maxIntervals = 3;
  options.tolerance = 1e-9;
  const Checker checker =
      makeChecker(kPole, worldOf(swept::Sphere{0.1}, at(0.7, 0.0, 0.12001)), options);
  Workspace workspace(checker);
  const std::vector<double> from{-1.0};
  const std::vector<double> to{1.0};
  const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
  EXPECT_EQ(certificate.verdict, Verdict::Undecided);
  EXPECT_LE(certificate.effort.intervals, 3);
}

}  // namespace
