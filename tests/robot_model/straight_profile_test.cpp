// SPDX-License-Identifier: BSD-3-Clause
// Changes of speed on a straight line, against small steps in time and a search over peaks.
#include "trajectory/straight_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace swept::detail {
namespace {

class Random {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double size(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  StraightLimits limits(bool ramps) {
    return {size(0.1, 10.0), size(0.1, 100.0),
            ramps ? size(0.1, 1000.0) : std::numeric_limits<double>::infinity()};
  }

 private:
  std::mt19937 random_{140};
};

/// The speed that is gained in a time when the acceleration rises as fast as it may, stays at its
/// limit and falls to 0 at the end, in small steps.
double gainIn(double time, const StraightLimits& limits) {
  constexpr int kSteps = 20000;
  const double step = time / kSteps;
  double gain = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    gain += step * std::min(limits.acceleration, limits.jerk * std::min(t, time - t));
  }
  return gain;
}

TEST(StraightProfile, ChangesSpeedAsFastAsAllowed) {
  Random random;
  int steady = 0;
  for (int round = 0; round < 100; ++round) {
    const StraightLimits limits = random.limits(round % 4 != 0);
    const double change = random.size(1e-3, 10.0);
    const double time = changeTime(change, limits);
    EXPECT_NEAR(gainIn(time, limits), change, 1e-3 * change);
    steady += time > 2.0 * limits.acceleration / limits.jerk;
  }
  EXPECT_GT(steady, 20);
  EXPECT_LT(steady, 90);
}

TEST(StraightProfile, ReachesWhatALengthAllows) {
  Random random;
  int limited = 0;
  for (int round = 0; round < 1000; ++round) {
    const StraightLimits limits = random.limits(round % 2 == 0);
    const double speed = round % 5 == 0 ? 0.0 : random.uniform(0.0, limits.speed);
    const double length = random.size(1e-6, 10.0);
    const double reached = reachableSpeed(speed, length, limits);
    ASSERT_GE(reached, speed);
    // The change is known to the rounding of both speeds.
    const double rounding = 4e-16 * reached;
    const double change = reached - speed;
    const auto lengthOf = [&](double gained) {
      return (speed + 0.5 * gained) * changeTime(gained, limits);
    };
    EXPECT_LE(lengthOf(std::max(0.0, change - rounding)), length * (1.0 + 1e-12));
    if (reached == limits.speed) {
      ++limited;
    } else {
      EXPECT_GE(lengthOf(change + rounding), length * (1.0 - 1e-12));
    }
    const double inSteps = reachableInSteps(speed, length, limits, 1e-5);
    EXPECT_LE(inSteps, reached);
    EXPECT_LE(inSteps * 2.0 * leastChangeTime(limits, 1e-5), length * (1.0 + 1e-12));
  }
  EXPECT_GT(limited, 200);
  EXPECT_LT(limited, 800);
}

/// What is said without a search is what the search finds, to the last digit.
TEST(StraightProfile, WhatHasRoomIsReachable) {
  Random random;
  int roomy = 0, reachable = 0, all = 0;
  for (int round = 0; round < 200000; ++round) {
    const StraightLimits limits = random.limits(round % 2 == 0);
    const double speed = round % 5 == 0 ? 0.0 : random.uniform(0.0, limits.speed);
    const double wanted =
        round % 3 == 0 ? random.uniform(0.0, 1.1 * limits.speed) : speed * random.size(0.999, 1.1);
    const double length = random.size(1e-9, 10.0);
    const double leastStep = random.size(1e-9, 1e-2);
    const bool isReachable = wanted <= reachableInSteps(speed, length, limits, leastStep);
    const bool hasRoom = reachableWithRoom(speed, wanted, length, limits, leastStep);
    EXPECT_LE(hasRoom, isReachable);
    ++all;
    reachable += isReachable ? 1 : 0;
    roomy += hasRoom ? 1 : 0;
  }
  EXPECT_LT(reachable, 0.8 * all);
  EXPECT_GT(roomy, 0.3 * all);
  EXPECT_GT(roomy, 0.6 * reachable);
}

/// The time over a length with some peak, or infinity if that needs a larger length.
double timeWith(double peak, double from, double to, double length, const StraightLimits& limits) {
  const double first = changeTime(std::abs(peak - from), limits);
  const double last = changeTime(std::abs(peak - to), limits);
  const double rest = length - 0.5 * (from + peak) * first - 0.5 * (to + peak) * last;
  return rest < 0.0 ? std::numeric_limits<double>::infinity() : first + last + rest / peak;
}

TEST(StraightProfile, IsTheFastestOfAllPeaks) {
  Random random;
  int cruises = 0;
  for (int round = 0; round < 400; ++round) {
    const StraightLimits limits = random.limits(round % 2 == 0);
    const double from = random.uniform(0.0, limits.speed);
    const double length = random.size(1e-3, 10.0);
    const double to = random.uniform(0.0, reachableSpeed(from, length, limits));
    // Braking to `to` must be possible too.
    if (reachableSpeed(to, length, limits) < from) continue;
    const StraightProfile profile = fastestProfile(from, to, length, limits);
    EXPECT_LE(profile.peak, limits.speed);
    const double used = 0.5 * (from + profile.peak) * profile.first +
                        profile.peak * profile.cruise + 0.5 * (to + profile.peak) * profile.last;
    EXPECT_NEAR(used, length, 1e-9 * length);
    const double high = std::max(from, to);
    for (int k = 0; k <= 200; ++k) {
      const double peak = high + (limits.speed - high) * k / 200.0;
      if (peak == 0.0) continue;
      EXPECT_LE(profile.duration(), timeWith(peak, from, to, length, limits) * (1.0 + 1e-9));
    }
    cruises += profile.cruise > 0.01 * profile.duration();
  }
  EXPECT_GT(cruises, 50);
  EXPECT_LT(cruises, 300);
}

}  // namespace
}  // namespace swept::detail
