// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"

namespace swept::detail {

/// Points of the link that seem to lie in the obstacle in that lane, at its middle: indices of
/// LaneHulls::inBody. At most eight; none for obstacles that have no sure inside here.
struct PointsInside {
  std::int32_t count = 0;
  std::int32_t index[kLanes] = {};
};
PointsInside pointsInside(const LaneModel& model, const LaneSuspect& suspect, LaneScratch& scratch);

}  // namespace swept::detail
