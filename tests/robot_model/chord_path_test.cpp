// SPDX-License-Identifier: BSD-3-Clause
// Curves along straight motions (L17 of ERROR_MODEL.md) against 50 digits; and those that only
// seem to be.
#include "kinematics/chord_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "exact_curves.hpp"
#include "rounding/error_model.hpp"
#include "simd_robots.hpp"

namespace swept::detail {
namespace {

using exact_test::Digits;
using exact_test::jointsSideBySide;
using exact_test::valueOf;
using simd_test::Random;

constexpr Eigen::Index kOrientation = 4;  // the last values are a quaternion
constexpr int kTheta = 4;                 // the planar joint's angle

/// A straight motion, and shares of it that never decrease: piece by piece those of the Bernstein
/// coefficients.
struct Straight {
  Eigen::VectorXd begin, change;
  std::vector<double> knots{0.0};
  std::vector<std::vector<double>> shares;

  PiecewisePolynomial curve() const { return curveBeside(0.0, nullptr); }
  /// Each value up to `noise` off.
  PiecewisePolynomial curveBeside(double noise, Random* random) const {
    std::vector<Eigen::MatrixXd> pieces;
    for (const std::vector<double>& own : shares) {
      Eigen::MatrixXd piece(begin.size(), static_cast<Eigen::Index>(own.size()));
      for (Eigen::Index k = 0; k < piece.cols(); ++k)
        for (Eigen::Index i = 0; i < piece.rows(); ++i) {
          piece(i, k) = begin[i] + own[static_cast<std::size_t>(k)] * change[i];
          // Not of the one that the shares are read off.
          if (noise > 0.0 && i == 1) piece(i, k) += random->uniform(-noise, noise);
        }
      pieces.push_back(piece);
    }
    return {knots, pieces};
  }
};

Straight straightMotion(Random& random, int dimension, int pieces) {
  Straight straight;
  straight.begin.resize(dimension);
  straight.change = Eigen::VectorXd::Zero(dimension);
  const double size = random.scale(1e-2, 2.9);
  for (Eigen::Index i = 0; i < dimension; ++i) {
    straight.begin[i] = random.uniform(-10.0, 10.0);
    if (i < dimension - kOrientation) straight.change[i] = random.uniform(-size, size);
  }
  straight.knots[0] = random.uniform(-100.0, 100.0);
  double share = 0.0;
  for (int p = 0; p < pieces; ++p) {
    const double end = p + 1 == pieces ? 1.0 : share + (1.0 - share) * random.uniform(0.05, 0.9);
    std::vector<double> own{share};
    const int degree = 2 + random.below(6);
    for (int k = 1; k < degree; ++k) own.push_back(random.uniform(share, end));
    std::sort(own.begin(), own.end());
    own.push_back(end);
    straight.shares.push_back(own);
    straight.knots.push_back(straight.knots.back() + random.scale(1e-3, 10.0));
    share = end;
  }
  return straight;
}

bool isOff(const JointMotion& joint, const Digits& truth, const Digits& at, double error) {
  return abs(truth - at) > Digits(error) ||
         truth > Digits(joint.highAngle) + Digits(kValueRounding) * 20 ||
         truth < Digits(joint.lowAngle) - Digits(kValueRounding) * 20;
}

TEST(ChordPath, HasEveryValueOfTheCurve) {
  Random random(91);
  const KinematicModel model = jointsSideBySide();
  int several = 0;
  double widest = 0.0;
  for (int round = 0; round < 1000; ++round) {
    const int pieces = 1 + random.below(6);
    const Straight straight = straightMotion(random, model.dimension, pieces);
    const double noise = random.chance(0.5) ? 0.0 : 0.4e-9;
    const PiecewisePolynomial curve = straight.curveBeside(noise, &random);
    const Chord chord = chordFrom(model, curve, 0, 32);
    // The value that has the noise may be the one that changes most.
    if (noise > 0.0 && chord.last < curve.pieces()) continue;
    ASSERT_EQ(chord.last, curve.pieces()) << round;
    several += pieces > 1 ? 1 : 0;
    widest = std::max(widest, chord.deviation);
    const Eigen::VectorXd from = curve.coefficients(0).col(0);
    const Eigen::MatrixXd& end = curve.coefficients(curve.pieces() - 1);
    const Eigen::VectorXd to = end.col(end.cols() - 1);
    const std::span<const double> a(from.data(), static_cast<std::size_t>(from.size()));
    const std::span<const double> b(to.data(), static_cast<std::size_t>(to.size()));
    const ChordPath path(model, a, b, chord.deviation);
    std::vector<JointMotion> joints(model.bodies.size());
    ASSERT_TRUE(path.linearize(0.5, 0.5, joints));
    for (int look = 0; look < 10; ++look) {
      const auto piece = static_cast<std::size_t>(random.below(pieces));
      const double since = random.uniform(0.0, 1.0);
      const Digits time =
          Digits(curve.knots()[piece]) +
          Digits(since) * (Digits(curve.knots()[piece + 1]) - Digits(curve.knots()[piece]));
      const auto at = [&](int value) { return valueOf(curve, piece, value, time, 0); };
      const Digits share = (at(chord.leading) - Digits(from[chord.leading])) /
                           (Digits(to[chord.leading]) - Digits(from[chord.leading]));
      ASSERT_GE(share, Digits(0));
      ASSERT_LE(share, Digits(1));
      for (int i = 0; i < model.dimension - kOrientation; ++i) {
        const Digits line = Digits(from[i]) + share * (Digits(to[i]) - Digits(from[i]));
        ASSERT_LE(abs(at(i) - line), Digits(chord.deviation));
      }
      // The joint that turns, the one that follows it, and the planar one.
      for (const auto& [body, value] : {std::pair{1, 0}, {2, 0}, {4, kTheta}}) {
        const MovingBody& own = model.bodies[static_cast<std::size_t>(body)];
        const JointMotion& joint = joints[static_cast<std::size_t>(body)];
        const Digits truth = Digits(own.multiplier) * at(value) + Digits(own.offset);
        const Digits line = Digits(joint.angle) + share * Digits(joint.angleRate);
        const double allowed = kValueRounding * (joint.largestAngle - kOrdinary + 30.0);
        if (body == 4) {
          ASSERT_LE(abs(truth - line), Digits(allowed));
        } else {
          ASSERT_FALSE(isOff(joint, truth, line, allowed)) << body << ' ' << abs(truth - line);
        }
      }
      const JointMotion& slide = joints[3];
      ASSERT_LE(abs(at(1) - Digits(slide.translation.z()) - share * Digits(slide.rate.z())),
                Digits(slide.slideError) + Digits(kValueRounding) * 20);
      ASSERT_LE(at(1), Digits(slide.high));
      ASSERT_GE(at(1), Digits(slide.low));
    }
  }
  EXPECT_GT(several, 400);
  EXPECT_GT(widest, 2e-10);
}

TEST(ChordPath, KnowsWhenTheCurveHasComeToAShare) {
  Random random(92);
  const KinematicModel model = jointsSideBySide();
  for (int round = 0; round < 300; ++round) {
    const int pieces = 1 + random.below(6);
    const PiecewisePolynomial curve = straightMotion(random, model.dimension, pieces).curve();
    const Chord chord = chordFrom(model, curve, 0, 32);
    ASSERT_EQ(chord.last, curve.pieces());
    double before = curve.begin();
    for (double share = 0.0; share < 1.0; share += random.uniform(0.0, 0.2)) {
      const double time = timeOnChord(curve, chord, share);
      ASSERT_GE(time, before);
      before = time;
      const double from = curve.position(curve.begin())[chord.leading];
      const double to = curve.position(curve.end())[chord.leading];
      const double value = curve.position(time)[chord.leading];
      // Rates are small where all coefficients but one are the same: values are near, not times.
      EXPECT_NEAR((value - from) / (to - from), share, 1e-9 + 1e-13 / std::abs(to - from));
      // In 50 digits it is not beyond the share.
      std::size_t piece = 0;
      while (piece + 1 < curve.pieces() && curve.knots()[piece + 1] <= time) ++piece;
      const Digits exact = valueOf(curve, piece, chord.leading, Digits(time), 0);
      if (share > 0.0) {
        EXPECT_LE((exact - Digits(from)) / (Digits(to) - Digits(from)), Digits(share));
      }
    }
    EXPECT_LE(before, curve.end());
    EXPECT_EQ(timeOnChord(curve, chord, 0.0), curve.begin());
  }
}

/// Pieces of a curve that a change makes: a chord of so many.
TEST(ChordPath, EndsWhereTheRobotStops) {
  Random random(93);
  const KinematicModel model = jointsSideBySide();
  Straight straight = straightMotion(random, model.dimension, 4);
  const auto endOf = [&](std::size_t first) {
    return chordFrom(model, straight.curve(), first, 32).last;
  };
  ASSERT_EQ(endOf(0), 4U);
  std::vector<double>& second = straight.shares[1];
  second[second.size() - 2] = second.back();
  EXPECT_EQ(endOf(0), 2U);
  EXPECT_EQ(endOf(1), 2U);
  EXPECT_EQ(endOf(2), 4U);
}

TEST(ChordPath, IsNoneWhereTheWayBendsOrTurnsBack) {
  Random random(93);
  KinematicModel model = jointsSideBySide();
  const auto pieces = [&](const PiecewisePolynomial& curve, std::size_t most = 32) {
    return chordFrom(model, curve, 0, most).last;
  };
  const auto changed = [](const PiecewisePolynomial& curve, const auto& change) {
    std::vector<Eigen::MatrixXd> own;
    for (std::size_t p = 0; p < curve.pieces(); ++p) own.push_back(curve.coefficients(p));
    change(own);
    return PiecewisePolynomial(curve.knots(), std::move(own));
  };
  Straight straight = straightMotion(random, model.dimension, 3);
  straight.shares = {{0.0, 0.1, 0.2}, {0.2, 0.3, 0.5, 0.6}, {0.6, 0.9, 1.0}};
  straight.begin.head(6) << 1.0, 2.0, 3.0, 4.0, 0.5, -2.0;
  straight.change.head(6) << 2.0, 0.5, 0.25, -0.5, 1.0, 0.125;
  const PiecewisePolynomial curve = straight.curve();
  ASSERT_EQ(pieces(curve), 3U);
  EXPECT_EQ(pieces(curve, 2), 2U);
  EXPECT_EQ(chordFrom(model, curve, 1, 32).last, 3U);

  EXPECT_EQ(pieces(changed(curve, [](auto& own) { own[1](2, 1) += 2e-9; })), 1U);
  EXPECT_EQ(pieces(changed(curve, [](auto& own) { own[1](2, 1) += 0.5e-9; })), 3U);
  EXPECT_EQ(pieces(changed(curve, [](auto& own) { own[0](2, 1) += 2e-9; })), 0U);

  Straight back = straight;
  back.shares[1] = {0.2, 0.3, 0.29, 0.6};
  EXPECT_EQ(pieces(back.curve()), 1U);
  Straight overshoots = straight;
  overshoots.shares[2] = {0.6, 1.01, 1.0};
  EXPECT_EQ(pieces(overshoots.curve()), 2U);
  Straight stays = straight;
  stays.shares[1] = {0.6, 0.6, 0.6};
  stays.shares[0] = {0.0, 0.1, 0.6};
  EXPECT_EQ(pieces(stays.curve()), 1U);

  Straight line = straight;
  line.shares[1] = {0.2, 0.6};
  EXPECT_EQ(pieces(line.curve()), 1U);

  // The first value is cyclic.
  Straight turns = straight;
  turns.change[0] = 3.01;
  EXPECT_EQ(pieces(turns.curve()), 2U);
  model.cyclic[0] = 0;
  EXPECT_EQ(pieces(turns.curve()), 3U);

  EXPECT_EQ(pieces(changed(curve, [](auto& own) { own[1].row(9)[1] += 1e-16 + 1e-9; })), 1U);

  model.bodies[3].upper = 2.4;
  EXPECT_EQ(pieces(curve), 2U);
  model.bodies[3].upper = 1e9;
  ASSERT_EQ(pieces(curve), 3U);
  addObstacleFrames(model, 1);
  EXPECT_EQ(pieces(curve), 0U);
}

}  // namespace
}  // namespace swept::detail
