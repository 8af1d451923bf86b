// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "lanes/joint_table.hpp"

namespace swept::detail {

/// Parts of an open cell that are not proven for one pair.
struct PartMask {
  std::int32_t cell = 0;  ///< index into JointTable::cells
  std::int32_t pair = 0;  ///< of JointTable::pairs, with a bit of its own
  std::uint64_t open = ~std::uint64_t{0};
};

/// Joins those of all pairs in the table. A cell has parts where all its open pairs have masks.
inline void setParts(const std::vector<PartMask>& masks, JointTable& table) {
  std::vector<std::uint8_t> known(table.cells.size(), 0);
  for (const PartMask& mask : masks) {
    JointTable::Cell& cell = table.cells[static_cast<std::size_t>(mask.cell)];
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

}  // namespace swept::detail
