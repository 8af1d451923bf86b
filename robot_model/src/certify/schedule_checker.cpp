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
/// Of the whole delay: no shorter range is asked about, however wide its tube is.
constexpr double kLeastShare = 1.0 / 1024.0;

}  // namespace

struct ScheduleChecker::Data {
  /// A checker that has room for others that are early or late by up to `half` (s).
  struct Tube {
    double half = 0.0;
    Checker checker;
  };

  Data(const Checker& whole, std::vector<std::string> ownNames, std::vector<ScheduledCurve> curves,
       ConfigurationView still, const std::vector<std::string>& ignored, double delayed)
      : variables(std::move(ownNames)),
        places(placesIn(whole, variables)),
        others(std::move(curves)),
        delay(delayed),
        pairs(detail::pairsMovedBy(whole, variables, ignored)),
        rest(Eigen::VectorXd::Zero(std::ssize(whole.group().variables))) {
    for (std::size_t v = 0; v < still.size(); ++v) rest[static_cast<Eigen::Index>(v)] = still[v];
    for (const ScheduledCurve& curve : others) {
      placesOfOthers.push_back(placesIn(whole, curve.variables));
      firstMove = std::min(firstMove, curve.start + curve.slowdown * curve.curve.begin());
      lastMove = std::max(lastMove, curve.start + curve.slowdown * curve.curve.end());
    }
    end = lastMove + delay;
    for (const MovingObstacle& obstacle : whole.world().obstacles())
      end = std::max(end, obstacle.waypoints.back().time);
    tubes.push_back({0.0, pairs.withTracking(detail::widened(pairs, offBy(0.0)))});
    if (delay == 0.0) return;
    for (double half = delay;; half *= 0.5) {
      const std::vector<double> off = offBy(half);
      const double widest = std::ranges::max(off);
      const bool isLast = widest <= kNarrowest || half <= kLeastShare * delay;
      if (isLast || widest <= kWidest) tubes.push_back({half, detail::inTube(pairs, off)});
      if (isLast) break;
    }
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() = default;

  double latest() const { return end + kLongest; }

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
        own[v] = (detail::combinedRounding(values[v], rate, latest()) + half * rate) *
                 detail::kArithmeticOutward;
      }
      detail::dropResting(others[i].curve, own);
      for (std::size_t v = 0; v < own.size(); ++v)
        off[static_cast<std::size_t>(placesOfOthers[i][v])] = own[v];
    }
    return off;
  }

  bool fitsTube(const PiecewisePolynomial& own) const {
    return own.end() <= latest() && std::ranges::max(detail::largestRates(own)) <= kMostRate &&
           std::ranges::max(detail::largestValues(own)) <= kMostValue;
  }

  /// What is proven in one of the tubes from one time to another (s), where all others are late by
  /// so much (s).
  TrajectoryCertificate certify(const PiecewisePolynomial& own, double begin, double until,
                                double late, const Tube& tube, Workspace& workspace,
                                MotionQuery query) const {
    std::vector<detail::CurveOnClock> parts;
    for (std::size_t i = 0; i < others.size(); ++i)
      parts.emplace_back(others[i].curve, others[i].start + late, others[i].slowdown,
                         placesOfOthers[i]);
    parts.emplace_back(own, 0.0, 1.0, places);
    return tube.checker.certifyTrajectory(detail::combined(parts, rest, begin, until), workspace,
                                          {.contact = query});
  }

  /// The first certificate that is not Free where the others are late by `late`, give or take what
  /// the tube has room for. Ranges without a proof are halved.
  std::optional<TrajectoryCertificate> notFree(const PiecewisePolynomial& own, double late,
                                               std::size_t tube, Workspace& workspace,
                                               MotionQuery query) const {
    // While all others rest, a delay changes nothing.
    const double half = tubes[tube].half;
    const double begin = std::max(own.begin(), firstMove + late - half);
    const double until = std::min(own.end(), lastMove + late + half);
    if (!(begin < until)) return std::nullopt;
    TrajectoryCertificate found = certify(own, begin, until, late, tubes[tube], workspace, query);
    if (found.verdict == Verdict::Free) return std::nullopt;
    if (tube + 1 == tubes.size()) return found;
    if (auto earlier = notFree(own, late - 0.5 * half, tube + 1, workspace, query)) return earlier;
    return notFree(own, late + 0.5 * half, tube + 1, workspace, query);
  }

  /// The same for all delays.
  std::optional<TrajectoryCertificate> notFree(const PiecewisePolynomial& own, Workspace& workspace,
                                               MotionQuery query) const {
    const double half = tubes[1].half;
    for (double late = half - delay; late < delay; late += 2.0 * half)
      if (auto found = notFree(own, late, 1, workspace, query)) return found;
    return std::nullopt;
  }

  const std::vector<std::string> variables;
  const std::vector<Eigen::Index> places;
  const std::vector<ScheduledCurve> others;
  const double delay;    ///< s
  const Checker pairs;   ///< those that are asked about
  Eigen::VectorXd rest;  ///< a configuration of the group
  std::vector<std::vector<Eigen::Index>> placesOfOthers;
  double firstMove = std::numeric_limits<double>::infinity();  ///< s, of others on time
  double lastMove = 0.0;                                       ///< s, likewise
  double end = 0.0;                                            ///< s
  std::vector<Tube> tubes;  ///< without a delay, then each for half the delay of that before
};

ScheduleChecker::ScheduleChecker(const Checker& checker, std::vector<std::string> variables,
                                 std::vector<ScheduledCurve> others, ConfigurationView still,
                                 const std::vector<std::string>& ignored, double delay) {
  if (detail::inForeignEnvironment()) {
    inDefaultEnvironment([&, still] {
      *this =
          ScheduleChecker(checker, std::move(variables), std::move(others), still, ignored, delay);
    });
    return;
  }
  requireNames(checker, variables, others, still, ignored);
  requireOwn(std::isfinite(delay) && delay >= 0.0, "the delay is " + detail::formatNumber(delay) +
                                                       " s; allowed are finite numbers from 0 on");
  requireOwn(delay == 0.0 || checker.world().obstacles().empty(),
             "the world has moving obstacles, which are never late: only a delay of 0 is allowed");
  data_ = std::make_shared<const Data>(checker, std::move(variables), std::move(others), still,
                                       ignored, delay);
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
  TrajectoryCertificate found =
      data_->certify(own, own.begin(), own.end(), 0.0, data_->tubes.front(), workspace, query);
  if (data_->delay == 0.0 || found.verdict != Verdict::Free) return found;
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
