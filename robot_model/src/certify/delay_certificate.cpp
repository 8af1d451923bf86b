// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "certify/moved_pairs.hpp"
#include "certify/schedule_tube.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/schedule.hpp"
#include "text/numbers.hpp"
#include "trajectory/rate_bounds.hpp"

namespace swept {

namespace {

void requireDelay(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("certifyDelays: " + message);
}

void requireQuery(const DelayQuery& query, std::size_t curves) {
  requireDelay(query.curve < curves, "there is no curve " + std::to_string(query.curve + 1) +
                                         ", there are " + std::to_string(curves));
  requireDelay(std::isfinite(query.latest) && query.latest >= 0.0,
               "the latest delay is " + detail::formatNumber(query.latest) +
                   " s; allowed are finite numbers from 0 on");
  requireDelay(std::isfinite(query.slowest) && query.slowest >= 1.0,
               "the slowest factor is " + detail::formatNumber(query.slowest) +
                   "; allowed are finite numbers from 1 on");
  requireDelay(std::isfinite(query.resolution) && query.resolution > 0.0,
               "the resolution is " + detail::formatNumber(query.resolution) +
                   " s; allowed are positive numbers");
}

/// A curve that rests at its end until a time (s), if that is later.
PiecewisePolynomial restedUntil(double time, const PiecewisePolynomial& curve) {
  if (!(time > curve.end())) return curve;
  std::vector<double> knots = curve.knots();
  std::vector<Eigen::MatrixXd> pieces;
  for (std::size_t i = 0; i < curve.pieces(); ++i) pieces.push_back(curve.coefficients(i));
  knots.push_back(time);
  pieces.push_back(pieces.back().rightCols<1>().replicate(1, 2));
  return {std::move(knots), std::move(pieces)};
}

/// Delays and slowdowns, as factors.
struct DelayBox {
  double begin = 0.0, end = 0.0;        ///< s
  double fastest = 1.0, slowest = 1.0;  ///< factors

  double delay() const { return 0.5 * (begin + end); }
  double slowdown() const { return 0.5 * (fastest + slowest); }
  double halfDelay() const { return 0.5 * (end - begin); }
  double halfSlowdown() const { return 0.5 * (slowest - fastest); }
};

/// The search for the longest range of delays from 0 on that is proven.
class DelaySearch {
 public:
  DelaySearch(const Checker& checker, std::span<const ScheduledCurve> curves,
              const DelayQuery& query, ConfigurationView still, const std::stop_token& stop)
      : checker_(checker),
        curves_(curves.begin(), curves.end()),
        query_(query),
        still_(still),
        stop_(stop),
        planned_(curves_[query.curve]),
        pairs_(detail::delayedPairs(checker, planned_.variables, namesOfOthers())),
        rates_(detail::largestRates(planned_.curve)) {
    for (const std::string& name : planned_.variables)
      places_.push_back(
          std::ranges::find(checker.group().variables, *checker.robot().findVariable(name)) -
          checker.group().variables.begin());
  }

  DelayCertificate run() {
    const DelayBox all{
        .begin = 0.0, .end = query_.latest, .fastest = 1.0, .slowest = query_.slowest};
    found_.verdict = Verdict::Free;
    if (isFreeAsPlanned()) {
      const double proven = provenUntil(all);
      // That nothing is proven from 0 on says nothing of 0 itself with all slowdowns.
      if (query_.slowest == 1.0 || proven > 0.0 || found_.verdict == Verdict::Free)
        found_.proven = proven;
    } else {
      say({0.0, 0.0, 1.0, 1.0});
    }
    return std::move(found_);
  }

 private:
  /// The first delay of a box that is not proven with all of its slowdowns; its end if all are.
  double provenUntil(const DelayBox& box) {
    if (stop_.stop_requested()) {
      if (found_.verdict == Verdict::Free) found_.verdict = Verdict::Undecided;
      return box.begin;
    }
    if (isFree(box)) return box.end;
    const double bySlowdown = planned_.slowdown * planned_.curve.end() * 2.0 * box.halfSlowdown();
    const double byDelay = 2.0 * box.halfDelay();
    if (std::max(byDelay, bySlowdown) <= query_.resolution) {
      say(box);
      return box.begin;
    }
    DelayBox first = box;
    DelayBox rest = box;
    if (byDelay >= bySlowdown) {
      first.end = rest.begin = box.delay();
      const double until = provenUntil(first);
      return until < first.end ? until : provenUntil(rest);
    }
    first.slowest = rest.fastest = box.slowdown();
    rest.end = provenUntil(first);
    // Of no delay is left anything to ask about where not even the first one is proven.
    return rest.end > box.begin || found_.verdict == Verdict::Free ? provenUntil(rest) : box.begin;
  }

  bool isFreeAsPlanned() {
    if (stop_.stop_requested()) return false;
    ++found_.curves;
    return certifySchedule(checker_, curves_, {.contact = MotionQuery::VerdictOnly}, still_)
               .verdict == Verdict::Free;
  }

  std::vector<std::string> namesOfOthers() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < curves_.size(); ++i)
      if (i != query_.curve)
        names.insert(names.end(), curves_[i].variables.begin(), curves_[i].variables.end());
    return names;
  }

