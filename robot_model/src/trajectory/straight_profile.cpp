// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/straight_profile.hpp"

#include <algorithm>
#include <cmath>

namespace swept::detail {

namespace {

/// A step of Newton's method that is no larger than this share of the value is the last: errors
/// fall with their squares, so it leaves none but roundings.
constexpr double kLastStep = 1e-9;

/// The way of a change of speed.
double changeLength(double from, double to, const StraightLimits& limits) {
  return 0.5 * (from + to) * changeTime(std::abs(to - from), limits);
}

/// The positive root of x^3 + p x = q with p >= 0 and q >= 0. Newton's method descends to it from
/// above, since the function is convex there.
double cubicRoot(double p, double q) {
  constexpr int kSteps = 60;
  double x = p * p * p > q * q ? q / p : std::cbrt(q);  // both are above it
  for (int i = 0; i < kSteps; ++i) {
    const double next = (2.0 * x * x * x + q) / (3.0 * x * x + p);
    if (!(next < x)) break;
    const bool last = x - next <= kLastStep * x;
    x = next;
    if (last) break;
  }
  return x;
}

/// With a limit of jerk. The change d solves (speed + d / 2) changeTime(d) = length.
double reachableByRamps(double speed, double length, const StraightLimits& limits) {
  const double ramp = limits.acceleration / limits.jerk;
  const double full = limits.acceleration * ramp;
  if (length < (2.0 * speed + full) * ramp) {
    const double root = cubicRoot(2.0 * speed, length * std::sqrt(limits.jerk));
    return speed + root * root;
  }
  // The acceleration reaches its limit: d^2 + b d + c = 0.
  const double b = 2.0 * speed + full;
  const double c = 2.0 * (speed * full - limits.acceleration * length);
  return speed - 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * c)));
}

/// The way of a change of speed by `change` to the peak, and its derivative by x, where the peak is
/// a square of x above something.
struct RampWay {
  double length, slope;

  RampWay(double all, double rate) : length(all), slope(rate) {}
  RampWay(double from, double peak, double x, const StraightLimits& limits) {
    const double change = peak - from;
    const double ramp = limits.acceleration / limits.jerk;
    const bool full = change >= limits.acceleration * ramp;
    const double root = full ? 0.0 : std::sqrt(change / limits.jerk);
    const double time = full ? change / limits.acceleration + ramp : 2.0 * root;
    // d time / d peak times x, which is finite where the change is none: there x is its root.
    const double rate = full           ? x / limits.acceleration
                        : change > 0.0 ? x / (limits.jerk * root)
                                       : 1.0 / std::sqrt(limits.jerk);
    length = 0.5 * (from + peak) * time;
    slope = x * time + (from + peak) * rate;
  }
};

/// With a limit of jerk: the peak above both speeds at which nothing is left to cruise. By x, the
/// root of how far the peak is above the larger speed, both ways are convex and increase; Newton's
/// method descends to the root from above. The first x is above it, since a change takes at least
/// twice the root of change / jerk.
double peakByRamps(double from, double to, double length, const StraightLimits& limits) {
  constexpr int kSteps = 60;
  const double most = std::max(from, to);
  const double scaled = length * std::sqrt(limits.jerk);
  const double least = std::min(from, to);
  const auto excess = [&](double x) {
    const double peak = most + x * x;
    const RampWay up(from, peak, x, limits);
    const RampWay down(to, peak, x, limits);
    return RampWay{up.length + down.length - length, up.slope + down.slope};
  };
  if (changeLength(least, most, limits) >= length) return most;
  const double fastest = std::sqrt(std::max(0.0, limits.speed - most));
  double x = std::min(fastest, std::cbrt(0.5 * scaled));
  const double speeds = 3.0 * most + least;
  if (speeds * x > scaled) x = scaled / speeds;
  // At a first x that is not given by the limit of speed, both ways are at least as long as the
  // length. Well above it they are longer by more than they round: no such limit has to be tried.
  constexpr double kClear = 0.99;
  if (x >= kClear * fastest && !(excess(fastest).length > 0.0)) return limits.speed;
  for (int i = 0; i < kSteps; ++i) {
    const RampWay at = excess(x);
    const double next = x - at.length / at.slope;
    if (!(next < x)) break;
    const bool last = x - next <= kLastStep * x;
    x = next;
    if (last) break;
  }
  return most + x * x;
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

// reachableInSteps() leaves at least half of the length for the change. Twice what a change needs
// allows a change that is larger by a quarter or more, which no rounding hides.
bool reachableWithRoom(double speed, double wanted, double length, const StraightLimits& limits,
                       double leastStep) {
  constexpr double kLessThanHalf = 0.49;
  if (wanted > limits.speed) return false;
  if (wanted * leastChangeTime(limits, leastStep) > kLessThanHalf * length) return false;
  return wanted <= speed || changeLength(speed, wanted, limits) <= 0.25 * length;
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
