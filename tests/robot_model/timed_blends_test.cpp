// SPDX-License-Identifier: BSD-3-Clause
// Which blends a timed path has, by what its prover accepts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "timed_paths.hpp"

namespace swept {
namespace {

using Eigen::VectorXd;
using test::WayPoints;

constexpr int kJoints = 5;

WayPoints randomPath(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  WayPoints path;
  for (int i = 0; i < count; ++i) {
    VectorXd q(kJoints);
    for (double& value : q) value = uniform(random);
    path.push_back(q);
  }
  return path;
}

TimedPath timedBy(const WayPoints& path, const BlendProver& proves,
                  const TimingOptions& options = {}) {
  static const auto kRobot = test::chainRobot(kJoints);
  const RateLimits limits = test::sameLimits(kJoints, 2.0, 6.0, 60.0);
  TimedPath timed = timeParameterize(*kRobot, kRobot->groups()[0], path, limits, proves, options);
  test::expectWellTimed(timed, path, limits, options);
  return timed;
}

/// The least distance of a way point from a curve, between two times.
double distanceFrom(const VectorXd& point, const PiecewisePolynomial& curve, double begin,
                    double end) {
  constexpr int kSamples = 400;
  double least = (curve.position(begin) - point).norm();
  for (int i = 1; i <= kSamples; ++i)
    least = std::min(least, (curve.position(begin + (end - begin) * i / kSamples) - point).norm());
  return least;
}

/// The way point that a blend belongs to: its middle coefficient.
VectorXd wayPointOf(const PiecewisePolynomial& blend) {
  return blend.coefficients(0).col(blend.degree(0) / 2);
}

TEST(TimedBlends, AreStopsIfAllAreRefused) {
  std::mt19937 random(120);
  for (const bool jerkLimited : {false, true}) {
    TimingOptions options;
    options.jerkLimited = jerkLimited;
    const WayPoints path = randomPath(random, 9);
    int calls = 0;
    const TimedPath timed = timedBy(
        path,
        [&](std::size_t, const PiecewisePolynomial&) {
          ++calls;
          return false;
        },
        options);
    EXPECT_EQ(calls, 7 * 7);  // the whole deviation and six halves of it
    ASSERT_EQ(timed.corners.size(), 7U);
    double alone = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      alone += timedBy({path[i], path[i + 1]}, {}, options).curve.duration();
    EXPECT_NEAR(timed.curve.duration(), alone, 1e-6);
    for (std::size_t i = 0; i < timed.corners.size(); ++i) {
      const TimedCorner& corner = timed.corners[i];
      EXPECT_TRUE(corner.stops());
      EXPECT_EQ(corner.wayPoint, i + 1);
      EXPECT_EQ(corner.before, 0.0);
      EXPECT_EQ(corner.after, 0.0);
      EXPECT_EQ(corner.deviation, 0.0);
      EXPECT_EQ(corner.begin, corner.end);
      const auto point =
          std::ranges::find(timed.trajectory.points, corner.begin, &TrajectoryPoint::time);
      ASSERT_NE(point, timed.trajectory.points.end());
      EXPECT_EQ(VectorXd::Map(point->positions.data(), kJoints), path[i + 1]);
      EXPECT_THAT(point->velocities, testing::Each(0.0));
    }
  }
}

TEST(TimedBlends, AreTheLargestThatIsAccepted) {
  std::mt19937 random(121);
  int reduced = 0;
  for (int round = 0; round < 60; ++round) {
    const double threshold =
        std::pow(10.0, std::uniform_real_distribution<double>(-2.6, -0.9)(random));
    TimingOptions options;
    options.jerkLimited = round % 2 == 1;
    const WayPoints path = randomPath(random, 6);
    std::vector<int> calls(path.size(), 0);
    std::vector<double> first(path.size(), 0.0);
    const TimedPath timed = timedBy(
        path,
        [&](std::size_t, const PiecewisePolynomial& blend) {
          EXPECT_EQ(blend.pieces(), 1U);
          EXPECT_EQ(blend.degree(0), options.jerkLimited ? 4 : 2);
          const VectorXd point = wayPointOf(blend);
          const auto index =
              static_cast<std::size_t>(std::ranges::find(path, point) - path.begin());
          const double off = distanceFrom(point, blend, 0.0, 1.0);
          if (++calls[index] == 1) first[index] = off;
          return off <= threshold;
        },
        options);
    for (const TimedCorner& corner : timed.corners) {
      const std::size_t i = corner.wayPoint;
      ASSERT_FALSE(corner.stops());
      EXPECT_LE(calls[i], 10);
      const double off = distanceFrom(path[i], timed.curve, corner.begin, corner.end);
      EXPECT_LE(off, threshold * (1.0 + 1e-9));
      if (first[i] <= threshold) {
        EXPECT_EQ(calls[i], 1);
        EXPECT_NEAR(off, first[i], 1e-9);
      } else {
        ++reduced;
        EXPECT_GT(off, 0.8 * threshold);
      }
    }
  }
  EXPECT_GT(reduced, 60);
}

TEST(TimedBlends, TakeTheWholeDeviationFirst) {
  std::mt19937 random(122);
  int whole = 0;
  for (int round = 0; round < 20; ++round) {
    const WayPoints path = randomPath(random, 5);
    const TimedPath timed =
        timedBy(path, [](std::size_t, const PiecewisePolynomial&) { return true; });
    const TimedPath free = timedBy(path, {});
    ASSERT_EQ(timed.corners.size(), free.corners.size());
    EXPECT_EQ(timed.curve.duration(), free.curve.duration());
    for (const TimedCorner& corner : timed.corners) whole += corner.deviation > 0.0999;
  }
  EXPECT_GT(whole, 50);
}

/// Nothing of the curve leaves the straight motions but blends that were accepted.
TEST(TimedBlends, AreThoseThatWereAccepted) {
  std::mt19937 random(123);
  for (int round = 0; round < 20; ++round) {
    TimingOptions options;
    options.jerkLimited = round % 2 == 1;
    const WayPoints path = randomPath(random, 8);
    std::vector<PiecewisePolynomial> accepted;
    const TimedPath timed = timedBy(
        path,
        [&](std::size_t, const PiecewisePolynomial& blend) {
          const bool accepts = random() % 3 == 0;
          if (accepts) accepted.push_back(blend);
          return accepts;
        },
        options);
    for (const TimedCorner& corner : timed.corners) {
      if (corner.stops()) continue;
      // The last one of its corner: the largest.
      const auto blend =
          std::ranges::find(accepted.rbegin(), accepted.rend(), path[corner.wayPoint], wayPointOf);
      ASSERT_NE(blend, accepted.rend());
      for (int k = 0; k <= 20; ++k) {
        const double u = k / 20.0;
        const double t = corner.begin + u * (corner.end - corner.begin);
        EXPECT_LE((timed.curve.position(t) - blend->position(u)).norm(), 1e-12);
      }
    }
  }
}

TEST(TimedBlends, AreNotMadeWithoutDeviation) {
  std::mt19937 random(124);
  TimingOptions options;
  options.blendDeviation = 0.0;
  const TimedPath timed = timedBy(
      randomPath(random, 5),
      [](std::size_t, const PiecewisePolynomial&) {
        ADD_FAILURE() << "there is nothing to ask about";
        return true;
      },
      options);
  for (const TimedCorner& corner : timed.corners) EXPECT_TRUE(corner.stops());
}

}  // namespace
}  // namespace swept
