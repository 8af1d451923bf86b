// SPDX-License-Identifier: BSD-3-Clause
// Curves of knots and of B-splines, against the formulas that define them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {
namespace {

std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

using Row = std::vector<double>;

/// The polynomial of ros2_control in powers of time since the first point, by its published
/// coefficients.
struct Powers {
  double c[6] = {};
  double at(double t) const {
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  }
  double rate(double t) const {
    return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])));
  }
  double rateOfRate(double t) const {
    return 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]));
  }
};

Powers linear(double p0, double p1, double T) {
  return {{p0, (p1 - p0) / T}};
}

Powers cubic(double p0, double v0, double p1, double v1, double T) {
  return {{p0, v0, (-3 * p0 + 3 * p1 - 2 * v0 * T - v1 * T) / (T * T),
           (2 * p0 - 2 * p1 + v0 * T + v1 * T) / (T * T * T)}};
}

Powers quintic(double p0, double v0, double a0, double p1, double v1, double a1, double T) {
  const double T2 = T * T;
  const double T3 = T2 * T;
  return {
      {p0, v0, 0.5 * a0,
       (-20 * p0 + 20 * p1 - 3 * a0 * T2 + a1 * T2 - 12 * v0 * T - 8 * v1 * T) / (2 * T3),
       (30 * p0 - 30 * p1 + 3 * a0 * T2 - 2 * a1 * T2 + 16 * v0 * T + 14 * v1 * T) / (2 * T3 * T),
       (-12 * p0 + 12 * p1 - a0 * T2 + a1 * T2 - 6 * v0 * T - 6 * v1 * T) / (2 * T3 * T2)}};
}

TEST(ControllerCurve, IsThePolynomialThatBothPointsHaveTheDataOf) {
  std::mt19937 random(47);
  std::uniform_real_distribution<double> value(-2.0, 2.0);
  std::uniform_real_distribution<double> length(0.1, 3.0);
  int seen[3] = {};
  for (int round = 0; round < 600; ++round) {
    TrajectoryPoint from;
    TrajectoryPoint to;
    from.time = length(random) - 0.1;
    to.time = from.time + length(random);
    const double T = to.time - from.time;
    const int kind = round % 3;
    const double p0 = value(random), p1 = value(random), v0 = value(random), v1 = value(random),
                 a0 = value(random), a1 = value(random);
    from.positions = {p0, 1.0};
    to.positions = {p1, 1.0};
    if (kind > 0 || round % 2 == 0)
      from.velocities = {v0, 0.0};  // what only one has, does not count
    if (kind > 0) to.velocities = {v1, 0.0};
    if (kind > 1 || round % 4 == 0) to.accelerations = {a1, 0.0};
    if (kind > 1) from.accelerations = {a0, 0.0};
    const Powers expected = kind == 0   ? linear(p0, p1, T)
                            : kind == 1 ? cubic(p0, v0, p1, v1, T)
                                        : quintic(p0, v0, a0, p1, v1, a1, T);
    ++seen[kind];
    const PiecewisePolynomial curve = controllerCurve({{"a", "b"}, {from, to}});
    ASSERT_EQ(curve.degree(0), 2 * kind + 1);
    for (int i = 0; i <= 20; ++i) {
      const double t = T * i / 20.0;
      EXPECT_NEAR(curve.position(from.time + t)[0], expected.at(t), 1e-12);
      EXPECT_NEAR(curve.velocity(from.time + t)[0], expected.rate(t), 1e-10);
      EXPECT_NEAR(curve.acceleration(from.time + t)[0], expected.rateOfRate(t), 1e-8);
      EXPECT_NEAR(curve.position(from.time + t)[1], 1.0, 1e-15);
    }
  }
  EXPECT_GT(seen[0] * seen[1] * seen[2], 0);
}

