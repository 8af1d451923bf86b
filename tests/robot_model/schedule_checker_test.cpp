// SPDX-License-Identifier: BSD-3-Clause
// One robot's curve beside those of others: against the whole schedule, and truths by hand.
#include "swept/robot_model/schedule_checker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "crossing_robot.hpp"
#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace swept {
namespace {

using test::messageOf;

/// Cubes of 0.2 m that slide: `east` along x, `north` along y, `up` along z, all through the
/// origin.
std::shared_ptr<const Robot> crossing() {
  return Robot::parse(test::crossingUrdf({{"east", "1 0 0"}, {"north", "0 1 0"}, {"up", "0 0 1"}}),
                      "crossing.urdf");
}

/// From -1 m to 1 m at 1 m/s, begun at a time (s).
PiecewisePolynomial pass(double begin = 0.0) {
  Eigen::MatrixXd way(1, 2);
  way << -1.0, 1.0;
  return {{begin, begin + 2.0}, {way}};
}

Checker checkerOf(const std::shared_ptr<const Robot>& robot) {
  return {robot, "all", std::make_shared<World>()};
}

const std::vector<double> kAway{0.0, 0.0, 3.0};  // `up` is far above

TEST(ScheduleChecker, WhoMeetsAtACrossingIsKnownByHand) {
  const ScheduleChecker beside(checkerOf(crossing()), {"east"},
                               {{.variables = {"north"}, .curve = pass()}}, kAway);
  EXPECT_EQ(beside.end(), 2.0);
  EXPECT_EQ(beside.variables(), std::vector<std::string>{"east"});
  EXPECT_EQ(beside.others().size(), 1U);
  Workspace workspace(beside.checker());
  for (const double begin : {0.0, 0.2, 0.39, 0.41, 0.5, 3.0}) {
    const TrajectoryCertificate found = beside.certify(pass(begin), workspace);
    EXPECT_EQ(found.verdict, begin < 0.4 ? Verdict::Collision : Verdict::Free) << begin;
    if (begin >= 0.4) continue;
    ASSERT_TRUE(found.contact);
    EXPECT_NEAR(found.contact->time, 0.8 + begin, 1e-3);
    EXPECT_NEAR(found.freeUntil, 0.8 + begin, 5e-3);
  }
  // Before the other begins and after it has ended, it rests.
  const Eigen::MatrixXd origin = Eigen::MatrixXd::Zero(1, 2);
  EXPECT_EQ(beside.certify({{0.0, 0.7}, {origin}}, workspace).verdict, Verdict::Free);
  EXPECT_EQ(beside.certify({{0.7, 0.9}, {origin}}, workspace).verdict, Verdict::Collision);
  EXPECT_EQ(beside.certify({{1.3, 50.0}, {origin}}, workspace).verdict, Verdict::Free);
}

TEST(ScheduleChecker, OthersAmongThemselvesAreNotAskedAbout) {
  // `north` and `up` meet, and `east` is away from both.
  const std::vector<ScheduledCurve> others{{.variables = {"north"}, .curve = pass()},
                                           {.variables = {"up"}, .curve = pass()}};
  const Checker checker = checkerOf(crossing());
  const ScheduleChecker beside(checker, {"east"}, others);
  Workspace workspace(beside.checker());
  const Eigen::MatrixXd away = Eigen::MatrixXd::Constant(1, 2, 2.0);
  EXPECT_EQ(beside.certify({{0.0, 3.0}, {away}}, workspace).verdict, Verdict::Free);
  std::vector<ScheduledCurve> all = others;
  all.push_back({.variables = {"east"}, .curve = {{0.0, 3.0}, {away}}});
  EXPECT_EQ(certifySchedule(checker, all).verdict, Verdict::Collision);
}

TEST(ScheduleChecker, IgnoredVariablesAreLeftOut) {
  const std::vector<double> still{0.0, 0.0, 0.0};  // both others are at the origin
  const Checker checker = checkerOf(crossing());
  const auto verdict = [&](const std::vector<std::string>& ignored) {
    const ScheduleChecker beside(checker, {"east"}, {}, still, ignored);
    Workspace workspace(beside.checker());
    return beside.certify(pass(), workspace).verdict;
  };
  EXPECT_EQ(verdict({}), Verdict::Collision);
  EXPECT_EQ(verdict({"north"}), Verdict::Collision);
  EXPECT_EQ(verdict({"north", "up"}), Verdict::Free);
}

TEST(ScheduleChecker, NamesLikePatternsLeaveOutNoOtherPair) {
  // To a rule, `east*` is also the cube that is planned.
  const Checker checker = checkerOf(crossing())
                              .withBody("east*", makeBox({0.1, 0.1, 0.1}),
                                        Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -5.0)));
  const ScheduleChecker beside(checker, {"east"}, {{.variables = {"north"}, .curve = pass()}},
                               kAway);
  Workspace workspace(beside.checker());
  EXPECT_EQ(beside.certify(pass(0.2), workspace).verdict, Verdict::Collision);
  EXPECT_EQ(beside.certify(pass(0.5), workspace).verdict, Verdict::Free);
}

