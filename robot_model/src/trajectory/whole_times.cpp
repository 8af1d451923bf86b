// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/whole_times.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace swept::detail {

namespace {

Nanoseconds even(Nanoseconds time) {
  return time + time % 2;
}

StraightLimits scaledLimits(const StraightLimits& limits, double factor) {
  return {factor * limits.speed, factor * limits.acceleration, factor * limits.jerk};
}

/// Finds the times of one straight part between two speeds.
class ProfileFit {
 public:
  ProfileFit(double from, double to, double length, const StraightLimits& limits, double slack,
             Nanoseconds leastStep)
      : from_(from),
        to_(to),
        length_(length),
        limits_(scaledLimits(limits, 1.0 + 0.5 * slack)),
        wider_(scaledLimits(limits, 1.0 + slack)),
        leastStep_(leastStep) {}

  /// Both changes are always there: the peak speed between them makes up for rounded times. The
  /// peak is the highest one that leaves enough time for both, or, if even the higher one of the
  /// two speeds leaves too little, between them. No value if nothing fits.
  std::optional<WholeProfile> find() const {
    const double high = std::max(from_, to_);
    if (restOf(high) < 0.0) return inNanoseconds(0.5 * (from_ + to_));
    const double most = length_ / leastChangeTime(limits_, seconds(leastStep_));
    double low = high;
    double peak = std::min(fastestProfile(from_, to_, length_, limits_).peak, most);
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings && restOf(peak) < 0.0; ++i) {
      const double middle = 0.5 * (low + peak);
      (restOf(middle) < 0.0 ? peak : low) = middle;
    }
    return inNanoseconds(restOf(peak) < 0.0 ? low : peak);
  }

 private:
  bool ramps() const { return std::isfinite(limits_.jerk); }

  /// s, of a change to or from the peak.
  double timeOf(double speed, double peak) const {
    const double change = std::abs(peak - speed);
    const double step = seconds(leastStep_);
    const double steady = change / limits_.acceleration;
    if (!ramps()) return std::max(step, steady);
    // With the largest acceleration between the ramps, if it lasts for a step, or without.
    const double ramp = std::max(step, limits_.acceleration / limits_.jerk);
    const double withoutSteady = 2.0 * std::max({step, std::sqrt(change / limits_.jerk), steady});
    if (steady - ramp < step) return withoutSteady;
    return std::min(withoutSteady, steady + ramp);
  }

  /// The length that both changes leave.
  double restOf(double peak) const {
    return length_ - 0.5 * (from_ + peak) * timeOf(from_, peak) -
           0.5 * (to_ + peak) * timeOf(to_, peak);
  }

  std::optional<WholeProfile> inNanoseconds(double peak) const {
    double first = timeOf(from_, peak);
    double last = timeOf(to_, peak);
    double cruise = std::max(0.0, restOf(peak) / peak);
    if (cruise < seconds(leastStep_)) {
      // The longer change takes it.
      const bool isFirst = first > last;
      (isFirst ? first : last) += 2.0 * cruise * peak / ((isFirst ? from_ : to_) + peak);
      cruise = 0.0;
    }
    return fitted(changeTimeOf(first), wholeNanoseconds(cruise), changeTimeOf(last));
  }

  Nanoseconds changeTimeOf(double time) const {
    return ramps() ? even(wholeNanoseconds(time)) : wholeNanoseconds(time);
  }

  std::optional<WholeProfile> fitted(Nanoseconds first, Nanoseconds cruise,
                                     Nanoseconds last) const {
    const double peak = (length_ - 0.5 * (from_ * seconds(first) + to_ * seconds(last))) /
                        (0.5 * seconds(first) + seconds(cruise) + 0.5 * seconds(last));
    if (!(peak >= 0.0 && peak <= wider_.speed)) return std::nullopt;
    const auto up = changeIn(first, std::abs(peak - from_));
    const auto down = changeIn(last, std::abs(peak - to_));
    if (!up || !down) return std::nullopt;
    return WholeProfile{*up, cruise, *down};
  }

  /// A change of speed in a time, if the limits allow it.
  std::optional<WholeChange> changeIn(Nanoseconds time, double change) const {
    const double duration = seconds(time);
    if (!ramps()) {
      if (change > wider_.acceleration * duration) return std::nullopt;
      return WholeChange{0, time};
    }
    // The acceleration is change / (duration - ramp), the jerk that over the ramp.
    const double square = duration * duration - 4.0 * change / wider_.jerk;
    if (square < 0.0) return std::nullopt;
    Nanoseconds ramp = std::max(leastStep_, wholeNanoseconds(0.5 * (duration - std::sqrt(square))));
    if (time - 2 * ramp < leastStep_) ramp = time / 2;
    const double rest = duration - seconds(ramp);
    if (change > wider_.acceleration * rest || change > wider_.jerk * rest * seconds(ramp))
      return std::nullopt;
    return WholeChange{ramp, time - 2 * ramp};
  }

