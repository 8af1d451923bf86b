// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/field_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swept::detail {

namespace {

using Mask = Voxels::Mask;

/// Cells, as far as their values reach.
constexpr int kFarthest = 20;
/// Twice a gap in cells, squared: gaps are whole or half cells, so sums of these are exact.
using Squared = std::int16_t;
constexpr Squared kUnknown = (2 * kFarthest) * (2 * kFarthest);
static_assert(3 * kUnknown <= std::numeric_limits<Squared>::max());

/// The gap between the middle of a cell and the `k`-th cell from it, along one axis.
constexpr Squared gapSquared(int k) {
  return k == 0 ? Squared{0} : static_cast<Squared>((2 * k - 1) * (2 * k - 1));
}

void lowerRow(Squared* to, Squared most, int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], most);
}
void lowerRow(Squared* __restrict to, const Squared* __restrict from, Squared gap, int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], static_cast<Squared>(from[i] + gap));
}

/// The same of few, all of which are read before any is written: what the compiler makes vectors
/// of without asking whether the two overlap.
template <int kCount>
void lowerRow(Squared* to, const Squared* from, Squared gap) {
  std::array<Squared, kCount> least;
  for (int i = 0; i < kCount; ++i) {
    const auto found = static_cast<Squared>(from[i] + gap);
    const Squared known = to[i];
    least[i] = found < known ? found : known;
  }
  std::copy_n(least.data(), kCount, to);
}

/// Steps that are not above the root of a squared gap, by more than roundings.
class Steps {
 public:
  /// `side`: m, of cells or voxels; `most`: of those, a gap.
  Steps(double side, double most) : units_(kUnknown + 1) {
    step_ = static_cast<float>(side * most / 255.0);
    for (int value = 0; value <= kUnknown; ++value) {
      const double gap = 0.5 * std::sqrt(static_cast<double>(value)) * side * (1.0 - 1e-6);
      const double units = std::floor(gap / static_cast<double>(step_));
      units_[value] = static_cast<std::uint32_t>(std::min(units, 255.0));
    }
  }
  std::uint32_t operator()(Squared value) const { return units_[value]; }
  float step() const { return step_; }

 private:
  std::vector<std::uint32_t> units_;
  float step_;
};

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
    squared_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], kUnknown);
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
    // What no value says of is at least this far.
    const Steps steps(2.0 * static_cast<double>(field.voxel), kFarthest - 0.5);
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

  /// Gaps to what is marked, and to where the window cut the shape.
  void spreadAlongX() {
    const int count = count_[0];
    for (std::size_t row = 0; row < squared_.size(); row += count) {
      int gap = cutBefore_[0] ? 0 : kFarthest;
      const auto pass = [&](Squared& value) {
        gap = value == 0 ? 0 : std::min(gap + 1, kFarthest);
        if (gap < kFarthest) value = std::min(value, gapSquared(gap));
      };
      for (int i = 0; i < count; ++i) pass(squared_[row + i]);
      gap = cutAfter_[0] ? 0 : kFarthest;
      for (int i = count; i-- > 0;) pass(squared_[row + i]);
    }
  }

  /// The least of what the cells of each line along an axis have, plus the square of the gap to
  /// them. Lines that are neighbours along x are done together.
  void spreadAlong(int axis) {
    const int nx = count_[0];
    const int count = count_[axis];
    const int others = axis == 1 ? count_[2] : count_[1];
    const std::ptrdiff_t stride = axis == 1 ? nx : std::ptrdiff_t{nx} * count_[1];
    const std::vector<Squared> from = squared_;
    for (int other = 0; other < others; ++other) {
      const std::size_t begin = axis == 1 ? indexOf(0, 0, other) : indexOf(0, other, 0);
      for (int i = 0; i < count; ++i) {
        Squared* const to = &squared_[begin + i * stride];
        const Squared* const source = &from[begin + i * stride];
        const int before = cutBefore_[axis] ? i + 1 : kFarthest;
        const int after = cutAfter_[axis] ? count - i : kFarthest;
        lowerRow(to, gapSquared(std::min({before, after, kFarthest})), nx);
        const Squared most = *std::max_element(to, to + nx);
        for (int k = 1; k < kFarthest && gapSquared(k) < most; ++k) {
          if (i >= k) lowerRow(to, source - k * stride, gapSquared(k), nx);
          if (i + k < count) lowerRow(to, source + k * stride, gapSquared(k), nx);
        }
      }
    }
  }

  std::array<int, 3> count_;
  std::array<bool, 3> cutBefore_;
  std::array<bool, 3> cutAfter_;
  std::vector<Squared> squared_;
};

