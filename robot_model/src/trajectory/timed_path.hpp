// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "swept/robot_model/time_parameterization.hpp"
#include "trajectory/corner_speeds.hpp"
#include "trajectory/way_point_path.hpp"

namespace swept::detail {

/// The trajectory of a path with at least one straight part, with these blends. `names`: of the
/// variables. `limits`: what the curve keeps, see keepsLimits(). `leastStep`: s, at least 1e-9,
/// between two points; it is doubled until roundings break no limit.
TimedPath timedPath(const WayPointPath& path, const CornerSpeeds& speeds,
                    const std::vector<std::string>& names, const VariableLimits& limits,
                    double leastStep);

}  // namespace swept::detail
