// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/rate_check.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "trajectory/bernstein.hpp"

namespace swept::detail {

namespace {

/// Whether a polynomial with these Bernstein coefficients is at most `limit`. They bound it closely
/// on its halves: the acceleration of a blend with ramps is largest in the middle.
bool isWithin(std::span<const double> coefficients, double limit, int halvings) {
  if (std::ranges::all_of(coefficients, [&](double value) { return std::abs(value) <= limit; }))
    return true;
  if (halvings == 0) return false;
  Bernstein first{};
  Bernstein rest{};
  divide(coefficients, 0.5, first, rest);
  const std::size_t count = coefficients.size();
  return isWithin(std::span(first).first(count), limit, halvings - 1) &&
         isWithin(std::span(rest).first(count), limit, halvings - 1);
}

bool areWithin(const Eigen::MatrixXd& coefficients, const Eigen::VectorXd& limits) {
  // Rounding of this arithmetic. It is small beside the slack that trajectories are made with.
  constexpr double kRounding = 1.0 - 1e-12;
  constexpr int kHalvings = 1;
  for (Eigen::Index j = 0; j < limits.size(); ++j) {
    Bernstein row{};
    const auto count = static_cast<std::size_t>(coefficients.cols());
    for (std::size_t k = 0; k < count; ++k) row[k] = coefficients(j, static_cast<Eigen::Index>(k));
    if (!isWithin(std::span(row).first(count), kRounding * limits[j], kHalvings)) return false;
  }
  return true;
}

}  // namespace

bool keepsLimits(const PiecewisePolynomial& curve, const VariableLimits& limits) {
  for (std::size_t i = 0; i < curve.pieces(); ++i) {
    const double duration = curve.knots()[i + 1] - curve.knots()[i];
    const Eigen::MatrixXd velocity = derivative(curve.coefficients(i), duration);
    const Eigen::MatrixXd acceleration = derivative(velocity, duration);
    if (!areWithin(velocity, limits.speed) || !areWithin(acceleration, limits.acceleration))
      return false;
    if (limits.ramps && !areWithin(derivative(acceleration, duration), limits.jerk)) return false;
  }
  return true;
}

// Lemma: a controller's cubic has the acceleration 6 (b2 - 2 b1 + b0) / T^2 at its begin, and with
// it at its end. Each position rounds by u = 2^-53 of its size P, and so does each sum of a
// position and a product: together 30 u P / T^2. A quintic has the jerk 60 (b3 - 3 b2 + 3 b1 - b0)
// / T^3: some 1000 u P / T^3. The time between two points differs from what the speeds were chosen
// for by a part of the duration, u t, and so does the length by u t times the speed.
double leastStepFor(const WayPointPath& path, double duration) {
  constexpr double kUnit = 0x1p-53;
  constexpr double kQuadratic = 60.0, kCubic = 2000.0, kLinear = 18.0;
  const VariableLimits& limits = path.variables;
  const double length = *std::max_element(path.lengths.begin(), path.lengths.end());
  double step = 0.0;
  for (std::size_t i = 0; i < path.parts(); ++i) {
    const StraightLimits& straight = path.straight[i];
    const double speed = std::min(straight.speed, std::sqrt(2.0 * straight.acceleration * length *
                                                            static_cast<double>(path.parts())));
    for (Eigen::Index j = 0; j < limits.speed.size(); ++j) {
      const double share = std::abs(path.directions(j, static_cast<Eigen::Index>(i)));
      if (share == 0.0) continue;
      const double error =
          kUnit * (path.points.row(j).lpNorm<Eigen::Infinity>() + share * speed * duration) /
          limits.slack;
      step = std::max({step, kLinear * error / limits.speed[j],
                       std::sqrt(kQuadratic * error / limits.acceleration[j])});
      if (limits.ramps) step = std::max(step, std::cbrt(kCubic * error / limits.jerk[j]));
    }
  }
  return step;
}

}  // namespace swept::detail
