// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include "geometry/single_precision.hpp"

namespace swept::detail {

/// The least float that is not below the value.
inline float roundedUp(double value) {
  const auto rounded = static_cast<float>(inSinglePrecision(value));
  if (static_cast<double>(rounded) >= value) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

/// The greatest float that is not above the value.
inline float roundedDown(double value) {
  return -roundedUp(-value);
}

}  // namespace swept::detail
