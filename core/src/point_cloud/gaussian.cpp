// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swept::detail {

namespace {

constexpr double kPeak = 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2;  // of the density

}  // namespace

double normalCdf(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double normalDensity(double x) {
  return kPeak * std::exp(-0.5 * x * x);
}

double tailBeyond(double x) {
  if (!(x > 0.0)) return 1.0;
  return std::min(1.0, std::erfc(x / std::numbers::sqrt2) + 2.0 * x * normalDensity(x));
}

// |x| phi(x) has its peak at 1.
double cdfCurvature(double middle, double reach) {
  const double least = std::max(0.0, std::abs(middle) - reach);
  const double most = std::abs(middle) + reach;
  const double at = std::clamp(1.0, least, most);
  return at * normalDensity(at);
}

double ballProbability(double distance, double radius, double s) {
  const double below = (radius - distance) / s;
  const double above = (radius + distance) / s;
  const double between = normalCdf(below) - normalCdf(-above);
  // (phi(below) - phi(above)) s / distance, without cancellation for small distances.
  const double exponent = 2.0 * (distance / s) * (radius / s);
  const double share = exponent > 0.0 ? -std::expm1(-exponent) / exponent : 1.0;
  const double edge = normalDensity(below) * share * 2.0 * (radius / s);
  return std::clamp(between - edge, 0.0, 1.0);
}

}  // namespace swept::detail
