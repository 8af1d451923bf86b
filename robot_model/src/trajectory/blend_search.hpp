// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/time_parameterization.hpp"
#include "trajectory/corner_speeds.hpp"

namespace swept::detail {

/// Chooses a blend for each corner that does not turn back, so that the path takes little time. No
/// blend deviates farther than `deviation` (rad or m); 0: the robot stops at each corner. Each
/// straight part keeps a part without blends.
void chooseBlends(const WayPointPath& path, double deviation, CornerSpeeds& speeds);

/// Replaces each blend by the largest one of the same proportions that `proves` accepts, or a stop.
void proveBlends(const BlendProver& proves, CornerSpeeds& speeds);

}  // namespace swept::detail
