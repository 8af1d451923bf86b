// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_claim.hpp"

#include <assimp/fast_atof.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// For what assimp throws at words that are no numbers to it; its own exception is not exported.
struct NotRead : std::exception {
  template <typename... Parts>
  explicit NotRead(Parts&&...) {}
};

/// Its readers of text share one function for numbers, which takes more than 19 digits for 0, and
/// the 16th behind the point and those after it for none.
double asAssimpReads(std::string_view word) {
  float value = 0.0F;
  Assimp::fast_atoreal_move<float, NotRead>(std::string(word).c_str(), value);
  return static_cast<double>(value);
}

}  // namespace

std::optional<double> MeshClaim::coordinate(std::string_view word) {
  const auto value = parseNumber(word);
  if (!value) return std::nullopt;
  try {
    loss = std::max(loss, std::abs(asAssimpReads(word) - *value));
  } catch (const NotRead&) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> MeshClaim::coordinate(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  loss = std::max(loss, std::abs(static_cast<double>(static_cast<float>(value)) - value));
  return value;
}

}  // namespace swept::detail
