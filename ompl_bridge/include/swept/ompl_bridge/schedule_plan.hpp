// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/schedule.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// Planning in time: robots that find their ways beside others, and beside moving obstacles.
namespace swept {

/// Where one robot is, and where it is to go.
struct ScheduleTask {
  std::string group;          ///< of the robot, all of whose variables are in the checker's group
  std::vector<double> start;  ///< rad or m; where it rests at the clock's time 0
  std::vector<std::vector<double>> goals;  ///< rad or m; it is to rest at one of these
  RateLimits limits;  ///< of each variable, of velocity and acceleration; jerks have none
};

/// How planSchedule() searches.
struct SchedulePlanOptions {
  double seconds = 10.0;  ///< s, about, until a schedule is found
  /// s, on the clock: when the last robot rests at its goal.
  double latest = std::numeric_limits<double>::infinity();
  /// s. Each curve, known or planned, may start late by up to so much, one at a time, and still
  /// nothing touches: PlannedSchedule::delays has the proofs. Moving obstacles keep their times.
  double delay = 0.0;
  /// 1 or more. Likewise each may take up to so many times as long, with each of the delays.
  double slowest = 1.0;
  int improvements = 2000;    ///< changes of each robot's way that are tried
  std::uint32_t seed = 1;     ///< of all random numbers
  std::stop_token stop = {};  ///< ends the search soon once it is requested
};

/// The result of planSchedule().
struct PlannedSchedule {
  /// What came of it.
  enum class Status : std::uint8_t {
    Found,         ///< and proven
    StartNotFree,  ///< of `task`, at the clock's time 0
    GoalNotFree,   ///< of `task`: none of them is, even after all others have come to rest
    NotFound,      ///< in the time given; `task` had no way in the last attempt
    NotProven,     ///< a schedule was found, and certifySchedule() left it undecided
  };
  Status status = Status::NotFound;  ///< see there
  std::size_t task = 0;              ///< index of the one that failed
  /// StartNotFree, GoalNotFree: what is in contact, if that is known. The other robots that have no
  /// way yet stand at their starts.
  std::optional<Witness> contact = {};
  ///@{
  /// Found, NotProven: one for each task, in their order, empty otherwise. A curve is that of the
  /// trajectory, by controllerCurve(), and its time is the clock's.
  std::vector<ScheduledCurve> curves = {};
  std::vector<JointTrajectory> trajectories = {};
  ///@}
  std::vector<std::size_t> order = {};  ///< indices of the tasks, in the order of their priority
  /// Found, NotProven: of all curves, the known ones too: certifySchedule().
  std::optional<TrajectoryCertificate> certificate = {};
  /// Likewise, if SchedulePlanOptions::delay is above 0, or slowest above 1: certifyDelays() of
  /// each known curve, then of those of the tasks.
  std::vector<DelayCertificate> delays = {};

  bool found() const { return status == Status::Found; }  ///< whether it is there and proven
};

/// Plans the ways of one or several robots on one clock, beside curves that are known, and beside
/// the world's moving obstacles. Each robot waits, goes around or comes later where that is needed.
/// `known`: curves of others, as ScheduledCurve has them. `still`: a configuration of the checker's
/// group for variables that are neither of a task nor of a known curve; empty: there are none.
///
/// Robots are planned one after the other, each beside the curves of those before (M. Erdmann and
/// T. Lozano-Perez, On multiple moving objects, 1987). Those that come later stand at their starts
/// (M. Cap et al., Prioritized planning algorithms for trajectory coordination of multiple mobile
/// robots, 2015); where that leaves no way, they are left out, and have to make way. A robot that
/// finds none goes first in the next attempt, and is not planned behind the same robots again.
/// Where all orders that are left are such, or twice as many as there are robots have failed, the
/// first robot of each waits at its start, so that others get out of its way, and longer from round
/// to round. So a schedule that exists may not be found.
///
/// One robot's way is searched for in configurations and time by two trees (F. Grothe et al.,
/// ST-RRT*, 2022), whose edges are proven, then made earlier and shorter. It is what a controller
/// executes: straight motions at constant speed with parabolic blends, positions and velocities,
/// within the limits at every instant. It begins and ends at rest. At the end the whole schedule is
/// proven.
///
/// The same arguments give the same schedule, if it is found well before the time is up. Throws
/// std::invalid_argument as combinedCurve() and ScheduleChecker do; for no task; for an unknown
/// group, one with variables beyond the checker's group or of another task; for another number of
/// values or limits than variables; for values that are not finite or beyond the limits of
/// positions; for a variable that has no limits of position and is not cyclic, and for one without
/// limits of velocity and acceleration; and for options that are not allowed.
PlannedSchedule planSchedule(const Checker& checker, std::span<const ScheduleTask> tasks,
                             std::span<const ScheduledCurve> known = {},
                             ConfigurationView still = {}, const SchedulePlanOptions& options = {});

/// `found`, `start not free`, `goal not free`, `not found` or `not proven`.
const char* toString(PlannedSchedule::Status status);

}  // namespace swept
