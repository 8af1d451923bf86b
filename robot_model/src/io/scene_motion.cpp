// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_motion.hpp"

namespace swept::detail {

std::vector<MovingObstacle::Waypoint> readMotion(const YamlPlace& motion) {
  std::vector<MovingObstacle::Waypoint> waypoints;
  if (!motion.present()) return waypoints;
  for (const YamlPlace& entry : motion.elements()) {
    entry.allowOnly({"time", "position", "orientation"});
    const YamlPlace time = entry.at("time");
    const YamlPlace position = entry.at("position");
    MovingObstacle::Waypoint waypoint{time.number(), Eigen::Isometry3d::Identity()};
    if (!waypoints.empty() && !(waypoint.time > waypoints.back().time))
      time.fail("is " + time.text() + "; it must be later than that of the waypoint before");
    // A default would be a place that nobody has named.
    if (!position.present()) position.fail("is missing");
    waypoint.world_from_body.translation() = position.vector();
    if (const YamlPlace turn = entry.at("orientation"); turn.present())
      waypoint.world_from_body.linear() = turn.rotation();
    waypoints.push_back(waypoint);
  }
  if (waypoints.empty())
    motion.fail("has no waypoint; one at least is needed, and an object that stands has none");
  return waypoints;
}

}  // namespace swept::detail
