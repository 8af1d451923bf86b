// SPDX-License-Identifier: BSD-3-Clause
// Curves of a cube that slides past another one, against what formulas say; and cases that were
// once wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../message_of.hpp"
#include "sliding_cube.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {
namespace {

using test::cubeDistance;
using test::messageOf;

Checker cubeChecker(const CheckerOptions& options = {}) {
  return {test::slidingCube(), "all", test::worldWithCube(), options};
}

/// Bernstein coefficients of x and z.
Eigen::MatrixXd piece(const std::vector<double>& x, const std::vector<double>& z) {
  Eigen::MatrixXd coefficients(2, static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    coefficients(0, static_cast<Eigen::Index>(k)) = x[k];
    coefficients(1, static_cast<Eigen::Index>(k)) = z[k];
  }
  return coefficients;
}

PiecewisePolynomial curveOf(std::vector<double> knots, const std::vector<Eigen::MatrixXd>& pieces) {
  return {std::move(knots), pieces};
}

TEST(CertifyTrajectory, FindsTheFirstContactOfACubic) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  // x = -1 + 2 (3 u^2 - 2 u^3), u = (t - 1) / 4; it touches where x = -0.2.
  const JointTrajectory trajectory{
      {"x", "z"}, {{1.0, {-1.0, 0.0}, {0.0, 0.0}, {}}, {5.0, {1.0, 0.0}, {0.0, 0.0}, {}}}};
  double u = 0.0;
  for (double step = 0.5; step > 1e-12; step /= 2.0)
    if (3.0 * (u + step) * (u + step) - 2.0 * std::pow(u + step, 3) < 0.4) u += step;
  const double touches = 1.0 + 4.0 * u;
  const TrajectoryCertificate found =
      checker.certifyTrajectory(controllerCurve(trajectory), workspace);
  ASSERT_EQ(found.verdict, Verdict::Collision);
  const double speed = 2.0 * 6.0 * u * (1.0 - u) / 4.0;
  EXPECT_NEAR(found.contact->time, touches, 1e-3 / speed);
  EXPECT_NEAR(found.freeUntil, touches, 1e-3 / speed);
  EXPECT_LE(found.freeUntil, touches);
  EXPECT_EQ(found.contact->piece, 0U);
  EXPECT_NEAR(found.contact->witness.t, (found.contact->time - 1.0) / 4.0, 1e-12);
  EXPECT_NEAR(found.contact->configuration[0], -0.2, 1e-3);
  EXPECT_TRUE(found.contact->witness.configuration.empty());
}

TEST(CertifyTrajectory, SaysHowFarAwayItStays) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  // Over the block: z is at least 0.5 at the middle of the second piece.
  const PiecewisePolynomial curve =
      curveOf({0.0, 1.0, 3.0, 4.0},
              {piece({-1.0, -0.5}, {0.9, 0.8}), piece({-0.5, 0.0, 0.5}, {0.8, 0.2, 0.8}),
               piece({0.5, 1.0}, {0.8, 0.9})});
  TrajectoryQuery query;
  query.clearances = true;
  const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace, query);
  EXPECT_EQ(found.verdict, Verdict::Free);
  EXPECT_EQ(found.freeUntil, 4.0);
  EXPECT_LE(found.world->lower, 0.3);
  EXPECT_GE(found.world->upper, 0.3 - 1e-9);
  EXPECT_LT(found.world->upper - found.world->lower, 1e-4);
  EXPECT_NEAR(found.world->time, 2.0, 0.1);
  EXPECT_EQ(found.world->piece, 1U);
  EXPECT_EQ(found.world->bodyA, "cube");
  EXPECT_TRUE(std::isinf(found.self->lower));
}

