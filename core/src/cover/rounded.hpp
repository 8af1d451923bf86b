// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

namespace swept::detail {

/// The least float that is not below the value.
inline float roundedUp(double value) {
  const auto rounded = static_cast<float>(value);
  if (static_cast<double>(rounded) >= value) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

/// The nearest float. GCC 12 takes `static_cast<double>(static_cast<float>(x))` for x where it
/// makes vectors of neighbouring statements (-ftree-slp-vectorize); a volatile number it leaves.
inline double inSinglePrecision(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

/// The greatest float that is not above the value.
inline float roundedDown(double value) {
  return -roundedUp(-value);
}

}  // namespace swept::detail
