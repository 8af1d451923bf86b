// SPDX-License-Identifier: BSD-3-Clause
// The duration of timed paths against time-optimal motions on a fine grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "timed_paths.hpp"

namespace swept {
namespace {

using Eigen::VectorXd;
using test::WayPoints;

/// The least time along a path with given blends: on a grid, where between two nodes the
/// acceleration along the path is constant. On a blend, the velocity changes evenly from one end to
/// the other.
class GridTiming {
 public:
  GridTiming(const WayPoints& path, const std::vector<TimedCorner>& corners,
             const RateLimits& limits)
      : path_(path), corners_(corners), limits_(limits) {
    for (std::size_t part = 0; part + 1 < path.size(); ++part) {
      addStraight(part);
      if (part < corners.size()) addBlend(part);
    }
  }

  double duration() {
    squares_.front() = squares_.back() = 0.0;
    for (std::size_t i = steps_.size(); i-- > 0;)
      squares_[i] = std::min(squares_[i], steps_[i].before(squares_[i + 1]));
    for (std::size_t i = 0; i < steps_.size(); ++i)
      squares_[i + 1] = std::min(squares_[i + 1], steps_[i].after(squares_[i]));
    double time = 0.0;
    for (std::size_t i = 0; i < steps_.size(); ++i)
      if (steps_[i].length > 0.0)
        time += 2.0 * steps_[i].length / (std::sqrt(squares_[i]) + std::sqrt(squares_[i + 1]));
    return time;
  }

 private:
  /// From one node to the next. On a blend the speeds at its ends have a fixed ratio, and `length`
  /// is that of both its sides, which are driven at the mean speed.
  struct Step {
    double length = 0.0;
    double change = 0.0;  ///< largest of the square of the speed
    double ratio = 0.0;   ///< of the squares; 0: none

    double after(double square) const { return ratio > 0.0 ? ratio * square : square + change; }
    double before(double square) const { return ratio > 0.0 ? square / ratio : square + change; }
  };

  VectorXd direction(std::size_t part) const {
    return (path_[part + 1] - path_[part]).normalized();
  }

  void addStraight(std::size_t part) {
    const VectorXd d = direction(part);
    double speed = 1e9;
    double acceleration = 1e9;
    for (int j = 0; j < d.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      if (d[j] == 0.0) continue;
      speed = std::min(speed, limits_.velocity[i] / std::abs(d[j]));
      acceleration = std::min(acceleration, limits_.acceleration[i] / std::abs(d[j]));
    }
    const double length = (path_[part + 1] - path_[part]).norm() -
                          (part > 0 ? corners_[part - 1].after : 0.0) -
                          (part < corners_.size() ? corners_[part].before : 0.0);
    const auto nodes =
        static_cast<std::size_t>(std::ceil(2000.0 / static_cast<double>(path_.size())));
    if (squares_.empty()) squares_.push_back(speed * speed);
    squares_.back() = std::min(squares_.back(), speed * speed);
    for (std::size_t k = 0; k < nodes; ++k) {
      const double step = length / static_cast<double>(nodes);
      steps_.push_back({step, 2.0 * acceleration * step, 0.0});
      squares_.push_back(speed * speed);
    }
  }

  /// Between the straight parts `part` and part + 1.
  void addBlend(std::size_t part) {
    const TimedCorner& corner = corners_[part];
    if (corner.stops()) {
      squares_.back() = 0.0;
      return;
    }
    const double ratio = corner.after / corner.before;
    // At the speed v before it, the velocities are v d1 and ratio v d2, and the time 2 before / v.
    const VectorXd change = ratio * direction(part + 1) - direction(part);
    for (int j = 0; j < change.size(); ++j)
      squares_.back() =
          std::min(squares_.back(), limits_.acceleration[static_cast<std::size_t>(j)] * 2.0 *
                                        corner.before / std::abs(change[j]));
    steps_.push_back({corner.before + corner.after, 0.0, ratio * ratio});
    squares_.push_back(1e18);
  }

