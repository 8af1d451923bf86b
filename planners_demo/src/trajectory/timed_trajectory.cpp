// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/timed_trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "output/progress.hpp"
#include "output/seconds_since.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "trajectory/timing.hpp"

namespace swept {

TimedTrajectory timedTrajectory(const Checker& checker, ProvenTrajectory proven,
                                std::vector<std::vector<double>> states, const RateLimits& limits,
                                double seconds, const std::string& label) {
  TimedPath& path = proven.timed;
  const auto stops =
      static_cast<std::size_t>(std::ranges::count_if(path.corners, &TimedCorner::stops));
  TrajectoryQuery query;
  query.limits = limits;
  query.clearances = true;
  Workspace workspace(checker);
  TrajectoryReport report{
      .label = label,
      .points = path.trajectory.points.size(),
      .begin = path.curve.begin(),
      .end = path.curve.end(),
      .certificate = checker.certifyTrajectory(path.curve, workspace, query),
      .timing =
          TimingReport{.blended = path.corners.size() - stops, .stops = stops, .seconds = seconds},
      .constraints = &checker.options().constraints};
  ShownTrajectory shown{label, std::move(path.curve), query, report.certificate, std::move(states)};
  return {std::move(path.trajectory), std::move(report), std::move(shown)};
}

TimedTrajectory timePath(const Arguments& args, const Checker& checker,
                         const std::vector<std::vector<double>>& states, const RateLimits& limits) {
  Progress progress("timing the path", args.quiet);
  const auto begin = std::chrono::steady_clock::now();
  try {
    ProvenTrajectory proven = provenTrajectory(checker, states, limits, timingOptions(args));
    return timedTrajectory(checker, std::move(proven), states, limits, secondsSince(begin),
                           "trajectory");
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--timed: ") + error.what());
  }
}

}  // namespace swept
