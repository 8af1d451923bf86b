// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/table_lanes.hpp"

#include <algorithm>

namespace swept::detail {

/// Without a tube, motions ask for these boxes all the time.
template <bool kInTube>
void TableLanes::takeBox(const PairSeparationTable& table, int first, int last,
                         PairSeparationTable::Values& lower,
                         PairSeparationTable::Values& upper) const {
  const SimdBlock& block = scratch_.block;
  const bool moving = block.mode == SimdMode::Motion;
  lower.fill(0.0F);
  upper.fill(0.0F);
  for (int k = 0; k < table.joints; ++k) {
    const int body = table.axes[k].body;
    const Row& angle = block.angle[body];
    const float spin = moving ? scratch_.motion[body].spin : 0.0F;
    lower[k] = std::min(angle.lane[first] - block.half.lane[first] * spin,
                        angle.lane[last - 1] - block.half.lane[last - 1] * spin);
    upper[k] = std::max(angle.lane[first] + block.half.lane[first] * spin,
                        angle.lane[last - 1] + block.half.lane[last - 1] * spin);
    if constexpr (kInTube) {
      lower[k] -= model_.tubeTurn[body];
      upper[k] += model_.tubeTurn[body];
    }
  }
}

template <bool kInTube>
std::uint32_t TableLanes::lanesProven(const PairSeparationTable& table) const {
  const SimdBlock& block = scratch_.block;
  PairSeparationTable::Values lower;
  PairSeparationTable::Values upper;
  takeBox<kInTube>(table, 0, kLanes, lower, upper);
  // A motion's first lanes are in order of time, and angles of constant rate do not turn back.
  const bool inOrder = block.mode != SimdMode::States && !scratch_.curved;
  if (inOrder && table.free(lower, upper)) return kAllLanes;
  std::uint32_t lanes = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    takeBox<kInTube>(table, lane, lane + 1, lower, upper);
    if (table.free(lower, upper)) lanes |= 1U << lane;
  }
  return lanes;
}

std::uint32_t TableLanes::proven(const PairSeparationTable& table) const {
  return model_.tubeTurn.empty() ? lanesProven<false>(table) : lanesProven<true>(table);
}

void TableLanes::boxOf(const PairSeparationTable& table, int first, int last,
                       PairSeparationTable::Values& lower,
                       PairSeparationTable::Values& upper) const {
  model_.tubeTurn.empty() ? takeBox<false>(table, first, last, lower, upper)
                          : takeBox<true>(table, first, last, lower, upper);
}

const PairSeparationTable::Cell* TableLanes::cellOf(const PairSeparationTable& table,
                                                    int lane) const {
  PairSeparationTable::Values values{};
  for (int k = 0; k < table.joints; ++k)
    values[k] = scratch_.block.angle[table.axes[k].body].lane[lane];
  return table.cellAt(values);
}

}  // namespace swept::detail
