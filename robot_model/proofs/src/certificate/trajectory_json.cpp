// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/trajectory_json.hpp"

#include "robot/joint_types.hpp"

namespace swept {

Json trajectoryJson(const JointTrajectory& trajectory) {
  Json json = {{"variables", trajectory.variables}, {"points", Json::array()}};
  for (const TrajectoryPoint& point : trajectory.points) {
    Json own = {{"time", point.time}, {"positions", toJson(point.positions)}};
    if (!point.velocities.empty()) own["velocities"] = toJson(point.velocities);
    if (!point.accelerations.empty()) own["accelerations"] = toJson(point.accelerations);
    json["points"].push_back(std::move(own));
  }
  return json;
}

Json trackingJson(const Checker& checker) {
  const TrackingTolerance& tracking = checker.options().tracking;
  Json json = Json::object();
  for (const int index : checker.group().joints) {
    const Joint& joint = checker.robot().joints()[static_cast<std::size_t>(index)];
    const auto own = tracking.joints.find(joint.name);
    const JointTolerance& tolerance = own == tracking.joints.end() ? tracking : own->second;
    Json entry = Json::object();
    if (!detail::slidesWithinLimits(joint.type) && tolerance.rotation > 0.0)
      entry["rotation"] = tolerance.rotation;
    if (!detail::turns(joint.type) && tolerance.translation > 0.0)
      entry["translation"] = tolerance.translation;
    if (!entry.empty()) json[joint.name] = std::move(entry);
  }
  return json;
}

}  // namespace swept