  CombinedCurve combined(double delay, double slowdown) {
    ScheduledCurve& late = curves_[query_.curve];
    late.start = planned_.start + delay;
    late.slowdown = planned_.slowdown * slowdown;
    return combinedCurve(checker_.robot(), checker_.group(), curves_, still_);
  }

  /// Whether all of a box is proven, by the curve of its middle, if the schedule is free as
  /// planned.
  bool isFree(const DelayBox& box) {
    ++found_.curves;
    CombinedCurve middle = combined(box.delay(), box.slowdown());
    // Moving obstacles go on until the latest of the box has ended.
    middle.curve = restedUntil(combined(box.end, box.slowest).curve.end(), middle.curve);
    std::vector<double> off = middle.rounding;
    const double time = (box.halfDelay() / (planned_.slowdown * box.fastest) +
                         planned_.curve.end() * box.halfSlowdown() / box.slowdown()) *
                        detail::kArithmeticOutward;
    for (std::size_t v = 0; v < places_.size(); ++v)
      off[static_cast<std::size_t>(places_[v])] += time * rates_[v] * detail::kArithmeticOutward;
    detail::dropResting(middle.curve, off);
    return isFree(inTube(box, off), middle.curve);
  }

  /// Piece by piece: the first one that is not proven, or a stop, ends it.
  bool isFree(const Checker& tube, const PiecewisePolynomial& curve) const {
    Workspace workspace(tube);
    for (std::size_t i = 0; i < curve.pieces(); ++i) {
      if (stop_.stop_requested()) return false;
      const PiecewisePolynomial piece({curve.knots()[i], curve.knots()[i + 1]},
                                      {curve.coefficients(i)});
      if (tube.certifyTrajectory(piece, workspace, {.contact = MotionQuery::VerdictOnly}).verdict !=
          Verdict::Free)
        return false;
    }
    return true;
  }

  /// Boxes of one width have tubes of nearly one width: that of the first is kept while it is wide
  /// enough, with a share to spare for what rounds otherwise.
  const Checker& inTube(const DelayBox& box, const std::vector<double>& off) {
    Tube& kept = tubes_[{box.halfDelay(), box.halfSlowdown()}];
    const auto fits = [](double wanted, double there) { return wanted <= there; };
    if (!kept.checker || !std::ranges::equal(off, kept.off, fits)) {
      kept.off = off;
      for (double& value : kept.off) value *= kSpare;
      kept.checker.emplace(detail::inTube(pairs_, kept.off));
    }
    return *kept.checker;
  }

  /// What is the matter with a box that is not proven: a contact of one of its corners, or of a
  /// later delay, each twice as far away.
  void say(const DelayBox& box) {
    found_.verdict = Verdict::Undecided;
    found_.contact.reset();
    if (meets(box.begin, box.fastest) || meets(box.begin, box.slowest)) return;
    const double step = std::max(box.end - box.begin, query_.resolution);
    for (double later = step; box.begin + later < 2.0 * query_.latest; later *= 2.0) {
      const double delay = std::min(box.begin + later, query_.latest);
      if (meets(delay, box.fastest) || meets(delay, box.slowest)) return;
    }
    if (query_.slowest > box.slowest) meets(box.begin, query_.slowest);
  }

  /// Whether the schedule is in contact, and which.
  bool meets(double delay, double slowdown) {
    if (stop_.stop_requested()) return false;
    const CombinedCurve late = combined(delay, slowdown);
    Workspace workspace(checker_);
    TrajectoryCertificate certificate = checker_.certifyTrajectory(late.curve, workspace);
    if (certificate.verdict != Verdict::Collision || !certificate.contact) return false;
    found_.verdict = Verdict::Collision;
    found_.contact = DelayContact{delay, slowdown, std::move(*certificate.contact)};
    return true;
  }

  static constexpr double kSpare = 1.0 + 1e-6;

  struct Tube {
    std::vector<double> off;
    std::optional<Checker> checker;
  };

  const Checker& checker_;
  std::vector<ScheduledCurve> curves_;
  const DelayQuery query_;
  const ConfigurationView still_;
  const std::stop_token stop_;
  const ScheduledCurve planned_;
  const Checker pairs_;
  const std::vector<double> rates_;  ///< per s of the curve's own time
  std::vector<std::ptrdiff_t> places_;
  std::map<std::pair<double, double>, Tube> tubes_;  ///< by half widths
  DelayCertificate found_;
};

}  // namespace

TrajectoryCertificate certifySchedule(const Checker& checker,
                                      std::span<const ScheduledCurve> curves,
                                      const TrajectoryQuery& query, ConfigurationView still) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, curves, still] { return certifySchedule(checker, curves, query, still); });
  }
  CombinedCurve combined = combinedCurve(checker.robot(), checker.group(), curves, still);
  detail::dropResting(combined.curve, combined.rounding);
  const Checker tube = checker.withTracking(detail::widened(checker, combined.rounding));
  Workspace workspace(tube);
  return tube.certifyTrajectory(combined.curve, workspace, query);
}

DelayCertificate certifyDelays(const Checker& checker, std::span<const ScheduledCurve> curves,
                               const DelayQuery& query, ConfigurationView still,
                               const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, curves, still] { return certifyDelays(checker, curves, query, still, stop); });
  }
  requireQuery(query, curves.size());
  combinedCurve(checker.robot(), checker.group(), curves, still);  // throws for what is not allowed
  return DelaySearch(checker, curves, query, still, stop).run();
}

}  // namespace swept
