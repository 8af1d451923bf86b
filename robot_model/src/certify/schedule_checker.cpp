// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/schedule_checker.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <memory>
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

}  // namespace

struct ScheduleChecker::Data {
  Data(const Checker& whole, std::vector<std::string> ownNames, std::vector<ScheduledCurve> curves,
       ConfigurationView still, const std::vector<std::string>& ignored)
      : variables(std::move(ownNames)),
        places(placesIn(whole, variables)),
        others(std::move(curves)),
        rest(Eigen::VectorXd::Zero(std::ssize(whole.group().variables))) {
    for (std::size_t v = 0; v < still.size(); ++v) rest[static_cast<Eigen::Index>(v)] = still[v];
    placesOfOthers.reserve(others.size());
    for (const ScheduledCurve& curve : others) {
      placesOfOthers.push_back(placesIn(whole, curve.variables));
      parts.emplace_back(curve, placesOfOthers.back());
      end = std::max(end, parts.back().end());
    }
    for (const MovingObstacle& obstacle : whole.world().obstacles())
      end = std::max(end, obstacle.waypoints.back().time);
    const Checker pairs = detail::pairsMovedBy(whole, variables, ignored);
    checker =
        std::make_unique<const Checker>(pairs.withTracking(detail::widened(pairs, rounding())));
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() = default;

  double latest() const { return end + kLongest; }

  /// rad or m. By how much each value of the group may be off what the curves say: L19.
  std::vector<double> rounding() const {
    std::vector<double> off(static_cast<std::size_t>(rest.size()), 0.0);
    for (const Eigen::Index place : places)
      off[static_cast<std::size_t>(place)] =
          detail::combinedRounding(kMostValue, kMostRate, latest());
    for (std::size_t i = 0; i < others.size(); ++i) {
      const std::vector<double> rates = detail::largestRates(others[i].curve);
      const std::vector<double> values = detail::largestValues(others[i].curve);
      std::vector<double> own(rates.size());
      for (std::size_t v = 0; v < own.size(); ++v)
        own[v] = detail::combinedRounding(values[v], rates[v] / others[i].slowdown, latest());
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

  const std::vector<std::string> variables;
  const std::vector<Eigen::Index> places;
  const std::vector<ScheduledCurve> others;
  Eigen::VectorXd rest;  ///< a configuration of the group
  std::vector<std::vector<Eigen::Index>> placesOfOthers;
  std::vector<detail::CurveOnClock> parts;  ///< of others
  double end = 0.0;                         ///< s
  std::unique_ptr<const Checker> checker;   ///< of the pairs that are asked about, in the tube
};

ScheduleChecker::ScheduleChecker(const Checker& checker, std::vector<std::string> variables,
                                 std::vector<ScheduledCurve> others, ConfigurationView still,
                                 const std::vector<std::string>& ignored) {
  if (detail::inForeignEnvironment()) {
    inDefaultEnvironment([&, still] {
      *this = ScheduleChecker(checker, std::move(variables), std::move(others), still, ignored);
    });
    return;
  }
  requireNames(checker, variables, others, still, ignored);
  data_ = std::make_shared<const Data>(checker, std::move(variables), std::move(others), still,
                                       ignored);
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
  std::vector<detail::CurveOnClock> parts = data_->parts;
  parts.emplace_back(own, 0.0, 1.0, data_->places);
  return data_->checker->certifyTrajectory(
      detail::combined(parts, data_->rest, own.begin(), own.end()), workspace, {.contact = query});
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
  return *data_->checker;
}

}  // namespace swept
