// SPDX-License-Identifier: BSD-3-Clause
// Curves on one clock: against each curve alone, truths by hand, and samples of delays.
#include "swept/robot_model/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <random>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "crossing_robot.hpp"
#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace swept {
namespace {

using test::messageOf;

/// Cubes of 0.2 m: `east` slides along x, `north` along y, through one another at the origin.
std::shared_ptr<const Robot> crossing() {
  return Robot::parse(test::crossingUrdf({{"east", "1 0 0"}, {"north", "0 1 0"}}), "crossing.urdf");
}

/// From -1 m to 1 m at 1 m/s. The cube is within 0.2 m of the origin from 0.8 s to 1.2 s.
PiecewisePolynomial pass() {
  return controllerCurve(
      {.variables = {"x"},
       .points = {{.time = 0.0, .positions = {-1.0}, .velocities = {}, .accelerations = {}},
                  {.time = 2.0, .positions = {1.0}, .velocities = {}, .accelerations = {}}}});
}

std::vector<ScheduledCurve> passes(double startOfNorth) {
  return {{.variables = {"east"}, .curve = pass()},
          {.variables = {"north"}, .curve = pass(), .start = startOfNorth}};
}

Checker checkerOf(const std::shared_ptr<const Robot>& robot) {
  return {robot, "all", std::make_shared<World>()};
}

TEST(Schedule, WhoMeetsAtACrossingIsKnownByHand) {
  const Checker checker = checkerOf(crossing());
  for (const double start : {0.0, 0.2, 0.39, 0.41, 0.5, 3.0}) {
    const TrajectoryCertificate found = certifySchedule(checker, passes(start));
    EXPECT_EQ(found.verdict, start < 0.4 ? Verdict::Collision : Verdict::Free) << start;
    if (start >= 0.4) continue;
    ASSERT_TRUE(found.contact);
    EXPECT_NEAR(found.contact->time, 0.8 + start, 1e-3);  // the later one arrives
  }
}

TEST(Schedule, DelaysAreProvenUpToTheTruth) {
  const Checker checker = checkerOf(crossing());
  // The first one may be late until it leaves when the second one arrives: 1.2 + d = 1.8.
  const DelayCertificate late = certifyDelays(checker, passes(1.0), {.curve = 0, .latest = 2.0});
  EXPECT_EQ(late.verdict, Verdict::Collision);
  ASSERT_TRUE(late.proven);
  EXPECT_LE(*late.proven, 0.6);
  EXPECT_GE(*late.proven, 0.6 - 4e-3);
  ASSERT_TRUE(late.contact);
  EXPECT_NEAR(late.contact->delay, 0.6, 4e-3);
  EXPECT_NEAR(late.contact->contact.time, 1.8, 4e-3);

  const DelayCertificate enough = certifyDelays(checker, passes(1.0), {.curve = 0, .latest = 0.55});
  EXPECT_EQ(enough.verdict, Verdict::Free);
  EXPECT_EQ(enough.proven, 0.55);
  EXPECT_FALSE(enough.contact);
  // Who comes later may be as late as it likes.
  EXPECT_EQ(certifyDelays(checker, passes(1.0), {.curve = 1, .latest = 1000.0}).verdict,
            Verdict::Free);
}

TEST(Schedule, SlowdownsAreProvenWithDelays) {
  const Checker checker = checkerOf(crossing());
  // It leaves at d + 1.2 s. At half its speed it arrives at 1.6 and is there until 2.4.
  const DelayCertificate slow =
      certifyDelays(checker, passes(1.0), {.curve = 0, .latest = 2.0, .slowest = 1.25});
  EXPECT_EQ(slow.verdict, Verdict::Collision);
  ASSERT_TRUE(slow.proven);
  EXPECT_LE(*slow.proven, 0.3);
  EXPECT_GE(*slow.proven, 0.3 - 4e-3);
  EXPECT_EQ(certifyDelays(checker, passes(1.0), {.curve = 0, .slowest = 1.49}).proven, 0.0);
  const DelayCertificate tooSlow =
      certifyDelays(checker, passes(1.0), {.curve = 0, .slowest = 1.6});
  EXPECT_EQ(tooSlow.verdict, Verdict::Collision);
  EXPECT_FALSE(tooSlow.proven);
  ASSERT_TRUE(tooSlow.contact);
  EXPECT_NEAR(tooSlow.contact->slowdown, 1.5, 0.01);
  // Both are slower from the beginning.
  std::vector<ScheduledCurve> half = passes(1.0);
  for (ScheduledCurve& curve : half) curve.slowdown = 2.0;
  EXPECT_EQ(certifySchedule(checker, half).verdict, Verdict::Free);  // 1.6 to 2.4, and 2.6 to 3.4
  const DelayCertificate both = certifyDelays(checker, half, {.curve = 0, .latest = 1.0});
  ASSERT_TRUE(both.proven);
  EXPECT_NEAR(*both.proven, 0.2, 4e-3);
  EXPECT_LE(*both.proven, 0.2);
}

TEST(Schedule, NamesLikePatternsLeaveOutNoOtherPair) {
  // To a rule, `north*` is also the cube that the late one meets.
  const Checker checker =
      checkerOf(crossing())
          .withAttached("north*", "base", makeBox({0.1, 0.1, 0.1}),
                        Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -5.0)));
  const DelayCertificate late = certifyDelays(checker, passes(1.0), {.curve = 0, .latest = 2.0});
  EXPECT_EQ(late.verdict, Verdict::Collision);
  ASSERT_TRUE(late.proven);
  EXPECT_NEAR(*late.proven, 0.6, 4e-3);
}

