// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/curve_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "swept/core/tolerances.hpp"
#include "swept/robot_model/limits.hpp"
#include "trajectory/bernstein.hpp"

namespace swept {

const char* toString(LimitKind kind) {
  switch (kind) {
    case LimitKind::Position:
      return "position";
    case LimitKind::Velocity:
      return "velocity";
    case LimitKind::Acceleration:
      return "acceleration";
    case LimitKind::Jerk:
      return "jerk";
  }
  return "";
}

namespace detail {

namespace {

/// A value beyond this range leaves a limit.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  bool isUnlimited() const { return std::isinf(lower) && std::isinf(upper); }
  /// By how much a value is outside; negative inside.
  double excess(double value) const { return std::max(lower - value, value - upper); }
};

/// One value or rate of a piece, over a part of it.
struct LimitedPart {
  Bernstein coefficients{};
  double begin = 0.0, end = 1.0;  ///< share of the piece
};

/// The most that a value is outside of its range, and where.
struct Excess {
  double most = 0.0;
  double value = 0.0;
  double time = 0.0;
  std::size_t piece = 0;
};

/// The coefficients of a derivative of one value, by time.
std::size_t derive(const Eigen::MatrixXd& piece, Eigen::Index variable, std::size_t order,
                   double duration, Bernstein& coefficients) {
  std::size_t count = static_cast<std::size_t>(piece.cols());
  for (std::size_t k = 0; k < count; ++k)
    coefficients[k] = piece(variable, static_cast<Eigen::Index>(k));
  for (; order > 0 && count > 0; --order) {
    --count;
    const double factor = static_cast<double>(count) / duration;
    for (std::size_t k = 0; k < count; ++k)
      coefficients[k] = factor * (coefficients[k + 1] - coefficients[k]);
  }
  return count;
}

/// A part whose largest coefficient is no worse than the worst value by more than this is not
/// divided: of the value.
constexpr double kExcessShare = 1e-9;
/// Halvings after which parts are too short to tell their values apart.
constexpr double kShortestPart = 0x1p-40;

/// Adds what one piece says: branch and bound over its parts, by the hull of their coefficients.
void addPiece(const LimitedPart& whole, std::size_t count, const Range& range, std::size_t piece,
              std::span<const double> knots, std::vector<LimitedPart>& parts, Excess& worst) {
  const auto look = [&](double value, double share) {
    if (!(range.excess(value) > worst.most)) return;
    const double duration = knots[piece + 1] - knots[piece];
    worst = {range.excess(value), value, knots[piece] + share * duration, piece};
  };
  parts.assign(1, whole);
  while (!parts.empty()) {
    const LimitedPart part = parts.back();
    parts.pop_back();
    const std::span<const double> own(part.coefficients.data(), count);
    look(own.front(), part.begin);
    look(own.back(), part.end);
    double most = 0.0;
    double size = 0.0;
    for (const double coefficient : own) {
      most = std::max(most, range.excess(coefficient));
      size = std::max(size, std::abs(coefficient));
    }
    if (!(most > worst.most + kExcessShare * size)) continue;
    // What is left is no value but a bound: the limit is not shown to hold.
    if (part.end - part.begin < kShortestPart) {
      worst = {most, own.front(), knots[piece] + part.begin * (knots[piece + 1] - knots[piece]),
               piece};
      continue;
    }
    LimitedPart first = part;
    LimitedPart rest = part;
    first.end = rest.begin = 0.5 * (part.begin + part.end);
    divide(own, 0.5, std::span(first.coefficients).first(count),
           std::span(rest.coefficients).first(count));
    parts.push_back(rest);
    parts.push_back(first);
  }
}

std::optional<Excess> worstOf(const PiecewisePolynomial& curve, Eigen::Index variable,
                              std::size_t order, const Range& range) {
  if (range.isUnlimited()) return std::nullopt;
  Excess worst;
  std::vector<LimitedPart> parts;
  for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
    LimitedPart whole;
    const double duration = curve.knots()[piece + 1] - curve.knots()[piece];
    const std::size_t count =
        derive(curve.coefficients(piece), variable, order, duration, whole.coefficients);
    const std::span<const double> all(whole.coefficients.data(), count);
    if (std::ranges::all_of(all, [&](double value) { return !(range.excess(value) > worst.most); }))
      continue;
    addPiece(whole, count, range, piece, curve.knots(), parts, worst);
  }
  if (worst.most > 0.0) return worst;
  return std::nullopt;
}

}  // namespace

std::vector<LimitViolation> limitViolations(const PiecewisePolynomial& curve, const Robot& robot,
                                            const Group& group, const RateLimits* rates) {
  std::vector<LimitViolation> violations;
  for (std::size_t i = 0; i < group.variables.size(); ++i) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(group.variables[i])];
    const auto look = [&](LimitKind kind, std::size_t order, const Range& range, double lower,
                          double upper) {
      const auto worst = worstOf(curve, static_cast<Eigen::Index>(i), order, range);
      if (!worst) return;
      LimitViolation violation;
      violation.time = worst->time;
      violation.piece = worst->piece;
      violation.variable = variable.name;
      violation.kind = kind;
      violation.value = worst->value;
      violation.limit = kind != LimitKind::Position ? upper : worst->value < lower ? lower : upper;
      violations.push_back(std::move(violation));
    };
    if (!variable.cyclic && !isOrientation(robot, variable))
      look(LimitKind::Position, 0,
           {variable.lower - tolerance::kLimit, variable.upper + tolerance::kLimit}, variable.lower,
           variable.upper);
    if (rates == nullptr) continue;
    const auto lookAtRate = [&](LimitKind kind, std::size_t order, double limit) {
      const double most = limit * (1.0 + tolerance::kRateLimit);
      look(kind, order, {-most, most}, -limit, limit);
    };
    lookAtRate(LimitKind::Velocity, 1, rates->velocity[i]);
    lookAtRate(LimitKind::Acceleration, 2, rates->acceleration[i]);
    lookAtRate(LimitKind::Jerk, 3, rates->jerk[i]);
  }
  return violations;
}

}  // namespace detail

}  // namespace swept
