// SPDX-License-Identifier: BSD-3-Clause
// What the checker of proofs knows of a body that moves, against the library's poses at many times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "swept/robot_model/world.hpp"
#include "verify/model.hpp"
#include "verify/obstacle.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using verify::ClockSpan;
using verify::Json;
using verify::Obstacle;

class RandomObstacles {
 public:
  explicit RandomObstacles(unsigned seed) : engine_(seed) {}
  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  Vector3d vector(double most) {
    return {uniform(-most, most), uniform(-most, most), uniform(-most, most)};
  }
  /// Waypoints 0.01 to 2 s apart; up to 2.9 rad between two orientations, in half of them none.
  std::vector<MovingObstacle::Waypoint> waypoints() {
    std::vector<MovingObstacle::Waypoint> list;
    const bool turns = uniform(0.0, 1.0) < 0.5;
    const auto count = static_cast<std::size_t>(uniform(1.0, 12.0));
    double time = uniform(-3.0, 0.0);
    Quaterniond turn = Quaterniond::Identity();
    for (std::size_t i = 0; i < count; ++i) {
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = vector(2.0);
      if (turns) turn = Eigen::AngleAxisd(uniform(0.0, 2.9), vector(1.0).normalized()) * turn;
      pose.linear() = turn.toRotationMatrix();
      list.push_back({time, pose});
      time += std::exp(uniform(std::log(0.01), std::log(2.0)));
    }
    return list;
  }

 private:
  std::mt19937_64 engine_;
};

Obstacle asProofsHaveIt(const std::vector<MovingObstacle::Waypoint>& list) {
  std::vector<Obstacle::Waypoint> waypoints;
  for (const MovingObstacle::Waypoint& own : list)
    waypoints.push_back({.time = own.time,
                         .position = own.world_from_body.translation(),
                         .orientation = Quaterniond(own.world_from_body.linear())});
  return Obstacle(waypoints);
}

TEST(ObstacleBounds, HoldOfEveryPointAtEveryTime) {
  RandomObstacles random(3);
  constexpr double kReach = 0.7;  // m
  double tightest = 0.0;
  int corners = 0, still = 0, swinging = 0;
  for (int i = 0; i < 6000; ++i) {
    const MovingObstacle source{.name = "a", .parts = {}, .waypoints = random.waypoints()};
    const Obstacle obstacle = asProofsHaveIt(source.waypoints);
    const double from = random.uniform(0.0, 3.0);
    const ClockSpan span{
        .clock = random.uniform(-3.0, 0.0), .from = from, .to = from + random.uniform(0.1, 4.0)};
    const double half = 0.5 * std::pow(0.5, std::floor(random.uniform(0.0, 6.0)));
    const double middle = random.uniform(half, 1.0 - half);
    const Obstacle::Placed placed = obstacle.at(span, middle);
    const Isometry3d own = source.poseAt(span.timeAt(middle));
    EXPECT_LT((placed.world_from_body.matrix() - own.matrix()).cwiseAbs().maxCoeff(), 1e-12);
    const Obstacle::Bounds bounds = obstacle.bounds(span, kReach, middle, half);
    EXPECT_GE(bounds.extent, kReach + own.translation().norm() - 1e-12);
    const double begin = span.timeAt(middle - half), end = span.timeAt(middle + half);
    bool corner = false;
    for (const MovingObstacle::Waypoint& waypoint : source.waypoints)
      corner = corner || (waypoint.time > begin && waypoint.time < end);
    corners += corner ? 1 : 0;
    still += bounds.deviation == 0.0 ? 1 : 0;
    swinging += bounds.spin > 0.0 ? 1 : 0;
    const Vector3d x = kReach * random.vector(1.0).normalized();
    const Vector3d at = placed.world_from_body * x;
    const Vector3d velocity = placed.linear + placed.angular.cross(at);
    for (int k = -20; k <= 20; ++k) {
      const double s = half * k / 20.0;
      const Vector3d there = source.poseAt(span.timeAt(middle + s)) * x;
      const double off = (there - at - s * velocity).norm();
      EXPECT_LE(off, 0.5 * bounds.deviation + 1e-12) << i;
      if (bounds.deviation > 1e-9) tightest = std::max(tightest, 2.0 * off / bounds.deviation);
      const double turned =
          Quaterniond(own.linear())
              .angularDistance(Quaterniond(source.poseAt(span.timeAt(middle + s)).linear()));
      EXPECT_LE(turned, bounds.spin + 1e-7) << i;
    }
  }
  EXPECT_GT(corners, 800);
  EXPECT_GT(still, 400);
  EXPECT_GT(swinging, 400);
  EXPECT_GT(tightest, 0.9) << "a bound that nothing comes near says little";
}