/// Beside a cube that moves along y: at these times (s) it is there (m).
Checker besideCart(const std::vector<std::pair<double, double>>& places) {
  MovingObstacle cart{.name = "cart",
                      .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}}};
  for (const auto& [time, y] : places)
    cart.waypoints.push_back({time, Eigen::Isometry3d(Eigen::Translation3d(0.0, y, 0.0))});
  return checkerOf(crossing()).withObstacle(cart);
}

TEST(ScheduleChecker, ObstaclesAreOnTheSameClock) {
  const Checker checker = besideCart({{0.0, -1.0}, {2.0, 1.0}, {7.0, 1.0}});
  const std::vector<double> still{0.0, 3.0, 3.0};
  const ScheduleChecker beside(checker, {"east"}, {}, still);
  EXPECT_EQ(beside.end(), 7.0);
  Workspace workspace(beside.checker());
  EXPECT_EQ(beside.certify(pass(0.3), workspace).verdict, Verdict::Collision);
  EXPECT_EQ(beside.certify(pass(0.5), workspace).verdict, Verdict::Free);
}

TEST(ScheduleChecker, DelaysAreProvenUpToTheTruth) {
  const Checker checker = checkerOf(crossing());
  const std::vector<ScheduledCurve> others{{.variables = {"north"}, .curve = pass()}};
  for (const double delay : {0.1, 0.5, 1.0}) {
    const ScheduleChecker beside(checker, {"east"}, others, kAway, {}, delay);
    EXPECT_EQ(beside.end(), 2.0 + delay);
    Workspace workspace(beside.checker());
    // Without a delay they meet if they are less than 0.4 s apart.
    for (const double begin : {0.1, 0.3 + delay, 0.39 + delay})
      EXPECT_NE(beside.certify(pass(begin), workspace).verdict, Verdict::Free) << delay << begin;
    // The tubes need up to 0.02 m more, on either side.
    for (const double begin : {0.45 + delay, 1.0 + 2.0 * delay})
      EXPECT_EQ(beside.certify(pass(begin), workspace).verdict, Verdict::Free) << delay << begin;
  }
}