TEST(Schedule, ObstaclesMoveOnWhileACurveIsLate) {
  // Both have come to rest at 3 s, and the one at (0, 1, 0) is hit after 3.81 s, unless all has
  // ended.
  const auto at = [](double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 1.0, z)); };
  const Checker checker =
      checkerOf(crossing())
          .withObstacle({.name = "hammer",
                         .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}},
                         .waypoints = {{0.0, at(4.2)}, {4.0, at(0.0)}}});
  std::vector<ScheduledCurve> curves = passes(1.0);
  std::swap(curves[0].start, curves[1].start);  // `north` rests from 2 s on, `east` from 3 s on
  EXPECT_EQ(certifySchedule(checker, curves).verdict, Verdict::Free);
  const DelayCertificate found = certifyDelays(checker, curves, {.curve = 0, .latest = 2.0});
  EXPECT_EQ(found.verdict, Verdict::Collision);
  ASSERT_TRUE(found.proven);
  const double hit = 4.0 / 1.05;  // s; it is then 0.2 m above
  EXPECT_LE(*found.proven, hit - 3.0);
  EXPECT_GE(*found.proven, hit - 3.0 - 4e-3);
}

TEST(Schedule, AContactWithoutADelayLeavesNothing) {
  const Checker checker = checkerOf(crossing());
  const DelayCertificate found = certifyDelays(checker, passes(0.1), {.curve = 1, .latest = 5.0});
  EXPECT_EQ(found.verdict, Verdict::Collision);
  EXPECT_FALSE(found.proven);
  ASSERT_TRUE(found.contact);
  EXPECT_EQ(found.contact->delay, 0.0);
}

TEST(Schedule, WhoeverStopsGetsWhatIsProvenByThen) {
  const Checker checker = checkerOf(crossing());
  std::stop_source stop;
  const DelayQuery query{.curve = 0, .latest = 0.55};
  EXPECT_EQ(certifyDelays(checker, passes(1.0), query, {}, stop.get_token()).verdict,
            Verdict::Free);
  stop.request_stop();
  const DelayCertificate none = certifyDelays(checker, passes(1.0), query, {}, stop.get_token());
  EXPECT_EQ(none.verdict, Verdict::Undecided);
  EXPECT_FALSE(none.proven || none.contact);
  EXPECT_EQ(none.curves, 0U);
  // While it works: neither more than the truth, nor all of the work.
  const DelayQuery fine{.curve = 0, .latest = 2.0, .resolution = 1e-9};
  const std::size_t all = certifyDelays(checker, passes(1.0), fine).curves;
  std::size_t ended = 0;
  for (int i = 0; i < 200 && ended < 5; ++i) {
    std::stop_source own;
    std::jthread stopper([&own, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(50 * i));
      own.request_stop();
    });
    const DelayCertificate some = certifyDelays(checker, passes(1.0), fine, {}, own.get_token());
    EXPECT_LE(some.curves, all);
    EXPECT_LE(some.proven.value_or(0.0), 0.6);
    EXPECT_NE(some.verdict, Verdict::Free);
    ended += some.proven && some.verdict == Verdict::Undecided && some.curves < all ? 1 : 0;
  }
  EXPECT_EQ(ended, 5U);
}

