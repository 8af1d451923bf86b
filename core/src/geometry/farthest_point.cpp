// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/farthest_point.hpp"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/farthest_point.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 4>;
using Lanes = hn::Vec<Tag>;

/// The largest value per lane so far, with the index it came from (exact in a double).
struct Best {
  Lanes value;
  Lanes index;

  HWY_INLINE void consider(Lanes along, Lanes at) {
    const auto more = hn::Gt(along, value);
    value = hn::IfThenElse(more, along, value);
    index = hn::IfThenElse(more, at, index);
  }
};

/// Two chains of comparisons, so that one does not wait for the other.
std::size_t farthestPoint(const double* coordinates, std::size_t count, double dx, double dy,
                          double dz) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  const double* x = coordinates;
  const double* y = x + count;
  const double* z = y + count;
  const Lanes nx = hn::Set(tag, dx);
  const Lanes ny = hn::Set(tag, dy);
  const Lanes nz = hn::Set(tag, dz);
  const auto along = [&](std::size_t i) {
    return hn::MulAdd(nx, hn::LoadU(tag, x + i),
                      hn::MulAdd(ny, hn::LoadU(tag, y + i), hn::Mul(nz, hn::LoadU(tag, z + i))));
  };
  const Lanes step = hn::Set(tag, static_cast<double>(2 * lanes));
  Lanes evenAt = hn::Iota(tag, 0.0);
  Lanes oddAt = hn::Iota(tag, static_cast<double>(lanes));
  Best even{along(0), evenAt};
  Best odd{along(lanes), oddAt};
  for (std::size_t i = 2 * lanes; i < count; i += 2 * lanes) {
    evenAt = hn::Add(evenAt, step);
    oddAt = hn::Add(oddAt, step);
    even.consider(along(i), evenAt);
    odd.consider(along(i + lanes), oddAt);
  }
  even.consider(odd.value, odd.index);
  // No branch on which lane won: that is unpredictable.
  HWY_ALIGN double index[4];
  hn::Store(even.index, tag, index);
  const auto won = hn::Eq(even.value, hn::MaxOfLanes(tag, even.value));
  const std::intptr_t lane = hn::FindFirstTrue(tag, won);
  return static_cast<std::size_t>(index[lane < 0 ? 0 : lane]);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(farthestPoint);

std::size_t farthestPoint(const double* coordinates, std::size_t count, double dx, double dy,
                          double dz) {
  return SWEPT_DISPATCH(farthestPoint)(coordinates, count, dx, dy, dz);
}

}  // namespace swept::detail
#endif  // HWY_ONCE
