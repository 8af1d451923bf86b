// SPDX-License-Identifier: BSD-3-Clause
#include "squared_distances.hpp"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "squared_distances.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kBlock>;

float squaredDistances(const float* blocks, std::size_t count, const float* point,
                       std::size_t dimension, float* squared) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  auto least = hn::Set(tag, kInfinity);
  for (std::size_t first = 0; first < count; first += kBlock) {
    const float* block = blocks + first * dimension;
    for (std::size_t lane = 0; lane < kBlock; lane += lanes) {
      auto sum = hn::Zero(tag);
      for (std::size_t d = 0; d < dimension; ++d) {
        const auto apart =
            hn::Sub(hn::LoadU(tag, block + d * kBlock + lane), hn::Set(tag, point[d]));
        sum = hn::MulAdd(apart, apart, sum);
      }
      const std::size_t left = first + lane < count ? count - first - lane : 0;
      sum = hn::IfThenElse(hn::FirstN(tag, left), sum, hn::Set(tag, kInfinity));
      hn::StoreU(sum, tag, squared + first + lane);
      least = hn::Min(least, sum);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

std::size_t placesNotAbove(float limit, const float* values, std::size_t count,
                           std::uint32_t* places) {
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto most = hn::Set(tag, limit);
  std::size_t found = 0;
  for (std::size_t first = 0; first < count; first += lanes) {
    const auto near = hn::Le(hn::LoadU(tag, values + first), most);
    if (hn::AllFalse(tag, near)) continue;
    std::uint8_t bits[8] = {};  // StoreMaskBits may write as many
    hn::StoreMaskBits(tag, near, bits);
    for (std::uint32_t left = bits[0] | (std::uint32_t{bits[1]} << 8U); left != 0; left &= left - 1)
      places[found++] =
          static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(left));
  }
  return found;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(squaredDistances);
SWEPT_DISPATCH_TABLE(placesNotAbove);

float squaredDistances(const float* blocks, std::size_t count, const float* point,
                       std::size_t dimension, float* squared) {
  return SWEPT_DISPATCH(squaredDistances)(blocks, count, point, dimension, squared);
}

std::size_t placesNotAbove(float limit, const float* values, std::size_t count,
                           std::uint32_t* places) {
  return SWEPT_DISPATCH(placesNotAbove)(limit, values, count, places);
}

}  // namespace swept::detail
#endif  // HWY_ONCE
