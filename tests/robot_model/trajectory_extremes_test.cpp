// SPDX-License-Identifier: BSD-3-Clause
// Curves in time at the ends of what there is: pieces, times, degrees, coefficients and limits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../heap_counter.hpp"
#include "sliding_cube.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {
namespace {

using Row = std::vector<double>;

Checker cubeChecker(const CheckerOptions& options = {}) {
  return {test::slidingCube(), "all", test::worldWithCube(), options};
}

/// Bernstein coefficients of x, at z = 0.
Eigen::MatrixXd alongX(const Row& x) {
  Eigen::MatrixXd piece = Eigen::MatrixXd::Zero(2, static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) piece(0, static_cast<Eigen::Index>(k)) = x[k];
  return piece;
}

PiecewisePolynomial curveOf(Row knots, const std::vector<Row>& pieces) {
  std::vector<Eigen::MatrixXd> coefficients;
  for (const Row& x : pieces) coefficients.push_back(alongX(x));
  return {std::move(knots), std::move(coefficients)};
}

/// From rest to rest.
Row restToRest(double from, double to) {
  return {from, from, to, to};
}

TEST(TrajectoryExtremes, PiecesOfAMicrosecondAndOfAnHour) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const Row knots{0.0, 3600.0, 3600.000001, 7200.000001, 7200.000002, 10800.0};
  // Their rates join: all are one run. It stays 5 cm away from the block.
  const std::vector<Row> pieces{restToRest(-2.0, -0.3), restToRest(-0.3, -0.30001),
                                restToRest(-0.30001, -0.25), restToRest(-0.25, -0.25),
                                restToRest(-0.25, -1.0)};
  const TrajectoryCertificate free = checker.certifyTrajectory(curveOf(knots, pieces), workspace);
  EXPECT_EQ(free.verdict, Verdict::Free);
  EXPECT_LT(free.effort.intervals, 2000);
  std::vector<Row> meets = pieces;
  meets[3] = restToRest(-0.25, -0.15);  // within a microsecond
  meets[4] = restToRest(-0.15, -1.0);
  const TrajectoryCertificate found = checker.certifyTrajectory(curveOf(knots, meets), workspace);
  ASSERT_EQ(found.verdict, Verdict::Collision);
  EXPECT_EQ(found.contact->piece, 3U);
  EXPECT_NEAR(found.contact->configuration[0], -0.2, 2e-3);
  EXPECT_GE(found.freeUntil, 7200.0);
}

TEST(TrajectoryExtremes, KnotsAMillionSecondsFromZero) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  for (const double begin : {1e6, -1e6, 1e9}) {
    const PiecewisePolynomial curve = curveOf({begin, begin + 0.25, begin + 0.5},
                                              {restToRest(-1.0, -0.5), restToRest(-0.5, 1.0)});
    const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace);
    ASSERT_EQ(found.verdict, Verdict::Collision) << begin;
    EXPECT_EQ(found.contact->piece, 1U);
    EXPECT_NEAR(curve.position(found.contact->time)[0], -0.2, 2e-3);
    EXPECT_LE(curve.position(found.freeUntil)[0], -0.2);
    EXPECT_GE(curve.position(found.freeUntil)[0], -0.203);
    const PiecewisePolynomial beside = curveOf({begin, begin + 0.25}, {restToRest(-1.0, -0.201)});
    EXPECT_EQ(checker.certifyTrajectory(beside, workspace).verdict, Verdict::Free) << begin;
  }
}

