// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/schedule_checker.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certify/moved_pairs.hpp"
#include "certify/obstacle_room.hpp"
#include "certify/schedule_tube.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "text/numbers.hpp"
#include "trajectory/curve_on_clock.hpp"
#include "trajectory/rate_bounds.hpp"

namespace swept {

namespace {

void requireOwn(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("ScheduleChecker: " + message);
}

std::vector<Eigen::Index> placesIn(const Checker& checker, const std::vector<std::string>& names) {
  const std::vector<int>& all = checker.group().variables;
  std::vector<Eigen::Index> places;
  for (const std::string& name : names)
    places.push_back(std::ranges::find(all, *checker.robot().findVariable(name)) - all.begin());
  return places;
}

/// A curve that rests for a second, to ask combinedCurve() about the names.
ScheduledCurve resting(const std::vector<std::string>& names) {
  const auto size = static_cast<Eigen::Index>(names.size());
  return {.variables = names,
          .curve = PiecewisePolynomial({0.0, 1.0}, {Eigen::MatrixXd::Zero(size, 2)})};
}

void requireNames(const Checker& checker, const std::vector<std::string>& variables,
                  const std::vector<ScheduledCurve>& others, ConfigurationView still,
                  const std::vector<std::string>& ignored) {
  requireOwn(!variables.empty(), "there is no own variable");
  std::vector<ScheduledCurve> all = others;
  all.push_back(resting(variables));
  combinedCurve(checker.robot(), checker.group(), all, still);
  for (const std::string& name : ignored)
    requireOwn(checker.robot().findVariable(name).has_value(),
               "the robot has no variable '" + name + "'");
}

/// The own curves that the tube is wide enough for.
constexpr double kMostRate = 100.0;    // rad/s or m/s
constexpr double kMostValue = 1000.0;  // rad or m
constexpr double kLongest = 600.0;     // s, beyond the end of all others
/// rad or m, of the value that moves fastest. Ranges of delays with a wider tube are divided before
/// they are asked about, since they are hardly ever free. Those with a narrower one are not
/// divided.
constexpr double kWidest = 0.2;
constexpr double kNarrowest = 0.02;
/// Of the longest delay: no shorter range is asked about, however wide its tube is.
constexpr double kLeastShare = 1.0 / 1024.0;

void requireLateness(double delay, double slowest, const std::vector<ScheduledCurve>& others) {
  requireOwn(std::isfinite(delay) && delay >= 0.0, "the delay is " + detail::formatNumber(delay) +
                                                       " s; allowed are finite numbers from 0 on");
  requireOwn(std::isfinite(slowest) && slowest >= 1.0,
             "the slowest factor is " + detail::formatNumber(slowest) +
                 "; allowed are finite numbers from 1 on");
  for (std::size_t i = 0; slowest > 1.0 && i < others.size(); ++i)
    requireOwn(others[i].curve.begin() >= 0.0,
               "curve " + std::to_string(i + 1) + " of others begins at " +
                   detail::formatNumber(others[i].curve.begin()) +
                   " s of its own time; with a slowdown, allowed are 0 and later");
}

}  // namespace

struct ScheduleChecker::Data {
  /// How much later one curve may be at what it does on time (L19).
  struct Lateness {
    double delay = 0.0;    ///< s
    double slowest = 1.0;  ///< factor
    ///@{
    /// s. The others have all of their starts between the two: a slowdown counts from there on.
    double firstStart = 0.0, lastStart = 0.0;
    ///@}

    /// s, of the own curve, where it is at `time` (s) of its own.
    double ofOwn(double time) const { return delay + (slowest - 1.0) * time; }
    /// s, of others, when the clock shows `time` (s): they do what they did that much earlier. What
    /// starts at s and is late by d does at s + d + f (t - s) what it did at t. So t is no less
    /// than s + (time - s - d) / f where that has begun.
    double ofOthers(double time) const {
      return std::max(delay, delay / slowest + (1.0 - 1.0 / slowest) * (time - firstStart));
    }
    /// s. When the last of others ends whose end is at `time` (s).
    double lastOf(double time) const { return delay + firstStart + slowest * (time - firstStart); }
    /// s, of the own curve. Before this, no other can be late by `late` (s), give or take `half`;
    /// early, where it is negative.
    double firstWith(double late, double half) const { return firstWith(late, half, firstStart); }
    /// s. From here on, all others can be late, or early, by `late`.
    double surelyWith(double late) const { return firstWith(late, 0.0, lastStart); }

