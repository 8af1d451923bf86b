// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/pair_separation_table.hpp"

#include <algorithm>
#include <utility>

namespace swept::detail {

namespace {

constexpr std::uint8_t kAllPairs = 0xFF;
/// Number of open cells that are tested one by one.
constexpr int kMostCells = 256;
constexpr int kFewCells = 16;

int cellOf(int part) {
  return part / PairSeparationTable::kParts;
}
/// Without end, likewise.
int cellsEnd(int end) {
  return (end + PairSeparationTable::kParts - 1) / PairSeparationTable::kParts;
}

}  // namespace

PairSeparationTable PairSeparationTable::allApart(Pairs pairs) {
  PairSeparationTable table;
  table.open.assign(4, 0);
  table.cells.resize(1);
  table.pairs = std::move(pairs);
  return table;
}

bool PairSeparationTable::find(const Values& lower, const Values& upper, Range& range) const {
  for (int k = 0; k < joints; ++k) {
    const Axis& axis = axes[k];
    if (!(lower[k] >= axis.lower && upper[k] <= axis.upper && lower[k] <= upper[k])) return false;
    const auto partOf = [&axis](float value) {
      return std::min(static_cast<int>((value - axis.lower) * axis.partsPerUnit),
                      axis.cells * kParts - 1);
    };
    range.begin[k] = partOf(lower[k]);
    range.end[k] = partOf(upper[k]) + 1;
  }
  return true;
}

const PairSeparationTable::Cell* PairSeparationTable::cellAt(const Values& values) const {
  Range range;
  if (!find(values, values, range)) return nullptr;
  const int at = cellOf(range.begin[0]) * axes[1].cells + cellOf(range.begin[1]);
  const Cell& cell = cells[at];
  return cell.coarse ? nullptr : &cell;
}

bool PairSeparationTable::allProven(const Range& parts) const {
  const int width = axes[1].cells + 1;
  const auto at = [&](int i, int j) { return open[i * width + j]; };
  const int row = cellOf(parts.begin[0]);
  const int column = cellOf(parts.begin[1]);
  const int rows = cellsEnd(parts.end[0]);
  const int columns = cellsEnd(parts.end[1]);
  return at(rows, columns) + at(row, column) == at(rows, column) + at(row, columns);
}

std::uint8_t PairSeparationTable::openAmong(const Range& parts, int i, int j) const {
  const Cell& cell = cells[i * axes[1].cells + j];
  if (cell.openPairs == 0 || cell.parts < 0) return cell.openPairs;
  const int rowBegin = std::max(parts.begin[0] - i * kParts, 0);
  const int rowEnd = std::min(parts.end[0] - i * kParts, kParts);
  const int columnBegin = std::max(parts.begin[1] - j * kParts, 0);
  const int columnEnd = std::min(parts.end[1] - j * kParts, kParts);
  // 1 to kParts bits each, so that no shift is as wide as its type.
  constexpr std::uint64_t kColumns = (1U << kParts) - 1;
  constexpr std::uint64_t kEachRow = 0x0101010101010101U;
  const std::uint64_t columns = (kColumns >> (kParts - (columnEnd - columnBegin))) << columnBegin;
  const std::uint64_t rows = (~std::uint64_t{0} >> (kParts * (kParts - (rowEnd - rowBegin))))
                             << (kParts * rowBegin);
  const std::uint64_t met = (columns * kEachRow) & rows;
  return (openParts[static_cast<std::size_t>(cell.parts)] & met) != 0 ? cell.openPairs : 0;
}

bool PairSeparationTable::free(const Values& lower, const Values& upper) const {
  Range range;
  if (!find(lower, upper, range)) return false;
  if (allProven(range)) return true;
  const int rows = cellsEnd(range.end[0]) - cellOf(range.begin[0]);
  const int columns = cellsEnd(range.end[1]) - cellOf(range.begin[1]);
  if (openParts.empty() || rows * columns > kFewCells) return false;
  for (int i = cellOf(range.begin[0]); i < cellsEnd(range.end[0]); ++i)
    for (int j = cellOf(range.begin[1]); j < cellsEnd(range.end[1]); ++j)
      if (openAmong(range, i, j) != 0) return false;
  return true;
}

std::uint8_t PairSeparationTable::openPairs(const Values& lower, const Values& upper) const {
  Range range;
  if (!find(lower, upper, range)) return kAllPairs;
  const int rows = cellsEnd(range.end[0]) - cellOf(range.begin[0]);
  const int columns = cellsEnd(range.end[1]) - cellOf(range.begin[1]);
  if (rows * columns > kMostCells) return kAllPairs;
  std::uint8_t found = 0;
  for (int i = cellOf(range.begin[0]); i < cellsEnd(range.end[0]); ++i)
    for (int j = cellOf(range.begin[1]); j < cellsEnd(range.end[1]); ++j)
      found |= openAmong(range, i, j);
  return found;
}

}  // namespace swept::detail
