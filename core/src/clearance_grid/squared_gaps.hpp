// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace swept::detail {

/// Range of the values, in cells.
inline constexpr int kFarthestGap = 20;
/// Twice a gap in cells, squared: gaps are whole or half cells, so sums of these are exact.
using SquaredGap = std::int16_t;
inline constexpr SquaredGap kUnknownGap = (2 * kFarthestGap) * (2 * kFarthestGap);
static_assert(3 * kUnknownGap <= std::numeric_limits<SquaredGap>::max());

/// The gap between the middle of a cell and the `k`-th cell from it, along one axis.
constexpr SquaredGap gapSquared(int k) {
  return k == 0 ? SquaredGap{0} : static_cast<SquaredGap>((2 * k - 1) * (2 * k - 1));
}

/// Steps that are at most the root of a squared gap, even after rounding.
class GapSteps {
 public:
  /// `side`: m, of cells or voxels; `most`: largest gap in these.
  GapSteps(double side, double most) : units_(kUnknownGap + 1) {
    step_ = static_cast<float>(side * most / 255.0);
    for (int value = 0; value <= kUnknownGap; ++value) {
      const double gap = 0.5 * std::sqrt(static_cast<double>(value)) * side * (1.0 - 1e-6);
      const double units = std::floor(gap / static_cast<double>(step_));
      units_[value] = static_cast<std::uint32_t>(std::min(units, 255.0));
    }
  }
  std::uint32_t operator()(SquaredGap value) const { return units_[value]; }
  float step() const { return step_; }

 private:
  std::vector<std::uint32_t> units_;
  float step_;
};

}  // namespace swept::detail