/// A number that has been left out of a sum of sizes would be missed where it is the only large
/// one.
TEST(ObstacleBounds, CountTheSizesOfTimes) {
  Isometry3d there = Isometry3d::Identity();
  there.translation().x() = 1.0;
  const Obstacle obstacle = asProofsHaveIt({{0.0, Isometry3d::Identity()}, {1.0, there}});
  const auto extent = [&](const ClockSpan& span) {
    return obstacle.bounds(span, 0.0, 0.5, 0.5).extent;
  };
  EXPECT_GE(extent({.clock = 1e6, .from = 0.0, .to = 1.0}), 1e6);
  EXPECT_GE(extent({.clock = -1e6, .from = 1e6, .to = 1e6 + 1.0}), 3e6);
  EXPECT_GE(asProofsHaveIt({{-1e6, Isometry3d::Identity()}, {1.0 - 1e6, there}})
                .bounds({.clock = 0.0, .from = 0.0, .to = 1.0}, 0.0, 0.5, 0.5)
                .extent,
            1e6);
}

TEST(ObstacleBounds, WaypointsThatAreNoneAreRefused) {
  const auto refusal = [](const std::string& list) -> std::string {
    try {
      verify::readObstacle(Json::parse("{\"waypoints\": " + list + "}"), "body a");
    } catch (const verify::Refusal& refused) {
      return refused.what();
    }
    return {};
  };
  const std::string start = R"({"time": 0, "position": [0, 0, 0], "orientation": [0, 0, 0, 1]})";
  const auto then = [&](const std::string& entry) {
    return refusal("[" + start + ", " + entry + "]");
  };
  EXPECT_EQ(refusal("[]"), "body a, waypoints: there is none");
  EXPECT_EQ(refusal("{}"), "body a: waypoints is not a list");
  EXPECT_EQ(then(R"({"time": 0, "position": [0, 0, 0], "orientation": [0, 0, 0, 1]})"),
            "body a, waypoint 2, time: it is not after the one before");
  EXPECT_EQ(then(R"({"time": 1e200, "position": [0, 0, 0], "orientation": [0, 0, 0, 1]})"),
            "body a, waypoint 2, time: it is too far away");
  EXPECT_EQ(then(R"({"time": 1, "position": [0, 1e200, 0], "orientation": [0, 0, 0, 1]})"),
            "body a, waypoint 2, position: it is too far away");
  EXPECT_EQ(then(R"({"time": "1", "position": [0, 0, 0], "orientation": [0, 0, 0, 1]})"),
            "body a, waypoint 2, time: not a number: \"1\"");
  EXPECT_EQ(then(R"({"time": 1, "position": [0, 0], "orientation": [0, 0, 0, 1]})"),
            "body a, waypoint 2, position: not three numbers");
  EXPECT_EQ(then(R"({"time": 1, "position": [0, 0, 0], "orientation": [0, 0, 0, 0]})"),
            "body a, waypoint 2, orientation: a quaternion has no direction");
  EXPECT_EQ(
      then(R"({"time": 1, "position": [0, 0, 0], "orientation": [0, 0, 1, 0]})"),
      "body a, waypoint 2, orientation: it is about half a turn from the one before, and which "
      "way round is not told");
  EXPECT_EQ(then(R"({"time": 1, "position": [0, 0, 0], "orientation": [0, 0, 0, 1], "a": 1})"),
            "body a, waypoint 2: it has more than time, position and orientation");
}

}  // namespace
}  // namespace swept
