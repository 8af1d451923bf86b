// SPDX-License-Identifier: BSD-3-Clause
// Writes the results of joint tables about two links into a block. Included once per instruction
// set.
#if defined(SWEPT_SIMD_SELF_TABLES) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_SELF_TABLES
#undef SWEPT_SIMD_SELF_TABLES
#else
#define SWEPT_SIMD_SELF_TABLES
#endif

#include <bit>
#include <cstdint>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/placed_ball.hpp"
#include "simd/kernels/self_contacts.hpp"
#include "simd/kernels/table_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

/// Joint tables of two links.
class SelfTables {
 public:
  SelfTables(const SimdModel& model, SimdScratch& scratch)
      : model_(model), block_(scratch.block), tables_(model, scratch) {}

  /// Lanes in which the bodies are apart.
  Lanes proven(const PairSeparationTable& table) const { return tables_.proven(table); }

  /// Tests the places where the table suggests a contact. True: the walk is over.
  bool meets(const PairSeparationTable& table, const LinkStates& states, SelfContacts& contacts,
             Lanes lanes) const {
    if (!block_.stopAtContact) return false;
    std::int32_t last = -1;
    for (; lanes != 0; lanes &= lanes - 1) {
      const PairSeparationTable::Cell* cell = tables_.cellOf(table, std::countr_zero(lanes));
      if (cell == nullptr || cell->meeting < 0 || cell->meeting == last) continue;
      last = cell->meeting;
      const PairSeparationTable::Meeting& meeting = table.meetings[static_cast<std::size_t>(last)];
      const std::int32_t pair = pairOf(table.pairs[static_cast<std::size_t>(meeting.pair)]);
      if (pair < 0) continue;
      if (contacts.touches(static_cast<std::uint32_t>(pair), meeting.a.inside,
                           place(meeting.a, *states.a), meeting.b.inside,
                           place(meeting.b, *states.b), lanes))
        return true;
    }
    return false;
  }

  /// Leaves open what the table leaves open; returns the lanes that it does not cover.
  Lanes markUnresolvedOf(const PairSeparationTable& table, Lanes lanes) const {
    // A bit that stands for many pairs would open them all.
    if (table.pairs.size() > PairSeparationTable::kPairBits) return lanes;
    Lanes outside = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      PairSeparationTable::Values lower;
      PairSeparationTable::Values upper;
      tables_.boxOf(table, lane, lane + 1, lower, upper);
      const PairSeparationTable::Cell* cell = tables_.cellOf(table, lane);
      if (cell == nullptr) {
        outside |= 1U << lane;
        continue;
      }
      const std::uint8_t bits = table.openPairs(lower, upper);
      for (std::size_t k = 0; k < table.pairs.size(); ++k) {
        const std::int32_t pair = pairOf(table.pairs[k]);
        if ((bits >> k & 1U) == 0 || pair < 0) continue;
        // A contact seen in the cell is likely here, and deeper the farther it is from where the
        // contact ends.
        const bool likely = cell->touching && (cell->openPairs >> k & 1U) != 0;
        markUnresolved(block_, static_cast<std::uint32_t>(pair), 1U << lane, true,
                       set(likely ? kLikelyDepth : 0.0F));
      }
    }
    return outside;
  }

 private:
  /// m. A guess for a contact in a cell of a table.
  static constexpr float kLikelyDepth = 0.01F;

  /// -1: not checked. The table may be older than the rule that excludes the pair.
  std::int32_t pairOf(const PairSeparationTable::Geometries& pair) const {
    return model_.pairOfGeometries[pair.a * model_.geometryBody.size() + pair.b];
  }

  const SimdModel& model_;
  SimdBlock& block_;
  const TableLanes tables_;
};

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
