// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/PlannerStatus.h>
#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <optional>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/time_parameterization.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept {

/// Options of planTrajectory().
struct TrajectoryPlanOptions {
  double seconds = 5.0;          ///< s, for the planner
  double simplifySeconds = 0.5;  ///< s, about, for simplifyPath(); 0: the path stays as it is
  TimingOptions timing = {};     ///< how the path is timed
};

/// The result of planTrajectory().
struct PlannedTrajectory {
  ompl::base::PlannerStatus status;  ///< of the planner
  /// Present exactly if the planner has an exact solution.
  std::optional<ProvenTrajectory> trajectory;
  /// What planned and proved it: the setup's checker in the tube. Never null.
  std::shared_ptr<const Checker> checker;

  /// Whether there is a trajectory whose whole curve, and all the tube around it, is proven free.
  bool isProven() const { return trajectory && trajectory->certificate.verdict == Verdict::Free; }
};

/// Plans with the setup's planner, simplifies the path, and makes of it a trajectory that is proven
/// as ros2_control's joint_trajectory_controller executes it: provenTrajectory(). The planner's
/// motions are proven in the tube, too; so the setup's checker becomes one in this tube, and stays
/// it. Start and goal have to be set before.
///
/// Throws std::invalid_argument for a setup that does not use CertifiedMotionValidator, times that
/// are not finite or are negative, and as Checker::withTracking() and provenTrajectory() do. Limits
/// are looked at before the planner runs.
PlannedTrajectory planTrajectory(ompl::geometric::SimpleSetup& setup, const RateLimits& limits,
                                 const TrackingTolerance& tube = {},
                                 const TrajectoryPlanOptions& options = {});

}  // namespace swept
