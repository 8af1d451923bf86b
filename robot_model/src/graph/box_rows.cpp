// SPDX-License-Identifier: BSD-3-Clause
#include "graph/box_rows.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "graph/box_rows.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using KeyTag = hn::CappedTag<std::int16_t, BoxRows::kBoxes>;

HWY_INLINE std::uint16_t overlapping(const BoxRows& rows, const BoxKeys& box) {
  const KeyTag tag;
  std::uint32_t found = 0;
  for (std::size_t first = 0; first < BoxRows::kBoxes; first += hn::Lanes(tag)) {
    const auto apart = [&](std::size_t k) {
      return hn::Or(hn::Gt(hn::Load(tag, rows.sides[k].data() + first), hn::Set(tag, box[k + 3])),
                    hn::Lt(hn::Load(tag, rows.sides[k + 3].data() + first), hn::Set(tag, box[k])));
    };
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(hn::Or(hn::Or(apart(0), apart(1)), apart(2))), bits);
    found |= (std::uint32_t{bits[0]} | std::uint32_t{bits[1]} << 8U) << first;
  }
  return static_cast<std::uint16_t>(found);
}

void AllRows(std::span<const BoxRows> rows, const BoxKeys& box, std::span<std::uint16_t> bits) {
  for (std::size_t i = 0; i < rows.size(); ++i) bits[i] = overlapping(rows[i], box);
}

void SomeRows(std::span<const BoxRows> rows, std::span<const std::uint32_t> which,
              const BoxKeys& box, std::span<std::uint16_t> bits) {
  for (std::size_t i = 0; i < which.size(); ++i) bits[i] = overlapping(rows[which[i]], box);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

std::int16_t BoxKey::of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);  // one zero
  const std::uint32_t size = bits & 0x7fffffffU;
  const auto key =
      static_cast<int>(size < kLeast ? 0U : std::min((size - kLeast) >> kShift, kLargest));
  return static_cast<std::int16_t>(size == bits ? key : -1 - key);
}

BoxKeys boxKeys(const SingleBox& box) {
  BoxKeys keys;
  std::ranges::transform(box.sides, keys.begin(), BoxKey::of);
  return keys;
}

SWEPT_DISPATCH_TABLE(AllRows);
SWEPT_DISPATCH_TABLE(SomeRows);

void findOverlapping(std::span<const BoxRows> rows, const BoxKeys& box,
                     std::span<std::uint16_t> bits) {
  SWEPT_DISPATCH(AllRows)(rows, box, bits);
}

void findOverlapping(std::span<const BoxRows> rows, std::span<const std::uint32_t> which,
                     const BoxKeys& box, std::span<std::uint16_t> bits) {
  SWEPT_DISPATCH(SomeRows)(rows, which, box, bits);
}

}  // namespace swept::detail
#endif
