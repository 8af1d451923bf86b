// SPDX-License-Identifier: BSD-3-Clause
// First contacts of single pairs by Newton's method, against closed forms and bisection.
#include "continuous/leaf_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference_distance.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"

namespace {

using namespace swept;
using detail::LeafContact;
using detail::OpenPair;
using detail::RelativeMotion;
using detail::Side;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using reference::Random;

constexpr double kResolution = 1e-9;

struct Pair {
  Pair(Shape first, UniformMotion moveFirst, Shape second, UniformMotion moveSecond)
      : a(std::move(first)),
        b(std::move(second)),
        moveA(std::move(moveFirst)),
        moveB(std::move(moveSecond)) {}

  std::optional<LeafContact::Found> find(double from, double to, bool touching, double margin = 0) {
    const BoundingSphere ballA = boundingSphere(a), ballB = boundingSphere(b);
    const RelativeMotion motion(ballA, moveA, ballB, moveB);
    LeafContact::Range range{from, to, touching, kResolution, 0.0};
    const MotionRates ratesA = moveA.rates(0.0, 1.0), ratesB = moveB.rates(0.0, 1.0);
    // About their reference points, which are the centres of the bodies.
    range.bend = 0.5 * (ratesA.acceleration + ratesB.acceleration +
                        ratesA.angularSpeed * ratesA.angularSpeed * ballA.radius +
                        ratesB.angularSpeed * ratesB.angularSpeed * ballB.radius);
    effort = {};
    const Side sideA = Side::of(a), sideB = Side::of(b);
    return LeafContact(sideA, sideB, motion, margin, 1e-12).find(OpenPair{}, range, effort);
  }
  double gapAt(double t) const { return distance(a, b, moveA.at(t).inverse() * moveB.at(t)).upper; }

  Shape a, b;
  UniformMotion moveA, moveB;
  ContinuousEffort effort;
};

UniformMotion flight(const Vector3d& from, const Vector3d& to) {
  return UniformMotion::translation(Isometry3d(Translation3d(from)), to - from);
}

TEST(LeafContact, OfBallsIsWhereTheirDistanceSays) {
  Random random(1);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d from = 3.0 * random.direction(), to = 3.0 * random.direction();
    const double margin = i % 2 == 0 ? 0.0 : 0.1;
    Pair pair(makeSphere(0.5), flight(from, to), makeSphere(0.7), flight(to, from));
    // |(1 - 2 t) (to - from)| = 1.2 + margin
    const double length = (to - from).norm();
    const double first = 0.5 * (1.0 - (1.2 + margin) / length);
    if (length < 2.0) continue;
    ++met;
    for (const bool touching : {false, true}) {
      const auto found = pair.find(0.0, touching ? 0.5 : 1.0, touching, margin);
      ASSERT_TRUE(found);
      ASSERT_GE(found->t, first - 1e-14);
      ASSERT_LE(found->t, first + kResolution);
      ASSERT_LE((found->pointA - found->pointB).norm(), margin + 1e-12);
      ASSERT_LE(pair.effort.leafTests, 4);
    }
  }
  EXPECT_GT(met, 100);
}

/// Corners, edges and faces of boxes that turn; the last sample apart is bisected to the contact.
TEST(LeafContact, OfTurningBoxesIsTheFirst) {
  Random random(2);
  int met = 0;
  std::int64_t steps = 0;
  for (int i = 0; i < 400; ++i) {
    const auto turning = [&](const Vector3d& from, const Vector3d& to) {
      Isometry3d start = random.pose(0.0);
      start.translation() = from;
      return UniformMotion::turning(start, random.vector(1.0), to - from);
    };
    Pair pair(makeBox({0.3, 0.5, 0.4}), turning({-1, 0, 0}, {0, 0, 0}), makeBox({0.2, 0.4, 0.8}),
              turning({1, 0.2, 0}, {0, 0.1, 0.1}));
    double from = 0.0, to = 1.0;
    for (double t = 0.0; t < 1.0 && to == 1.0; t += 1e-3) (pair.gapAt(t) > 0.0 ? from : to) = t;
    while (to - from > 1e-12) {
      const double t = 0.5 * (from + to);
      (pair.gapAt(t) > 0.0 ? from : to) = t;
    }
    const auto found = pair.find(std::max(0.0, to - 0.05), 1.0, false);
    steps += pair.effort.leafTests;
    // Newton's method may pass a graze.
    if (!found) continue;
    ASSERT_EQ(pair.gapAt(found->t), 0.0);
    ASSERT_GE(found->t, to - 1e-9);
    met += found->t <= to + kResolution;
  }
  EXPECT_GT(met, 350);
  EXPECT_LT(steps, 400 * 6);
}

TEST(LeafContact, IsNotFoundWhereNothingMeets) {
  Pair passing(makeSphere(0.5), flight({-2, 0, 0}, {2, 0, 0}), makeSphere(0.5),
               flight({2, 1.1, 0}, {-2, 1.1, 0}));
  EXPECT_FALSE(passing.find(0.0, 1.0, false));
  Pair leaving(makeSphere(0.5), flight({-1, 0, 0}, {-2, 0, 0}), makeSphere(0.5),
               flight({1, 0, 0}, {2, 0, 0}));
  EXPECT_FALSE(leaving.find(0.0, 1.0, false));
  EXPECT_EQ(leaving.effort.leafTests, 1);
  Pair later(makeSphere(0.5), flight({-1, 0, 0}, {1, 0, 0}), makeSphere(0.5),
             flight({1, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(later.find(0.0, 0.4, false));
  EXPECT_TRUE(later.find(0.0, 0.6, false));
}

TEST(LeafContact, IsAtTheStartOfWhatTouchesThere) {
  Pair pair(makeBox({1, 1, 1}), flight({0, 0, 0}, {0, 0, 0}), makeBox({1, 1, 1}),
            flight({0.5, 0, 0}, {0.4, 0, 0}));
  const auto found = pair.find(0.25, 0.75, true);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->t, 0.25);
}

}  // namespace