   private:
    double firstWith(double late, double half, double start) const {
      const double least = (std::abs(late) - half) / detail::kArithmeticOutward;
      if (least <= delay * detail::kArithmeticOutward) return 0.0;
      const double own = (least - delay * detail::kArithmeticOutward) / (slowest - 1.0);
      return (late < 0.0 ? own : own * slowest + delay + start) / detail::kArithmeticOutward;
    }
  };

  /// Of these curves.
  static Lateness latenessOf(double delay, double slowest,
                             const std::vector<ScheduledCurve>& others) {
    Lateness lateness{.delay = delay, .slowest = slowest};
    if (others.empty()) return lateness;
    const auto [first, last] = std::ranges::minmax(others, {}, &ScheduledCurve::start);
    lateness.firstStart = first.start;
    lateness.lastStart = last.start;
    return lateness;
  }

  /// A checker that has room for others that are early or late by up to `half` (s).
  struct Tube {
    double half = 0.0;
    Checker checker;
    /// Has room for moving obstacles that are as early or late, too. No value: there are none.
    std::optional<Checker> besideObstacles = {};
  };
  /// When something moves: others on time, and perhaps moving obstacles.
  struct Moves {
    double first = std::numeric_limits<double>::infinity();  ///< s
    double last = 0.0;                                       ///< s
  };
  /// Who is late by how much (s) beside the own curve: all others, and perhaps moving obstacles.
  struct Shift {
    double late = 0.0;
    bool withObstacles = false;
  };