  double from_, to_, length_;
  StraightLimits limits_;  ///< for the choice of times
  StraightLimits wider_;   ///< for times that are rounded
  Nanoseconds leastStep_;
};

/// Lengthens blends until all straight parts have times. A straight part that has none gets a
/// smaller limit of acceleration, so that the speeds at its ends differ less than they might.
class TimeRounding {
 public:
  TimeRounding(const WayPointPath& path, const CornerSpeeds& speeds, Nanoseconds leastStep)
      : path_(path), speeds_(speeds), leastStep_(leastStep), reserves_(path.parts(), 0.0) {
    times_.blends.assign(path.parts() + 1, 0);
    times_.straights.resize(path.parts());
    for (std::size_t corner = 1; corner < path.parts(); ++corner)
      if (!speeds.blend(corner).stops())
        times_.blends[corner] = std::max(leastStep, wholeNanoseconds(1.0 / speeds.rate(corner)));
  }

  WholeTimes run() {
    do settle();
    while (!fitAll());
    return std::move(times_);
  }

 private:
  double speedAt(std::size_t corner, double length) const {
    const Nanoseconds time = times_.blends[corner];
    return time == 0 ? 0.0 : 2.0 * length / seconds(time);
  }
  double speedOut(std::size_t part) const { return speedAt(part, speeds_.blend(part).after); }
  double speedIn(std::size_t part) const {
    return speedAt(part + 1, speeds_.blend(part + 1).before);
  }

  /// The two passes of CornerSpeeds, until no time changes any more. What is rounded up in the
  /// second may ask for more in the first; after some rounds, longer steps end that.
  void settle() {
    constexpr int kWithoutHaste = 8;
    double haste = 1.0;
    for (int round = 0; pass(haste); ++round)
      if (round >= kWithoutHaste) haste = 1.0 + 4.0 * std::max(haste - 1.0, path_.variables.slack);
  }

  bool pass(double haste) {
    bool changed = false;
    const auto reachable = [&](std::size_t part, double speed) {
      StraightLimits limits = scaledLimits(path_.straight[part], 1.0 - reserves_[part]);
      limits.speed = path_.straight[part].speed;
      return reachableInSteps(speed, speeds_.straightLength(part), limits, seconds(leastStep_));
    };
    for (std::size_t i = path_.parts() - 1; i >= 1; --i)
      changed |= slowDown(i, speeds_.blend(i).after, reachable(i, speedIn(i)), haste);
    for (std::size_t i = 1; i < path_.parts(); ++i)
      changed |= slowDown(i, speeds_.blend(i).before, reachable(i - 1, speedOut(i - 1)), haste);
    return changed;
  }

  bool slowDown(std::size_t corner, double length, double speed, double haste) {
    if (!(speedAt(corner, length) > speed)) return false;
    times_.blends[corner] =
        std::max(times_.blends[corner] + 1, wholeNanoseconds(haste * 2.0 * length / speed));
    return true;
  }

  bool fitAll() {
    bool all = true;
    for (std::size_t part = 0; part < path_.parts(); ++part) {
      const ProfileFit fit(speedOut(part), speedIn(part), speeds_.straightLength(part),
                           path_.straight[part], path_.variables.slack, leastStep_);
      if (const auto profile = fit.find()) {
        times_.straights[part] = *profile;
      } else {
        all = false;
        giveRoom(part);
      }
    }
    return all;
  }

  void giveRoom(std::size_t part) {
    constexpr double kMost = 0.5;
    constexpr double kLonger = 1.1;
    if (reserves_[part] == kMost)
      for (const std::size_t corner : {part, part + 1})
        if (Nanoseconds& time = times_.blends[corner]; time > 0)
          time = wholeNanoseconds(kLonger * seconds(time));
    reserves_[part] = std::min(kMost, 4.0 * std::max(reserves_[part], path_.variables.slack));
  }

  const WayPointPath& path_;
  const CornerSpeeds& speeds_;
  Nanoseconds leastStep_;
  std::vector<double> reserves_;  ///< of each straight part, share of acceleration and jerk
  WholeTimes times_;
};

}  // namespace

Nanoseconds wholeNanoseconds(double time) {
  constexpr double kMost = 2147483648.0;  // s, in 31 bits
  if (!(time < kMost))
    throw std::invalid_argument(
        "timeParameterize: the trajectory takes 2^31 s or more, which no message carries");
  return static_cast<Nanoseconds>(std::ceil(time * 1e9));
}

WholeTimes wholeTimes(const WayPointPath& path, const CornerSpeeds& speeds, Nanoseconds leastStep) {
  return TimeRounding(path, speeds, leastStep).run();
}

}  // namespace swept::detail
