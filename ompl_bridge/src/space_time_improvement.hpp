// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "space_time_search.hpp"
#include "swept/robot_model/schedule_checker.hpp"
#include "timed_polyline.hpp"

namespace swept::detail {

/// What is kept of a way while it becomes better.
struct ImprovementLimits {
  double begin = 0.0;     ///< s: the robot is at rest until then
  double restFrom = 0.0;  ///< s: at the end it may rest from here on
  int attempts = 0;       ///< changes that are tried
};

/// Makes a way earlier and shorter: random changes (knots and the stops between them left out,
/// shortcuts in configuration and time, knots made earlier, all made faster), each kept if the
/// whole curve still keeps its limits, arrives earlier or is shorter, and is proven.
std::vector<TimedKnot> improved(const ScheduleChecker& checker, const OwnSpace& space,
                                std::vector<TimedKnot> knots, const ImprovementLimits& limits,
                                unsigned seed, const std::function<bool()>& stop);

}  // namespace swept::detail
