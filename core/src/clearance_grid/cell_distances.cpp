// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/field_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "clearance_grid/squared_gaps.hpp"

namespace swept::detail {

namespace {

void lowerRow(SquaredGap* to, SquaredGap most, int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], most);
}
void lowerRow(SquaredGap* __restrict to, const SquaredGap* __restrict from, SquaredGap gap,
              int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], static_cast<SquaredGap>(from[i] + gap));
}

/// Distances of all cells from the marked ones, exact for whole cells: the least over an axis of
/// the least over another (Saito, Toriwaki 1994).
class CellDistances {
 public:
  CellDistances(const Voxels& voxels, const ClearanceField& field) {
    for (int i = 0; i < 3; ++i) {
      count_[i] = 2 * voxels.blocks()[i];
      cutBefore_[i] = std::isinf(field.lower[i]);
      cutAfter_[i] = std::isinf(field.upper[i]);
    }
    squared_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], kUnknownGap);
    const auto [nx, ny, nz] = voxels.blocks();
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
          if (!voxels.empty(x, y, z)) markBlock(voxels, x, y, z);
    spreadAlongX();
    spreadAlong(1);
    spreadAlong(2);
  }

  void store(ClearanceField& field) const {
    // Cells without a value are at least this far.
    const GapSteps steps(2.0 * static_cast<double>(field.voxel), kFarthestGap - 0.5);
    field.step = steps.step();
    field.cells.assign(squared_.size() / 4 + 1, 0);
    for (std::size_t i = 0; i < squared_.size(); ++i)
      field.cells[i / 4] |= steps(squared_[i]) << (8 * (i % 4));
  }

 private:
  std::size_t indexOf(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * count_[1] + y) * count_[0] + x;
  }

  void markBlock(const Voxels& voxels, int x, int y, int z) {
    for (int i = 0; i < 8; ++i) {
      const int cell[3] = {2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2)};
      if (voxels.cell(cell[0], cell[1], cell[2])) squared_[indexOf(cell[0], cell[1], cell[2])] = 0;
    }
  }

  /// Gaps to marked cells, and to where the window cut the shape.
  void spreadAlongX() {
    const int count = count_[0];
    for (std::size_t row = 0; row < squared_.size(); row += count) {
      int gap = cutBefore_[0] ? 0 : kFarthestGap;
      const auto pass = [&](SquaredGap& value) {
        gap = value == 0 ? 0 : std::min(gap + 1, kFarthestGap);
        if (gap < kFarthestGap) value = std::min(value, gapSquared(gap));
      };
      for (int i = 0; i < count; ++i) pass(squared_[row + i]);
      gap = cutAfter_[0] ? 0 : kFarthestGap;
      for (int i = count; i-- > 0;) pass(squared_[row + i]);
    }
  }

  /// The minimum over the cells of each line along an axis of their value plus the square of the
  /// gap to them. Neighbouring lines along x are processed together.
  void spreadAlong(int axis) {
    const int nx = count_[0];
    const int count = count_[axis];
    const int others = axis == 1 ? count_[2] : count_[1];
    const std::ptrdiff_t stride = axis == 1 ? nx : std::ptrdiff_t{nx} * count_[1];
    const std::vector<SquaredGap> from = squared_;
    for (int other = 0; other < others; ++other) {
      const std::size_t begin = axis == 1 ? indexOf(0, 0, other) : indexOf(0, other, 0);
      for (int i = 0; i < count; ++i) {
        SquaredGap* const to = &squared_[begin + i * stride];
        const SquaredGap* const source = &from[begin + i * stride];
        const int before = cutBefore_[axis] ? i + 1 : kFarthestGap;
        const int after = cutAfter_[axis] ? count - i : kFarthestGap;
        lowerRow(to, gapSquared(std::min({before, after, kFarthestGap})), nx);
        const SquaredGap most = *std::max_element(to, to + nx);
        for (int k = 1; k < kFarthestGap && gapSquared(k) < most; ++k) {
          if (i >= k) lowerRow(to, source - k * stride, gapSquared(k), nx);
          if (i + k < count) lowerRow(to, source + k * stride, gapSquared(k), nx);
        }
      }
    }
  }

  std::array<int, 3> count_;
  std::array<bool, 3> cutBefore_;
  std::array<bool, 3> cutAfter_;
  std::vector<SquaredGap> squared_;
};

}  // namespace

void measureCells(const Voxels& voxels, ClearanceField& field) {
  CellDistances(voxels, field).store(field);
}

}  // namespace swept::detail
