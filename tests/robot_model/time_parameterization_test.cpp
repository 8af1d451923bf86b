// SPDX-License-Identifier: BSD-3-Clause
// What a timed path keeps: limits, the straight motions, and the curve that a controller makes.
#include "swept/robot_model/time_parameterization.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "foreign_environment.hpp"
#include "timed_paths.hpp"

namespace swept {
namespace {

using Eigen::VectorXd;
using test::WayPoints;

/// Random paths of 2 to 30 way points in 1 to 9 dimensions, with limits of one size or of many.
class RandomPaths {
 public:
  explicit RandomPaths(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  void next() {
    joints = whole(1, 9);
    robot = test::chainRobot(joints);
    const bool wide = whole(0, 1) == 1;
    limits = {};
    for (int j = 0; j < joints; ++j) {
      limits.velocity.push_back(wide ? std::pow(10.0, uniform(-1.0, 2.0)) : uniform(1.0, 3.0));
      limits.acceleration.push_back(wide ? std::pow(10.0, uniform(-1.0, 2.0)) : uniform(2.0, 8.0));
      limits.jerk.push_back(wide ? std::pow(10.0, uniform(0.0, 3.0)) : uniform(20.0, 80.0));
    }
    const double size = std::pow(10.0, uniform(-2.0, 0.5));
    path.assign(1, point(2.0));
    const int count = whole(2, 30);
    while (std::ssize(path) < count) {
      VectorXd step = point(size);
      // On a line each way point turns back: others would be left out.
      if (joints == 1) step = step.cwiseAbs() * (path.size() % 2 == 0 ? 1.0 : -1.0);
      path.push_back(path.back() + step);
    }
    options = {};
    options.blendDeviation = whole(0, 3) == 0 ? 0.0 : std::pow(10.0, uniform(-3.0, 0.0));
    options.velocityScale = whole(0, 1) == 0 ? 1.0 : uniform(0.1, 1.0);
    options.accelerationScale = whole(0, 1) == 0 ? 1.0 : uniform(0.1, 1.0);
  }

  TimedPath timed() const {
    return timeParameterize(*robot, robot->groups()[0], path, limits, {}, options);
  }

  int joints = 0;
  std::shared_ptr<const Robot> robot;
  RateLimits limits;
  WayPoints path;
  TimingOptions options;

 private:
  VectorXd point(double size) {
    VectorXd q(joints);
    for (double& value : q) value = uniform(-size, size);
    return q;
  }

  std::mt19937 random_;
};

/// The blend at a corner by its definition, at a share u of its time.
VectorXd blendAt(const RandomPaths& paths, const TimedCorner& corner, double u) {
  const std::size_t i = corner.wayPoint;
  const VectorXd in = (paths.path[i] - paths.path[i - 1]).normalized();
  const VectorXd out = (paths.path[i + 1] - paths.path[i]).normalized();
  const auto share = [&](double t) {
    return paths.options.jerkLimited ? 2.0 * t * t * t - t * t * t * t : t * t;
  };
  return paths.path[i] - corner.before * share(1.0 - u) * in + corner.after * share(u) * out;
}

/// How the curve compares with the path: blends as defined, else on the straight motions, with an
/// acceleration along them.
void expectOnPath(const RandomPaths& paths, const TimedPath& timed) {
  constexpr int kSamples = 16;
  double begin = 0.0;
  for (std::size_t i = 0; i <= timed.corners.size(); ++i) {
    const double end =
        i < timed.corners.size() ? timed.corners[i].begin : timed.trajectory.points.back().time;
    const VectorXd& from = paths.path[i];
    const VectorXd& to = paths.path[i + 1];
    const VectorXd direction = (to - from).normalized();
    for (int k = 0; k <= kSamples; ++k) {
      const double t = begin + (end - begin) * k / kSamples;
      EXPECT_LE(test::distanceFrom(from, to, timed.curve.position(t)), 1e-12);
      const VectorXd rate = timed.curve.velocity(t);
      EXPECT_LE((rate - rate.dot(direction) * direction).norm(), 1e-9 * (1.0 + rate.norm()));
    }
    if (i == timed.corners.size()) break;
    const TimedCorner& corner = timed.corners[i];
    ASSERT_EQ(corner.wayPoint, i + 1);
    EXPECT_LE(corner.deviation, paths.options.blendDeviation);
    for (int k = 0; k <= kSamples; ++k) {
      const double u = static_cast<double>(k) / kSamples;
      const VectorXd q = timed.curve.position(corner.begin + u * (corner.end - corner.begin));
      EXPECT_LE((q - blendAt(paths, corner, u)).norm(), 1e-10);
      EXPECT_LE(test::distanceFrom(paths.path, q), corner.deviation + 1e-12);
    }
    begin = corner.end;
  }
}

/// Within the box of the way points.
void expectInBox(const RandomPaths& paths, const TimedPath& timed) {
  VectorXd low = paths.path[0];
  VectorXd high = paths.path[0];
  for (const VectorXd& q : paths.path) {
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  for (std::size_t i = 0; i < timed.curve.pieces(); ++i) {
    const Eigen::MatrixXd& piece = timed.curve.coefficients(i);
    EXPECT_LE((piece.colwise() - high).maxCoeff(), 1e-12);
    EXPECT_GE((piece.colwise() - low).minCoeff(), -1e-12);
  }
}

TEST(TimeParameterization, KeepsLimitsAndPath) {
  RandomPaths paths(101);
  int blends = 0;
  int stops = 0;
  int limitedByVelocity = 0;
  int limitedByAcceleration = 0;
  constexpr int kRounds = 300;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    paths.next();
    const TimedPath timed = paths.timed();
    test::expectWellTimed(timed, paths.path, paths.limits, paths.options);
    expectOnPath(paths, timed);
    expectInBox(paths, timed);
    for (const TimedCorner& corner : timed.corners) (corner.stops() ? stops : blends) += 1;
    const test::Shares shares = test::sharesOf(timed.curve, paths.limits);
    limitedByVelocity += shares.velocity > 0.999L * paths.options.velocityScale;
    limitedByAcceleration += shares.acceleration > 0.999L * paths.options.accelerationScale;
  }
  EXPECT_GT(blends, 1000);
  EXPECT_GT(stops, 300);
  EXPECT_GT(limitedByVelocity, kRounds / 5);
  EXPECT_EQ(limitedByAcceleration, kRounds);
}

TEST(TimeParameterization, WithLimitedJerkKeepsThatToo) {
  RandomPaths paths(102);
  int limitedByJerk = 0;
  constexpr int kRounds = 150;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    paths.next();
    paths.options.jerkLimited = true;
    const TimedPath timed = paths.timed();
    test::expectWellTimed(timed, paths.path, paths.limits, paths.options);
    expectOnPath(paths, timed);
    // The acceleration is continuous.
    const std::vector<double>& knots = timed.curve.knots();
    for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
      const double step = 1e-6 * (knots[i] - knots[i - 1]);
      const VectorXd before = timed.curve.acceleration(knots[i] - step);
      const VectorXd jump = timed.curve.acceleration(knots[i]) - before;
      for (int j = 0; j < paths.joints; ++j)
        EXPECT_LE(std::abs(jump[j]), 1e-3 * paths.limits.acceleration[static_cast<std::size_t>(j)]);
    }
    limitedByJerk += test::sharesOf(timed.curve, paths.limits).jerk > 0.99L;
  }
  EXPECT_GT(limitedByJerk, kRounds / 2);
}

/// The trajectory as a message has it: time_from_start in seconds and nanoseconds.
TEST(TimeParameterization, IsTheSameAfterAMessage) {
  RandomPaths paths(103);
  for (int round = 0; round < 20; ++round) {
    paths.next();
    const TimedPath timed = paths.timed();
    JointTrajectory message = timed.trajectory;
    for (TrajectoryPoint& point : message.points) {
      const long long time = test::nanosecondsOf(point);
      const long long whole = time / 1'000'000'000;
      const long long rest = time % 1'000'000'000;
      point.time = static_cast<double>(whole) + static_cast<double>(rest) * 1e-9;
    }
    const PiecewisePolynomial curve = controllerCurve(message);
    for (int k = 0; k <= 100; ++k) {
      const double t = timed.curve.end() * k / 100.0;
      EXPECT_LE((curve.position(t) - timed.curve.position(t)).norm(), 1e-12);
    }
  }
}

TEST(TimeParameterization, IsTheSameInEveryEnvironment) {
  RandomPaths paths(104);
  for (int round = 0; round < 6; ++round) {
    paths.next();
    paths.options.jerkLimited = round % 2 == 0;
    const TimedPath expected = paths.timed();
    for (const test::Environment& environment : test::foreignEnvironments()) {
      std::vector<TrajectoryPoint> points;
      EXPECT_TRUE(
          test::leavesAlone(environment, [&] { points = paths.timed().trajectory.points; }));
      ASSERT_EQ(points.size(), expected.trajectory.points.size()) << environment.name;
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(points[i].time, expected.trajectory.points[i].time);
        EXPECT_EQ(points[i].positions, expected.trajectory.points[i].positions);
        EXPECT_EQ(points[i].velocities, expected.trajectory.points[i].velocities);
      }
    }
  }
}

}  // namespace
}  // namespace swept