// ---------------------------------------------------------------------------- random curves

std::shared_ptr<const Robot> twoRooks() {
  const std::filesystem::path folder = std::filesystem::path(modelsDir()) / "robots/rook7";
  Eigen::Isometry3d right = Eigen::Isometry3d::Identity();
  right.translation() = Eigen::Vector3d(0.7, 0.0, 0.0);
  right.linear() = Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return loadWorkCell(
      {.name = "pair",
       .robots = {{.name = "left", .urdf = folder / "rook7.urdf", .srdf = folder / "rook7.srdf"},
                  {.name = "right",
                   .urdf = folder / "rook7.urdf",
                   .srdf = folder / "rook7.srdf",
                   .parent_from_robot = right}},
       .groups = {{.name = "both", .groups = {"left/arm", "right/arm"}}}});
}

std::vector<std::string> namesOf(const Robot& robot, const std::string& group) {
  std::vector<std::string> names;
  for (const int variable : robot.findGroup(group)->variables)
    names.push_back(robot.variables()[static_cast<std::size_t>(variable)].name);
  return names;
}

/// Which of positions, velocities and accelerations a trajectory has.
enum class Kind { Lines, Cubics, Quintics };

JointTrajectory randomTrajectory(std::vector<std::string> names, Kind kind, double step,
                                 std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  JointTrajectory trajectory{.variables = std::move(names), .points = {}};
  std::vector<double> q(trajectory.variables.size());
  for (double& value : q) value = 0.8 * unit(random);
  double time = 0.0;
  const int count = 2 + static_cast<int>(random() % 4);
  for (int i = 0; i < count; ++i) {
    const bool end = i == 0 || i + 1 == count;
    TrajectoryPoint point;
    point.time = time;
    for (double& value : q) value += step * unit(random);
    point.positions = q;
    for (std::size_t v = 0; v < q.size() && kind != Kind::Lines; ++v) {
      point.velocities.push_back(end ? 0.0 : step * unit(random));
      if (kind == Kind::Quintics) point.accelerations.push_back(end ? 0.0 : step * unit(random));
    }
    trajectory.points.push_back(std::move(point));
    time += 0.3 + 0.5 * std::abs(unit(random));
  }
  return trajectory;
}

/// Where a curve is at a time of the clock, by itself.
Eigen::VectorXd alone(const ScheduledCurve& curve, double time, double delay = 0.0,
                      double slowdown = 1.0) {
  return curve.curve.position((time - curve.start - delay) / (curve.slowdown * slowdown));
}

TEST(Schedule, ACombinedCurveIsThatOfEachAlone) {
  const auto robot = twoRooks();
  const Group& both = *robot->findGroup("both");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    std::vector<ScheduledCurve> curves;
    for (const std::string side : {"right", "left"})
      curves.push_back(
          {.variables = namesOf(*robot, side + "/arm"),
           .curve = controllerCurve(randomTrajectory(namesOf(*robot, side + "/arm"),
                                                     static_cast<Kind>(random() % 3), 0.5, random)),
           .start = i % 5 == 0 ? 0.0 : 2.0 * share(random),
           .slowdown = i % 4 == 0 ? 1.0 : 0.5 + share(random)});
    const CombinedCurve found = combinedCurve(*robot, both, curves);
    EXPECT_EQ(found.curve.begin(), 0.0);
    double end = 0.0;
    for (const ScheduledCurve& curve : curves)
      end = std::max(end, curve.start + curve.slowdown * curve.curve.end());
    EXPECT_NEAR(found.curve.end(), end, 1e-12 * end);
    for (int k = 0; k <= 200; ++k) {
      const double time = end * k / 200;
      const Eigen::VectorXd q = found.curve.position(time);
      for (std::size_t c = 0; c < 2; ++c) {
        const Eigen::VectorXd own = alone(curves[c], time);
        for (Eigen::Index v = 0; v < 7; ++v) {
          const Eigen::Index at = v + (c == 0 ? 7 : 0);
          const double bound = found.rounding[static_cast<std::size_t>(at)];
          EXPECT_LE(std::abs(q[at] - own[v]), bound);
          EXPECT_LT(bound, 1e-11);
          largest = std::max(largest, std::abs(q[at] - own[v]) / bound);
        }
      }
    }
  }
  EXPECT_GT(largest, 0.001);  // the bound says something
}

