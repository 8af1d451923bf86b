// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "trajectory/trajectory_report.hpp"

namespace swept {

/// A trajectory that was made of a path.
struct TimedTrajectory {
  JointTrajectory trajectory;
  TrajectoryReport report;  ///< with clearances
  ShownTrajectory shown;    ///< beside the path
};

/// `proven`: what was made of the path `states` within the limits, in so many seconds. It is
/// certified again for its clearances.
TimedTrajectory timedTrajectory(const Checker& checker, ProvenTrajectory proven,
                                std::vector<std::vector<double>> states, const RateLimits& limits,
                                double seconds, const std::string& label);

/// Times a path for `plan --timed`, and proves it. Throws UsageError for a path that cannot be
/// timed.
TimedTrajectory timePath(const Arguments& args, const Checker& checker,
                         const std::vector<std::vector<double>>& states, const RateLimits& limits);

}  // namespace swept
