// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace swept::detail {

/// A factor as two halves of 26 bits, whose products with other halves are exact (Veltkamp; Dekker
/// 1971, "A floating-point technique for extending the available precision", section 5).
struct FactorHalves {
  double high;
  double low;
};

inline FactorHalves halvesOf(double x) {
  constexpr double kSplit = 0x1p27 + 1.0;
  const double scaled = kSplit * x;
  const double high = scaled - (scaled - x);
  return {high, x - high};
}

/// x * y - product, where `product` is x * y as rounded, without a fused operation (Dekker 1971,
/// section 5). Exact if factors are below 2^996 and the error is a double, as it is where
/// abs(product) is 0 or at least 2^-969. It is not finite where a factor is larger.
inline double dekkerProductError(double x, double y, double product) {
  const FactorHalves a = halvesOf(x), b = halvesOf(y);
  return ((a.high * b.high - product) + a.high * b.low + a.low * b.high) + a.low * b.low;
}

/// The same by the quickest operation that rounds once.
inline double productError(double x, double y, double product) {
#if defined(__MINGW32__) && !defined(__FMA__)
  // This library's fma is a product and a sum in long double, which round twice.
  return dekkerProductError(x, y, product);
#else
  return std::fma(x, y, -product);
#endif
}

}  // namespace swept::detail
