// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lanes/joint_table.hpp"
#include "lanes/pair_proof.hpp"
#include "lanes/part_masks.hpp"
#include "lanes/table_motion.hpp"

namespace swept::detail {

/// Proves the cells of one table: coarse regions first, then their quarters where that did not
/// succeed, so that a table whose work ran out is a coarser one; then parts of the open cells.
class TableBuilder {
 public:
  /// `pairs` are those of the bodies' geometry.
  TableBuilder(const CheckerModel& model, const LaneModel& lanes, const LaneBodyPair& bodies,
               const TableMotion& motion, JointTable::Pairs pairs);
  TableBuilder(const TableBuilder&) = delete;
  TableBuilder& operator=(const TableBuilder&) = delete;

  /// Goes on until done, or work is spent: see PairProof::work. Goes over
  /// by what one region takes.
  void prove(int& work);
  /// Whether there is anything left to prove.
  bool proven() const { return probed_ && at_ == level_.size() && next_.empty(); }
  /// The same for parts of cells, once the cells are proven.
  void refine(int& work);
  bool refined() const { return partAt_ == partLevel_.size() && nextParts_.empty(); }
  /// Null if the bodies are not apart in enough of their range to be worth it.
  std::shared_ptr<const JointTable> finish();

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
  void leaveOpen(const Region& region, bool touching, bool coarse);
  void repeatTurns();
  void sum();

  TableMotion motion_;
  PairProof proof_;  ///< refers to motion_
  JointTable table_;
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
