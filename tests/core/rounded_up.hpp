// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace swept::test {

/// One digit of 1, 2, 5, rounded up from a little more: another instruction set may order sums in
/// another way.
inline std::string roundedUp(double measured) {
  if (!(measured > 0.0)) return "0";
  const double x = 1.2 * measured;
  const int power = static_cast<int>(std::floor(std::log10(x)));
  for (const auto& [digit, raise] : {std::pair{"1", 0}, {"2", 0}, {"5", 0}, {"1", 1}}) {
    std::string text = digit + ("e" + std::to_string(power + raise));
    if (std::strtod(text.c_str(), nullptr) >= x) return text;
  }
  return "inf";
}

}  // namespace swept::test