TEST(Schedule, WhatNoCurveMovesRests) {
  const auto robot = twoRooks();
  const Group& both = *robot->findGroup("both");
  std::mt19937 random(4);
  const std::vector<ScheduledCurve> left{
      {.variables = namesOf(*robot, "left/arm"),
       .curve = controllerCurve(
           randomTrajectory(namesOf(*robot, "left/arm"), Kind::Quintics, 0.5, random))}};
  std::vector<double> still(14);
  for (std::size_t v = 0; v < 14; ++v) still[v] = 0.1 * static_cast<double>(v);
  const CombinedCurve found = combinedCurve(*robot, both, left, still);
  for (const double time : {0.0, 0.3, 10.0})
    for (Eigen::Index v = 7; v < 14; ++v) {
      EXPECT_EQ(found.curve.position(time)[v], still[static_cast<std::size_t>(v)]);
      EXPECT_EQ(found.rounding[static_cast<std::size_t>(v)], 0.0);
    }
}

TEST(Schedule, AControllerMakesTheCurveOfItsTrajectory) {
  const auto robot = twoRooks();
  const Group& both = *robot->findGroup("both");
  std::mt19937 random(5);
  int none = 0;
  for (int i = 0; i < 90; ++i) {
    const auto first = static_cast<Kind>(i % 3);
    const auto second = static_cast<Kind>(i / 3 % 3);
    std::vector<ScheduledCurve> curves;
    for (const auto& [side, kind] : {std::pair("left", first), std::pair("right", second)})
      curves.push_back({.variables = namesOf(*robot, side + std::string("/arm")),
                        .curve = controllerCurve(randomTrajectory(
                            namesOf(*robot, side + std::string("/arm")), kind, 0.5, random)),
                        .start = 0.37 * (i % 2)});
    const CombinedCurve combined = combinedCurve(*robot, both, curves);
    const auto trajectory = controllerTrajectory(combined.curve, namesOf(*robot, "both"));
    if (!trajectory) {
      // Velocities or accelerations of one jump where those of the other one do not.
      ++none;
      EXPECT_NE(first, second);
      continue;
    }
    const PiecewisePolynomial again = controllerCurve(*trajectory);
    ASSERT_EQ(again.knots(), combined.curve.knots());
    for (int k = 0; k <= 100; ++k) {
      const double time = again.end() * k / 100;
      EXPECT_LT((again.position(time) - combined.curve.position(time)).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
  EXPECT_GT(none, 20);
  EXPECT_LT(none, 80);
}

TEST(Schedule, NothingRefutesADelay) {
  const auto robot = twoRooks();
  const Group& both = *robot->findGroup("both");
  const Checker checker(robot, both.name, std::make_shared<World>());
  Workspace workspace(checker);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int whole = 0, partly = 0, nothing = 0;
  for (int i = 0; i < 16; ++i) {
    std::vector<ScheduledCurve> curves;
    for (const std::string side : {"left", "right"})
      curves.push_back(
          {.variables = namesOf(*robot, side + "/arm"),
           .curve = controllerCurve(randomTrajectory(namesOf(*robot, side + "/arm"),
                                                     static_cast<Kind>(random() % 3), 0.6, random)),
           .start = 0.5 * share(random)});
    const DelayQuery query{.curve = i % 2 == 0 ? std::size_t{0} : std::size_t{1},
                           .latest = 0.6,
                           .slowest = i % 3 == 0 ? 1.1 : 1.0,
                           .resolution = 0.1};
    const DelayCertificate found = certifyDelays(checker, curves, query);
    if (!found.proven) {
      ++nothing;
      continue;
    }
    ++(*found.proven == query.latest ? whole : partly);
    for (int k = 0; k < 400; ++k) {
      const double delay = *found.proven * share(random);
      const double slowdown = 1.0 + (query.slowest - 1.0) * share(random);
      const double time = 6.0 * share(random);
      Eigen::VectorXd q(14);
      for (std::size_t c = 0; c < 2; ++c)
        q.segment<7>(c == 0 ? 0 : 7) =
            c == query.curve ? alone(curves[c], time, delay, slowdown) : alone(curves[c], time);
      EXPECT_NE(checker.checkState(q, workspace), Verdict::Collision) << i << ' ' << time;
    }
  }
  EXPECT_GT(whole, 2) << whole << partly << nothing;
  EXPECT_GT(partly, 1);
  EXPECT_GT(nothing, 2);
}

// ------------------------------------------------------------------------------- what is refused

std::string messageOfCombined(const std::vector<ScheduledCurve>& curves,
                              const std::vector<double>& still = {}) {
  const auto robot = crossing();
  return messageOf([&] { combinedCurve(*robot, *robot->findGroup("all"), curves, still); });
}

TEST(Schedule, RefusesWhatIsNoSchedule) {
  EXPECT_EQ(messageOfCombined({}), "combinedCurve: there is no curve");
  EXPECT_EQ(messageOfCombined({passes(0.0)[0]}), "combinedCurve: no curve moves 'north'");
  EXPECT_EQ(messageOfCombined({passes(0.0)[0], passes(0.0)[0]}),
            "combinedCurve: two curves move 'east'");
  std::vector<ScheduledCurve> bad = passes(0.0);
  bad[1].variables = {"south"};
  EXPECT_EQ(messageOfCombined(bad), "combinedCurve: group 'all' has no variable 'south'");
  bad[1].variables = {"north", "east"};
  EXPECT_EQ(messageOfCombined(bad), "combinedCurve: curve 2 has 1 values and 2 names");
  EXPECT_EQ(messageOfCombined(passes(-1.0)),
            "combinedCurve: curve 2 starts at -1 s; allowed are 0 and later");
  EXPECT_EQ(messageOfCombined(passes(std::numeric_limits<double>::quiet_NaN())),
            "combinedCurve: curve 2 starts at nan s; allowed are 0 and later");
  bad = passes(0.0);
  bad[0].slowdown = 0.0;
  EXPECT_EQ(messageOfCombined(bad),
            "combinedCurve: curve 1 has a slowdown of 0; allowed are positive numbers");
  EXPECT_EQ(messageOfCombined({passes(0.0)[0]}, {0.0, 0.0, 0.0}),
            "combinedCurve: the configuration has 3 values, expected 2");
  EXPECT_EQ(messageOf([] {
              controllerTrajectory(pass(), {"a", "b"});
            }),
            "controllerTrajectory: the curve has 1 values and 2 names");

  const Checker checker = checkerOf(crossing());
  const auto ofQuery = [&](const DelayQuery& query) {
    return messageOf([&] { certifyDelays(checker, passes(1.0), query); });
  };
  EXPECT_EQ(ofQuery({.curve = 2}), "certifyDelays: there is no curve 3, there are 2");
  EXPECT_EQ(ofQuery({.latest = -1.0}),
            "certifyDelays: the latest delay is -1 s; allowed are finite numbers from 0 on");
  EXPECT_EQ(ofQuery({.slowest = 0.5}),
            "certifyDelays: the slowest factor is 0.5; allowed are finite numbers from 1 on");
  EXPECT_EQ(ofQuery({.resolution = 0.0}),
            "certifyDelays: the resolution is 0 s; allowed are positive numbers");
}

}  // namespace
}  // namespace swept
