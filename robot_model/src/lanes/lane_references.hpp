// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lanes/lane_model.hpp"

namespace swept::detail {

/// LaneModel::references for these bodies; the first one is 0, the model frame. Needs the bodies
/// and covers of the lanes.
std::vector<LaneReference> compileReferences(const CheckerModel& model, const LaneModel& lanes,
                                             const std::vector<int>& bodies);

}  // namespace swept::detail