TEST(ControllerCurve, BeginsWhereTheRobotIs) {
  const JointTrajectory trajectory{{"a"}, {{1.0, {2.0}, {0.5}, {}}, {2.0, {3.0}, {0.0}, {}}}};
  EXPECT_EQ(controllerCurve(trajectory).begin(), 1.0);
  const PiecewisePolynomial curve = controllerCurve(trajectory, Row{1.0});
  EXPECT_EQ(curve.begin(), 0.0);
  EXPECT_EQ(curve.position(0.0)[0], 1.0);
  EXPECT_EQ(curve.velocity(0.0)[0], 0.0);
  EXPECT_NEAR(curve.velocity(1.0)[0], 0.5, 1e-15);
  // A point at time 0 is where it begins, wherever the robot is.
  EXPECT_EQ(controllerCurve({{"a"}, {{0.0, {2.0}, {}, {}}, {1.0, {3.0}, {}, {}}}}, Row{1.0})
                .position(0.0)[0],
            2.0);
}

TEST(ControllerCurve, NamesWhatItCannotTake) {
  const auto of = [](std::vector<TrajectoryPoint> points, Row start = {}) {
    return messageOf([&] { controllerCurve({{"a", "b"}, points}, start); });
  };
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of({}), "controllerCurve: the trajectory has no point");
  EXPECT_EQ(of({{0.0, {1.0}, {}, {}}}), "controllerCurve: point 0 has 1 positions, expected 2");
  EXPECT_EQ(of({{0.0, {1.0, 2.0}, {1.0}, {}}}),
            "controllerCurve: point 0 has 1 velocities, expected 2");
  EXPECT_EQ(of({{0.0, {1.0, kNone}, {}, {}}}),
            "controllerCurve: point 0 has positions that are not finite");
  EXPECT_EQ(of({{0.0, {1.0, 2.0}, {}, {}}, {0.0, {1.0, 2.0}, {}, {}}}),
            "controllerCurve: point 1 is at 0 s, allowed is more than 0");
  EXPECT_EQ(of({{-1.0, {1.0, 2.0}, {}, {}}}),
            "controllerCurve: point 0 is at -1 s, allowed is 0 or more");
  EXPECT_EQ(of({{0.0, {1.0, 2.0}, {}, {}}}, {1.0}),
            "controllerCurve: the start has 1 values, expected 2");
  EXPECT_EQ(of({{0.0, {1.0, 2.0}, {}, {}}}),
            "controllerCurve: the trajectory has one point, at which the robot stays: give the "
            "state that it starts from");
}

/// The B-spline of some degree by its basis functions (Cox and de Boor).
double basis(const std::vector<double>& knots, std::size_t i, int degree, double t) {
  if (degree == 0) return t >= knots[i] && t < knots[i + 1] ? 1.0 : 0.0;
  const auto d = static_cast<std::size_t>(degree);
  double sum = 0.0;
  if (knots[i + d] > knots[i])
    sum += (t - knots[i]) / (knots[i + d] - knots[i]) * basis(knots, i, degree - 1, t);
  if (knots[i + d + 1] > knots[i + 1])
    sum += (knots[i + d + 1] - t) / (knots[i + d + 1] - knots[i + 1]) *
           basis(knots, i + 1, degree - 1, t);
  return sum;
}

TEST(PiecewisePolynomial, OfABSplineIsThatSpline) {
  std::mt19937 random(48);
  std::uniform_real_distribution<double> value(-2.0, 2.0);
  std::uniform_real_distribution<double> length(0.05, 1.0);
  for (int degree = 1; degree <= PiecewisePolynomial::kMaxDegree; ++degree) {
    for (int round = 0; round < 20; ++round) {
      const int points = degree + 1 + round % 5;
      std::vector<double> knots{0.0};
      // Repeated at the ends, and sometimes in between.
      while (knots.size() < static_cast<std::size_t>(points + degree + 1)) {
        const bool repeats =
            knots.size() <= static_cast<std::size_t>(degree) ||
            (degree > 1 && round % 3 == 0 && knots.size() > static_cast<std::size_t>(degree) + 1 &&
             knots.size() % 4 == 1);
        knots.push_back(knots.back() + (repeats ? 0.0 : length(random)));
      }
      Eigen::MatrixXd control(2, points);
      for (Eigen::Index i = 0; i < control.size(); ++i) control.data()[i] = value(random);
      const PiecewisePolynomial curve = PiecewisePolynomial::bSpline(degree, knots, control);
      EXPECT_EQ(curve.begin(), knots[static_cast<std::size_t>(degree)]);
      EXPECT_EQ(curve.end(), knots[static_cast<std::size_t>(points)]);
      for (int i = 0; i < 40; ++i) {
        const double t = curve.begin() + curve.duration() * (i + 0.5) / 40.0;
        double expected = 0.0;
        for (int k = 0; k < points; ++k)
          expected += basis(knots, static_cast<std::size_t>(k), degree, t) * control(0, k);
        EXPECT_NEAR(curve.position(t)[0], expected, 1e-11);
      }
    }
  }
}