TEST(CertifyTrajectory, ListsTheLargestViolationsOfLimits) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  // z = 0.5 + 4 u (1 - u) has its largest value 1.5 at 1/2, its largest rate 4 / T = 2 at the
  // ends.
  const PiecewisePolynomial curve = curveOf({0.0, 2.0}, {piece({-1.0, 0.0, 1.0}, {0.5, 2.5, 0.5})});
  TrajectoryQuery query;
  query.limits = RateLimits{{0.5, 1.9}, {1.0, 1.9}, {1.0, 1.0}};
  const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace, query);
  ASSERT_EQ(found.violations.size(), 3U);
  EXPECT_EQ(found.violations[0].variable, "x");
  EXPECT_EQ(found.violations[0].kind, LimitKind::Velocity);
  EXPECT_NEAR(found.violations[0].value, 1.0, 1e-12);
  EXPECT_EQ(found.violations[0].limit, 0.5);
  EXPECT_EQ(found.violations[1].variable, "z");
  EXPECT_EQ(found.violations[1].kind, LimitKind::Velocity);
  EXPECT_NEAR(std::abs(found.violations[1].value), 2.0, 1e-12);
  EXPECT_EQ(found.violations[2].kind, LimitKind::Acceleration);
  EXPECT_NEAR(found.violations[2].value, -2.0, 1e-12);
  EXPECT_EQ(found.violations[2].limit, 1.9);
}

/// Its first piece comes within a micrometre of the block, which is not decided; in the next one it
/// meets it. A query about the first contact once ended with the first piece.
TEST(CertifyTrajectory, EveryQueryGivesTheSameVerdict) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const double grazing = 2.0 * (0.2 + 1e-6) - 1.0;
  const PiecewisePolynomial curve =
      curveOf({0.0, 1.0, 2.0},
              {piece({0.0, 0.0, 0.0}, {1.0, grazing, 1.0}), piece({0.0, 0.0}, {1.0, 0.0})});
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
    const TrajectoryCertificate found =
        checker.certifyTrajectory(curve, workspace, {.contact = query});
    EXPECT_EQ(found.verdict, Verdict::Collision);
    EXPECT_FALSE(found.undecided);
    EXPECT_NEAR(found.contact->configuration[1], 0.1, 0.11);
    if (query == MotionQuery::FirstContact) {
      EXPECT_NEAR(found.freeUntil, 0.5, 0.05);
      EXPECT_NEAR(found.contact->time, 1.8, 0.01);
    }
  }
  const PiecewisePolynomial first = curveOf({0.0, 1.0}, {curve.coefficients(0)});
  const TrajectoryCertificate found = checker.certifyTrajectory(first, workspace);
  ASSERT_EQ(found.verdict, Verdict::Undecided);
  EXPECT_NEAR(found.undecided->time, 0.5, 0.05);
  EXPECT_FALSE(found.contact);
}

/// A body that floats, with a rotor that turns without limits.
std::shared_ptr<const Robot> flyer() {
  return Robot::parse(
      "<robot name='flyer'><link name='hull'><collision><geometry><box size='1 0.1 "
      "0.1'/></geometry>"
      "</collision></link><link name='rotor'><collision><origin xyz='0.1 0 0'/><geometry>"
      "<sphere radius='0.02'/></geometry></collision></link><joint name='spin' type='continuous'>"
      "<parent link='hull'/><child link='rotor'/><origin xyz='0 0 0.3'/><axis xyz='0 0 1'/></joint>"
      "</robot>",
      "flyer.urdf",
      "<robot name='flyer'><virtual_joint name='flight' type='floating' parent_frame='world' "
      "child_link='hull'/><group name='all'><joint name='flight'/><joint "
      "name='spin'/></group></robot>",
      "flyer.srdf");
}

std::shared_ptr<const World> pole(double x, double y) {
  auto world = std::make_shared<World>();
  world->add(WorldBody{.name = "pole",
                       .parts = {{makeBox({0.02, 0.02, 0.02}),
                                  Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.0))}}});
  return world;
}

/// From no turn to a quarter turn about z, while the rotor turns.
PiecewisePolynomial quarterTurn(double rotor) {
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(8, 2);
  ends(6, 0) = 1.0;
  ends(5, 1) = ends(6, 1) = std::numbers::sqrt2 / 2.0;
  ends(7, 1) = rotor;
  return {{0.0, 1.0}, {ends}};
}

