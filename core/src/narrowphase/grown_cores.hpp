// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "narrowphase/core_gap.hpp"
#include "narrowphase/gjk.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

/// Grown by their balls, the bodies are apart by the cores' distance minus both radii. Fills the
/// caller's result in place: copying results costs as much as the closed forms of spheres.
template <typename Result>
[[gnu::always_inline]] inline void grow(const CoreGap& gap, const Convex& a, const Convex& b,
                                        Result& result) {
  result.iterations = 1;
  const double apart = gap.distance - a.radius - b.radius;
  if (apart > 0.0) {
    result.upper = apart;
    result.pointA = moved(gap.pointA, a.radius, gap.normal);
    result.pointB = moved(gap.pointB, -b.radius, gap.normal);
    result.lower = std::max(0.0, apart - gap.rounding);
    result.normal = gap.normal;
    return;
  }
  result.upper = 0.0;
  if (gap.distance > 0.0) {
    // Any point at s from A's core, distance - radiusB <= s <= radiusA, belongs to both.
    const double s = std::clamp(0.5 * (a.radius + gap.distance - b.radius), 0.0, gap.distance);
    result.pointA = moved(gap.pointA, s, gap.normal);
  } else {
    result.pointA = gap.common;
  }
  result.pointB = result.pointA;
  result.normal = gap.normal;
}

inline GjkResult grown(const CoreGap& gap, const Convex& a, const Convex& b, const Goal& goal) {
  GjkResult result;
  grow(gap, a, b, result);
  result.satisfied = result.lower > 0.0 && result.lower > goal.along(gap.normal);
  return result;
}

[[gnu::always_inline]] inline void growSigned(const CoreGap& gap, const Convex& a, const Convex& b,
                                              SignedDistanceResult& result) {
  const double apart = gap.distance - a.radius - b.radius;
  result.iterations = 1;
  result.lower = apart - gap.rounding;
  result.upper = apart + gap.rounding;
  result.normal = gap.normal;
  result.pointA = moved(gap.pointA, a.radius, gap.normal);
  result.pointB = moved(gap.pointB, -b.radius, gap.normal);
}

inline SignedDistanceResult grownSigned(const CoreGap& gap, const Convex& a, const Convex& b) {
  SignedDistanceResult result;
  growSigned(gap, a, b, result);
  return result;
}

}  // namespace swept::detail
