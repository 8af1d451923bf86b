// SPDX-License-Identifier: BSD-3-Clause
// Limits that a certificate lists, and those that it does not.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "judge.hpp"
#include "swept/core/tolerances.hpp"

namespace trajectories {

namespace {

using swept::LimitKind;
using swept::LimitViolation;
using State = std::vector<double>;

constexpr std::array kLimitKinds{LimitKind::Position, LimitKind::Velocity, LimitKind::Acceleration,
                                 LimitKind::Jerk};
/// Relative.
constexpr double kShare = 1e-6;

/// A limit, and the most that samples are beyond it.
struct Limit {
  double lower, upper;
  double rounding = 0.0;  ///< of the value or rate
  double most = -HUGE_VAL;
};

std::string text(const char* what, const std::string& variable, LimitKind kind, double value,
                 double limit) {
  std::ostringstream out;
  out.precision(17);
  out << what << ": " << variable << ", " << toString(kind) << " " << value << ", limit " << limit;
  return out.str();
}

/// What a derivative of a value of some size rounds by.
double roundingOf(const RandomCurve& curve, Eigen::Index value, int order) {
  double most = 0.0;
  for (std::size_t piece = 0; piece < curve.curve.pieces(); ++piece) {
    const double length = curve.curve.knots()[piece + 1] - curve.curve.knots()[piece];
    const double size = curve.curve.coefficients(piece).row(value).cwiseAbs().maxCoeff() +
                        std::abs(curve.curve.knots()[piece]) * 4.0;
    most = std::max(most, size * std::pow(14.0 / length, order));
  }
  return 1e-13 * most;
}

Limit limitOf(const Stage& stage, const RandomCurve& curve, const swept::RateLimits& limits,
              std::size_t k, LimitKind kind) {
  const auto order = static_cast<int>(kind);
  const double rounding = roundingOf(curve, static_cast<Eigen::Index>(k), order);
  if (kind == LimitKind::Position) {
    const StageVariable& variable = stage.variables[k];
    const bool none = variable.cyclic || variable.orientation;
    return {none ? -HUGE_VAL : variable.lower - swept::tolerance::kLimit,
            none ? HUGE_VAL : variable.upper + swept::tolerance::kLimit, rounding};
  }
  const std::vector<double>& rates = kind == LimitKind::Velocity       ? limits.velocity
                                     : kind == LimitKind::Acceleration ? limits.acceleration
                                                                       : limits.jerk;
  const double most = rates[k] * (1.0 + swept::tolerance::kRateLimit);
  return {-most, most, rounding};
}

}  // namespace

std::vector<std::string> limitFaults(const Stage& stage, const RandomCurve& curve,
                                     const swept::RateLimits& limits,
                                     const swept::TrajectoryCertificate& found) {
  constexpr int kSteps = 24;
  std::vector<std::string> faults;
  const swept::Group& group = stage.checker.group();
  State values;
  std::size_t listed = 0;
  for (const LimitKind kind : kLimitKinds) {
    std::vector<Limit> all;
    for (std::size_t k = 0; k < stage.values(); ++k)
      all.push_back(limitOf(stage, curve, limits, k, kind));
    for (std::size_t piece = 0; piece < curve.truth.pieces(); ++piece) {
      const double begin = curve.truth.knots[piece];
      const double length = curve.truth.knots[piece + 1] - begin;
      for (int i = 0; i <= kSteps; ++i) {
        const double t = i == kSteps ? curve.truth.knots[piece + 1] : begin + length * i / kSteps;
        curve.truth.at(piece, t, static_cast<int>(kind), values);
        for (std::size_t k = 0; k < values.size(); ++k)
          all[k].most = std::max({all[k].most, all[k].lower - values[k], values[k] - all[k].upper});
      }
    }
    for (std::size_t k = 0; k < stage.values(); ++k) {
      const std::string& name =
          stage.checker.robot().variables()[static_cast<std::size_t>(group.variables[k])].name;
      const auto own = std::ranges::find_if(found.violations, [&](const LimitViolation& violation) {
        return violation.variable == name && violation.kind == kind;
      });
      const Limit& limit = all[k];
      const double room = kShare * std::min(std::abs(limit.upper), 1e9) + limit.rounding;
      if (own == found.violations.end()) {
        if (limit.most > room)
          faults.push_back(text("beyond a limit that is not listed", name, kind,
                                limit.upper + limit.most, limit.upper));
        continue;
      }
      ++listed;
      curve.truth.at(own->piece, own->time, static_cast<int>(kind), values);
      const double beyond = std::max(limit.lower - own->value, own->value - limit.upper);
      if (!(beyond > 0.0) || beyond < limit.most - kShare * std::abs(own->value) - limit.rounding)
        faults.push_back(text("listed, but not the largest", name, kind, own->value, limit.upper));
      if (std::abs(values[k] - own->value) > kShare * std::abs(own->value) + limit.rounding)
        faults.push_back(text("listed, but not attained", name, kind, own->value, values[k]));
    }
  }
  if (listed != found.violations.size()) faults.emplace_back("limits that are listed twice");
  return faults;
}

}  // namespace trajectories
