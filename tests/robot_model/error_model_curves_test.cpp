// SPDX-License-Identifier: BSD-3-Clause
// Bounds on curves (L17 of ERROR_MODEL.md) against 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <hwy/highway.h>

#include "exact_curves.hpp"
#include "kinematics/curve_path.hpp"
#include "rounding/error_model.hpp"
#include "simd_robots.hpp"
#include "worst_share.hpp"

namespace swept::detail {
namespace {

using exact_test::Digits;
using exact_test::jointsSideBySide;
using exact_test::valueOf;
using simd_test::kAnyTarget;
using simd_test::Random;
using simd_test::Worst;

/// The last four values are an orientation, which does not change.
constexpr Eigen::Index kOrientation = 4;

double rateAtEnd(const Eigen::MatrixXd& piece, Eigen::Index i, double length) {
  const Eigen::Index d = piece.cols() - 1;
  return static_cast<double>(d) * (piece(i, d) - piece(i, d - 1)) / length;
}

/// Pieces whose rates join, of degrees 2 to 7 and lengths of up to 1 : 1000, around values of any
/// size. `miss`: share of a coefficient that values miss each other by at knots, up to what a curve
/// allows, and share of a change by which rates do.
PiecewisePolynomial smoothCurve(Random& random, int dimension, double miss) {
  const int pieces = 1 + random.below(8);
  const double size = random.scale(1e-2, 1e2);
  const double length = random.scale(1e-3, 10.0);
  const double spread = random.scale(1.0, 30.0);
  std::vector<double> knots{random.chance(0.5) ? 0.0 : random.uniform(-1e4, 1e4)};
  std::vector<Eigen::MatrixXd> coefficients;
  for (int p = 0; p < pieces; ++p) {
    const double own = length * random.scale(1.0 / spread, spread);
    const int degree = 2 + random.below(6);
    Eigen::MatrixXd piece(dimension, degree + 1);
    for (Eigen::Index i = 0; i < dimension; ++i) {
      for (Eigen::Index k = 0; k <= degree; ++k) piece(i, k) = random.uniform(-size, size);
      if (i >= dimension - kOrientation)
        piece.row(i).setConstant(p == 0 ? 0.5 : coefficients[0](i, 0));
      if (p == 0 || i >= dimension - kOrientation) continue;
      const Eigen::MatrixXd& before = coefficients.back();
      const double last = knots[knots.size() - 1] - knots[knots.size() - 2];
      piece(i, 0) = before(i, before.cols() - 1);
      piece(i, 1) = piece(i, 0) + rateAtEnd(before, i, last) * own / degree;
      if (miss == 0.0) continue;
      const double jump = std::min(miss, 5e-10) * random.uniform(-1.0, 1.0) * piece(i, 0);
      piece(i, 0) += jump;
      piece(i, 1) += jump + miss * random.uniform(-1.0, 1.0) * size;
    }
    coefficients.push_back(piece);
    knots.push_back(knots.back() + own);
  }
  return {knots, coefficients};
}

/// A run of a curve as a path, and its values in 50 digits.
class ExactRun {
 public:
  explicit ExactRun(Random& random, double miss = 0.0)
      : model_(jointsSideBySide()),
        curve_(smoothCurve(random, model_.dimension, miss)),
        run_(runFrom(model_, curve_, 0, 32, scratch_)),
        path_(model_, curve_, run_, 0.0, scratch_),
        whole_(model_.bodies.size()),
        part_(model_.bodies.size()) {}

  bool start() { return path_.linearize(0.5, 0.5, whole_); }
  bool look(double t, double half) { return path_.linearize(t, half, part_); }
  std::size_t pieces() const { return run_.last - run_.first; }
  bool isWhole() const { return run_.last == curve_.pieces(); }
  /// By t, of a knot inside of the run.
  double anyKnot(Random& random) const {
    const auto knot = 1 + static_cast<std::size_t>(random.below(static_cast<int>(pieces()) - 1));
    const double begin = curve_.knots()[run_.first];
    return (curve_.knots()[run_.first + knot] - begin) / (curve_.knots()[run_.last] - begin);
  }
  const JointMotion& whole(std::size_t body) const { return whole_[body]; }
  const JointMotion& part(std::size_t body) const { return part_[body]; }
  const KinematicModel& model() const { return model_; }

  Digits width() const {
    return Digits(curve_.knots()[run_.last]) - Digits(curve_.knots()[run_.first]);
  }
  /// Of a body's own first value, or another one; by t.
  Digits value(std::size_t body, const Digits& t, int order, int which = 0) const {
    const Digits time = Digits(curve_.knots()[run_.first]) + t * width();
    std::size_t piece = run_.first;
    while (piece + 1 < run_.last && Digits(curve_.knots()[piece + 1]) <= time) ++piece;
    Digits value = valueOf(curve_, piece, model_.bodies[body].variable + which, time, order);
    for (int o = 0; o < order; ++o) value *= width();
    const MovingBody& own = model_.bodies[body];
    return Digits(own.multiplier) * value + (order == 0 ? Digits(own.offset) : Digits(0));
  }

