// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/time_parameterization.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// Trajectories that are proven as a controller executes them.
namespace swept {

/// A path with times, and the proof of its curve.
struct ProvenTrajectory {
  TimedPath timed;  ///< the trajectory, its curve and its corners
  /// Of `timed.curve`, with MotionQuery::FirstContact and the limits that it was timed with.
  TrajectoryCertificate certificate;
};

/// Times a path with timeParameterize(), where each blend is the largest that is proven free, and
/// proves the whole curve. CheckerOptions::tracking is the tube around it. Where the curve is not
/// free although all straight motions are, because a tube or a margin leaves no room for their
/// proof in other pieces, the corners beside that place become stops, and if need be way points on
/// the line between their neighbours.
///
/// A straight part between two stops is proven as the motion is. So if every straight motion of the
/// path is Free, the verdict is Free, too, but for rounding. Throws std::invalid_argument as
/// timeParameterize() and Checker::certifyTrajectory() do, and for a world with moving obstacles,
/// whose places depend on the times.
ProvenTrajectory provenTrajectory(const Checker& checker, const ConfigurationList& wayPoints,
                                  const RateLimits& limits, const TimingOptions& options = {});

/// A trajectory beside one that could not be proven.
struct RepairedTrajectory {
  /// The trajectory; no value: there is none.
  std::optional<ProvenTrajectory> proven;
  /// The configurations that it goes through, with those of the curve that were inserted.
  std::vector<std::vector<double>> wayPoints;
  std::size_t inserted = 0;  ///< number of these
  /// Without a trajectory: where the curve itself is in contact, or cannot be proven.
  std::optional<TrajectoryPlace> place;
  std::optional<Witness> contact;  ///< there, if it is in contact
};

/// The nearest trajectory to a curve that is proven: straight motions between points of the curve,
/// its knots and as many others as the proofs need, timed by provenTrajectory(). It follows the
/// curve to where that is in contact by itself; then there is none. Throws as provenTrajectory()
/// does.
RepairedTrajectory repairTrajectory(const Checker& checker, const PiecewisePolynomial& curve,
                                    const RateLimits& limits, const TimingOptions& options = {});

}  // namespace swept
