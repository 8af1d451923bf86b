// SPDX-License-Identifier: BSD-3-Clause
// Classes of defects that continuous collision has had elsewhere, each with its mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d placed(const Vector3d& position) {
  return Isometry3d(Eigen::Translation3d(position));
}

UniformMotion straight(const Vector3d& from, const Vector3d& to) {
  return UniformMotion::translation(placed(from), to - from);
}

void expectFirstContact(const ContinuousResult& result, double first, double within) {
  ASSERT_EQ(result.verdict, Verdict::Collision);
  EXPECT_LE(result.freeUntil, first + 1e-12);
  EXPECT_GE(result.contactBy, first - 1e-12);
  EXPECT_LE(result.contactBy - result.freeUntil, within);
}

/// Samples every tenth of the way miss a plate of a millimetre: the ball is 19.5 mm from it at the
/// nearest of them.
TEST(FirstContact, OfABallWithAThinWall) {
  const Shape ball = makeSphere(0.01), wall = makeBox({1e-3, 1.0, 1.0});
  const UniformMotion flight = straight({-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0});
  const UniformMotion still = UniformMotion::still(placed({0.07, 0.0, 0.0}));
  for (int i = 0; i <= 10; ++i) {
    EXPECT_GT(distance(ball, wall, flight.at(0.1 * i).inverse() * still.at(0.0)).lower, 0.0194);
  }
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto result = continuousCollide(ball, flight, wall, still, {.tolerance = tolerance});
    expectFirstContact(result, 0.5595, tolerance);
  }
}

/// The wall without any thickness and the ball without any size: there is one instant to be found.
TEST(FirstContact, OfAPointWithATriangle) {
  const Shape point = makeSphere(0.0);
  const Shape wall = makeTriangle({0.0, -1.0, -1.0}, {0.0, 1.0, -1.0}, {0.0, 0.0, 1.0});
  const UniformMotion still = UniformMotion::still(Isometry3d::Identity());
  // An irrational instant, which no double is.
  const double before = 3.0 * std::numbers::sqrt2;
  const auto result = continuousCollide(point, straight({-before, 0.0, 0.0}, {7.0, 0.0, 0.0}), wall,
                                        still, {.tolerance = 1e-6});
  EXPECT_NE(result.verdict, Verdict::Free);
  EXPECT_LE(result.freeUntil, before / (7.0 + before) + 1e-15);
  EXPECT_GE(result.freeUntil, before / (7.0 + before) - 1e-6);
}

/// A ball that comes to a box at an angle of 45 degrees, 16 m from the origin: the advancement
/// towards the contact got shorter than an ulp and went on for ever.
TEST(FirstContact, EndsWhereStepsGetShorterThanAnUlp) {
  const Shape ball = makeSphere(1.0), box = makeBox({10.0, 50.0, 100.0});
  const UniformMotion flight = straight({158.0, -5.2, 0.0}, {159.4, -6.6, 0.0});
  const UniformMotion still = UniformMotion::still(placed({164.2, -14.0, 0.0}));
  for (const double tolerance : {1e-3, 1e-9, 1e-12, 1e-15, 0.0}) {
    const auto result = continuousCollide(ball, flight, box, still, {.tolerance = tolerance});
    EXPECT_NE(result.verdict, Verdict::Free) << tolerance;
    EXPECT_LE(result.freeUntil, 0.2 / 1.4 + 1e-12) << tolerance;
    EXPECT_LT(result.effort.intervals, 10000) << tolerance;
  }
  // And where it only slides along the box, a hair away or touching.
  for (const double gap : {0.0, 1e-13, 1e-9}) {
    const double x = 159.2 - 1.0 - gap;
    const auto result = continuousCollide(ball, straight({x, -20.0, 0.0}, {x, 0.0, 0.0}), box,
                                          still, {.tolerance = 1e-12});
    EXPECT_LT(result.effort.intervals, 100000) << gap;
    if (!(gap > 0.0)) {
      EXPECT_NE(result.verdict, Verdict::Free);
    }
    if (gap > 1e-10) {
      EXPECT_EQ(result.verdict, Verdict::Free);
    }
  }
}

