// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace swept::benchmark {

/// The finite number above zero that all of the text is; none otherwise.
inline std::optional<double> positiveNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value > 0.0) || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace swept::benchmark
