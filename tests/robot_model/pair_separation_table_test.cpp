// SPDX-License-Identifier: BSD-3-Clause
// What a table says of a box of joint values, against a look at each of its parts.
#include "simd/tables/pair_separation_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "simd_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::PairSeparationTable;
using Values = PairSeparationTable::Values;
constexpr int kParts = PairSeparationTable::kParts;

/// Cells of all kinds: proven, with some parts open, open as a whole.
PairSeparationTable randomTable(Random& random, int joints) {
  PairSeparationTable table;
  table.joints = joints;
  for (int k = 0; k < joints; ++k) {
    PairSeparationTable::Axis& axis = table.axes[k];
    axis.cells = 1 + random.below(9);
    axis.lower = static_cast<float>(random.uniform(-3.0, 0.0));
    axis.partsPerUnit = static_cast<float>(random.uniform(5.0, 50.0));
    axis.upper = axis.lower + static_cast<float>(axis.cells * kParts) / axis.partsPerUnit;
  }
  const int rows = table.axes[0].cells;
  const int columns = table.axes[1].cells;
  const std::uint64_t used = joints == 1 ? 0x0101010101010101U : ~std::uint64_t{0};
  for (int cell = 0; cell < rows * columns; ++cell) {
    PairSeparationTable::Cell& made = table.cells.emplace_back();
    if (random.chance(0.6)) continue;
    made.openPairs = static_cast<std::uint8_t>(1 + random.below(255));
    if (random.chance(0.2)) continue;
    std::uint64_t parts = 0;
    const int few = 1 + random.below(4);
    while (parts == 0)
      for (int i = 0; i < few; ++i) parts |= (std::uint64_t{1} << random.below(64)) & used;
    made.parts = static_cast<std::int32_t>(table.openParts.size());
    table.openParts.push_back(parts);
  }
  const auto width = static_cast<std::size_t>(columns) + 1;
  table.open.assign((static_cast<std::size_t>(rows) + 1) * width, 0);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      table.open[(i + 1) * width + j + 1] =
          table.open[i * width + j + 1] + table.open[(i + 1) * width + j] -
          table.open[i * width + j] + (table.cells[i * columns + j].openPairs != 0 ? 1 : 0);
  return table;
}

/// Parts from `begin` on, up to but without `end`, along a joint.
struct Span {
  int begin = 0;
  int end = 1;
};

/// Ends in the first and in the last of the parts, not on what is between two of them.
Span randomSpan(Random& random, const PairSeparationTable::Axis& axis, int most, float& lower,
                float& upper) {
  const int parts = axis.cells * kParts;
  const int count = std::min(parts, 1 + random.below(most));
  const int begin = random.below(parts - count + 1);
  const auto within = [&](double part) {
    return axis.lower + static_cast<float>(part) / axis.partsPerUnit;
  };
  const double first = random.uniform(0.01, 0.99);
  const double last = random.uniform(count == 1 ? first : 0.01, 0.99);
  lower = within(begin + first);
  upper = within(begin + count - 1 + last);
  return {begin, begin + count};
}

/// The open pairs of cells that have an open part in the box.
std::uint8_t openIn(const PairSeparationTable& table, const Span& rows, const Span& columns) {
  std::uint8_t found = 0;
  for (int i = rows.begin; i < rows.end; ++i) {
    for (int j = columns.begin; j < columns.end; ++j) {
      const PairSeparationTable::Cell& cell =
          table.cells[(i / kParts) * table.axes[1].cells + j / kParts];
      const int bit = (i % kParts) * kParts + j % kParts;
      const bool open = cell.parts < 0 || (table.openParts[cell.parts] >> bit & 1U) != 0;
      if (open) found |= cell.openPairs;
    }
  }
  return found;
}

struct Tally {
  int free = 0;
  int open = 0;
  int wideAndFree = 0;
};

/// Up to `most` parts along each joint.
void compare(Random& random, const PairSeparationTable& table, int most, Tally& tally) {
  Values lower{};
  Values upper{};
  const Span rows = randomSpan(random, table.axes[0], most, lower[0], upper[0]);
  const Span columns =
      table.joints == 2 ? randomSpan(random, table.axes[1], most, lower[1], upper[1]) : Span{};
  const std::uint8_t expected = openIn(table, rows, columns);
  EXPECT_EQ(table.openPairs(lower, upper), expected);
  // A box of many cells may be taken for open.
  if (most <= 3 * kParts || expected != 0) {
    EXPECT_EQ(table.free(lower, upper), expected == 0);
  }
  ++(expected == 0 ? tally.free : tally.open);
  tally.wideAndFree += expected == 0 && rows.end - rows.begin > 1 ? 1 : 0;
}

TEST(PairSeparationTable, SaysOfABoxWhatItsPartsSay) {
  Random random(46);
  for (const int joints : {1, 2}) {
    SCOPED_TRACE(joints);
    Tally tally;
    for (int round = 0; round < 300; ++round) {
      const PairSeparationTable table = randomTable(random, joints);
      for (int box = 0; box < 100; ++box) {
        compare(random, table, std::array{2, kParts, 3 * kParts, 9 * kParts}[box % 4], tally);
        if (HasFailure()) return;
      }
    }
    EXPECT_GT(tally.free, 5000);
    EXPECT_GT(tally.open, 5000);
    EXPECT_GT(tally.wideAndFree, 1000);
  }
}

}  // namespace
}  // namespace swept::simd_test
