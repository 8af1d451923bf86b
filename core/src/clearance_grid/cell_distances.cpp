// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearance_grid/field_distances.hpp"
#include "clearance_grid/squared_gaps.hpp"
#include "threads/crew.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "clearance_grid/cell_distances.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

// The compiler vectorises the loops over rows itself.
HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

void lowerCells(SquaredGap* to, SquaredGap most, int count) {
  for (int i = 0; i < count; ++i) to[i] = to[i] < most ? to[i] : most;
}
void lowerCells(SquaredGap* __restrict to, const SquaredGap* __restrict from, SquaredGap gap,
                int count) {
  for (int i = 0; i < count; ++i) {
    const auto found = static_cast<SquaredGap>(from[i] + gap);
    to[i] = to[i] < found ? to[i] : found;
  }
}
SquaredGap largestOf(const SquaredGap* cells, int count) {
  SquaredGap largest = 0;
  for (int i = 0; i < count; ++i) largest = largest < cells[i] ? cells[i] : largest;
  return largest;
}

/// Distances of all cells from the marked ones, exact for whole cells: the least over an axis of
/// the least over another (Saito, Toriwaki 1994). Rows (along x) without any value are left out: in
/// most worlds these are most of them.
class CellDistances {
 public:
  CellDistances(const Voxels& voxels, const ClearanceField& field) : voxels_(voxels) {
    for (int i = 0; i < 3; ++i) {
      count_[i] = 2 * voxels.blocks()[i];
      cutBefore_[i] = std::isinf(field.lower[i]);
      cutAfter_[i] = std::isinf(field.upper[i]);
    }
    const std::size_t rows = static_cast<std::size_t>(count_[1]) * count_[2];
    squared_.assign(rows * count_[0], gapSquared(kFarthestGap));
    hasValues_.assign(rows, 0);
  }

  void measure(Crew& crew) {
    const int layer = voxels_.blocks()[2], slice = voxels_.blocks()[1];
    crew.forPieces(layer, 1, [this](std::size_t z, std::size_t) {
      std::vector<SquaredGap> from;
      std::vector<std::uint8_t> has;
      markLayer(static_cast<int>(z));
      for (const std::size_t k : {2 * z, 2 * z + 1}) {
        spreadAlongX(k);
        spreadAlong(1, k, from, has);
      }
    });
    crew.forPieces(slice, 2, [this](std::size_t first, std::size_t last) {
      std::vector<SquaredGap> from;
      std::vector<std::uint8_t> has;
      for (std::size_t k = 2 * first; k < 2 * last; ++k) spreadAlong(2, k, from, has);
    });
  }

  void store(Crew& crew, ClearanceField& field) const {
    constexpr std::size_t kWords = 16384;
    // Cells without a value are at least this far.
    const GapSteps steps(2.0 * static_cast<double>(field.voxel), kFarthestGap - 0.5);
    field.step = steps.step();
    field.cells.resize(squared_.size() / 4 + 1);
    crew.forPieces(field.cells.size(), kWords, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = 4 * first; i < std::min(4 * last, squared_.size()); ++i)
        field.cells[i / 4] |= steps(squared_[i]) << (8 * (i % 4));
    });
  }

 private:
  std::size_t rowOf(std::size_t y, std::size_t z) const { return z * count_[1] + y; }

  /// The cells of a layer of blocks.
  void markLayer(int z) {
    const auto [nx, ny, nz] = voxels_.blocks();
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        if (voxels_.empty(x, y, z)) continue;
        for (int i = 0; i < 8; ++i) {
          const int cell[3] = {2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2)};
          if (!voxels_.cell(cell[0], cell[1], cell[2])) continue;
          const std::size_t row = rowOf(cell[1], cell[2]);
          squared_[row * count_[0] + cell[0]] = 0;
          hasValues_[row] = 1;
        }
      }
    }
  }

  /// Gaps to marked cells, and to where the window cut the shape, in a layer of cells.
  void spreadAlongX(std::size_t z) {
    const int count = count_[0];
    for (std::size_t row = rowOf(0, z); row < rowOf(0, z + 1); ++row) {
      hasValues_[row] |= cutBefore_[0] || cutAfter_[0];
      if (hasValues_[row] == 0) continue;
      SquaredGap* const cells = &squared_[row * count];
      int gap = cutBefore_[0] ? 0 : kFarthestGap;
      const auto pass = [&](SquaredGap& value) {
        gap = value == 0 ? 0 : std::min(gap + 1, kFarthestGap);
        if (gap < kFarthestGap) value = std::min(value, gapSquared(gap));
      };
      for (int i = 0; i < count; ++i) pass(cells[i]);
      gap = cutAfter_[0] ? 0 : kFarthestGap;
      for (int i = count; i-- > 0;) pass(cells[i]);
    }
  }

  /// The minimum over the cells of each line along an axis of their value plus the square of the
  /// gap to them. Neighbouring lines along x are processed together: those at `other` of the third
  /// axis. `from` and `has` are scratch.
  void spreadAlong(int axis, std::size_t other, std::vector<SquaredGap>& from,
                   std::vector<std::uint8_t>& has) {
    const int nx = count_[0];
    const int count = count_[axis];
    const auto row = [&](int i) { return axis == 1 ? rowOf(i, other) : rowOf(other, i); };
    from.resize(static_cast<std::size_t>(count) * nx);
    has.resize(count);
    bool any = cutBefore_[axis] || cutAfter_[axis];
    for (int i = 0; i < count; ++i) {
      has[i] = hasValues_[row(i)];
      any = any || has[i] != 0;
      if (has[i] != 0)
        std::copy_n(&squared_[row(i) * nx], nx, &from[static_cast<std::size_t>(i) * nx]);
    }
    if (!any) return;
    for (int i = 0; i < count; ++i) {
      SquaredGap* const to = &squared_[row(i) * nx];
      const int before = cutBefore_[axis] ? i + 1 : kFarthestGap;
      const int after = cutAfter_[axis] ? count - i : kFarthestGap;
      const int cut = std::min({before, after, kFarthestGap});
      if (cut < kFarthestGap) lowerCells(to, gapSquared(cut), nx);
      hasValues_[row(i)] |= cut < kFarthestGap;
      const SquaredGap most = largestOf(to, nx);
      const auto lower = [&](int at, int gap) {
        if (at < 0 || at >= count || has[at] == 0) return;
        lowerCells(to, &from[static_cast<std::size_t>(at) * nx], gapSquared(gap), nx);
        hasValues_[row(i)] = 1;
      };
      for (int k = 1; k < kFarthestGap && gapSquared(k) < most; ++k) {
        lower(i - k, k);
        lower(i + k, k);
      }
    }
  }

  const Voxels& voxels_;
  std::array<int, 3> count_;
  std::array<bool, 3> cutBefore_;
  std::array<bool, 3> cutAfter_;
  std::vector<SquaredGap> squared_;
  std::vector<std::uint8_t> hasValues_;  ///< per row: whether a value in it is known
};

void MeasureCells(const Voxels& voxels, Crew& crew, ClearanceField& field) {
  CellDistances distances(voxels, field);
  distances.measure(crew);
  distances.store(crew, field);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(MeasureCells);

void measureCells(const Voxels& voxels, Crew& crew, ClearanceField& field) {
  SWEPT_DISPATCH(MeasureCells)(voxels, crew, field);
}

}  // namespace swept::detail
#endif