/// Velocities that do not fit the positions carry the cube past them.
TEST(TrajectoryExtremes, VelocitiesThatOvershoot) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const auto between = [](double velocity) {
    return controllerCurve(
        {{"x", "z"},
         {{0.0, {-1.0, 0.0}, {velocity, 0.0}, {}}, {2.0, {-1.0, 0.0}, {-velocity, 0.0}, {}}}});
  };
  // Half a second's way beyond.
  EXPECT_EQ(checker.certifyTrajectory(between(1.5), workspace).verdict, Verdict::Free);
  EXPECT_EQ(checker.certifyTrajectory(between(1.7), workspace).verdict, Verdict::Collision);
  // Past the limit -3 of a joint that slides: there is no robot there.
  const TrajectoryCertificate outside = checker.certifyTrajectory(between(-4.01), workspace);
  EXPECT_EQ(outside.verdict, Verdict::Undecided);
  ASSERT_EQ(outside.violations.size(), 1U);
  EXPECT_EQ(outside.violations[0].variable, "x");
  EXPECT_NEAR(outside.violations[0].value, -3.005, 1e-12);
  EXPECT_EQ(outside.violations[0].limit, -3.0);
  EXPECT_NEAR(outside.violations[0].time, 1.0, 1e-6);
}

TEST(TrajectoryExtremes, AValueThatTouchesALimitIsWithinIt) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const auto until = [](double limit) {
    return curveOf({0.0, 1.0}, {Row{2.0, 2.0 * limit - 2.0, 2.0}});
  };
  for (const double limit : {3.0, 3.00001}) {
    const TrajectoryCertificate found = checker.certifyTrajectory(until(limit), workspace);
    EXPECT_EQ(found.verdict, Verdict::Free) << limit;
    EXPECT_TRUE(found.violations.empty()) << limit;
  }
  const TrajectoryCertificate beyond = checker.certifyTrajectory(until(3.00002), workspace);
  EXPECT_EQ(beyond.verdict, Verdict::Undecided);
  ASSERT_EQ(beyond.violations.size(), 1U);
  EXPECT_NEAR(beyond.violations[0].value, 3.00002, 1e-9);
  // From there on, too.
  const PiecewisePolynomial from =
      curveOf({0.0, 1.0, 2.0}, {Row{3.0, 3.0, 3.0}, Row{3.0, 2.0, 2.5}});
  EXPECT_EQ(checker.certifyTrajectory(from, workspace).verdict, Verdict::Free);
}

/// The coefficients of Chebyshev's polynomial are 86 times its values: they cancel.
TEST(TrajectoryExtremes, CoefficientsThatCancel) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const auto choose = [](int n, int k) {
    return std::round(
        std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0)));
  };
  const auto chebyshev = [&](double middle, double size) {
    Row x;
    for (int k = 0; k <= 7; ++k)
      x.push_back(middle + size * (k % 2 == 0 ? -1.0 : 1.0) * choose(14, 2 * k) / choose(7, k));
    return x;
  };
  const auto verdict = [&](double middle, double size) {
    const PiecewisePolynomial curve = curveOf({0.0, 0.01}, {chebyshev(middle, size)});
    EXPECT_GT(curve.coefficients(0).cwiseAbs().maxCoeff(), 80.0 * size);
    EXPECT_NEAR(curve.position(0.01)[0], middle + size, 1e-12);
    return checker.certifyTrajectory(curve, workspace).verdict;
  };
  EXPECT_EQ(verdict(-1.5, 1.295), Verdict::Free);
  EXPECT_EQ(verdict(-1.5, 1.305), Verdict::Collision);
  // Limits are compared with values, and not with coefficients.
  EXPECT_TRUE(checker.certifyTrajectory(curveOf({0.0, 0.01}, {chebyshev(-1.5, 1.295)}), workspace)
                  .violations.empty());
}

/// No bound of use: the answer is not free, and comes.
TEST(TrajectoryExtremes, HugeCoefficientsAreNotFree) {
  CheckerOptions options;
  options.maxIntervals = 2000;
  const auto robot = Robot::parse(
      "<robot name='r'><link name='base'/><link name='arm'><collision><origin xyz='1 0 0'/>"
      "<geometry><sphere radius='0.1'/></geometry></collision></link><joint name='turn' "
      "type='continuous'><parent link='base'/><child link='arm'/><axis xyz='0 0 "
      "1'/></joint></robot>",
      "r.urdf");
  auto world = std::make_shared<World>();
  world->add(WorldBody{.name = "post",
                       .parts = {{makeBox({0.1, 0.1, 0.1}),
                                  Eigen::Isometry3d(Eigen::Translation3d(-1.0, 0.0, 0.0))}}});
  const Checker checker(robot, "all", world, options);
  Workspace workspace(checker);
  for (const double size : {1e3, 1e9, 1e100, 1e300}) {
    Eigen::MatrixXd piece = Eigen::MatrixXd::Zero(1, 8);
    piece(0, 3) = size;
    piece(0, 4) = -size;
    for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
      const TrajectoryCertificate found = checker.certifyTrajectory(
          PiecewisePolynomial({0.0, 1.0}, {piece}), workspace, {.contact = query});
      EXPECT_NE(found.verdict, Verdict::Free) << size;
    }
  }
}