/// A sliver whose corners are nearly in line has no normal to speak of: the cast took the zero
/// vector for one and reported a hit two metres away.
TEST(FirstContact, OfDegenerateTrianglesIsNotMadeUp) {
  const Vector3d a(14.55, 10.6, 0.0), b(14.55, 10.6, -3.2), c(14.55, 10.6, -5.2);
  const UniformMotion still = UniformMotion::still(Isometry3d::Identity());
  for (const double off : {0.0, 1e-16, 1e-9, 4e-4}) {
    const Shape sliver = makeTriangle(a + Vector3d(0.0, off, 0.0), b, c);
    const auto past = continuousCollide(
        makeSphere(0.2), straight({14.83, 8.19, -4.31}, {14.73, 8.19, -4.3}), sliver, still);
    EXPECT_EQ(past.verdict, Verdict::Free) << off;
    const auto at =
        continuousCollide(makeSphere(0.2), straight({14.55, 8.4, -4.31}, {14.55, 12.4, -4.31}),
                          sliver, still, {.tolerance = 1e-7});
    ASSERT_EQ(at.verdict, Verdict::Collision) << off;
    EXPECT_NEAR(at.contactBy, 0.5, 2e-4 + 1e-7) << off;
  }
  const Shape dot = makeTriangle(a, a, a);
  EXPECT_EQ(
      continuousCollide(makeSphere(0.2), straight({14.0, 10.0, 0.0}, {15.0, 11.3, 0.0}), dot, still)
          .verdict,
      Verdict::Collision);
}

/// What the two balls sweep overlaps by 0.1 m, but each is past when the other comes.
TEST(FirstContact, IsNotThatOfTheSweptVolumes) {
  const Shape ball = makeSphere(0.25);
  const UniformMotion a = straight({-0.2, -1.0, 0.25}, {-0.2, 3.0, 0.25});
  const UniformMotion b = straight({0.2, 0.0, -2.75}, {0.2, 0.0, 0.45});
  EXPECT_EQ(continuousCollide(ball, a, ball, b).verdict, Verdict::Free);
  // At the same time they would have met.
  const UniformMotion now = straight({0.2, 0.0, -1.1}, {0.2, 0.0, 3.3});
  EXPECT_EQ(continuousCollide(ball, a, ball, now).verdict, Verdict::Collision);
}

/// Two unit boxes, face to face: the faces are parallel all the way, and there is no one nearest
/// pair of points to advance along.
TEST(FirstContact, OfBoxesFaceToFace) {
  const Shape box = makeBox(Vector3d::Ones());
  const UniformMotion still = UniformMotion::still(Isometry3d::Identity());
  const UniformMotion flight = straight({-3.0, 0.0, 0.0}, {3.0, 0.0, 0.0});
  const ContinuousOptions options{.tolerance = 1e-6};
  expectFirstContact(continuousCollide(box, flight, box, still, options), 1.0 / 3.0, 1e-6);
  // Seen by either, and where both move, it is the same.
  expectFirstContact(continuousCollide(box, still, box, flight, options), 1.0 / 3.0, 1e-6);
  const UniformMotion towards = straight({0.0, 0.0, 0.0}, {-6.0, 0.0, 0.0});
  expectFirstContact(continuousCollide(box, flight, box, towards, options), 1.0 / 6.0, 1e-6);
}

/// A rod that turns half way round sweeps over a post which it touches neither at the start nor at
/// the end, nor does the hull of both.
TEST(FirstContact, OfATurnThatEndsWhereTheCastIsThin) {
  const Shape rod = makeBox({0.02, 0.02, 1.0}), post = makeCylinder(0.02, 1.0);
  const Isometry3d start = placed(Vector3d::Zero());
  const UniformMotion turn = UniformMotion::turning(start, std::numbers::pi * Vector3d::UnitX(),
                                                    Vector3d::Zero(), {0.0, 0.0, -0.5});
  const UniformMotion still = UniformMotion::still(
      placed({0.0, -0.6, -0.5}) *
      Isometry3d(Eigen::AngleAxisd(std::numbers::pi / 2.0, Vector3d::UnitY())));
  const auto result = continuousCollide(rod, turn, post, still, {.tolerance = 1e-6});
  ASSERT_EQ(result.verdict, Verdict::Collision);
  EXPECT_GT(result.freeUntil, 0.3);
  EXPECT_LT(result.contactBy, 0.5);
}

/// Left in deep overlap, a pair has no gap to advance by.
TEST(FirstContact, IsAtOnceHoweverDeepTheOverlap) {
  const Shape inner = makeSphere(0.1), outer = makeBox({4.0, 4.0, 4.0});
  const UniformMotion still = UniformMotion::still(Isometry3d::Identity());
  for (const Vector3d& to : {Vector3d(0.1, 0.0, 0.0), Vector3d(10.0, 0.0, 0.0)}) {
    const auto result = continuousCollide(inner, straight(Vector3d::Zero(), to), outer, still);
    expectFirstContact(result, 0.0, 0.0);
  }
}

}  // namespace
