// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <vector>

#include "model.hpp"
#include "obstacle.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

/// Of a quaternion x, y, z, w: any length that has a direction.
constexpr double kLeastLength = 1e-6;
/// The cosine of half the angle between two orientations that are 3.04 rad apart. Beyond, rounding
/// might tell which way round is the shorter one.
constexpr double kLeastProduct = 0.05;

Eigen::Quaterniond readOrientation(const Json& json, const std::string& where) {
  if (!json.is_array() || json.size() != 4) throw Refusal(where + ": not four numbers");
  Eigen::Quaterniond turn;
  for (Eigen::Index i = 0; i < 4; ++i)
    turn.coeffs()[i] = readNumber(json[static_cast<std::size_t>(i)], where);
  const double length = turn.norm();
  if (!(length > kLeastLength && std::isfinite(length)))
    throw Refusal(where + ": a quaternion has no direction");
  return turn;
}

Obstacle::Waypoint readWaypoint(const Json& json, const std::string& where) {
  const Obstacle::Waypoint waypoint{
      .time = readNumber(at(json, "time", where), where + ", time"),
      .position = readVector(at(json, "position", where), where + ", position"),
      .orientation = readOrientation(at(json, "orientation", where), where + ", orientation")};
  // Differences and sums stay finite.
  if (!(std::abs(waypoint.time) <= kFarthest)) throw Refusal(where + ", time: it is too far away");
  if (!(waypoint.position.cwiseAbs().maxCoeff() <= kFarthest))
    throw Refusal(where + ", position: it is too far away");
  if (json.size() != 3) throw Refusal(where + ": it has more than time, position and orientation");
  return waypoint;
}

}  // namespace

Obstacle readObstacle(const Json& json, const std::string& where) {
  std::vector<Obstacle::Waypoint> waypoints;
  for (const Json& entry : readList(json, "waypoints", where)) {
    const std::string place = where + ", waypoint " + std::to_string(waypoints.size() + 1);
    waypoints.push_back(readWaypoint(entry, place));
    if (waypoints.size() == 1) continue;
    const Obstacle::Waypoint &own = waypoints.back(), &before = waypoints[waypoints.size() - 2];
    if (!(own.time > before.time)) throw Refusal(place + ", time: it is not after the one before");
    const double product = own.orientation.normalized().dot(before.orientation.normalized());
    if (!(std::abs(product) >= kLeastProduct))
      throw Refusal(place +
                    ", orientation: it is about half a turn from the one before, and which "
                    "way round is not told");
  }
  if (waypoints.empty()) throw Refusal(where + ", waypoints: there is none");
  return Obstacle(waypoints);
}

}  // namespace swept::verify
