// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lanes/lane_model.hpp"

namespace swept::detail {

/// All of LaneModel::bodyPairs, those with the same first body side by side.
std::vector<LaneRootRow> compileRootRows(const LaneModel& lanes);

}  // namespace swept::detail