/// Where one joint turns by more than half a turn, the orientation was once taken for constant.
TEST(CertifyTrajectory, AnOrientationFollowsSlerpBesideAnyTurn) {
  for (const double rotor : {1.0, 4.0, 50.0}) {
    const Checker checker(flyer(), "all", pole(0.3, 0.3));
    Workspace workspace(checker);
    const TrajectoryCertificate found = checker.certifyTrajectory(quarterTurn(rotor), workspace);
    ASSERT_EQ(found.verdict, Verdict::Collision) << rotor;
    EXPECT_NEAR(found.contact->time, 0.5, 0.15);
    // The components of the configuration are those of slerp, not of the polynomial.
    const Eigen::VectorXd& q = found.contact->configuration;
    EXPECT_NEAR(q.segment(3, 4).norm(), 1.0, 1e-12);
    EXPECT_NEAR(2.0 * std::atan2(q[5], q[6]), found.contact->time * std::numbers::pi / 2.0, 1e-9);
    EXPECT_NEAR(q[7], found.contact->time * rotor, 1e-9);
    EXPECT_NE(checker.checkState(q, workspace), Verdict::Free);
    const Checker beside(flyer(), "all", pole(0.3, -0.3));
    Workspace other(beside);
    EXPECT_EQ(beside.certifyTrajectory(quarterTurn(rotor), other).verdict, Verdict::Free);
  }
}

/// Values of joints without limits keep the turns that the curve counts.
TEST(CertifyTrajectory, AContactBesideTheCurveIsNearIt) {
  CheckerOptions options;
  options.tracking.joints["spin"].rotation = 0.3;
  auto world = std::make_shared<World>();
  world->add(WorldBody{.name = "pole",
                       .parts = {{makeBox({0.02, 0.02, 0.02}),
                                  Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.125, 0.3))}}});
  const Checker checker(flyer(), "all", world, options);
  Workspace workspace(checker);
  const double turns = 6.0 * std::numbers::pi;
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(8, 2);
  ends.row(6).setOnes();
  ends.row(7) << turns, turns + 1.25;  // a quarter turn would meet it
  const PiecewisePolynomial curve({0.0, 1.0}, {ends});
  const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace);
  ASSERT_EQ(found.verdict, Verdict::Collision);
  const double off = found.contact->configuration[7] - curve.position(found.contact->time)[7];
  EXPECT_GT(off, 0.2);
  EXPECT_LE(off, 0.3 + 1e-12);
  EXPECT_EQ(found.contact->witness.configuration[7], found.contact->configuration[7]);
}

TEST(CertifyTrajectory, NamesWhatItCannotTake) {
  const Checker checker = cubeChecker();
  Workspace workspace(checker);
  const PiecewisePolynomial curve = curveOf({0.0, 1.0}, {piece({-1.0, 1.0}, {1.0, 1.0})});
  const auto of = [&](const TrajectoryQuery& query) {
    return messageOf([&] { checker.certifyTrajectory(curve, workspace, query); });
  };
  EXPECT_EQ(of({}), "");
  EXPECT_EQ(of({.limits = RateLimits{{1.0}, {1.0, 1.0}, {1.0, 1.0}}}),
            "Checker: RateLimits::velocity of group 'all' has 2 values, not 1");
  EXPECT_EQ(of({.limits = RateLimits{{1.0, 1.0}, {}, {1.0, 1.0}}}),
            "Checker: RateLimits::acceleration of group 'all' has 2 values, not 0");
  EXPECT_EQ(of({.limits = RateLimits{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0, 1.0}}}),
            "Checker: RateLimits::jerk of group 'all' has 2 values, not 3");
  EXPECT_EQ(of({.clock = std::nan("")}), "Checker: clock nan s must be a finite number");
  EXPECT_EQ(of({.clock = HUGE_VAL}), "Checker: clock inf s must be a finite number");
  const PiecewisePolynomial wide({0.0, 1.0}, {Eigen::MatrixXd::Zero(3, 2)});
  EXPECT_EQ(messageOf([&] { checker.certifyTrajectory(wide, workspace); }),
            "Checker: a curve of group 'all' has 2 values, not 3");
  const Checker flying(flyer(), "all", pole(0.3, 0.3));
  Workspace other(flying);
  Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(8, 4);
  turns.row(6).setOnes();
  turns(5, 2) = 0.1;
  EXPECT_EQ(messageOf([&] {
              flying.certifyTrajectory(PiecewisePolynomial({0.0, 1.0}, {turns}), other);
            }),
            "Checker: the orientation of floating joint 'flight' changes along a piece of a higher "
            "degree than 1: its components are no polynomials; allowed are pieces of degree 1 "
            "(slerp)");
}

}  // namespace
}  // namespace swept
