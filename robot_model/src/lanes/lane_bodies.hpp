// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes/lane_model.hpp"

namespace swept::detail {

/// The moving bodies, in the lanes' frames, and their covers: what depends on neither pairs nor the
/// world. False where the lanes' bounds on motions do not hold; nothing is compiled then.
bool compileLaneBodies(const CheckerModel& model, LaneModel& lanes);

/// The same as another model has.
void shareLaneBodies(const LaneModel& like, LaneModel& lanes);

}  // namespace swept::detail
