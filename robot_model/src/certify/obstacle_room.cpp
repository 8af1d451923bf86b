// SPDX-License-Identifier: BSD-3-Clause
// L19 of the error model: the way of a point of an obstacle in a time.
#include "certify/obstacle_room.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "certify/model_of.hpp"
#include "rounding/error_model.hpp"
#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

/// rad. What orientations of two waypoints, their angle and what is between them may be off.
constexpr double kAngleRounding = 1e-14;

/// m. The farthest that an obstacle has a point from its origin.
double reachOf(const CheckerModel& model, std::size_t collisionBody) {
  double reach = 0.0;
  for (const RobotGeometry& geometry : model.robotGeometry)
    if (geometry.collisionBody == static_cast<int>(collisionBody))
      reach = std::max(reach, geometry.center.norm() + geometry.radius);
  return reach;
}

/// m. The farthest that a point within `reach` of the origin goes in `seconds`.
double roomOf(const MovingObstacle& obstacle, double reach, double seconds) {
  double room = 0.0;
  for (std::size_t i = 1; i < obstacle.waypoints.size(); ++i) {
    const MovingObstacle::Waypoint &from = obstacle.waypoints[i - 1], &to = obstacle.waypoints[i];
    // Halves, because the whole span may overflow.
    const double duration = 2.0 * (0.5 * to.time - 0.5 * from.time);
    const Eigen::Quaterniond turn(from.world_from_body.linear());
    const double angle = std::min(
        turn.angularDistance(Eigen::Quaterniond(to.world_from_body.linear())) + kAngleRounding,
        std::numbers::pi);
    const double way =
        (to.world_from_body.translation() - from.world_from_body.translation()).norm();
    room = std::max(room, (way + angle * reach) / duration * seconds);
  }
  // Where coordinates may be larger than this, nothing is proven free.
  return std::min(room * kArithmeticOutward, kLargestNorm);
}

/// m, per collision body: of obstacles alone.
std::vector<double> roomsOf(const Checker& checker, double seconds) {
  const CheckerModel& model = modelOf(checker);
  std::vector<double> rooms(model.collisionBodies.size(), 0.0);
  auto obstacle = checker.world().obstacles().begin();
  for (std::size_t i = 0; i < rooms.size(); ++i)
    if (model.collisionBodies[i].kind == CollisionBody::Kind::Obstacle)
      rooms[i] = roomOf(*obstacle++, reachOf(model, i), seconds);
  return rooms;
}

}  // namespace

double largestObstacleRoom(const Checker& checker, double seconds) {
  const std::vector<double> rooms = roomsOf(checker, seconds);
  return rooms.empty() ? 0.0 : std::ranges::max(rooms);
}

Checker besideObstaclesWithin(const Checker& checker, double seconds) {
  const CheckerModel& model = modelOf(checker);
  const std::vector<double> rooms = roomsOf(checker, seconds);
  struct Kept {
    std::string a, b;
    double margin;  // m
  };
  std::vector<Kept> pairs;
  double largest = 0.0;
  for (const BodyPair& pair : model.bodyPairs) {
    if (!pair.ofRobot) continue;
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const double room = rooms[a] + rooms[b];
    if (room == 0.0) continue;
    const double margin = std::min((pair.margin + room) * kArithmeticOutward, kLargestNorm);
    pairs.push_back(
        {model.collisionBodies[a].name.str(), model.collisionBodies[b].name.str(), margin});
    largest = std::max(largest, margin);
  }
  CollisionRules rules;
  for (const Kept& pair : pairs) {
    // To a rule, a name with a `*` is that of several bodies.
    const bool isOfSeveral = isPattern(pair.a) || isPattern(pair.b);
    rules.margin(pair.a, pair.b, isOfSeveral ? largest : pair.margin,
                 "room for an obstacle that is early or late");
  }
  return checker.withRules(rules.over(checker.options().rules));
}

}  // namespace swept::detail