TEST(ScheduleChecker, SlowdownsAreProvenUpToTheTruth) {
  const Checker checker = checkerOf(crossing());
  for (const double slowest : {1.05, 1.25, 2.0}) {
    for (const double delay : {0.0, 0.3}) {
      const auto verdict = [&](double begin, double ofOther) {
        const ScheduleChecker beside(checker, {"east"},
                                     {{.variables = {"north"}, .curve = pass(), .start = ofOther}},
                                     kAway, {}, delay, slowest);
        EXPECT_NEAR(beside.end(), delay + ofOther + slowest * 2.0, 1e-12);
        Workspace workspace(beside.checker());
        return beside.certify(pass(begin), workspace).verdict;
      };
      // The other one leaves at 1.2 s. If it is slow, the own one must not come before that.
      const double after = delay + slowest * 1.2 - 0.8;
      EXPECT_NE(verdict(after - 0.15, 0.0), Verdict::Free) << slowest << ' ' << delay;
      EXPECT_NE(verdict(after - 0.01, 0.0), Verdict::Free) << slowest << ' ' << delay;
      EXPECT_EQ(verdict(after + 0.08, 0.0), Verdict::Free) << slowest << ' ' << delay;
      // The other one comes at 5.8 s. If the own one is slow, it must have left by then.
      const double before = (5.8 - delay) / slowest - 1.2;
      EXPECT_EQ(verdict(before - 0.08, 5.0), Verdict::Free) << slowest << ' ' << delay;
      EXPECT_NE(verdict(before + 0.01, 5.0), Verdict::Free) << slowest << ' ' << delay;
      EXPECT_NE(verdict(before + 0.15, 5.0), Verdict::Free) << slowest << ' ' << delay;
    }
  }
}

/// The least size of what is between two values.
double leastSizeBetween(double a, double b) {
  return a * b <= 0.0 ? 0.0 : std::min(std::abs(a), std::abs(b));
}

TEST(ScheduleChecker, EveryDelayAndSlowdownIsWeighedByHand) {
  // How near two passes come, with all delays and slowdowns of either: at each time of the own one,
  // those of the other are an interval, and its places are one, too.
  const Checker checker = checkerOf(crossing());
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0x1p-32 * static_cast<double>(random());
  };
  std::array<int, 3> count{};  // colliding, undecided, free
  for (int i = 0; i < 300; ++i) {
    const double delay = i % 3 == 0 ? 0.0 : uniform(0.0, 1.0), slowest = uniform(1.0, 1.4);
    const double begin = uniform(0.0, 4.0), start = uniform(0.0, 4.0), factor = uniform(0.5, 2.0);
    const ScheduleChecker beside(
        checker, {"east"},
        {{.variables = {"north"}, .curve = pass(), .start = start, .slowdown = factor}}, kAway, {},
        delay, slowest);
    Workspace workspace(beside.checker());
    const Verdict verdict = beside.certify(pass(begin), workspace).verdict;
    const auto own = [&](double time) { return std::clamp(time - begin - 1.0, -1.0, 1.0); };
    const auto other = [&](double time) {
      return std::clamp((time - start) / factor - 1.0, -1.0, 1.0);
    };
    double apart = 10.0;
    for (double time = begin; time <= begin + 2.0; time += 1e-3) {
      const double x = std::abs(own(time));
      // The own one is late: it is here when the clock shows `time` to `until`.
      const double until = delay + slowest * time;
      apart = std::min(apart, std::max(x, leastSizeBetween(other(time), other(until))));
      // The other one is late: it does now what it did since then, once it has begun.
      const double since = start + std::min((time - start - delay) / slowest, time - start - delay);
      apart = std::min(apart, std::max(x, leastSizeBetween(other(since), other(time))));
    }
    // Times are 1 ms apart, in which each goes at most 2 mm.
    EXPECT_FALSE(verdict == Verdict::Free && apart < 0.2 - 2e-3) << i << ' ' << apart;
    EXPECT_FALSE(verdict == Verdict::Collision && apart > 0.2 + 2e-3) << i << ' ' << apart;
    EXPECT_FALSE(verdict != Verdict::Free && apart > 0.25) << i << ' ' << apart;
    ++count[verdict == Verdict::Collision ? 0 : verdict == Verdict::Free ? 2 : 1];
  }
  EXPECT_GE(count[0], 60);
  EXPECT_LE(count[1], 60);
  EXPECT_GE(count[2], 60);
}