/// A joint without limits goes as many turns as its polynomial says.
TEST(TrajectoryExtremes, SeveralTurns) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='base'/><link name='arm'><collision><origin xyz='1 0 0'/>"
      "<geometry><sphere radius='0.1'/></geometry></collision></link><joint name='turn' "
      "type='continuous'><parent link='base'/><child link='arm'/><axis xyz='0 0 "
      "1'/></joint></robot>",
      "r.urdf");
  const auto before = [&](double x) {
    auto world = std::make_shared<World>();
    world->add(WorldBody{.name = "post",
                         .parts = {{makeBox({0.1, 0.1, 0.1}),
                                    Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0))}}});
    return Checker(robot, "all", world);
  };
  const auto turns = [](double from, double to) {
    Eigen::MatrixXd piece(1, 4);
    piece << from, from, to, to;
    return PiecewisePolynomial({0.0, 10.0}, {piece});
  };
  const Checker hit = before(-1.0);
  const Checker beyond = before(-1.16);
  Workspace workspace(hit), other(beyond);
  for (const double from : {0.0, 20.0 * std::numbers::pi, -1000.0 * std::numbers::pi}) {
    const TrajectoryCertificate found =
        hit.certifyTrajectory(turns(from, from + 7.0 * std::numbers::pi), workspace);
    ASSERT_EQ(found.verdict, Verdict::Collision);
    EXPECT_NEAR(found.contact->configuration[0] - from, std::numbers::pi, 0.16);
    EXPECT_LT(found.contact->configuration[0] - from, std::numbers::pi);
    EXPECT_EQ(beyond.certifyTrajectory(turns(from, from + 7.0 * std::numbers::pi), other).verdict,
              Verdict::Free);
    // A whole turn and a straight line: no shorter way is taken.
    const PiecewisePolynomial straight({0.0, 1.0},
                                       {(Eigen::MatrixXd(1, 2) << from, from + 6.0).finished()});
    EXPECT_EQ(hit.certifyTrajectory(straight, workspace).verdict, Verdict::Collision);
  }
}

/// A million knots need no more memory than a few.
TEST(TrajectoryExtremes, AMillionKnots) {
  constexpr int kKnots = 1'000'000;
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  std::vector<double> knots;
  std::vector<Eigen::MatrixXd> pieces;
  const auto at = [](int i) { return -1.0 + 0.7 * std::sin(1e-4 * i); };
  const auto rate = [](int i) { return 0.7 * 1e-4 * std::cos(1e-4 * i); };
  for (int i = 0; i < kKnots; ++i) {
    knots.push_back(1e-3 * i);
    if (i + 1 < kKnots)
      pieces.push_back(
          alongX({at(i), at(i) + rate(i) / 3.0, at(i + 1) - rate(i + 1) / 3.0, at(i + 1)}));
  }
  const PiecewisePolynomial curve(std::move(knots), std::move(pieces));
  TrajectoryQuery query;
  query.limits = RateLimits{{0.1, 0.1}, {1.0, 1.0}, {1.0, 1.0}};
  checker.certifyTrajectory(curve, workspace, query);
  const long before = test::allocations;
  const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace, query);
  EXPECT_EQ(test::allocations - before, 0);
  EXPECT_EQ(found.verdict, Verdict::Free);
  EXPECT_EQ(found.freeUntil, curve.end());
  EXPECT_TRUE(found.violations.empty());
}

}  // namespace
}  // namespace swept
