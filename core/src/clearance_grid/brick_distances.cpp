// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/field_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearance_grid/squared_gaps.hpp"

namespace swept::detail {

namespace {

using Mask = Voxels::Mask;

/// The minimum of either row's values, the other row's values grown by a gap. Everything is read
/// before anything is written, so that the compiler vectorises without testing for overlap.
template <std::size_t kCount>
void lowerRow(SquaredGap* to, const SquaredGap* from, SquaredGap gap) {
  std::array<SquaredGap, kCount> least;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto found = static_cast<SquaredGap>(from[i] + gap);
    const SquaredGap known = to[i];
    least[i] = found < known ? found : known;
  }
  std::copy_n(least.data(), kCount, to);
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
  }

  void store() {
    const auto [nx, ny, nz] = field_.blocks;
    const std::vector<std::uint8_t> near = findNear();
    field_.bricks.assign(near.size(), 0);
    field_.voxels.assign(16, 0);
    std::size_t i = 0;
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x, ++i) {
          if (near[i] == 0 || voxels_.block(x, y, z) == Voxels::kFull) continue;
          look(x, y, z);
          field_.bricks[i] = static_cast<std::int32_t>(field_.voxels.size() / 16);
          spread();
        }
      }
    }
  }

 private:
  static constexpr std::size_t kWindow = 12;  ///< voxels: three blocks
  static constexpr double kMost = 5.5;

  /// Blocks that are not empty, the blocks around them, and those where the window cut the shape.
  std::vector<std::uint8_t> findNear() const {
    const auto [nx, ny, nz] = field_.blocks;
    std::vector<std::uint8_t> near(static_cast<std::size_t>(nx) * ny * nz, 0);
    const auto isCut = [&](int axis, int at) {
      return (at == 0 && std::isinf(field_.lower[axis])) ||
             (at + 1 == field_.blocks[axis] && std::isinf(field_.upper[axis]));
    };
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          if (isCut(0, x) || isCut(1, y) || isCut(2, z)) near[voxels_.blockIndex(x, y, z)] = 1;
          if (voxels_.empty(x, y, z)) continue;
          for (int k = std::max(z - 1, 0); k <= std::min(z + 1, nz - 1); ++k)
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, ny - 1); ++j)
              for (int i = std::max(x - 1, 0); i <= std::min(x + 1, nx - 1); ++i)
                near[voxels_.blockIndex(i, j, k)] = 1;
        }
      }
    }
    return near;
  }

  /// At the blocks around.
  void look(int x, int y, int z) {
    for (int i = 0; i < 27; ++i)
      around_[i] = maskAt(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
  }

  Mask maskAt(int x, int y, int z) const {
    const std::array<int, 3> at = {x, y, z};
    for (int i = 0; i < 3; ++i) {
      if (at[i] < 0) return std::isinf(field_.lower[i]) ? Voxels::kFull : 0;
      if (at[i] >= field_.blocks[i]) return std::isinf(field_.upper[i]) ? Voxels::kFull : 0;
    }
    return voxels_.block(x, y, z);
  }

  void spread() {
    std::array<SquaredGap, kWindow * kWindow * 4> rows;
    rows.fill(kUnknownGap);
    std::array<unsigned, kWindow> ofY{};  // bits of all rows at a y, and at a z: most are empty
    std::array<unsigned, kWindow> ofZ{};
    for (std::size_t i = 0; i < 9; ++i) {
      const Mask* blocks = &around_[3 * i];
      if ((blocks[0] | blocks[1] | blocks[2]) == 0) continue;
      for (std::size_t j = 0; j < 16; ++j) {
        const std::size_t shift = 4 * j;
        const auto bits =
            static_cast<unsigned>((blocks[0] >> shift & 15U) | (blocks[1] >> shift & 15U) << 4 |
                                  (blocks[2] >> shift & 15U) << 8);
        const std::size_t y = 4 * (i % 3) + j % 4;
        const std::size_t z = 4 * (i / 3) + j / 4;
        ofY[y] |= bits;
        ofZ[z] |= bits;
        std::copy_n(ofRow_[bits].data(), 4, &rows[4 * (kWindow * z + y)]);
      }
    }
    std::array<SquaredGap, kWindow * 16> columns;
    columns.fill(kUnknownGap);
    for (std::size_t from = 0; from < kWindow; ++from) {
      if (ofZ[from] == 0) continue;
      for (std::size_t z = 0; z < 4; ++z)
        lowerRow<4 * kWindow>(&columns[4 * kWindow * z], &rows[4 * kWindow * from], gapTo(z, from));
    }
    // With z before y, so that the next step, too, goes through long rows.
    std::array<SquaredGap, kWindow * 16> turned;
    for (std::size_t y = 0; y < kWindow; ++y)
      for (std::size_t z = 0; z < 4; ++z)
        std::copy_n(&columns[4 * (kWindow * z + y)], 4, &turned[16 * y + 4 * z]);
    std::array<SquaredGap, 64> least = toBorder_;
    for (std::size_t y = 0; y < 4; ++y)
      for (std::size_t from = 0; from < kWindow; ++from)
        if (ofY[from] != 0) lowerRow<16>(&least[16 * y], &turned[16 * from], gapTo(y, from));
    for (std::size_t z = 0; z < 4; ++z) {
      for (std::size_t y = 0; y < 4; ++y) {
        std::uint32_t word = 0;
        for (std::size_t x = 0; x < 4; ++x) word |= steps_(least[16 * y + 4 * z + x]) << (8 * x);
        field_.voxels.push_back(word);
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
  std::array<SquaredGap, 64> toBorder_;  ///< x, then z, then y
  std::array<Mask, 27> around_{};
};

}  // namespace

void measureBricks(const Voxels& voxels, ClearanceField& field) {
  BrickDistances(voxels, field).store();
}

}  // namespace swept::detail
