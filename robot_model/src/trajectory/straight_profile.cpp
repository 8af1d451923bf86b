// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/straight_profile.hpp"

#include <algorithm>
#include <cmath>

namespace swept::detail {

namespace {

/// The way of a change of speed.
double changeLength(double from, double to, const StraightLimits& limits) {
  return 0.5 * (from + to) * changeTime(std::abs(to - from), limits);
}

/// The positive root of x^3 + p x = q with p >= 0 and q >= 0. Newton's method descends to it from
/// above, since the function is convex there.
double cubicRoot(double p, double q) {
  constexpr int kSteps = 60;
  double x = std::cbrt(q);
  if (p * x > q) x = q / p;
  for (int i = 0; i < kSteps; ++i) {
    const double next = (2.0 * x * x * x + q) / (3.0 * x * x + p);
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

/// With a limit of jerk. The change d solves (speed + d / 2) changeTime(d) = length.
double reachableByRamps(double speed, double length, const StraightLimits& limits) {
  const double full = limits.acceleration * limits.acceleration / limits.jerk;
  const double root = cubicRoot(2.0 * speed, length * std::sqrt(limits.jerk));
  if (root * root <= full) return speed + root * root;
  // Beyond `full` the acceleration reaches its limit: d^2 + b d + c = 0.
  const double b = 2.0 * speed + full;
  const double c = 2.0 * (speed * full - limits.acceleration * length);
  return speed - 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * c)));
}

/// With a limit of jerk: the peak above both speeds at which nothing is left to cruise, by regula
/// falsi (M. Dowell and P. Jarratt, A modified regula falsi method, 1971).
double peakByRamps(double from, double to, double length, const StraightLimits& limits) {
  constexpr int kSteps = 100;
  constexpr double kNothing = 1e-13;
  const auto excess = [&](double peak) {
    return changeLength(from, peak, limits) + changeLength(to, peak, limits) - length;
  };
  double low = std::max(from, to);
  double high = limits.speed;
  double atLow = excess(low);
  double atHigh = excess(high);
  if (!(atLow < 0.0)) return low;
  if (!(atHigh > 0.0)) return high;
  for (int i = 0, side = 0; i < kSteps; ++i) {
    const double middle = std::clamp((low * atHigh - high * atLow) / (atHigh - atLow), low, high);
    const double at = excess(middle);
    if (std::abs(at) <= kNothing * length) return middle;
    if (at < 0.0) {
      low = middle;
      atLow = at;
      if (side == -1) atHigh *= 0.5;
      side = -1;
    } else {
      high = middle;
      atHigh = at;
      if (side == 1) atLow *= 0.5;
      side = 1;
    }
  }
  return low;
}

}  // namespace

double changeTime(double change, const StraightLimits& limits) {
  if (std::isinf(limits.jerk)) return change / limits.acceleration;
  const double ramp = limits.acceleration / limits.jerk;
  if (change >= limits.acceleration * ramp) return change / limits.acceleration + ramp;
  return 2.0 * std::sqrt(change / limits.jerk);
}

double reachableSpeed(double speed, double length, const StraightLimits& limits) {
  const double reached = std::isinf(limits.jerk)
                             ? std::sqrt(speed * speed + 2.0 * limits.acceleration * length)
                             : reachableByRamps(speed, length, limits);
  return std::min(reached, limits.speed);
}

double leastChangeTime(const StraightLimits& limits, double leastStep) {
  return std::isinf(limits.jerk) ? leastStep : 2.0 * leastStep;
}

double reachableInSteps(double speed, double length, const StraightLimits& limits,
                        double leastStep) {
  const double change = leastChangeTime(limits, leastStep);
  const double most = std::min(reachableSpeed(speed, length, limits), 0.5 * length / change);
  if (std::isinf(limits.jerk)) return most;
  const double rest = length - change * std::min(std::max(speed, most), 0.5 * length / change);
  return std::min(most, reachableSpeed(speed, rest, limits));
}

StraightProfile fastestProfile(double from, double to, double length,
                               const StraightLimits& limits) {
  StraightProfile profile;
  if (std::isinf(limits.jerk)) {
    const double peak = std::sqrt(limits.acceleration * length + 0.5 * (from * from + to * to));
    profile.peak = std::max({from, to, std::min(peak, limits.speed)});
  } else {
    profile.peak = peakByRamps(from, to, length, limits);
  }
  profile.first = changeTime(profile.peak - from, limits);
  profile.last = changeTime(profile.peak - to, limits);
  const double rest = length - 0.5 * (from + profile.peak) * profile.first -
                      0.5 * (to + profile.peak) * profile.last;
  profile.cruise = std::max(0.0, rest / profile.peak);
  return profile;
}

}  // namespace swept::detail
