// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

/// Limits of the speed along a straight line, which is measured in the Euclidean norm over all
/// variables (rad or m).
struct StraightLimits {
  double speed = 0.0;         ///< rad/s or m/s
  double acceleration = 0.0;  ///< rad/s^2 or m/s^2
  double jerk = 0.0;          ///< rad/s^3 or m/s^3; infinity: the acceleration may jump
};

/// s. The least time for a change of speed (not negative). With a limit of jerk it begins and ends
/// without acceleration, and half of the change is done after half of the time.
double changeTime(double change, const StraightLimits& limits);

/// The highest speed that a length allows to reach from `speed`, or to brake from to `speed`.
double reachableSpeed(double speed, double length, const StraightLimits& limits);

/// The same with time left for whole nanoseconds, where no time between two points is less than
/// `leastStep` (s). With a limit of jerk, a second small change of speed has to fit in; without,
/// the change has two parts.
double reachableInSteps(double speed, double length, const StraightLimits& limits,
                        double leastStep);

/// Whether a speed is one that reachableInSteps() allows, with room to spare: the change takes at
/// most a quarter of the length. False says nothing.
bool reachableWithRoom(double speed, double wanted, double length, const StraightLimits& limits,
                       double leastStep);

/// s. The least time for a change of speed whose points have `leastStep` between them.
double leastChangeTime(const StraightLimits& limits, double leastStep);

/// The fastest way along a length between two speeds: a change to the peak, cruise, another change.
struct StraightProfile {
  double peak = 0.0;    ///< rad/s or m/s, of the cruise
  double first = 0.0;   ///< s
  double cruise = 0.0;  ///< s
  double last = 0.0;    ///< s

  double duration() const { return first + cruise + last; }  ///< s
};

/// `length` is positive, and each of the speeds can be reached from the other.
StraightProfile fastestProfile(double from, double to, double length, const StraightLimits& limits);

}  // namespace swept::detail
