// SPDX-License-Identifier: BSD-3-Clause
// The last check of a timed path: its curve against the limits.
#include "trajectory/rate_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "trajectory/blend_search.hpp"
#include "trajectory/timed_path.hpp"

namespace swept::detail {
namespace {

VariableLimits limitsOf(double speed, double acceleration, double jerk, bool ramps) {
  VariableLimits limits;
  limits.speed = Eigen::VectorXd::Constant(2, speed);
  limits.acceleration = Eigen::VectorXd::Constant(2, acceleration);
  limits.jerk = Eigen::VectorXd::Constant(2, jerk);
  limits.ramps = ramps;
  return limits;
}

/// The first value stays. The second one has these coefficients, over 2 s, as the last of two
/// pieces.
PiecewisePolynomial curveOf(const std::vector<double>& coefficients) {
  Eigen::MatrixXd stay = Eigen::MatrixXd::Constant(2, 2, coefficients.front());
  Eigen::MatrixXd piece(2, std::ssize(coefficients));
  piece.row(0).setConstant(coefficients.front());
  piece.row(1) = Eigen::RowVectorXd::Map(coefficients.data(), std::ssize(coefficients));
  std::vector<Eigen::MatrixXd> pieces;
  pieces.push_back(stay);
  pieces.push_back(piece);
  return {{0.0, 1.0, 3.0}, pieces};
}

TEST(RateCheck, ComparesEachRateWithItsLimit) {
  // q = t^2 / 4 - t^3 / 12: velocity t / 2 - t^2 / 4, acceleration (1 - t) / 2, jerk -1 / 2.
  const PiecewisePolynomial curve = curveOf({0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0});
  EXPECT_TRUE(keepsLimits(curve, limitsOf(0.26, 0.501, 0.501, true)));
  EXPECT_FALSE(keepsLimits(curve, limitsOf(0.24, 0.501, 0.501, true)));
  EXPECT_FALSE(keepsLimits(curve, limitsOf(0.26, 0.499, 0.501, true)));
  EXPECT_FALSE(keepsLimits(curve, limitsOf(0.26, 0.501, 0.499, true)));
  EXPECT_TRUE(keepsLimits(curve, limitsOf(0.26, 0.501, 0.499, false)));
}

TEST(RateCheck, FindsTheLargestAccelerationOfABlend) {
  // The speed 3 u^2 - 2 u^3 with u = t / 2: the acceleration 3 u (1 - u) is 0.75 in the middle,
  // where the coefficients say 1.
  const PiecewisePolynomial curve = curveOf({0.0, 0.0, 0.0, 0.2, 0.6, 1.0});
  EXPECT_NEAR(curve.acceleration(2.0)[1], 0.75, 1e-12);
  EXPECT_TRUE(keepsLimits(curve, limitsOf(1.01, 0.751, 1.51, true)));
  EXPECT_FALSE(keepsLimits(curve, limitsOf(1.01, 0.749, 1.51, true)));
}

/// The time between two points is doubled as often as needed; leastStepFor() knows how long it must
/// be.
TEST(RateCheck, LengthensStepsUntilRoundingBreaksNoLimit) {
  Eigen::MatrixXd points(2, 12);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) << 1e3 + 1e-3 * static_cast<double>(i), i % 2 == 0 ? 0.0 : 1e-4;
  const VariableLimits limits = [] {
    VariableLimits some = limitsOf(1.0, 5.0, std::numeric_limits<double>::infinity(), false);
    some.slack = kSlack;
    return some;
  }();
  const WayPointPath path =
      straightParts(points, std::vector<char>(12), withSlack(limits), {"a", "b"});
  const auto shortestOf = [&](double leastStep) {
    CornerSpeeds speeds(path, leastStep);
    chooseBlends(path, 0.1, speeds);
    const TimedPath timed = timedPath(path, speeds, {"a", "b"}, limits, leastStep);
    EXPECT_TRUE(keepsLimits(timed.curve, limits));
    double shortest = 1.0;
    for (std::size_t i = 0; i < timed.curve.pieces(); ++i)
      shortest = std::min(shortest, timed.curve.knots()[i + 1] - timed.curve.knots()[i]);
    return shortest;
  };
  const double known = leastStepFor(path, 1.0);
  EXPECT_GE(shortestOf(known), known);
  EXPECT_LT(shortestOf(known), 2.0 * known);  // at once
  EXPECT_GT(shortestOf(1e-9), 1e-7);
}

}  // namespace
}  // namespace swept::detail
