// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
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

/// The whole number from 1 to `most` that all of the text is; none otherwise.
inline std::optional<std::size_t> countOf(const std::string& text, std::size_t most) {
  const std::optional<double> value = positiveNumber(text);
  if (!value || *value != std::floor(*value) || *value > static_cast<double>(most))
    return std::nullopt;
  return static_cast<std::size_t>(*value);
}

}  // namespace swept::benchmark