TEST(ScheduleChecker, ObstaclesKeepTheirTimesWhileTheCurveIsLate) {
  // It passes the origin at 4 s. They meet if they pass less than 0.4 s apart.
  const Checker checker = besideCart({{3.0, -1.0}, {5.0, 1.0}});
  const std::vector<double> still{0.0, 3.0, 3.0};
  for (const double delay : {0.1, 0.5, 1.0}) {
    const ScheduleChecker beside(checker, {"east"}, {}, still, {}, delay);
    EXPECT_EQ(beside.end(), 5.0);
    Workspace workspace(beside.checker());
    const auto verdict = [&](double passes) {
      return beside.certify(pass(passes - 1.0), workspace).verdict;
    };
    // Later is never nearer. The rooms need up to 0.02 m more, on either side.
    for (const double passes : {4.45, 4.6, 6.0}) EXPECT_EQ(verdict(passes), Verdict::Free) << delay;
    for (const double passes : {3.55 - delay, 2.0 - delay})
      EXPECT_EQ(verdict(passes), Verdict::Free) << delay;
    for (const double passes : {3.61 - delay, 3.9 - delay, 3.61, 4.0, 4.39})
      EXPECT_NE(verdict(passes), Verdict::Free) << delay << ' ' << passes;
    EXPECT_EQ(verdict(3.9), Verdict::Collision);
    // Only some delays are in contact, and they are found.
    EXPECT_EQ(verdict(3.9 - delay), Verdict::Collision) << delay;
    // Its own place while it waits: the cart comes to it before it has left.
    const Eigen::MatrixXd origin = Eigen::MatrixXd::Zero(1, 2);
    EXPECT_EQ(beside.certify({{0.0, 3.75 - delay}, {origin}}, workspace).verdict, Verdict::Free);
    EXPECT_NE(beside.certify({{0.0, 3.85 - delay}, {origin}}, workspace).verdict, Verdict::Free);
  }
}

TEST(ScheduleChecker, ALargerMarginOfAPairIsKeptWithADelay) {
  const Checker checker = besideCart({{3.0, -1.0}, {5.0, 1.0}})
                              .withRules(CollisionRules().margin("east*", "cart", 0.1));
  const ScheduleChecker beside(checker, {"east"}, {}, std::vector<double>{0.0, 3.0, 3.0}, {}, 0.5);
  Workspace workspace(beside.checker());
  // Without a margin 0.4 s are enough. With one, the corners pass 0.1 m apart where the cubes are
  // 0.27 m apart along both axes.
  EXPECT_NE(beside.certify(pass(3.5), workspace).verdict, Verdict::Free);
  EXPECT_EQ(beside.certify(pass(3.6), workspace).verdict, Verdict::Free);
}

TEST(ScheduleChecker, AClockOfYearsLeavesRangesThatAreTooWide) {
  // Rounding alone is then wider than what ranges are divided to.
  const std::vector<ScheduledCurve> others{
      {.variables = {"north"}, .curve = pass(), .start = 1e12}};
  const ScheduleChecker beside(checkerOf(crossing()), {"east"}, others, kAway, {}, 0.5);
  Workspace workspace(beside.checker());
  EXPECT_NE(beside.certify(pass(1e12), workspace).verdict, Verdict::Free);
  EXPECT_NE(beside.certify(pass(1e12 + 50.0), workspace).verdict, Verdict::Collision);
}

TEST(ScheduleChecker, CurvesThatItsTubeHasNoRoomForAreUndecided) {
  const ScheduleChecker beside(checkerOf(crossing()), {"east"}, {}, kAway);
  Workspace workspace(beside.checker());
  Eigen::MatrixXd way(1, 2);
  way << 1.0, 1.5;
  EXPECT_EQ(beside.certify({{0.0, 1.0}, {way}}, workspace).verdict, Verdict::Free);
  const TrajectoryCertificate fast = beside.certify({{0.0, 0.004}, {way}}, workspace);
  EXPECT_EQ(fast.verdict, Verdict::Undecided);
  EXPECT_TRUE(fast.undecided);
  EXPECT_EQ(beside.certify({{0.0, 700.0}, {way}}, workspace).verdict, Verdict::Undecided);
}

