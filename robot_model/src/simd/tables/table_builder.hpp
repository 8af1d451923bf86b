// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "simd/tables/pair_proof.hpp"
#include "simd/tables/pair_separation_table.hpp"
#include "simd/tables/table_motion.hpp"

namespace swept::detail {

/// Parts of an open cell that are not proven for one pair.
struct PartMask {
  std::int32_t cell = 0;  ///< index into PairSeparationTable::cells
  std::int32_t pair = 0;  ///< of PairSeparationTable::pairs, with a bit of its own
  std::uint64_t open = ~std::uint64_t{0};
};

/// Combines those of all pairs in the table. A cell has parts if all its open pairs have masks.
inline void setParts(const std::vector<PartMask>& masks, PairSeparationTable& table) {
  std::vector<std::uint8_t> known(table.cells.size(), 0);
  for (const PartMask& mask : masks) {
    PairSeparationTable::Cell& cell = table.cells[static_cast<std::size_t>(mask.cell)];
    const auto bit = static_cast<std::uint8_t>(1U << mask.pair);
    known[static_cast<std::size_t>(mask.cell)] |= bit;
    if (mask.open == 0) cell.openPairs &= static_cast<std::uint8_t>(~bit);
    if (cell.parts < 0) {
      cell.parts = static_cast<std::int32_t>(table.openParts.size());
      table.openParts.push_back(0);
    }
    table.openParts[static_cast<std::size_t>(cell.parts)] |= mask.open;
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    if ((table.cells[i].openPairs & ~known[i]) != 0) table.cells[i].parts = -1;
}

/// Proves the cells of one table: coarse regions first, then their quarters if that failed, so that
/// a table whose work ran out is a coarser one; then parts of the open cells.
class TableBuilder {
 public:
  /// `pairs` are those of the bodies' geometry.
  TableBuilder(const PairModel& model, const SimdModel& simd, const SimdBodyPair& bodies,
               const TableMotion& motion, PairSeparationTable::Pairs pairs);
  TableBuilder(const TableBuilder&) = delete;
  TableBuilder& operator=(const TableBuilder&) = delete;

  /// Continues until done, or until the work is spent (see PairProof::work). It may exceed the work
  /// by that of one region.
  void prove(int& work);
  /// Whether there is anything left to prove.
  bool proven() const { return probed_ && at_ == level_.size() && next_.empty(); }
  /// The same for parts of cells, once the cells are proven.
  void refine(int& work);
  bool refined() const { return partAt_ == partLevel_.size() && nextParts_.empty(); }
  /// Null if the bodies are not apart in enough of their range.
  std::shared_ptr<const PairSeparationTable> finish();

 private:
  using Parts = TableMotion::Parts;
  using Place = TableMotion::Place;
  using Levers = TableMotion::Levers;
  /// Cells, for one pair.
  struct Region {
    std::array<int, 2> begin{0, 0};
    std::array<int, 2> end{1, 1};
    std::int32_t pair = 0;
  };
  /// Parts of an open cell, for one pair.
  struct PartRegion {
    Parts parts;
    Levers levers;  ///< of points that are not proven apart by balls
    double gap;     ///< m, in the middle of a cell; 0: not known yet
    std::int32_t pair;
    std::int32_t mask;  ///< of masks_
  };
  bool isMostlyOpen();
  void choose(std::int32_t pair);
  void proveRegion(const Region& region);
  void proveParts(PartRegion& region);
  void startParts(const Region& region, double gap);
  bool clearParts(const PartRegion& region);
  void splitRegion(const Region& region);
  void splitParts(const PartRegion& region);
  Parts partsOf(const Region& region) const;
  bool haveMeetings(const Region& region) const;
  void markUnresolved(const Region& region, bool touching, bool coarse);
  void repeatTurns();
  void sum();

  TableMotion motion_;
  PairProof proof_;  ///< refers to motion_
  PairSeparationTable table_;
  std::vector<Region> level_, next_;
  std::size_t at_ = 0;
  std::vector<PartRegion> partLevel_, nextParts_;
  std::size_t partAt_ = 0;
  std::vector<PartMask> masks_;
  bool worthwhile_ = false;
  bool probed_ = false;
  std::int32_t pair_ = -1;
  std::uint8_t bit_ = 0;  ///< of the pair
};

}  // namespace swept::detail