/// Distances of the voxels of blocks from the marked ones of the blocks around. Beyond these
/// anything may be, so no distance is larger than that to their border.
class BrickDistances {
 public:
  BrickDistances(const Voxels& voxels, ClearanceField& field)
      : voxels_(voxels), field_(field), steps_(static_cast<double>(field.voxel), kMost) {
    field.fineStep = steps_.step();
    for (int i = 0; i < 64; ++i) toBorder_[i] = toBorder(i % 4, i / 16, i / 4 % 4);
    for (int row = 0; row < (1 << kWindow); ++row) {
      for (int x = 0; x < 4; ++x) {
        Squared least = kUnknown;
        for (int k = 0; k < kWindow; ++k)
          if ((row >> k & 1) != 0) least = std::min(least, gapSquared(std::abs(k - 4 - x)));
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
  static constexpr int kWindow = 12;  ///< voxels: three blocks
  static constexpr double kMost = 5.5;

  /// Blocks that are not empty, those around them, and those where the window cut the shape.
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
    std::array<Squared, kWindow * kWindow * 4> rows;
    rows.fill(kUnknown);
    std::array<unsigned, kWindow> ofY{};  // bits of all rows at a y, and at a z: most are empty
    std::array<unsigned, kWindow> ofZ{};
    for (int i = 0; i < 9; ++i) {
      const Mask* blocks = &around_[3 * i];
      if ((blocks[0] | blocks[1] | blocks[2]) == 0) continue;
      for (int j = 0; j < 16; ++j) {
        const int shift = 4 * j;
        const auto bits =
            static_cast<unsigned>((blocks[0] >> shift & 15U) | (blocks[1] >> shift & 15U) << 4 |
                                  (blocks[2] >> shift & 15U) << 8);
        const int y = 4 * (i % 3) + j % 4;
        const int z = 4 * (i / 3) + j / 4;
        ofY[y] |= bits;
        ofZ[z] |= bits;
        std::copy_n(ofRow_[bits].data(), 4, &rows[4 * (kWindow * z + y)]);
      }
    }
    std::array<Squared, 4 * kWindow * 4> columns;
    columns.fill(kUnknown);
    for (int from = 0; from < kWindow; ++from) {
      if (ofZ[from] == 0) continue;
      for (int z = 0; z < 4; ++z)
        lowerRow<4 * kWindow>(&columns[4 * kWindow * z], &rows[4 * kWindow * from],
                              gapSquared(std::abs(from - 4 - z)));
    }
    // With z before y, so that the next step, too, goes through long rows.
    std::array<Squared, kWindow * 16> turned;
    for (int y = 0; y < kWindow; ++y)
      for (int z = 0; z < 4; ++z)
        std::copy_n(&columns[4 * (kWindow * z + y)], 4, &turned[16 * y + 4 * z]);
    std::array<Squared, 64> least = toBorder_;
    for (int y = 0; y < 4; ++y)
      for (int from = 0; from < kWindow; ++from)
        if (ofY[from] != 0)
          lowerRow<16>(&least[16 * y], &turned[16 * from], gapSquared(std::abs(from - 4 - y)));
    for (int z = 0; z < 4; ++z) {
      for (int y = 0; y < 4; ++y) {
        std::uint32_t word = 0;
        for (int x = 0; x < 4; ++x) word |= steps_(least[16 * y + 4 * z + x]) << (8 * x);
        field_.voxels.push_back(word);
      }
    }
  }

  /// Of the window, from the middle of a voxel.
  static Squared toBorder(int x, int y, int z) {
    const auto along = [](int i) { return 2 * std::min(4 + i, 7 - i) + 1; };
    const int least = std::min({along(x), along(y), along(z)});
    return static_cast<Squared>(least * least);
  }

  const Voxels& voxels_;
  ClearanceField& field_;
  Steps steps_;
  std::array<std::array<Squared, 4>, 1 << kWindow> ofRow_;
  std::array<Squared, 64> toBorder_;  ///< x, then z, then y
  std::array<Mask, 27> around_{};
};

}  // namespace

void measureDistances(const Voxels& voxels, ClearanceField& field) {
  CellDistances(voxels, field).store(field);
  BrickDistances(voxels, field).store();
}

}  // namespace swept::detail
