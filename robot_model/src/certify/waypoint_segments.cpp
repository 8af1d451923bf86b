// SPDX-License-Identifier: BSD-3-Clause
#include "certify/waypoint_segments.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "world/obstacle_pose.hpp"

namespace swept::detail {

namespace {

/// Behind the configuration that is there already.
void placeObstacles(const CheckerModel& model, std::vector<double>& whole) {
  auto at = whole.begin() + model.kinematics.dimension;
  const double time = *std::prev(at);
  // No pose is known, and nothing is free.
  if (!std::isfinite(time)) {
    std::fill(at, whole.end(), std::numeric_limits<double>::quiet_NaN());
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
                                          std::vector<double>& whole) {
  if (whole.empty()) return q;
  std::ranges::copy(q, whole.begin());
  placeObstacles(model, whole);
  return whole;
}

WaypointSegments::WaypointSegments(const CheckerModel& model, std::span<const double> from,
                                   std::span<const double> to, WorkspaceData& workspace)
    : model_(model), from_(from), to_(to), workspace_(workspace) {
  workspace.crossings.clear();
  if (workspace.from.empty()) return;
  const double begin = from.back();
  const double end = to.back();
  if (!std::isfinite(begin) || !std::isfinite(end)) return;
  const auto isPassed = [&](double time) {
    return time > std::min(begin, end) && time < std::max(begin, end);
  };
  const auto pass = [&](double time) {
    // Halves: the whole span may overflow.
    const double t = (0.5 * time - 0.5 * begin) / (0.5 * end - 0.5 * begin);
    workspace.crossings.push_back({std::clamp(t, 0.0, 1.0), time});
  };
  for (const MovingObstacle& obstacle : model.world->obstacles()) {
    const auto& waypoints = obstacle.waypoints;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      if (isPassed(waypoints[i].time)) pass(waypoints[i].time);
      if (i == 0) continue;
      // About half a turn: from its ends alone rounding would tell which way round. An angle costs
      // as much as tens of comparisons: it is looked at only where the middle is passed.
      const double halfway = 0.5 * waypoints[i - 1].time + 0.5 * waypoints[i].time;
      if (isPassed(halfway) && angleBetween(waypoints[i - 1], waypoints[i]) > kWideTurn)
        pass(halfway);
    }
  }
  // By time: of a jump both ends may be at the same t.
  auto& crossings = workspace.crossings;
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

WaypointSegment WaypointSegments::part(const WaypointCrossing& begin, const WaypointCrossing& end) {
  fill(begin, workspace_.from);
  fill(end, workspace_.to);
  return {begin.t, end.t, workspace_.from, workspace_.to};
}

/// At the time itself: where it is large, that of the interpolated configuration may lie on the
/// other side of a waypoint.
void WaypointSegments::fill(const WaypointCrossing& crossing, std::vector<double>& whole) const {
  const auto dimension = static_cast<std::size_t>(model_.kinematics.dimension);
  const std::span<double> q = std::span(whole).first(dimension);
  if (crossing.t == 0.0 || crossing.t == 1.0)
    std::ranges::copy(crossing.t == 0.0 ? from_ : to_, q.begin());
  else
    interpolateMotion(model_.kinematics, from_, to_, crossing.t, q);
  q.back() = crossing.time;
  placeObstacles(model_, whole);
}

}  // namespace swept::detail