  Data(const Checker& whole, std::vector<std::string> ownNames, std::vector<ScheduledCurve> curves,
       ConfigurationView still, const std::vector<std::string>& ignored, double delay,
       double slowest)
      : variables(std::move(ownNames)),
        places(placesIn(whole, variables)),
        others(std::move(curves)),
        lateness(latenessOf(delay, slowest, others)),
        pairs(detail::pairsMovedBy(whole, variables, ignored)),
        rest(Eigen::VectorXd::Zero(std::ssize(whole.group().variables))) {
    for (std::size_t v = 0; v < still.size(); ++v) rest[static_cast<Eigen::Index>(v)] = still[v];
    for (const ScheduledCurve& curve : others) {
      placesOfOthers.push_back(placesIn(whole, curve.variables));
      moves.first = std::min(moves.first, curve.start + curve.slowdown * curve.curve.begin());
      moves.last = std::max(moves.last, curve.start + curve.slowdown * curve.curve.end());
    }
    end = lateness.lastOf(moves.last);
    movesWithObstacles = moves;
    for (const MovingObstacle& obstacle : whole.world().obstacles()) {
      const double begins = obstacle.waypoints.front().time, ends = obstacle.waypoints.back().time;
      movesWithObstacles.first = std::min(movesWithObstacles.first, begins);
      movesWithObstacles.last = std::max(movesWithObstacles.last, ends);
      largestTime = std::max({largestTime, std::abs(begins), std::abs(ends)});
    }
    end = std::max(end, movesWithObstacles.last);
    tubes.push_back({0.0, pairs.withTracking(detail::widened(pairs, offBy(0.0)))});
    if (longest() > 0.0) addTubes();
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() = default;

  double latest() const { return end + kLongest; }

  /// s. No curve is later while something else moves.
  double longest() const {
    return lateness.ofOwn(std::max({0.0, moves.last, movesWithObstacles.last}));
  }

  /// rad or m. By how much each value may be off, where others are early or late by up to `half`
  /// (s), with all roundings (L19).
  std::vector<double> offBy(double half) const {
    std::vector<double> off(static_cast<std::size_t>(rest.size()), 0.0);
    for (const Eigen::Index place : places)
      off[static_cast<std::size_t>(place)] =
          detail::combinedRounding(kMostValue, kMostRate, latest());
    for (std::size_t i = 0; i < others.size(); ++i) {
      const std::vector<double> rates = detail::largestRates(others[i].curve);
      const std::vector<double> values = detail::largestValues(others[i].curve);
      std::vector<double> own(rates.size());
      for (std::size_t v = 0; v < own.size(); ++v) {
        const double rate = rates[v] / others[i].slowdown;
        own[v] = (detail::combinedRounding(values[v], rate, latest()) +
                  (half > 0.0 ? roundedOutward(half) : 0.0) * rate) *
                 detail::kArithmeticOutward;
      }
      detail::dropResting(others[i].curve, own);
      for (std::size_t v = 0; v < own.size(); ++v)
        off[static_cast<std::size_t>(placesOfOthers[i][v])] = own[v];
    }
    return off;
  }

  /// s. A range of delays, with what times on the clock round by.
  double roundedOutward(double half) const {
    return half + 4.0 * detail::kTimeRounding * (latest() + largestTime);
  }

  void addTubes() {
    const bool isBesideObstacles = !pairs.world().obstacles().empty();
    for (double half = isBesideObstacles ? 0.5 * longest() : longest();; half *= 0.5) {
      const std::vector<double> off = offBy(half);
      const double widest =
          std::max(std::ranges::max(off), detail::largestObstacleRoom(pairs, roundedOutward(half)));
      const bool isLast = widest <= kNarrowest || half <= kLeastShare * longest();
      if (isLast || widest <= kWidest) {
        tubes.push_back({half, detail::inTube(pairs, off)});
        if (isBesideObstacles)
          tubes.back().besideObstacles =
              detail::besideObstaclesWithin(tubes.back().checker, roundedOutward(half));
      }
      if (isLast) break;
    }
  }

  bool fitsTube(const PiecewisePolynomial& own) const {
    return own.end() <= latest() && std::ranges::max(detail::largestRates(own)) <= kMostRate &&
           std::ranges::max(detail::largestValues(own)) <= kMostValue;
  }

  /// What is proven by one of the tubes' checkers from one time to another (s).
  TrajectoryCertificate certify(const PiecewisePolynomial& own, double begin, double until,
                                const Shift& shift, const Checker& checker, Workspace& workspace,
                                MotionQuery query) const {
    std::vector<detail::CurveOnClock> parts;
    for (std::size_t i = 0; i < others.size(); ++i)
      parts.emplace_back(others[i].curve, others[i].start + shift.late, others[i].slowdown,
                         placesOfOthers[i]);
    parts.emplace_back(own, 0.0, 1.0, places);
    return checker.certifyTrajectory(
        detail::combined(parts, rest, begin, until), workspace,
        {.contact = query, .clock = shift.withObstacles ? -shift.late : 0.0});
  }

  /// The first certificate that is not Free with a shift, give or take what the tube has room for.
  /// Ranges without a proof are halved.
  std::optional<TrajectoryCertificate> notFree(const PiecewisePolynomial& own, const Shift& shift,
                                               std::size_t tube, Workspace& workspace,
                                               MotionQuery query) const {
    // While nothing else moves, a delay changes nothing.
    const double half = tubes[tube].half;
    const Moves& all = shift.withObstacles ? movesWithObstacles : moves;
    const double begin = std::max({own.begin(), all.first + shift.late - roundedOutward(half),
                                   lateness.firstWith(shift.late, roundedOutward(half))});
    const double until = std::min(own.end(), all.last + shift.late + roundedOutward(half));
    if (!(begin < until)) return std::nullopt;
    const Checker& checker =
        shift.withObstacles ? *tubes[tube].besideObstacles : tubes[tube].checker;
    TrajectoryCertificate found = certify(own, begin, until, shift, checker, workspace, query);
    if (found.verdict == Verdict::Free) return std::nullopt;
    if (tube + 1 == tubes.size()) {
      if (!found.contact) return found;
      // A slowdown reaches the range before it reaches its middle, whose contacts are found.
      const auto counts = [&](const TrajectoryCertificate& certificate) {
        return certificate.contact && lateness.surelyWith(shift.late) <= certificate.contact->time;
      };
      if (!shift.withObstacles && counts(found)) return found;
      // Where obstacles have room, a contact may be none: it counts if there is one without.
      if (shift.withObstacles) {
        TrajectoryCertificate withoutRoom =
            certify(own, begin, until, shift, tubes.front().checker, workspace, query);
        if (counts(withoutRoom)) return withoutRoom;
      }
      TrajectoryCertificate open;
      open.freeUntil = found.freeUntil;
      open.undecided = static_cast<const TrajectoryPlace&>(*found.contact);
      return open;
    }
    for (const double late : {shift.late - 0.5 * half, shift.late + 0.5 * half})
      if (auto part = notFree(own, {late, shift.withObstacles}, tube + 1, workspace, query))
        return part;
    return std::nullopt;
  }

  /// The same for all delays (s) from one to another.
  std::optional<TrajectoryCertificate> notFree(const PiecewisePolynomial& own, double from,
                                               double to, bool withObstacles, Workspace& workspace,
                                               MotionQuery query) const {
    const double ranges = std::ceil((to - from) / (2.0 * tubes[1].half));
    const double half = 0.5 * (to - from) / ranges;
    for (double i = 0.0; i < ranges; ++i) {
      const double late = from + (2.0 * i + 1.0) * half;
      if (auto found = notFree(own, {late, withObstacles}, 1, workspace, query)) return found;
    }
    return std::nullopt;
  }

  /// The same for all delays. Moving obstacles are never late: they are early where the own curve
  /// is late, as all others are, and on time where others are late.
  std::optional<TrajectoryCertificate> notFree(const PiecewisePolynomial& own, Workspace& workspace,
                                               MotionQuery query) const {
    const bool isBesideObstacles = tubes[1].besideObstacles.has_value();
    const double last = isBesideObstacles ? movesWithObstacles.last : moves.last;
    const double early = lateness.ofOwn(std::max(0.0, std::min(own.end(), last)));
    const double late = lateness.ofOthers(std::min(own.end(), lateness.lastOf(moves.last)));
    if (!isBesideObstacles) return notFree(own, -early, late, false, workspace, query);
    if (auto found = notFree(own, -early, 0.0, true, workspace, query)) return found;
    return notFree(own, 0.0, late, false, workspace, query);
  }

  const std::vector<std::string> variables;
  const std::vector<Eigen::Index> places;
  const std::vector<ScheduledCurve> others;
  const Lateness lateness;
  const Checker pairs;   ///< those that are asked about
  Eigen::VectorXd rest;  ///< a configuration of the group
  std::vector<std::vector<Eigen::Index>> placesOfOthers;
  Moves moves;               ///< of others on time
  Moves movesWithObstacles;  ///< and of moving obstacles
  double end = 0.0;          ///< s
  double largestTime = 0.0;  ///< s, the largest size of an obstacle's first and last time
  std::vector<Tube> tubes;   ///< without a delay, then each for half the range of that before
};

ScheduleChecker::ScheduleChecker(const Checker& checker, std::vector<std::string> variables,
                                 std::vector<ScheduledCurve> others, ConfigurationView still,
                                 const std::vector<std::string>& ignored, double delay,
                                 double slowest) {
  if (detail::inForeignEnvironment()) {
    inDefaultEnvironment([&, still] {
      *this = ScheduleChecker(checker, std::move(variables), std::move(others), still, ignored,
                              delay, slowest);
    });
    return;
  }
  requireNames(checker, variables, others, still, ignored);
  requireLateness(delay, slowest, others);
  data_ = std::make_shared<const Data>(checker, std::move(variables), std::move(others), still,
                                       ignored, delay, slowest);
}

TrajectoryCertificate ScheduleChecker::certify(const PiecewisePolynomial& own, Workspace& workspace,
                                               MotionQuery query) const {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return certify(own, workspace, query); });
  requireOwn(own.dimension() == std::ssize(data_->places),
             "the curve has " + std::to_string(own.dimension()) + " values, expected " +
                 std::to_string(data_->places.size()));
  requireOwn(own.begin() >= 0.0, "the curve begins at " + detail::formatNumber(own.begin()) +
                                     " s; allowed are 0 and later");
  if (!data_->fitsTube(own)) {
    TrajectoryCertificate tooFar;
    tooFar.freeUntil = own.begin();
    tooFar.undecided = TrajectoryPlace{.time = own.begin()};
    return tooFar;
  }
  TrajectoryCertificate found = data_->certify(own, own.begin(), own.end(), {},
                                               data_->tubes.front().checker, workspace, query);
  if (data_->tubes.size() == 1 || found.verdict != Verdict::Free) return found;
  if (auto late = data_->notFree(own, workspace, query)) return *std::move(late);
  return found;
}

double ScheduleChecker::end() const {
  return data_->end;
}

const std::vector<std::string>& ScheduleChecker::variables() const {
  return data_->variables;
}

const std::vector<ScheduledCurve>& ScheduleChecker::others() const {
  return data_->others;
}

const Checker& ScheduleChecker::checker() const {
  return data_->tubes.front().checker;
}

}  // namespace swept
