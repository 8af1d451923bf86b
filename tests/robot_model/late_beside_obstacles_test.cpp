// SPDX-License-Identifier: BSD-3-Clause
// Robots that are late beside a bar that moves and turns and is never late: samples of delays
// against what is proven, by plane geometry alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "crossing_robot.hpp"
#include "swept/robot_model/schedule.hpp"
#include "swept/robot_model/schedule_checker.hpp"

namespace swept {
namespace {

constexpr double kCube = 0.1;                   // m, half of a side
constexpr double kLength = 0.5, kWidth = 0.05;  // m, half sides of the bar

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * 0x1p-32 * static_cast<double>(random());
}

/// Where the bar is at a time.
struct Stop {
  double time, x, y, angle;  // s, m, rad
};

Stop barAt(const std::vector<Stop>& stops, double time) {
  if (time <= stops.front().time) return stops.front();
  for (std::size_t i = 1; i < stops.size(); ++i) {
    if (time > stops[i].time) continue;
    const Stop &from = stops[i - 1], &to = stops[i];
    const double share = (time - from.time) / (to.time - from.time);
    return {time, std::lerp(from.x, to.x, share), std::lerp(from.y, to.y, share),
            std::lerp(from.angle, to.angle, share)};
  }
  return stops.back();
}

/// Whether the bar and a cube at (x, y) overlap: no axis of either separates them.
bool overlap(const Stop& bar, double x, double y) {
  const double c = std::abs(std::cos(bar.angle)), s = std::abs(std::sin(bar.angle));
  const double dx = x - bar.x, dy = y - bar.y;
  const double along = dx * std::cos(bar.angle) + dy * std::sin(bar.angle);
  const double across = dy * std::cos(bar.angle) - dx * std::sin(bar.angle);
  return std::abs(dx) < kCube + kLength * c + kWidth * s &&
         std::abs(dy) < kCube + kLength * s + kWidth * c &&
         std::abs(along) < kLength + kCube * (c + s) && std::abs(across) < kWidth + kCube * (c + s);
}

/// A bar, and a way of each cube.
struct Scene {
  std::vector<Stop> stops;
  PiecewisePolynomial east, north;

