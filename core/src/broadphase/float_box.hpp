// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "swept/core/bv/aabb.hpp"

namespace swept::detail {

/// Axis-aligned box in single precision around one in double: half the memory to read.
struct FloatBox {
  std::array<float, 3> lower;  ///< m
  std::array<float, 3> upper;  ///< m

  bool operator==(const FloatBox&) const = default;
  bool overlaps(const FloatBox& other) const {
    int apart = 0;
    for (int k = 0; k < 3; ++k) {
      apart |= static_cast<int>(lower[k] > other.upper[k]);
      apart |= static_cast<int>(other.lower[k] > upper[k]);
    }
    return apart == 0;
  }
  /// For boxes of either precision. Without branches: nearly always true for a box that moved a
  /// little.
  template <typename Box>
  bool contains(const Box& box) const {
    int inside = 1;
    for (int k = 0; k < 3; ++k) {
      inside &= static_cast<int>(box.lower[k] >= lower[k]);
      inside &= static_cast<int>(box.upper[k] <= upper[k]);
    }
    return inside != 0;
  }
};

/// A float that is at most x. x is not NaN.
///
/// Lemma: for |x| within the range of floats, f = fl(x) is off by at most u |f| (1 + u) plus half
/// the least denormal, u = 2^-24; the product and the difference below round by at most u of
/// theirs, and 4 u |f| exceeds the sum. The last term covers what underflows.
inline float floatBelow(double x) {
  constexpr float kMost = std::numeric_limits<float>::max();
  if (x < -static_cast<double>(kMost)) return -std::numeric_limits<float>::infinity();
  if (x > static_cast<double>(kMost)) return kMost;
  const auto f = static_cast<float>(x);
  return f - (0x1p-22F * std::abs(f) + std::numeric_limits<float>::min());
}

/// A float that is at least x. x is not NaN.
inline float floatAbove(double x) {
  return -floatBelow(-x);
}

/// A box that contains `box`, which has no NaN.
inline FloatBox floatBox(const Aabb& box) {
  FloatBox result;
  for (int k = 0; k < 3; ++k) {
    result.lower[k] = floatBelow(box.lower[k]);
    result.upper[k] = floatAbove(box.upper[k]);
  }
  return result;
}

}  // namespace swept::detail
