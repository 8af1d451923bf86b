// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trajectory/corner_speeds.hpp"
#include "trajectory/way_point_path.hpp"

namespace swept::detail {

/// Times are whole nanoseconds, as messages of ROS carry them: the curve of a message is that of
/// the trajectory.
using Nanoseconds = std::int64_t;

/// s, the nearest number.
constexpr double seconds(Nanoseconds time) {
  return static_cast<double>(time) / 1e9;
}

/// Throws std::invalid_argument for a time (s) that no message carries.
Nanoseconds wholeNanoseconds(double time);

/// A change of speed: the acceleration rises for `ramp`, stays for `steady` and falls for `ramp`.
struct WholeChange {
  Nanoseconds ramp = 0;  ///< 0: the acceleration jumps
  Nanoseconds steady = 0;

  Nanoseconds duration() const { return 2 * ramp + steady; }
};

/// The times of a straight part. Its peak speed is the one that makes its length.
struct WholeProfile {
  WholeChange first;
  Nanoseconds cruise = 0;
  WholeChange last;

  Nanoseconds duration() const { return first.duration() + cruise + last.duration(); }
};

/// The times of a path.
struct WholeTimes {
  std::vector<Nanoseconds> blends;      ///< of each corner; 0: the robot stops
  std::vector<WholeProfile> straights;  ///< of each straight part
};

/// The times of a path with these blends, whole and no shorter than `leastStep` between two points.
/// Limits are kept, to a share of VariableLimits::slack. Blends last longer than at the rates of
/// `speeds` where that is needed.
WholeTimes wholeTimes(const WayPointPath& path, const CornerSpeeds& speeds, Nanoseconds leastStep);

}  // namespace swept::detail
