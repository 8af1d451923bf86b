// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "swept/robot_model/time_parameterization.hpp"
#include "urdf_text.hpp"

/// Paths to time, and what a timed path must keep.
namespace swept::test {

using WayPoints = std::vector<Eigen::VectorXd>;

/// A chain of revolute joints `j0`, `j1`, ... with wide limits.
inline std::shared_ptr<const Robot> chainRobot(int joints) {
  std::string text = "<robot name='chain'><link name='l0'/>";
  for (int i = 0; i < joints; ++i) {
    const std::string child = "l" + std::to_string(i + 1);
    text += "<link name='" + child + "'/>" +
            joint("j" + std::to_string(i), "revolute", "l" + std::to_string(i), child,
                  limited("0 0 1", -1e9, 1e9));
  }
  return Robot::parse(text + "</robot>", "chain.urdf");
}

inline RateLimits sameLimits(int joints, double velocity, double acceleration, double jerk) {
  const auto size = static_cast<std::size_t>(joints);
  return {std::vector<double>(size, velocity), std::vector<double>(size, acceleration),
          std::vector<double>(size, jerk)};
}

/// The largest share of its limit that a rate of a curve reaches.
struct Shares {
  long double velocity = 0.0L;
  long double acceleration = 0.0L;
  long double jerk = 0.0L;
};

/// The range of a polynomial on [0, 1] by Bernstein coefficients, halved until its ends are as
/// large as they are, or eight times.
inline long double largestOf(std::vector<long double> b, int halvings = 8) {
  const auto size = [](long double x, long double y) { return std::abs(x) < std::abs(y); };
  const long double bound = std::abs(*std::max_element(b.begin(), b.end(), size));
  if (halvings == 0 || bound <= std::max(std::abs(b.front()), std::abs(b.back()))) return bound;
  std::vector<long double> first;
  std::vector<long double> rest = b;
  for (std::size_t n = b.size(); n > 0; --n) {
    first.push_back(rest[0]);
    for (std::size_t k = 0; k + 1 < n; ++k) rest[k] = 0.5L * (rest[k] + rest[k + 1]);
  }
  return std::max(largestOf(first, halvings - 1), largestOf(rest, halvings - 1));
}

/// Bounds over the whole curve, in 64 bits of mantissa.
inline Shares sharesOf(const PiecewisePolynomial& curve, const RateLimits& limits) {
  Shares shares;
  for (std::size_t i = 0; i < curve.pieces(); ++i) {
    const long double time =
        static_cast<long double>(curve.knots()[i + 1]) - static_cast<long double>(curve.knots()[i]);
    for (int row = 0; row < curve.dimension(); ++row) {
      const auto j = static_cast<std::size_t>(row);
      std::vector<long double> b;
      for (int k = 0; k <= curve.degree(i); ++k) b.push_back(curve.coefficients(i)(row, k));
      for (const auto& [share, limit] : {std::pair{&shares.velocity, limits.velocity[j]},
                                         std::pair{&shares.acceleration, limits.acceleration[j]},
                                         std::pair{&shares.jerk, limits.jerk[j]}}) {
        if (b.size() < 2) break;
        const auto degree = static_cast<long double>(b.size() - 1);
        for (std::size_t k = 0; k + 1 < b.size(); ++k) b[k] = (b[k + 1] - b[k]) * degree / time;
        b.pop_back();
        *share = std::max(*share, largestOf(b) / static_cast<long double>(limit));
      }
    }
  }
  return shares;
}

/// The distance of a point from a straight segment.
inline double distanceFrom(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                           const Eigen::VectorXd& p) {
  const Eigen::VectorXd line = b - a;
  const double square = line.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - a).dot(line) / square, 0.0, 1.0) : 0.0;
  return (p - a - share * line).norm();
}

/// The distance of a point from a path of straight segments.
inline double distanceFrom(const WayPoints& path, const Eigen::VectorXd& p) {
  double least = (p - path.front()).norm();
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    least = std::min(least, distanceFrom(path[i], path[i + 1], p));
  return least;
}

/// As a message has it.
inline long long nanosecondsOf(const TrajectoryPoint& point) {
  return std::llround(static_cast<long double>(point.time) * 1e9L);
}

/// What holds for every timed path, whatever the options.
inline void expectWellTimed(const TimedPath& timed, const WayPoints& path, const RateLimits& limits,
                            const TimingOptions& options) {
  RateLimits scaled = limits;
  for (double& limit : scaled.velocity) limit *= options.velocityScale;
  for (double& limit : scaled.acceleration) limit *= options.accelerationScale;
  const Shares shares = sharesOf(timed.curve, scaled);
  EXPECT_LE(shares.velocity, 1.0L);
  EXPECT_LE(shares.acceleration, 1.0L);
  if (options.jerkLimited) {
    EXPECT_LE(shares.jerk, 1.0L);
  }
  const std::vector<TrajectoryPoint>& points = timed.trajectory.points;
  for (const TrajectoryPoint* end : {&points.front(), &points.back()}) {
    EXPECT_EQ(Eigen::VectorXd::Map(end->positions.data(), std::ssize(end->positions)),
              end == &points.front() ? path.front() : path.back());
    EXPECT_TRUE(std::ranges::all_of(end->velocities, [](double v) { return v == 0.0; }));
  }
  EXPECT_EQ(points.front().time, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].accelerations.empty(), !options.jerkLimited);
    const long long time = nanosecondsOf(points[i]);
    EXPECT_EQ(points[i].time, static_cast<double>(time) / 1e9) << "no whole nanoseconds";
    if (i > 0) {
      EXPECT_GT(time, nanosecondsOf(points[i - 1]));
    }
  }
}

}  // namespace swept::test
