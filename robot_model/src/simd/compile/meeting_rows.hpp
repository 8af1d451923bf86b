// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "simd/compile/simd_model.hpp"

namespace swept::detail {

/// A ball inside a link, or a point of it.
struct MeetingBall {
  Eigen::Vector3f center;  ///< m
  float inside = 0.0F;     ///< m, the radius
};

/// As many rows as a row of balls around them has lanes.
inline constexpr int kMostMeetingBalls = kLanes * kLanes;

/// Puts balls that are near each other into the same row, after a row of balls around these rows;
/// see SimdModel::meetingRows. If there are more than kMostMeetingBalls, it uses the first ones.
SimdModel::InnerBalls addMeetingRows(std::vector<MeetingBall> balls,
                                     std::vector<SimdModel::Probes>& rows);

/// At most `count` of the points, each the farthest from those before; the first one is the
/// farthest from the centre of all.
std::vector<Eigen::Vector3d> spreadPoints(std::span<const Eigen::Vector3d> points, int count);

}  // namespace swept::detail
