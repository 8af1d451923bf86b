// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/trajectory.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "number_text.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/paths.hpp"
#include "swept/ompl_bridge/setup.hpp"

namespace swept {

namespace {

void requireTime(double time, const char* name) {
  if (time >= 0.0 && std::isfinite(time)) return;
  throw std::invalid_argument(std::string("planTrajectory: ") + name + " " +
                              detail::numberText(time) +
                              " s must be a finite number that is not negative");
}

const Checker& checkerOf(const ompl::geometric::SimpleSetup& setup) {
  const auto* motions = dynamic_cast<const CertifiedMotionValidator*>(
      setup.getSpaceInformation()->getMotionValidator().get());
  if (motions == nullptr)
    throw std::invalid_argument(
        "planTrajectory: the setup's motion validator is no swept::CertifiedMotionValidator");
  return *motions->checker();
}

}  // namespace

PlannedTrajectory planTrajectory(ompl::geometric::SimpleSetup& setup, const RateLimits& limits,
                                 const TrackingTolerance& tube,
                                 const TrajectoryPlanOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return planTrajectory(setup, limits, tube, options); });
  }
  requireTime(options.seconds, "seconds");
  requireTime(options.simplifySeconds, "simplifySeconds");
  PlannedTrajectory planned;
  planned.checker = std::make_shared<const Checker>(checkerOf(setup).withTracking(tube));
  const Checker& checker = *planned.checker;
  // A path that stays shows whether limits and options can be used at all.
  const std::vector<double> anywhere(static_cast<std::size_t>(checker.dimension()), 0.0);
  timeParameterize(checker.robot(), checker.group(), {anywhere}, limits, {}, options.timing);
  setChecker(*setup.getSpaceInformation(), planned.checker);

  planned.status = setup.solve(options.seconds);
  if (planned.status != ompl::base::PlannerStatus::EXACT_SOLUTION) return planned;
  ompl::geometric::PathGeometric& path = setup.getSolutionPath();
  if (options.simplifySeconds > 0.0)
    simplifyPath(path, checker, options.simplifySeconds, setup.getGoal());
  planned.trajectory =
      provenTrajectory(checker, configurationsOf(path, checker), limits, options.timing);
  return planned;
}

}  // namespace swept
