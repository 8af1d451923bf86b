// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/meeting_rows.hpp"

#include <algorithm>
#include <limits>

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Halves the balls along their largest extent, until eight or fewer are left in each part: these
/// make a row.
void divide(std::span<MeetingBall> balls, std::vector<std::span<MeetingBall>>& eights) {
  if (balls.size() <= kLanes) {
    if (!balls.empty()) eights.push_back(balls);
    return;
  }
  Vector3f lower = balls.front().center;
  Vector3f upper = lower;
  for (const MeetingBall& ball : balls) {
    lower = lower.cwiseMin(ball.center);
    upper = upper.cwiseMax(ball.center);
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  std::ranges::stable_sort(balls, {},
                           [axis](const MeetingBall& ball) { return ball.center[axis]; });
  // All rows are full except the last.
  const std::size_t rows = (balls.size() + kLanes - 1) / kLanes;
  const std::size_t half = rows / 2 * kLanes;
  divide(balls.first(half), eights);
  divide(balls.subspan(half), eights);
}

void setLane(SimdModel::Probes& row, int lane, const Vector3f& center, float radius) {
  row.x.lane[lane] = center.x();
  row.y.lane[lane] = center.y();
  row.z.lane[lane] = center.z();
  row.inside.lane[lane] = radius;
}

/// Balls that it misses by rounding are not tested: no answer depends on it.
MeetingBall ballAround(std::span<const MeetingBall> balls) {
  MeetingBall around{Vector3f::Zero(), 0.0F};
  for (const MeetingBall& ball : balls) around.center += ball.center;
  around.center /= static_cast<float>(balls.size());
  for (const MeetingBall& ball : balls)
    around.inside = std::max(around.inside, (ball.center - around.center).norm() + ball.inside);
  return around;
}

}  // namespace

SimdModel::InnerBalls addMeetingRows(std::vector<MeetingBall> balls,
                                     std::vector<SimdModel::Probes>& rows) {
  SimdModel::InnerBalls added{static_cast<std::int32_t>(rows.size()), 0};
  if (balls.empty()) return added;
  if (balls.size() > kMostMeetingBalls) balls.resize(kMostMeetingBalls);
  std::vector<std::span<MeetingBall>> eights;
  divide(balls, eights);
  added.count = static_cast<std::int32_t>(eights.size());
  SimdModel::Probes around;
  for (int lane = 0; lane < kLanes; ++lane) {
    const MeetingBall all = ballAround(eights[std::min<std::size_t>(lane, eights.size() - 1)]);
    setLane(around, lane, all.center, all.inside);
  }
  rows.push_back(around);
  for (const std::span<MeetingBall> eight : eights) {
    SimdModel::Probes& row = rows.emplace_back();
    for (int lane = 0; lane < kLanes; ++lane) {
      const MeetingBall& ball = eight[std::min<std::size_t>(lane, eight.size() - 1)];
      setLane(row, lane, ball.center, ball.inside);
    }
  }
  return added;
}

std::vector<Vector3d> spreadPoints(std::span<const Vector3d> points, int count) {
  std::vector<Vector3d> chosen;
  if (points.empty()) return chosen;
  Vector3d lower = points.front();
  Vector3d upper = lower;
  for (const Vector3d& point : points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const Vector3d middle = 0.5 * (lower + upper);
  std::vector<double> toChosen;
  for (const Vector3d& point : points) toChosen.push_back((point - middle).squaredNorm());
  while (static_cast<int>(chosen.size()) < count) {
    const auto farthest = std::ranges::max_element(toChosen);
    if (!chosen.empty() && !(*farthest > 0.0)) break;
    chosen.push_back(points[static_cast<std::size_t>(farthest - toChosen.begin())]);
    if (chosen.size() == 1) std::ranges::fill(toChosen, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < points.size(); ++i)
      toChosen[i] = std::min(toChosen[i], (points[i] - chosen.back()).squaredNorm());
  }
  return chosen;
}

}  // namespace swept::detail
