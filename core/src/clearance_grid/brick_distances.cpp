// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/field_distances.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearance_grid/squared_gaps.hpp"
#include "threads/crew.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "clearance_grid/brick_distances.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

using Mask = Voxels::Mask;

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<SquaredGap, 16>;
using Lanes = hn::Vec<Tag>;

/// Lowers four rows of `count` values to those of twelve rows, the i-th of which is `gaps[k][i]`
/// farther from the k-th of the four. Rows that are not in `wanted` have no values.
template <std::size_t kCount, typename Gaps>
HWY_INLINE void lowerRows(SquaredGap* to, const SquaredGap* from, unsigned wanted,
                          const Gaps& gaps) {
  const Tag tag;
  for (std::size_t at = 0; at < kCount; at += hn::Lanes(tag)) {
    Lanes least0 = hn::LoadU(tag, to + at);
    Lanes least1 = hn::LoadU(tag, to + kCount + at);
    Lanes least2 = hn::LoadU(tag, to + 2 * kCount + at);
    Lanes least3 = hn::LoadU(tag, to + 3 * kCount + at);
    for (unsigned left = wanted; left != 0; left &= left - 1) {
      const auto row = static_cast<std::size_t>(std::countr_zero(left));
      const Lanes values = hn::LoadU(tag, from + kCount * row + at);
      least0 = hn::Min(least0, hn::Add(values, hn::Set(tag, gaps[0][row])));
      least1 = hn::Min(least1, hn::Add(values, hn::Set(tag, gaps[1][row])));
      least2 = hn::Min(least2, hn::Add(values, hn::Set(tag, gaps[2][row])));
      least3 = hn::Min(least3, hn::Add(values, hn::Set(tag, gaps[3][row])));
    }
    hn::StoreU(least0, tag, to + at);
    hn::StoreU(least1, tag, to + kCount + at);
    hn::StoreU(least2, tag, to + 2 * kCount + at);
    hn::StoreU(least3, tag, to + 3 * kCount + at);
  }
}

/// Distances of the voxels of blocks from the marked voxels of the surrounding blocks. Space beyond
/// these is unknown, so no distance is larger than that to their border.
class BrickDistances {
 public:
  BrickDistances(const Voxels& voxels, ClearanceField& field)
      : voxels_(voxels), field_(field), steps_(static_cast<double>(field.voxel), kMost) {
    field.fineStep = steps_.step();
    for (int i = 0; i < 64; ++i) toBorder_[i] = toBorder(i % 4, i / 16, i / 4 % 4);
    for (std::size_t row = 0; row < ofRow_.size(); ++row) {
      for (std::size_t x = 0; x < 4; ++x) {
        SquaredGap least = kUnknownGap;
        for (std::size_t k = 0; k < kWindow; ++k)
          if ((row >> k & 1) != 0) least = std::min(least, gapTo(x, k));
        ofRow_[row][x] = least;
      }
    }
    for (std::size_t x = 0; x < 4; ++x)
      for (std::size_t k = 0; k < kWindow; ++k) gaps_[x][k] = gapTo(x, k);
  }

  /// Layers of blocks are numbered by the bricks in those before, so that threads do not matter.
  void store(Crew& crew) {
    const auto [nx, ny, nz] = field_.blocks;
    near_.assign(static_cast<std::size_t>(nx) * ny * nz, 0);
    field_.bricks.assign(near_.size(), 0);
    std::vector<std::int32_t> firstOf(static_cast<std::size_t>(nz) + 1, 0);
    crew.forPieces(
        nz, 1, [&](std::size_t z, std::size_t) { firstOf[z + 1] = findNear(static_cast<int>(z)); });
    firstOf[0] = 1;  // brick 0 stands for none
    for (std::size_t z = 1; z < firstOf.size(); ++z) firstOf[z] += firstOf[z - 1];
    field_.voxels.assign(16 * static_cast<std::size_t>(firstOf.back()), 0);
    crew.forPieces(
        nz, 1, [&](std::size_t z, std::size_t) { storeLayer(static_cast<int>(z), firstOf[z]); });
  }

 private:
  static constexpr std::size_t kWindow = 12;  ///< voxels: three blocks
  static constexpr double kMost = 5.5;

