// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/schedule.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// Proofs about curves of some variables while others move on known curves: what a planner asks
/// that looks for one robot's way beside those of other robots. It asks about any number of curves
/// without putting the whole schedule together again.
///
/// It asks about the pairs that the own variables move, and about no others: those of the other
/// curves among themselves are proven once, where these were made. At the end certifySchedule()
/// proves the whole schedule. Immutable: any number of threads may use one, each with its own
/// Workspace.
class ScheduleChecker {
 public:
  /// `checker`: of a group that has all variables. `variables`: names of the own ones. `others`:
  /// the curves of others, none of an own variable. `still`: a configuration of the group, for
  /// variables that no curve moves; empty: there are none. `ignored`: names of variables about
  /// which nothing is known yet. Pairs with such a variable between the two bodies are left out.
  /// `delay` (s): what is proven holds also if the own curve, or all of the others, start late by
  /// up to so much; or each of the others by itself, where none carries another. `slowest`: it also
  /// holds if these take up to so many times as long, as in DelayQuery; with all of the others
  /// slow, those of which one carries another have to start together. More room is needed for that
  /// than delays take: ranges of delays are proven in tubes, down to a width of 0.02 rad or m.
  /// Moving obstacles keep their times: a curve that is late meets them later on their way.
  ///
  /// Throws std::invalid_argument as combinedCurve() does, without an own variable, for an own one
  /// that is of the orientation of a floating joint, for a name that the robot does not have, for a
  /// delay that is negative or not finite, for a slowest factor below 1 or not finite, and with one
  /// above 1 for a curve that begins before its own time 0.
  ScheduleChecker(const Checker& checker, std::vector<std::string> variables,
                  std::vector<ScheduledCurve> others = {}, ConfigurationView still = {},
                  const std::vector<std::string>& ignored = {}, double delay = 0.0,
                  double slowest = 1.0);

  /// What is proven about the group's curve from the begin to the end of `own`, whose time is the
  /// clock's and whose values are those of `variables()`. As in certifySchedule(), the roundings of
  /// combinedCurve() are in the tube. A curve that is faster than 100 rad/s or m/s, farther away
  /// than 1000 rad or m, or ends later than 600 s after end(), is Undecided. Throws
  /// std::invalid_argument for another number of values, and for a curve that begins before the
  /// clock's time 0.
  ///
  /// With a delay or a slowdown, the certificate is that of a range of delays that is not Free, on
  /// the clock of the own curve. A contact is one of a delay of this range.
  TrajectoryCertificate certify(const PiecewisePolynomial& own, Workspace& workspace,
                                MotionQuery query = MotionQuery::FirstContact) const;

  /// s. From here on nothing but the own variables moves: no curve, with a delay and a slowdown,
  /// and no moving obstacle.
  double end() const;
  /// As given.
  const std::vector<std::string>& variables() const;
  /// As given.
  const std::vector<ScheduledCurve>& others() const;
  /// The checker of the pairs that are asked about, in the tube of the roundings.
  const Checker& checker() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
