// SPDX-License-Identifier: BSD-3-Clause
#include "certify/waypoint_segments.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "world/obstacle_pose.hpp"

namespace swept::detail {

namespace {

/// Appends the obstacles' poses to the configuration.
void placeObstacles(const CheckerModel& model, std::vector<double>& full) {
  auto at = full.begin() + model.kinematics.dimension;
  const double time = *std::prev(at);
  // NaN: no pose is known, so nothing is proven free.
  if (!std::isfinite(time)) {
    std::fill(at, full.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  for (const MovingObstacle& obstacle : model.world->obstacles()) {
    const ObstaclePose pose = obstaclePose(obstacle, time);
    const Eigen::Quaterniond turn(pose.world_from_body.linear());
    at = std::copy_n(pose.world_from_body.translation().data(), 3, at);
    at = std::copy_n(turn.coeffs().data(), 4, at);
    *at++ = pose.magnitude;
  }
}

constexpr double kWideTurn = 3.0;  // rad

double angleBetween(const MovingObstacle::Waypoint& a, const MovingObstacle::Waypoint& b) {
  const Eigen::Quaterniond first(a.world_from_body.linear());
  return first.angularDistance(Eigen::Quaterniond(b.world_from_body.linear()));
}

}  // namespace

std::span<const double> fullConfiguration(const CheckerModel& model, std::span<const double> q,
                                          std::vector<double>& full) {
  if (full.empty()) return q;
  std::ranges::copy(q, full.begin());
  placeObstacles(model, full);
  return full;
}

WaypointSegments::WaypointSegments(const CheckerModel& model, const JointPath& path,
                                   WorkspaceData& workspace)
    : model_(model), path_(path), workspace_(workspace) {
  auto& crossings = workspace.crossings;
  crossings.clear();
  if (workspace.from.empty()) return;
  const auto timeAt = [&](double t) {
    path.interpolate(t, workspace.probe);
    return workspace.probe.back();
  };
  const double begin = timeAt(0.0);
  const double end = timeAt(1.0);
  if (std::isfinite(begin) && std::isfinite(end)) addCrossings(begin, end);
  crossings.insert(crossings.begin(), {0.0, begin});
  crossings.push_back({1.0, end});
}

void WaypointSegments::addCrossings(double begin, double end) {
  auto& crossings = workspace_.crossings;
  const double first = std::min(begin, end);
  const double last = std::max(begin, end);
  const auto isPassed = [first, last](double time) { return time > first && time < last; };
  const auto pass = [&](double time) {
    // Halves, because the whole span may overflow.
    const double t = (0.5 * time - 0.5 * begin) / (0.5 * end - 0.5 * begin);
    crossings.push_back({std::clamp(t, 0.0, 1.0), time});
  };
  for (const MovingObstacle& obstacle : model_.world->obstacles()) {
    const auto& waypoints = obstacle.waypoints;
    const auto after =
        std::ranges::upper_bound(waypoints, first, {}, &MovingObstacle::Waypoint::time);
    for (auto i = static_cast<std::size_t>(after - waypoints.begin()); i < waypoints.size(); ++i) {
      if (isPassed(waypoints[i].time)) pass(waypoints[i].time);
      if (i == 0) continue;
      if (waypoints[i - 1].time >= last) break;
      // About half a turn: from its ends alone rounding would tell which way round. An angle costs
      // as much as tens of comparisons: it is looked at only where the middle is passed.
      const double halfway = 0.5 * waypoints[i - 1].time + 0.5 * waypoints[i].time;
      if (isPassed(halfway) && angleBetween(waypoints[i - 1], waypoints[i]) > kWideTurn)
        pass(halfway);
    }
  }
  // By time: both ends of a jump may be at the same t.
  if (begin < end)
    std::ranges::sort(crossings, std::less<>(), &WaypointCrossing::time);
  else
    std::ranges::sort(crossings, std::greater<>(), &WaypointCrossing::time);
  crossings.erase(std::unique(crossings.begin(), crossings.end(),
                              [](const WaypointCrossing& a, const WaypointCrossing& b) {
                                return a.time == b.time;
                              }),
                  crossings.end());
}

/// Uses the time itself: if it is large, the time of the interpolated configuration may lie on the
/// other side of a waypoint.
void WaypointSegments::fill(const WaypointCrossing& crossing, std::vector<double>& full) const {
  const auto dimension = static_cast<std::size_t>(model_.kinematics.dimension);
  const std::span<double> q = std::span(full).first(dimension);
  path_.interpolate(crossing.t, q);
  q.back() = crossing.time;
  placeObstacles(model_, full);
}

}  // namespace swept::detail
