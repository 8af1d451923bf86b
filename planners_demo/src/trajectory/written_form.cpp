// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/written_form.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "certificate/path_files.hpp"

namespace swept {
namespace {

/// What controllerCurve() makes of a start, as a point.
void beginAt(const std::vector<double>& start, JointTrajectory& trajectory) {
  const TrajectoryPoint& first = trajectory.points.front();
  if (first.time == 0.0) return;
  TrajectoryPoint rest{.time = 0.0,
                       .positions = start,
                       .velocities = std::vector<double>(first.velocities.size()),
                       .accelerations = std::vector<double>(first.accelerations.size())};
  trajectory.points.insert(trajectory.points.begin(), std::move(rest));
}

JointTrajectory inNanoseconds(JointTrajectory trajectory) {
  constexpr double kPerSecond = 1e9;
  for (TrajectoryPoint& point : trajectory.points)
    point.time = std::round(point.time * kPerSecond) / kPerSecond;
  return trajectory;
}

bool increases(const JointTrajectory& trajectory) {
  return std::ranges::adjacent_find(trajectory.points, std::greater_equal<>(),
                                    &TrajectoryPoint::time) == trajectory.points.end();
}

}  // namespace

JointTrajectory writtenForm(JointTrajectory trajectory,
                            const std::optional<std::vector<double>>& start,
                            const std::filesystem::path& file) {
  if (start) beginAt(*start, trajectory);
  if (!isYaml(file)) return trajectory;
  JointTrajectory rounded = inNanoseconds(trajectory);
  return increases(rounded) ? rounded : trajectory;
}

}  // namespace swept