/// The orientation of a floating joint must not change along a piece of a higher degree than 1:
/// shares of 1 once made of a constant what differs in the last bit.
TEST(PiecewisePolynomial, OfABSplineKeepsWhatIsConstant) {
  std::mt19937 random(49);
  std::uniform_real_distribution<double> value(-2.0, 2.0);
  std::uniform_real_distribution<double> length(0.05, 1.0);
  for (int degree = 2; degree <= PiecewisePolynomial::kMaxDegree; ++degree) {
    std::vector<double> knots{0.3};
    while (knots.size() < 20) knots.push_back(knots.back() + length(random));
    Eigen::MatrixXd control(8, 19 - degree);
    for (Eigen::Index i = 0; i < control.rows(); ++i) control.row(i).setConstant(value(random));
    const PiecewisePolynomial curve = PiecewisePolynomial::bSpline(degree, knots, control);
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece)
      EXPECT_TRUE((curve.coefficients(piece).colwise() - control.col(0)).isZero(0.0));
  }
}

TEST(PiecewisePolynomial, NamesWhatItCannotTake) {
  using Pieces = std::vector<Eigen::MatrixXd>;
  Eigen::MatrixXd line(1, 2);
  line << 0.0, 1.0;
  Eigen::MatrixXd next(1, 2);
  next << 1.5, 2.0;
  const Eigen::MatrixXd steep = Eigen::MatrixXd::Zero(1, 9);
  const Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(2, 2);
  const auto pair = [](const Eigen::MatrixXd& first, const Eigen::MatrixXd& second) {
    Pieces pieces;
    pieces.push_back(first);
    pieces.push_back(second);
    return pieces;
  };
  const auto of = [](const Row& knots, const Pieces& pieces) {
    return messageOf([&] { PiecewisePolynomial(knots, pieces); });
  };
  EXPECT_EQ(of({}, {}), "PiecewisePolynomial: no piece");
  EXPECT_EQ(of({0.0}, Pieces(1, line)),
            "PiecewisePolynomial: 1 knots for 1 pieces, expected one more than pieces");
  EXPECT_EQ(of({0.0, 0.0}, Pieces(1, line)),
            "PiecewisePolynomial: knots must increase, but knot 1 is 0 s, not above 0 s");
  EXPECT_EQ(of({0.0, 1.0}, Pieces(1, steep)),
            "PiecewisePolynomial: piece 0 has degree 8, allowed is 1 to 7");
  EXPECT_EQ(of({0.0, 1.0, 2.0}, pair(line, wide)),
            "PiecewisePolynomial: piece 1 has 2 values, but the first piece has 1");
  EXPECT_EQ(of({0.0, 1.0, 2.0}, pair(line, next)),
            "PiecewisePolynomial: value 0 jumps from 1 to 1.5 at knot 1");
  EXPECT_EQ(messageOf([&] {
              PiecewisePolynomial::bSpline(1, {0.0, 1.0, 2.0, 2.0, 2.0, 3.0, 4.0},
                                           Eigen::MatrixXd::Zero(1, 5));
            }),
            "PiecewisePolynomial: knot 2 s repeats more often than the degree 1: the curve would "
            "jump");
}

TEST(PiecewisePolynomial, FindsThePieceOfATime) {
  const Eigen::MatrixXd line = Eigen::MatrixXd::Zero(1, 2);
  const PiecewisePolynomial curve({1.0, 2.0, 4.0}, std::vector<Eigen::MatrixXd>(2, line));
  EXPECT_EQ(curve.pieceAt(0.0), 0U);
  EXPECT_EQ(curve.pieceAt(1.5), 0U);
  EXPECT_EQ(curve.pieceAt(2.0), 1U);
  EXPECT_EQ(curve.pieceAt(4.0), 1U);
  EXPECT_EQ(curve.pieceAt(9.0), 1U);
}

}  // namespace
}  // namespace swept