TEST(ScheduleChecker, TwoArmsGetTheVerdictsOfTheWholeSchedule) {
  const auto robot = loadWorkCell(WorkCell::read(modelsDir() + "/cells/two_rooks.yaml"));
  const Checker checker(robot, "both", std::make_shared<World>());
  std::mt19937 random(3);
  const auto curveOf = [&](const Group& group, double begin) {
    JointTrajectory trajectory;
    for (const int variable : group.variables)
      trajectory.variables.push_back(robot->variables()[static_cast<std::size_t>(variable)].name);
    for (int k = 0; k < 3; ++k) {
      TrajectoryPoint point{
          .time = begin + k, .positions = {}, .velocities = {}, .accelerations = {}};
      for (std::size_t v = 0; v < 7; ++v) {
        const double share = static_cast<double>(random()) * 0x1p-32;
        point.positions.push_back((v == 1 ? 1.0 : v == 3 ? 0.6 : 0.0) + 0.8 * (share - 0.5));
        point.velocities.push_back(0.4 * (share - 0.5));
      }
      trajectory.points.push_back(std::move(point));
    }
    return ScheduledCurve{trajectory.variables, controllerCurve(trajectory)};
  };
  const Checker right(robot, "right/arm", std::make_shared<World>());
  Workspace workspaceOfRight(right);
  std::array<int, 2> count{};  // colliding, free
  for (int i = 0; i < 6; ++i) {
    const ScheduledCurve other = curveOf(right.group(), 0.0);
    if (right.certifyTrajectory(other.curve, workspaceOfRight).verdict != Verdict::Free) continue;
    const ScheduledCurve sample = curveOf(*robot->findGroup("left/arm"), 0.0);
    const ScheduleChecker beside(checker, sample.variables, {other});
    Workspace workspace(beside.checker());
    for (int k = 0; k < 5; ++k) {
      const ScheduledCurve left = curveOf(*robot->findGroup("left/arm"), 0.0);
      const Verdict own = beside.certify(left.curve, workspace).verdict;
      EXPECT_EQ(own, certifySchedule(checker, std::vector{left, other}).verdict) << i << ' ' << k;
      if (own != Verdict::Undecided) ++count[own == Verdict::Free ? 1 : 0];
    }
  }
  EXPECT_GE(count[0], 5);
  EXPECT_GE(count[1], 5);
}

TEST(ScheduleChecker, WhatIsNotAllowedIsNamed) {
  const Checker checker = checkerOf(crossing());
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {}, {}, kAway); }),
            "ScheduleChecker: there is no own variable");
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {"west"}, {}, kAway); }),
            "combinedCurve: group 'all' has no variable 'west'");
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {"east"}); }),
            "combinedCurve: no curve moves 'north'");
  EXPECT_EQ(messageOf([&] {
              ScheduleChecker(checker, {"east"}, {{.variables = {"east"}, .curve = pass()}}, kAway);
            }),
            "combinedCurve: two curves move 'east'");
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {"east"}, {}, kAway, {"west"}); }),
            "ScheduleChecker: the robot has no variable 'west'");
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {"east"}, {}, kAway, {}, 0.0, 0.5); }),
            "ScheduleChecker: the slowest factor is 0.5; allowed are finite numbers from 1 on");
  const std::vector<ScheduledCurve> early{
      {.variables = {"north"}, .curve = pass(-1.0), .start = 1.0}};
  EXPECT_EQ(messageOf([&] { ScheduleChecker(checker, {"east"}, early, kAway, {}, 0.0, 1.1); }),
            "ScheduleChecker: curve 1 of others begins at -1 s of its own time; with a slowdown, "
            "allowed are 0 and later");
  const ScheduleChecker beside(checker, {"east"}, {}, kAway);
  Workspace workspace(beside.checker());
  EXPECT_EQ(messageOf([&] {
              beside.certify({{0.0, 1.0}, {Eigen::MatrixXd::Zero(2, 2)}}, workspace);
            }),
            "ScheduleChecker: the curve has 2 values, expected 1");
  EXPECT_EQ(messageOf([&] { beside.certify(pass(-1.0), workspace); }),
            "ScheduleChecker: the curve begins at -1 s; allowed are 0 and later");
}

}  // namespace
}  // namespace swept
