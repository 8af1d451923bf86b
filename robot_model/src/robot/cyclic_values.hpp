// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace swept::detail {

/// The difference by which a cyclic value moves: the given one if it is at most half a turn, else
/// the shorter one.
inline double cyclicDifference(double from, double to) {
  const double difference = to - from;
  return std::abs(difference) <= std::numbers::pi
             ? difference
             : std::remainder(difference, 2.0 * std::numbers::pi);
}

}  // namespace swept::detail
