// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/proven_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

void requireStill(const Checker& checker, const char* function) {
  if (checker.world().obstacles().empty()) return;
  throw std::invalid_argument(std::string(function) +
                              ": the world has moving obstacles, whose places depend on the times "
                              "that are to be found");
}

class Timing {
 public:
  Timing(const Checker& checker, const ConfigurationList& wayPoints, const RateLimits& limits,
         const TimingOptions& options)
      : checker_(checker),
        wayPoints_(wayPoints),
        limits_(limits),
        options_(options),
        workspace_(checker),
        stops_(options.stops.begin(), options.stops.end()) {}

  ProvenTrajectory run() {
    ProvenTrajectory proven = timed();
    // Each round adds stops beside a place; there are only so many.
    while (proven.certificate.verdict != Verdict::Free && addStops(proven)) proven = timed();
    return proven;
  }

 private:
  ProvenTrajectory timed() {
    const BlendProver proves = [&](std::size_t, const PiecewisePolynomial& blend) {
      const TrajectoryQuery query{.contact = MotionQuery::VerdictOnly};
      return checker_.certifyTrajectory(blend, workspace_, query).verdict == Verdict::Free;
    };
    options_.stops.assign(stops_.begin(), stops_.end());
    TimedPath path =
        timeParameterize(checker_.robot(), checker_.group(), wayPoints_, limits_, proves, options_);
    TrajectoryQuery query;
    query.limits = limits_;
    TrajectoryCertificate certificate = checker_.certifyTrajectory(path.curve, workspace_, query);
    return {std::move(path), std::move(certificate)};
  }

  /// The blends beside the place become stops. Without any, the motion that it is in has been left
  /// undecided: then way points that are on its line become stops, so that the motions between them
  /// are proven one by one. False: nothing is left to do.
  bool addStops(const ProvenTrajectory& proven) {
    const TrajectoryCertificate& found = proven.certificate;
    const double time = found.contact     ? found.contact->time
                        : found.violation ? found.violation->time
                                          : found.undecided->time;
    const std::vector<TimedCorner>& corners = proven.timed.corners;
    // The corners of the straight part, or the blend, that the place is in.
    const auto after = std::ranges::find_if(
        corners, [time](const TimedCorner& corner) { return corner.end > time; });
    const bool isFirst = after == corners.begin();
    const bool isLast = after == corners.end();
    bool added = false;
    const auto add = [&](const TimedCorner& corner) {
      if (!corner.stops()) added = stops_.insert(corner.wayPoint).second || added;
    };
    if (!isLast) add(*after);
    if (!isFirst) add(*std::prev(after));
    if (added || found.verdict != Verdict::Undecided) return added;
    const std::size_t begin = isFirst ? 0 : std::prev(after)->wayPoint;
    const std::size_t end = isLast ? wayPoints_.size() - 1 : after->wayPoint;
    for (std::size_t i = begin + 1; i < end; ++i) added = stops_.insert(i).second || added;
    return added;
  }

  const Checker& checker_;
  const ConfigurationList& wayPoints_;
  const RateLimits& limits_;
  TimingOptions options_;
  Workspace workspace_;
  std::set<std::size_t> stops_;  ///< indices of way points
};

/// Straight motions along a curve.
class Chords {
 public:
  Chords(const Checker& checker, const PiecewisePolynomial& curve)
      : checker_(checker), curve_(curve), workspace_(checker) {}

  RepairedTrajectory run() {
    RepairedTrajectory repaired;
    repaired.wayPoints.push_back(at(curve_.begin()));
    for (std::size_t piece = 0; piece < curve_.pieces(); ++piece)
      if (!follow(curve_.knots()[piece], curve_.knots()[piece + 1], 0, repaired)) return repaired;
    return repaired;
  }

 private:
  /// Chords are no shorter than this share of a piece.
  static constexpr int kMostHalvings = 12;
  static constexpr double kWidestTurn = 1.5;  // rad

  std::vector<double> at(double time) const {
    std::vector<double> q(static_cast<std::size_t>(curve_.dimension()));
    curve_.position(time, q);
    return q;
  }

  /// Adds way points up to the end of the interval.
  bool follow(double begin, double end, int halvings, RepairedTrajectory& repaired) {
    std::vector<double> to = at(end);
    if (isProven(repaired.wayPoints.back(), to)) {
      repaired.wayPoints.push_back(std::move(to));
      return true;
    }
    const double middle = 0.5 * (begin + end);
    if (halvings == kMostHalvings) return fail(middle, repaired);
    if (checker_.checkState(to, workspace_) != Verdict::Free) return fail(end, repaired);
    if (!follow(begin, middle, halvings + 1, repaired)) return false;
    ++repaired.inserted;
    return follow(middle, end, halvings + 1, repaired);
  }

  /// Only where the shorter way of a cyclic value is the curve's own for sure.
  bool isProven(const std::vector<double>& from, const std::vector<double>& to) {
    const std::vector<Variable>& variables = checker_.robot().variables();
    for (std::size_t i = 0; i < from.size(); ++i) {
      const int variable = checker_.group().variables[i];
      if (variables[static_cast<std::size_t>(variable)].cyclic &&
          std::abs(to[i] - from[i]) > kWidestTurn)
        return false;
    }
    return checker_.certifyMotion(from, to, workspace_, MotionQuery::VerdictOnly).verdict ==
           Verdict::Free;
  }

  bool fail(double time, RepairedTrajectory& repaired) {
    TrajectoryPlace place;
    place.time = time;
    place.piece = curve_.pieceAt(time);
    repaired.place = place;
    const StateReport state = checker_.reportState(at(time), workspace_);
    if (!state.contacts.empty()) repaired.contact = state.contacts.front();
    return false;
  }

  const Checker& checker_;
  const PiecewisePolynomial& curve_;
  Workspace workspace_;
};

}  // namespace

ProvenTrajectory provenTrajectory(const Checker& checker, const ConfigurationList& wayPoints,
                                  const RateLimits& limits, const TimingOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return provenTrajectory(checker, wayPoints, limits, options); });
  }
  requireStill(checker, "provenTrajectory");
  return Timing(checker, wayPoints, limits, options).run();
}

RepairedTrajectory repairTrajectory(const Checker& checker, const PiecewisePolynomial& curve,
                                    const RateLimits& limits, const TimingOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return repairTrajectory(checker, curve, limits, options); });
  }
  requireStill(checker, "repairTrajectory");
  RepairedTrajectory repaired = Chords(checker, curve).run();
  if (repaired.place) return repaired;
  ProvenTrajectory proven = provenTrajectory(checker, repaired.wayPoints, limits, options);
  const TrajectoryCertificate& found = proven.certificate;
  if (found.verdict == Verdict::Free) {
    repaired.proven = std::move(proven);
  } else if (found.contact) {
    repaired.place = *found.contact;
    repaired.contact = found.contact->witness;
  } else if (found.violation) {
    repaired.place = *found.violation;
  } else {
    repaired.place = *found.undecided;
  }
  return repaired;
}

}  // namespace swept
