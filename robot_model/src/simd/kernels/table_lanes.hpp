// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"
#include "simd/tables/pair_separation_table.hpp"

namespace swept::detail {

/// Joint tables at the joint values of a block's lanes.
class TableLanes {
 public:
  TableLanes(const SimdModel& model, const SimdScratch& scratch)
      : model_(model), scratch_(scratch) {}

  /// Lanes whose joint values are in cells in which the bodies are apart.
  std::uint32_t proven(const PairSeparationTable& table) const;
  /// Of the joint values in the first and the last of these lanes, and in the tube around them.
  void boxOf(const PairSeparationTable& table, int first, int last,
             PairSeparationTable::Values& lower, PairSeparationTable::Values& upper) const;
  /// At the middle of a lane; null outside.
  const PairSeparationTable::Cell* cellOf(const PairSeparationTable& table, int lane) const;

 private:
  template <bool kInTube>
  void takeBox(const PairSeparationTable& table, int first, int last,
               PairSeparationTable::Values& lower, PairSeparationTable::Values& upper) const;
  template <bool kInTube>
  std::uint32_t lanesProven(const PairSeparationTable& table) const;

  const SimdModel& model_;
  const SimdScratch& scratch_;
};

}  // namespace swept::detail
