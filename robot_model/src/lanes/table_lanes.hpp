// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lanes/joint_table.hpp"
#include "lanes/lane_scratch.hpp"

namespace swept::detail {

/// Joint tables at the joint values of a block's lanes.
class TableLanes {
 public:
  explicit TableLanes(const LaneScratch& scratch) : scratch_(scratch) {}

  /// Lanes whose joint values are in cells in which the bodies are apart.
  std::uint32_t proven(const JointTable& table) const;
  /// Of the joint values in the first and the last of these lanes.
  void boxOf(const JointTable& table, int first, int last, JointTable::Values& lower,
             JointTable::Values& upper) const;
  /// At the middle of a lane; null outside.
  const JointTable::Cell* cellOf(const JointTable& table, int lane) const;

 private:
  const LaneScratch& scratch_;
};

}  // namespace swept::detail