  bool meets(double time, double ofEast, double ofNorth) const {
    const double x = east.position(ofEast)[0], y = north.position(ofNorth)[0];
    const Stop bar = barAt(stops, time);
    return overlap(bar, x, 0.0) || overlap(bar, 0.0, y) ||
           (std::abs(x) < 2.0 * kCube && std::abs(y) < 2.0 * kCube);
  }
};

PiecewisePolynomial randomWay(std::mt19937& random) {
  std::vector<double> knots{0.0};
  std::vector<Eigen::MatrixXd> pieces;
  double from = uniform(random, -1.5, 1.5);
  for (int i = 0; i < 3; ++i) {
    const double to = uniform(random, -1.5, 1.5);
    knots.push_back(knots.back() + uniform(random, 0.7, 2.0));
    pieces.emplace_back(1, 2);
    pieces.back() << from, to;
    from = to;
  }
  return {knots, pieces};
}

Scene randomScene(std::mt19937& random) {
  std::vector<Stop> stops{{uniform(random, -0.5, 0.5), uniform(random, -2.0, 2.0),
                           uniform(random, -2.0, 2.0), uniform(random, -3.0, 3.0)}};
  for (int i = 0; i < 3; ++i)
    stops.push_back({stops.back().time + uniform(random, 0.5, 2.0), uniform(random, -2.0, 2.0),
                     uniform(random, -2.0, 2.0), stops.back().angle + uniform(random, -2.5, 2.5)});
  return {std::move(stops), randomWay(random), randomWay(random)};
}

Checker checkerOf(const std::shared_ptr<const Robot>& robot, const Scene& scene) {
  World world;
  MovingObstacle bar{
      .name = "bar",
      .parts = {{makeBox({2.0 * kLength, 2.0 * kWidth, 0.1}), Eigen::Isometry3d::Identity()}}};
  for (const Stop& stop : scene.stops) {
    Eigen::Isometry3d pose(Eigen::Translation3d(stop.x, stop.y, 0.0));
    pose.rotate(Eigen::AngleAxisd(stop.angle, Eigen::Vector3d::UnitZ()));
    bar.waypoints.push_back({stop.time, pose});
  }
  world.add(std::move(bar));
  return {robot, "all", std::make_shared<World>(std::move(world))};
}

std::shared_ptr<const Robot> crossing() {
  return Robot::parse(test::crossingUrdf({{"east", "1 0 0"}, {"north", "0 1 0"}}), "crossing.urdf");
}

TEST(LateBesideObstacles, NothingRefutesWhatAPlannerIsTold) {
  const auto robot = crossing();
  std::mt19937 random(11);
  int free = 0, refuted = 0, onlyLate = 0, unknown = 0, slow = 0;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = randomScene(random);
    const Checker checker = checkerOf(robot, scene);
    const double delay = i % 4 == 3 ? 0.0 : uniform(random, 0.1, 0.6);
    const double slowest = i % 4 < 2 ? 1.0 : uniform(random, 1.02, 1.3);
    const auto verdict = [&](double room, double factor) {
      const ScheduleChecker beside(checker, {"east"},
                                   {{.variables = {"north"}, .curve = scene.north}}, {}, {}, room,
                                   factor);
      Workspace workspace(beside.checker());
      return beside.certify(scene.east, workspace).verdict;
    };
    const bool onTime = verdict(0.0, 1.0) == Verdict::Free;
    const bool late = onTime && verdict(delay, slowest) == Verdict::Free;
    // Only pairs that `east` moves are asked about: `north` may meet the bar.
    const auto refutes = [&] {
      for (int k = 0; k < 2000; ++k) {
        const double own = uniform(random, 0.0, delay), factor = uniform(random, 1.0, slowest);
        const double time = uniform(random, 0.0, factor * scene.east.end() + own);
        const bool isEastLate = k % 2 == 0;
        const double lateTime = (time - own) / factor;
        const double x = scene.east.position(isEastLate ? lateTime : time)[0];
        const double y = scene.north.position(isEastLate ? time : lateTime)[0];
        if (!isEastLate && time > scene.east.end()) continue;
        if (overlap(barAt(scene.stops, time), x, 0.0)) return true;
        if (std::abs(x) < 2.0 * kCube && std::abs(y) < 2.0 * kCube) return true;
      }
      return false;
    };
    const bool isRefutedBySamples = refutes();
    EXPECT_FALSE(late && isRefutedBySamples) << i;
    free += late ? 1 : 0;
    refuted += isRefutedBySamples ? 1 : 0;
    onlyLate += onTime && isRefutedBySamples ? 1 : 0;
    unknown += !late && !isRefutedBySamples ? 1 : 0;
    slow += late && slowest > 1.0 ? 1 : 0;
  }
  EXPECT_GE(free, 30);
  EXPECT_GE(slow, 15);
  EXPECT_GE(refuted, 60);
  EXPECT_GE(onlyLate, 10);  // free on time, and in contact if late
  EXPECT_LE(unknown, 53);
}

TEST(LateBesideObstacles, NothingRefutesACertificate) {
  const auto robot = crossing();
  std::mt19937 random(12);
  int whole = 0, partly = 0;
  for (int i = 0; i < 200; ++i) {
    const Scene scene = randomScene(random);
    const Checker checker = checkerOf(robot, scene);
    const std::vector<ScheduledCurve> curves{{.variables = {"east"}, .curve = scene.east},
                                             {.variables = {"north"}, .curve = scene.north}};
    const DelayQuery query{.latest = 0.6, .slowest = i % 2 == 0 ? 1.0 : 1.1, .resolution = 5e-3};
    const DelayCertificate found = certifyDelays(checker, curves, query);
    if (!found.proven) continue;
    ++(*found.proven == query.latest ? whole : partly);
    for (int k = 0; k < 2000; ++k) {
      const double late = uniform(random, 0.0, *found.proven);
      const double slower = uniform(random, 1.0, query.slowest);
      const double end = std::max(late + slower * scene.east.end(), scene.north.end());
      const double time = uniform(random, 0.0, end);
      EXPECT_FALSE(scene.meets(time, (time - late) / slower, time)) << i << ' ' << time;
    }
  }
  EXPECT_GE(whole, 8);
  EXPECT_GE(partly, 5);
}

}  // namespace
}  // namespace swept
