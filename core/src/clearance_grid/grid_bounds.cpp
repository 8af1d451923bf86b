// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/grid_bounds.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "clearance_grid/grid_bounds.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, kGridLanes>;
using Lanes = hn::Vec<Tag>;
using WordTag = hn::Rebind<std::int32_t, Tag>;
using Words = hn::Vec<WordTag>;

HWY_INLINE Words whole(Lanes number) {
  return hn::DemoteTo(WordTag(), number);
}

/// Byte `of` of each word, from the lowest.
HWY_INLINE Lanes byteOf(const std::uint32_t* words, Words word, Words of) {
  const hn::RebindToUnsigned<WordTag> tag;
  const auto found = hn::BitCast(
      tag, hn::GatherIndex(WordTag(), reinterpret_cast<const std::int32_t*>(words), word));
  // Shifts up and down again: for a right shift by 0 on SSE4, Highway converts 2^32 to an integer,
  // which is an invalid operation for programs that trap these.
  const auto above = hn::BitCast(tag, hn::AndNot(of, hn::Set(WordTag(), 3)));
  const auto byte = hn::ShiftRight<24>(hn::Shl(found, hn::ShiftLeft<3>(above)));
  return hn::PromoteTo(Tag(), hn::BitCast(WordTag(), byte));
}

/// Rounds products and sums one by one, as in the query for one point.
HWY_INLINE Lanes squaredNorm(Lanes x, Lanes y, Lanes z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

struct Axis {
  Lanes beyond;   ///< m, of the point from W
  Lanes off;      ///< m, of the nearest point of W from the middle of its voxel
  Lanes voxel;    ///< whole numbers
  Lanes cell;     ///< likewise
  Lanes block;    ///< likewise
  Lanes inBlock;  ///< of the voxel, 0 to 3
};

HWY_INLINE Axis along(const GridView& grid, std::size_t i, Lanes point) {
  const Tag tag;
  const auto all = [&](double value) { return hn::Set(tag, value); };
  const Lanes at = hn::Sub(point, all(grid.origin[i]));
  const Lanes q = hn::Min(hn::Max(at, all(grid.lower[i])), all(grid.upper[i]));
  const Lanes scaled = hn::Sub(hn::Mul(q, all(grid.inverse)), all(0.5));
  Axis axis;
  axis.voxel = hn::Round(hn::Min(hn::Max(scaled, all(0.0)), all(grid.last[i])));
  axis.cell = hn::Floor(hn::Mul(axis.voxel, all(0.5)));
  axis.block = hn::Floor(hn::Mul(axis.voxel, all(0.25)));
  axis.inBlock = hn::Sub(axis.voxel, hn::Mul(axis.block, all(4.0)));
  axis.beyond = hn::Sub(at, q);
  axis.off = hn::Sub(q, hn::Mul(hn::Add(axis.voxel, all(0.5)), all(grid.voxel)));
  return axis;
}

HWY_INLINE Lanes placeIn(Lanes x, Lanes y, Lanes z, double row, double layer) {
  const Tag tag;
  return hn::MulAdd(z, hn::Set(tag, layer), hn::MulAdd(y, hn::Set(tag, row), x));
}

HWY_INLINE Lanes bounds(const GridView& grid, Lanes px, Lanes py, Lanes pz) {
  const Tag tag;
  const Axis x = along(grid, 0, px), y = along(grid, 1, py), z = along(grid, 2, pz);
  const Words cell = whole(placeIn(x.cell, y.cell, z.cell, grid.cellRow, grid.cellLayer));
  const Words block = whole(placeIn(x.block, y.block, z.block, grid.blockRow, grid.blockLayer));
  const Words brick = hn::GatherIndex(WordTag(), grid.bricks, block);
  const Words word =
      hn::Add(hn::ShiftLeft<4>(brick), whole(hn::MulAdd(z.inBlock, hn::Set(tag, 4.0), y.inBlock)));
  const Words three = hn::Set(WordTag(), 3);
  const Lanes byCell =
      hn::Sub(hn::Mul(byteOf(grid.cells, hn::ShiftRight<2>(cell), hn::And(cell, three)),
                      hn::Set(tag, grid.cellSteps)),
              hn::Set(tag, grid.halfDiagonal));
  const Lanes byVoxel =
      hn::Mul(byteOf(grid.voxels, word, whole(x.inBlock)), hn::Set(tag, grid.voxelSteps));
  const Lanes off = hn::Sqrt(squaredNorm(x.off, y.off, z.off));
  const Lanes inside = hn::Max(hn::Sub(hn::Max(byCell, byVoxel), off), hn::Zero(tag));
  const Lanes squared = hn::Add(squaredNorm(x.beyond, y.beyond, z.beyond), hn::Mul(inside, inside));
  const Lanes size = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Abs(pz));
  const Lanes rounding =
      hn::Add(hn::Set(tag, grid.rounding), hn::Mul(hn::Set(tag, grid.relativeRounding), size));
  return hn::Max(hn::Sub(hn::Sqrt(squared), rounding), hn::Zero(tag));
}

void GridBounds(const GridView& grid, const double* points, double* found) {
  const Tag tag;
  for (std::size_t first = 0; first < kGridLanes; first += hn::Lanes(tag)) {
    Lanes x, y, z;
    hn::LoadInterleaved3(tag, points + 3 * first, x, y, z);
    hn::StoreU(bounds(grid, x, y, z), tag, found + first);
  }
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(GridBounds);

void gridBounds(const GridView& grid, const double* points, double* bounds) {
  SWEPT_DISPATCH(GridBounds)(grid, points, bounds);
}

}  // namespace swept::detail
#endif
