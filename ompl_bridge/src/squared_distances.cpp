// SPDX-License-Identifier: BSD-3-Clause
#include "squared_distances.hpp"

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

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(squaredDistances);

float squaredDistances(const float* blocks, std::size_t count, const float* point,
                       std::size_t dimension, float* squared) {
  return SWEPT_DISPATCH(squaredDistances)(blocks, count, point, dimension, squared);
}

}  // namespace swept::detail
#endif  // HWY_ONCE