  const WayPoints& path_;
  const std::vector<TimedCorner>& corners_;
  const RateLimits& limits_;
  std::vector<Step> steps_;
  std::vector<double> squares_;  ///< of the speed at each node
};

TEST(TimeOptimality, IsThatOfAFineGrid) {
  std::mt19937 random(110);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int blended = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const int joints = 1 + round % 9;
    const auto robot = test::chainRobot(joints);
    RateLimits limits = test::sameLimits(joints, 1.0, 1.0, 1.0);
    for (double& limit : limits.velocity) limit = uniform(0.5, 3.0);
    for (double& limit : limits.acceleration) limit = std::pow(10.0, uniform(-0.5, 1.5));
    const double size = std::pow(10.0, uniform(-1.0, 0.5));
    WayPoints path(1, VectorXd::Zero(joints));
    const int count = 2 + static_cast<int>(uniform(0.0, 29.0));
    while (std::ssize(path) < count) {
      VectorXd step(joints);
      for (double& value : step) value = uniform(-size, size);
      if (joints == 1) step = step.cwiseAbs();  // no corner turns back, which is a stop
      path.push_back(path.back() + step);
    }
    const TimedPath timed = timeParameterize(*robot, robot->groups()[0], path, limits);
    if (joints == 1) {
      EXPECT_TRUE(timed.corners.empty());
      path = {path.front(), path.back()};
    }
    const double expected = GridTiming(path, timed.corners, limits).duration();
    EXPECT_NEAR(timed.curve.duration(), expected, 0.005 * expected);
    for (const TimedCorner& corner : timed.corners) blended += !corner.stops();
  }
  EXPECT_GT(blended, 1500);
}

/// A right angle with limits that are equal in all directions of the plane: the best blend of equal
/// lengths follows from a formula.
TEST(TimeOptimality, UsesTheWholeDeviation) {
  const auto robot = test::chainRobot(2);
  const RateLimits limits = test::sameLimits(2, 1e3, 1.0, 1.0);
  const WayPoints path{VectorXd{{0.0, 0.0}}, VectorXd{{10.0, 0.0}}, VectorXd{{10.0, 10.0}}};
  const TimedPath timed = timeParameterize(*robot, robot->groups()[0], path, limits);
  ASSERT_EQ(timed.corners.size(), 1U);
  const TimedCorner& corner = timed.corners[0];
  EXPECT_NEAR(corner.deviation, 0.1, 1e-9);
  const double length = 4.0 * 0.1 / std::sqrt(2.0);  // |d2 - d1| = sqrt(2)
  EXPECT_NEAR(corner.before, length, 0.02 * length);
  EXPECT_NEAR(corner.after, length, 0.02 * length);
  // There the speed is v^2 = 2 b, and before it is that of a triangle from rest to v.
  const double speed = std::sqrt(2.0 * length);
  const double straight = 2.0 * std::sqrt(10.0 - length + 0.5 * speed * speed) - speed;
  EXPECT_NEAR(timed.curve.duration(), 2.0 * straight + 2.0 * length / speed, 1e-3);
}

/// The same with limits of jerk: each of the three kinds of limits in turn is the one that counts.
TEST(TimeOptimality, DrivesBlendsWithoutJumpsAsFastAsAllowed) {
  const auto robot = test::chainRobot(2);
  const WayPoints path{VectorXd{{0.0, 0.0}}, VectorXd{{10.0, 0.0}}, VectorXd{{10.0, 10.0}}};
  for (const RateLimits& limits :
       {test::sameLimits(2, 0.1, 1.0, 100.0), test::sameLimits(2, 10.0, 1.0, 100.0),
        test::sameLimits(2, 10.0, 10.0, 1.0)}) {
    TimingOptions options;
    options.jerkLimited = true;
    const TimedPath timed = timeParameterize(*robot, robot->groups()[0], path, limits, {}, options);
    ASSERT_EQ(timed.corners.size(), 1U);
    const TimedCorner& corner = timed.corners[0];
    EXPECT_FALSE(corner.stops());
    const double length = std::max(corner.before, corner.after);
    // The speed 2 b / T; of each variable, the acceleration 3 b / T^2 and the jerk 12 b / T^3.
    const double expected = std::max({2.0 * length / limits.velocity[0],
                                      std::sqrt(3.0 * length / limits.acceleration[0]),
                                      std::cbrt(12.0 * length / limits.jerk[0])});
    EXPECT_NEAR(corner.end - corner.begin, expected, 1e-3 * expected);
  }
}

/// A path that is divided takes no longer, and one with a larger deviation neither.
TEST(TimeOptimality, GrowsWithNothingThatGivesRoom) {
  std::mt19937 random(111);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto robot = test::chainRobot(4);
  const RateLimits limits = test::sameLimits(4, 2.0, 5.0, 50.0);
  for (int round = 0; round < 50; ++round) {
    WayPoints path;
    for (int i = 0; i < 8; ++i) {
      VectorXd q(4);
      for (double& value : q) value = uniform(random);
      path.push_back(q);
    }
    WayPoints divided;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      for (int k = 0; k < 5; ++k) divided.push_back(path[i] + 0.2 * k * (path[i + 1] - path[i]));
    divided.push_back(path.back());
    const auto duration = [&](const WayPoints& points, double deviation) {
      TimingOptions options;
      options.blendDeviation = deviation;
      return timeParameterize(*robot, robot->groups()[0], points, limits, {}, options)
          .curve.duration();
    };
    const double expected = duration(path, 0.1);
    EXPECT_NEAR(duration(divided, 0.1), expected, 1e-6 * expected);
    EXPECT_LT(expected, duration(path, 0.01));
    EXPECT_LT(duration(path, 0.01), duration(path, 0.0));
    EXPECT_LE(duration(path, 0.5), expected);
  }
}

}  // namespace
}  // namespace swept