 private:
  CurveScratch scratch_;
  const KinematicModel model_;
  const PiecewisePolynomial curve_;
  const CurveRun run_;
  const CurvePath path_;
  std::vector<JointMotion> whole_, part_;
};

/// rad. What the whole motion is said to round by, see carriedRounding().
Digits angleError(const JointMotion& whole) {
  return Digits(kValueRounding) * (Digits(whole.largestAngle) - Digits(kOrdinary));
}

struct Rows {
  Worst values{"values of curves (L17: curveRounding)", 1e-5};
  Worst ways{"ways along curves (L17: CurvePath)", 0.5};
  Worst rates{"rates of curves (L17: CurvePath)", 0.99};
  Worst accelerations{"accelerations of curves (L17: CurvePath)", 0.99};
};

/// Beside knots at which pieces nearly join.
struct JoinRows {
  Worst ways{"ways across joins (L17: CurvePath)", 0.5};
  Worst rates{"rates beside joins (L17: CurvePath)", 0.5};
  Worst accelerations{"accelerations beside joins (L17: CurvePath)", 0.5};
};

/// A joint that turns, in the interval that was looked at.
template <typename AnyRows>
void lookAtTurn(const ExactRun& run, std::size_t body, int which, double t, double half, double at,
                AnyRows& rows) {
  const JointMotion& joint = run.part(body);
  const Digits allowed = angleError(run.whole(body));
  const Digits h(half);
  const Digits since = h * Digits(at);
  const Digits when = Digits(t) + since;
  const Digits truth = run.value(body, when, 0, which);
  const Digits line = Digits(joint.angle) + since * Digits(joint.angleRate);
  if constexpr (requires { rows.values; })
    if (half == 0.0) rows.values.note(kAnyTarget, abs(truth - line), allowed);
  const Digits curvature = h * h / 2 * Digits(joint.spinAcceleration);
  rows.ways.note(kAnyTarget, abs(truth - line),
                 allowed + curvature + Digits(kVelocityRounding) * h * Digits(joint.spinSpeed));
  EXPECT_LE(truth, Digits(joint.highAngle) + allowed);
  EXPECT_GE(truth, Digits(joint.lowAngle) - allowed);
  rows.rates.note(kAnyTarget, abs(run.value(body, when, 1, which)), joint.spinSpeed);
  rows.accelerations.note(kAnyTarget, abs(run.value(body, when, 2, which)), joint.spinAcceleration);
}

/// One that slides along its axis, z.
template <typename AnyRows>
void lookAtSlide(const ExactRun& run, std::size_t body, double t, double half, double at,
                 AnyRows& rows) {
  const JointMotion& joint = run.part(body);
  const Digits allowed(run.whole(body).slideError);
  const Digits h(half);
  const Digits since = h * Digits(at);
  const Digits when = Digits(t) + since;
  const Digits truth = run.value(body, when, 0);
  const Digits line = Digits(joint.translation.z()) + since * Digits(joint.rate.z());
  const Digits curvature = h * h / 2 * Digits(joint.acceleration);
  rows.ways.note(kAnyTarget, abs(truth - line),
                 allowed + curvature + Digits(kVelocityRounding) * h * Digits(joint.speed));
  EXPECT_LE(truth, Digits(joint.high) + allowed);
  EXPECT_GE(truth, Digits(joint.low) - allowed);
  rows.rates.note(kAnyTarget, abs(run.value(body, when, 1)), joint.speed);
  rows.accelerations.note(kAnyTarget, abs(run.value(body, when, 2)), joint.acceleration);
}

/// The place of a planar or floating joint.
template <typename AnyRows>
void lookAtPlace(const ExactRun& run, std::size_t body, double t, double half, double at,
                 AnyRows& rows) {
  const JointMotion& joint = run.part(body);
  const MovingBody& moving = run.model().bodies[body];
  const bool planar = moving.type == JointType::Planar;
  const Digits h(half);
  const Digits since = h * Digits(at);
  const Digits when = Digits(t) + since;
  std::array<Digits, 3> squares{};
  Digits off = 0;
  for (int k = 0; k < (planar ? 2 : 3); ++k) {
    const Eigen::Vector3d axis = planar ? Eigen::Vector3d(moving.planarBasis.col(k))
                                        : Eigen::Vector3d(Eigen::Vector3d::Unit(k));
    for (int order = 0; order < 3; ++order) {
      const Digits value = run.value(body, when, order, k);
      squares[static_cast<std::size_t>(order)] += value * value;
    }
    const Digits line = Digits(axis.dot(joint.translation)) + since * Digits(axis.dot(joint.rate));
    const Digits own = run.value(body, when, 0, k) - line;
    off += own * own;
  }
  const Digits allowed =
      Digits(run.whole(body).slideError) + Digits(kValueRounding) * Digits(joint.maxTranslation);
  const Digits curvature = h * h / 2 * Digits(joint.acceleration);
  rows.ways.note(kAnyTarget, sqrt(off),
                 allowed + curvature + Digits(kVelocityRounding) * h * Digits(joint.speed));
  EXPECT_LE(sqrt(squares[0]), Digits(joint.maxTranslation) + allowed);
  rows.rates.note(kAnyTarget, sqrt(squares[1]), joint.speed);
  rows.accelerations.note(kAnyTarget, sqrt(squares[2]), joint.acceleration);
}

/// All joints of jointsSideBySide().
template <typename AnyRows>
void lookAtJoints(const ExactRun& run, double t, double half, double at, AnyRows& rows) {
  lookAtTurn(run, 1, 0, t, half, at, rows);
  lookAtTurn(run, 2, 0, t, half, at, rows);
  lookAtSlide(run, 3, t, half, at, rows);
  lookAtPlace(run, 4, t, half, at, rows);
  lookAtTurn(run, 4, 2, t, half, at, rows);
  lookAtPlace(run, 5, t, half, at, rows);
}

TEST(ErrorModel, Curves) {
  Rows rows;
  Random random(71);
  int joined = 0;
  for (int round = 0; round < 1500 && !HasFailure(); ++round) {
    ExactRun run(random);
    ASSERT_TRUE(run.start());
    joined += run.pieces() > 1 ? 1 : 0;
    for (int i = 0; i < 4; ++i) {
      const double half = i == 0 ? 0.0 : i == 1 ? 0.5 : random.scale(1e-6, 0.5);
      const double t = half == 0.5 ? 0.5 : random.uniform(half, 1.0 - half);
      ASSERT_TRUE(run.look(t, half));
      for (const double at : {-1.0, 1.0, random.uniform(-1.0, 1.0)})
        lookAtJoints(run, t, half, at, rows);
    }
  }
  EXPECT_GT(joined, 500);
}

/// Pieces whose values and rates miss each other a little are one run, which says what that makes
/// of its values; those that miss more are not.
TEST(ErrorModel, CurvesThatNearlyJoin) {
  JoinRows rows;
  Random random(73);
  int joined = 0, apart = 0;
  for (int round = 0; round < 4000 && !HasFailure(); ++round) {
    ExactRun run(random, random.scale(1e-16, 1.0));
    apart += run.isWhole() ? 0 : 1;
    if (run.pieces() == 1) continue;
    ++joined;
    ASSERT_TRUE(run.start());
    for (int i = 0; i < 3; ++i) {
      const double knot = run.anyKnot(random);
      const double half = random.scale(1e-9, 0.9) * std::min(knot, 1.0 - knot);
      const double t = knot + random.uniform(-0.9, 0.9) * half;
      if (t - half < 0.0 || t + half > 1.0) continue;
      ASSERT_TRUE(run.look(t, half));
      for (const double at : {-1.0, 1.0}) lookAtJoints(run, t, half, at, rows);
    }
  }
  EXPECT_GT(joined, 1000);
  EXPECT_GT(apart, 1000);
}

/// The counts of L17, from what they are made of: roundings of a polynomial of degree d whose
/// coefficients are at most 1, at up to half its length from its middle.
TEST(ErrorModel, CurveCountsAreBelowTheirConstants) {
  for (std::size_t degree = 1; degree <= PiecewisePolynomial::kMaxDegree; ++degree) {
    const auto d = static_cast<double>(degree);
    const double size = std::pow(2.0, d);
    const double terms = 2.0 * d + 1.0;  // Taylor coefficients,
    const double moved = 2.0 * d + 1.0;  // moved to another middle,
    const CurveRounding rounding = curveRounding(degree, 1.0);
    EXPECT_GE(rounding.value, kDouble * size * (terms + moved + 2.0 * d + 2.0)) << degree;
    EXPECT_GE(rounding.rate, kDouble * size * d * (terms + moved + 3.0 * d + 2.0)) << degree;
    EXPECT_GE(rounding.acceleration,
              kDouble * size * d * (d - 1.0) * (terms + moved + 4.0 * d + 2.0))
        << degree;
  }
  EXPECT_GE(kTimeRounding / kDouble, 3.0 + 3.0 + 1.0);
}

/// A floating joint whose orientation is another one, however little, begins another run.
TEST(CurveRuns, EndWhereAnOrientationChanges) {
  const KinematicModel model = jointsSideBySide();
  Random random(72);
  Eigen::MatrixXd first(model.dimension, 3);
  first.setZero();
  first.bottomRows(1).setOnes();
  Eigen::MatrixXd second = first;
  CurveScratch scratch;
  const auto runs = [&] {
    std::vector<Eigen::MatrixXd> pieces;
    pieces.push_back(first);
    pieces.push_back(second);
    const PiecewisePolynomial curve({0.0, 1.0, 2.0}, std::move(pieces));
    return runFrom(model, curve, 0, 32, scratch).last;
  };
  EXPECT_EQ(runs(), 2U);
  second.row(model.dimension - 2).setConstant(5e-10);
  EXPECT_EQ(runs(), 1U);
}

}  // namespace
}  // namespace swept::detail