  /// In a layer: blocks that are not empty, the blocks around such ones, and those where the window
  /// cut the shape. Returns how many of them have bricks.
  std::int32_t findNear(int z) {
    const auto [nx, ny, nz] = field_.blocks;
    const auto isCut = [&](int axis, int at) {
      return (at == 0 && std::isinf(field_.lower[axis])) ||
             (at + 1 == field_.blocks[axis] && std::isinf(field_.upper[axis]));
    };
    for (int k = std::max(z - 1, 0); k <= std::min(z + 1, nz - 1); ++k) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          if (voxels_.empty(x, y, k)) continue;
          for (int j = std::max(y - 1, 0); j <= std::min(y + 1, ny - 1); ++j)
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, nx - 1); ++i)
              near_[voxels_.blockIndex(i, j, z)] = 1;
        }
      }
    }
    std::int32_t count = 0;
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        std::uint8_t& near = near_[voxels_.blockIndex(x, y, z)];
        if (isCut(0, x) || isCut(1, y) || isCut(2, z)) near = 1;
        if (voxels_.block(x, y, z) == Voxels::kFull) near = 0;
        count += near;
      }
    }
    return count;
  }

  /// The bricks of a layer, from number `brick` on.
  void storeLayer(int z, std::int32_t brick) const {
    std::array<Mask, 27> around{};
    for (int y = 0; y < field_.blocks[1]; ++y) {
      for (int x = 0; x < field_.blocks[0]; ++x) {
        const std::size_t block = voxels_.blockIndex(x, y, z);
        if (near_[block] == 0) continue;
        for (int i = 0; i < 27; ++i)
          around[i] = maskAt(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
        spread(around, &field_.voxels[16 * static_cast<std::size_t>(brick)]);
        field_.bricks[block] = brick++;
      }
    }
  }

  Mask maskAt(int x, int y, int z) const {
    const std::array<int, 3> at = {x, y, z};
    for (int i = 0; i < 3; ++i) {
      if (at[i] < 0) return std::isinf(field_.lower[i]) ? Voxels::kFull : 0;
      if (at[i] >= field_.blocks[i]) return std::isinf(field_.upper[i]) ? Voxels::kFull : 0;
    }
    return voxels_.block(x, y, z);
  }

  /// `words`: the sixteen of the brick.
  void spread(const std::array<Mask, 27>& around, std::uint32_t* words) const {
    std::array<SquaredGap, kWindow * kWindow * 4> rows;
    rows.fill(kUnknownGap);
    unsigned ofY = 0;  // those with a value in a row: most have none
    unsigned ofZ = 0;
    for (std::size_t i = 0; i < 9; ++i) {
      const Mask* blocks = &around[3 * i];
      if ((blocks[0] | blocks[1] | blocks[2]) == 0) continue;
      for (std::size_t j = 0; j < 16; ++j) {
        const std::size_t shift = 4 * j;
        const auto bits =
            static_cast<unsigned>((blocks[0] >> shift & 15U) | (blocks[1] >> shift & 15U) << 4 |
                                  (blocks[2] >> shift & 15U) << 8);
        const std::size_t y = 4 * (i % 3) + j % 4;
        const std::size_t z = 4 * (i / 3) + j / 4;
        if (bits == 0) continue;
        ofY |= 1U << y;
        ofZ |= 1U << z;
        std::copy_n(ofRow_[bits].data(), 4, &rows[4 * (kWindow * z + y)]);
      }
    }
    std::array<SquaredGap, kWindow * 16> columns;
    columns.fill(kUnknownGap);
    lowerRows<4 * kWindow>(columns.data(), rows.data(), ofZ, gaps_);
    // With z before y, so that the next step, too, goes through long rows.
    std::array<SquaredGap, kWindow * 16> turned;
    for (std::size_t y = 0; y < kWindow; ++y)
      for (std::size_t z = 0; z < 4; ++z)
        std::copy_n(&columns[4 * (kWindow * z + y)], 4, &turned[16 * y + 4 * z]);
    std::array<SquaredGap, 64> least = toBorder_;
    lowerRows<16>(least.data(), turned.data(), ofY, gaps_);
    for (std::size_t z = 0; z < 4; ++z) {
      for (std::size_t y = 0; y < 4; ++y) {
        std::uint32_t word = 0;
        for (std::size_t x = 0; x < 4; ++x) word |= steps_(least[16 * y + 4 * z + x]) << (8 * x);
        *words++ = word;
      }
    }
  }

  /// From the centre of a voxel of the middle block to a voxel of the window, along one axis.
  static SquaredGap gapTo(std::size_t voxel, std::size_t inWindow) {
    return gapSquared(std::abs(static_cast<int>(inWindow) - 4 - static_cast<int>(voxel)));
  }

  /// Distances in the window, from the centre of a voxel.
  static SquaredGap toBorder(int x, int y, int z) {
    const auto along = [](int i) { return 2 * std::min(4 + i, 7 - i) + 1; };
    const int least = std::min({along(x), along(y), along(z)});
    return static_cast<SquaredGap>(least * least);
  }

  const Voxels& voxels_;
  ClearanceField& field_;
  GapSteps steps_;
  std::array<std::array<SquaredGap, 4>, 1 << kWindow> ofRow_;
  /// gapTo().
  std::array<std::array<SquaredGap, kWindow>, 4> gaps_;
  std::array<SquaredGap, 64> toBorder_;  ///< x, then z, then y
  std::vector<std::uint8_t> near_;       ///< per block: whether it has a brick
};

void MeasureBricks(const Voxels& voxels, Crew& crew, ClearanceField& field) {
  BrickDistances(voxels, field).store(crew);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(MeasureBricks);

void measureBricks(const Voxels& voxels, Crew& crew, ClearanceField& field) {
  SWEPT_DISPATCH(MeasureBricks)(voxels, crew, field);
}

}  // namespace swept::detail
#endif
