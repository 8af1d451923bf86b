// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

/// The nearest number that single precision holds. GCC 12 takes
/// `static_cast<double>(static_cast<float>(x))` for x where it makes vectors of neighbouring
/// statements (-ftree-slp-vectorize); a volatile number it leaves.
inline double inSinglePrecision(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace swept::detail
