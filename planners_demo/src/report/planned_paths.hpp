// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "report/report_worlds.hpp"
#include "report/turns.hpp"

namespace swept {

/// Up to so many paths between random free states, as a user of RRTConnect has them. The straight
/// motion between the two states of a path is not proven free; RRTConnect finds the path, and
/// simplifyPath() simplifies it. Each path has a corner, and all of its straight motions are proven
/// free. Its way points are columns, as continuousWayPoints() makes them.
///
/// There are fewer, or none, where nearly all motions are free or the planner finds no path: it
/// ends after a number of iterations, so the paths depend on the seed alone. Throws UsageError when
/// no free state is found.
std::vector<Eigen::MatrixXd> plannedPaths(const ReportWorld& world,
                                          const std::shared_ptr<const Checker>& checker,
                                          std::size_t count, std::uint32_t seed,
                                          const ReportTick& tick);

}  // namespace swept
