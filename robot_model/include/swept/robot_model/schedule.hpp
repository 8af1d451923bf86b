// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// Several robots that move on one clock, each along a curve of its own, and by how much one of
/// them may be late. The robots are those of a WorkCell, or arms of one robot.
namespace swept {

/// A curve of some of a group's variables. On the clock it begins at `start` and takes `slowdown`
/// times as long as it would alone. Before, its joints rest where it begins, and afterwards where
/// it ends.
struct ScheduledCurve {
  std::vector<std::string> variables;  ///< names, one for each value of the curve
  PiecewisePolynomial curve;           ///< in a time of its own
  double start = 0.0;     ///< s, 0 or later: what the clock shows at the curve's time 0
  double slowdown = 1.0;  ///< positive; twice as long: 2
};

/// The curve of a whole group, from the clock's time 0 to the end of the last curve.
struct CombinedCurve {
  PiecewisePolynomial curve;  ///< its time is the clock's
  /// rad or m. How far each value may be from what the scheduled curves say: rounding of times and
  /// of coefficients (L20 of the error model).
  std::vector<double> rounding;
};

/// Puts curves on one clock. `still`: a configuration of the group, for variables that no curve
/// moves; empty: all are moved. Throws std::invalid_argument without a curve, for a name that the
/// group does not have or that has a curve already, for another number of names than a curve has
/// values, a group's variable without a value, and for a start or a slowdown that is not allowed.
CombinedCurve combinedCurve(const Robot& robot, const Group& group,
                            std::span<const ScheduledCurve> curves, ConfigurationView still = {});

/// The trajectory of which controllerCurve() makes this curve, but for rounding: with positions
/// alone if all pieces have degree 1; with velocities if the degrees are at most 3, and with
/// accelerations if they are at most 5, where these do not jump from one piece to the next. No
/// value: there is none. Throws std::invalid_argument for another number of names than values.
std::optional<JointTrajectory> controllerTrajectory(const PiecewisePolynomial& curve,
                                                    std::vector<std::string> variables);

/// What is proven about curves on one clock: Checker::certifyTrajectory() of the combined curve, in
/// the checker's tube, to which the rounding of combinedCurve() is added. Places are times of the
/// clock. Throws std::invalid_argument as both do, and for a floating joint whose orientation a
/// curve changes, which has no bound here.
TrajectoryCertificate certifySchedule(const Checker& checker,
                                      std::span<const ScheduledCurve> curves,
                                      const TrajectoryQuery& query = {},
                                      ConfigurationView still = {});

/// What one of several curves may do to its schedule.
struct DelayQuery {
  std::size_t curve = 0;  ///< which of them
  double latest = 0.0;    ///< s, 0 or more; the largest delay of its start
  double slowest = 1.0;   ///< 1 or more; the most that its slowdown is multiplied by
  /// s, positive. Ranges of delays that are shorter, and of slowdowns that move the curve's end by
  /// less, are not divided any further.
  double resolution = 1e-3;
};

/// A contact of a schedule in which a curve is late.
struct DelayContact {
  double delay = 0.0;         ///< s
  double slowdown = 1.0;      ///< factor on the curve's own one
  TrajectoryContact contact;  ///< its time is the clock's
};

/// By how much a curve may be late.
struct DelayCertificate {
  /// Free: every delay up to DelayQuery::latest, with every slowdown up to DelayQuery::slowest.
  /// Collision: `contact` has one that is not. Otherwise Undecided.
  Verdict verdict = Verdict::Undecided;
  /// s. The schedule is Free for every delay from 0 to this, each with every slowdown. No value:
  /// not even without a delay.
  std::optional<double> proven;
  /// Beyond `proven`: by the resolution at most, where a contact is found so near, otherwise by
  /// less than twice what it takes to find one.
  std::optional<DelayContact> contact;
  std::size_t curves = 0;  ///< combined curves that were certified
};

/// Proves a schedule free for a range of delays. The schedule itself is proven first. Then what
/// is left are pairs that the curve moves against what others move: all others pass the same
/// relative poses, at other times. A curve that is late by d, within h of a delay m,
/// is at every time within h times its largest velocities of the curve that is late by m. So one
/// proof of that curve in a tube of this width holds for all of them, and ranges without a proof
/// are divided. Once `stop` is requested, by any thread, it begins with no other proof and returns
/// what is known by then: Undecided if neither all is proven nor a contact is found. Throws
/// std::invalid_argument as certifySchedule() does, and for a query that is not allowed.
DelayCertificate certifyDelays(const Checker& checker, std::span<const ScheduledCurve> curves,
                               const DelayQuery& query, ConfigurationView still = {},
                               const std::stop_token& stop = {});

}  // namespace swept
