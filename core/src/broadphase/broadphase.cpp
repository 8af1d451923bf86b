// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/broadphase/broadphase.hpp"

#include <cmath>
#include <limits>

#include "geometry/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

/// m. Gap of two intervals; infinite if finite ones are farther apart than a double holds.
double gap(double lowerA, double upperA, double lowerB, double upperB) {
  if (lowerA > upperB) return lowerA - upperB;
  if (lowerB > upperA) return lowerB - upperA;
  return 0.0;
}

}  // namespace

/// Differences and the final rounding to double are off by half an epsilon each, the long sums and
/// the root by less. Each step is monotonic in the gaps, and so is the result: a box within another
/// is not nearer, whatever the rounding. Different doubles differ by at least the least denormal,
/// so boxes that do not overlap have a positive distance.
double boxDistance(const Aabb& a, const Aabb& b) {
  if (detail::inForeignEnvironment() || detail::inForeignPrecision()) {
    return inDefaultEnvironment([&] { return boxDistance(a, b); });
  }
  long double sum = 0.0L;
  int apart = 0;
  for (int k = 0; k < 3; ++k) {
    const long double length = gap(a.lower[k], a.upper[k], b.lower[k], b.upper[k]);
    apart |= static_cast<int>(length > 0.0L);
    sum += length * length;
  }
  const long double bound = std::sqrt(sum) * detail::kDistanceShrink -
                            static_cast<long double>(std::numeric_limits<double>::min());
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  if (apart == 0) return 0.0;
  if (!(bound > static_cast<long double>(kLeast))) return kLeast;
  return bound < kMost ? static_cast<double>(bound) : kMost;
}

}  // namespace swept
