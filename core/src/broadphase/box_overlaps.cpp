// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/box_overlaps.hpp"

#include <hwy/cache_control.h>

#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/box_overlaps.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, BoxBlock::kLanes>;

/// Bit i: the box in lane i meets `box`; never set for an empty lane.
HWY_INLINE std::uint32_t lanesHit(const BoxBlock& block, const FloatBox& box) {
  const Tag tag;
  std::uint32_t hits = 0;
  for (std::size_t first = 0; first < BoxBlock::kLanes; first += hn::Lanes(tag)) {
    const auto below = [&](int k) {
      return hn::Le(hn::Load(tag, block.lower[k].data() + first), hn::Set(tag, box.upper[k]));
    };
    const auto above = [&](int k) {
      return hn::Ge(hn::Load(tag, block.upper[k].data() + first), hn::Set(tag, box.lower[k]));
    };
    const auto meets = hn::And(hn::And(hn::And(below(0), above(0)), hn::And(below(1), above(1))),
                               hn::And(below(2), above(2)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, meets, bits);
    hits |= std::uint32_t{bits[0]} << first;
  }
  return hits;
}

void FindOverlaps(const BoxTree& tree, const FloatBox& box, std::vector<std::uint32_t>& owners) {
  struct Open {
    std::uint32_t level, block;
  };
  // A block leaves at most seven other blocks of its level to visit.
  std::array<Open, BoxTree::kMostLevels * BoxBlock::kLanes> stack;
  std::size_t depth = 0;
  if (tree.levels() > 0) stack[depth++] = {static_cast<std::uint32_t>(tree.levels() - 1), 0};
  while (depth > 0) {
    const Open open = stack[--depth];
    std::uint32_t hits = lanesHit(tree.level(open.level)[open.block], box);
    for (; hits != 0; hits &= hits - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(hits));
      const std::uint32_t below = open.block * BoxBlock::kLanes + lane;
      if (open.level == 0) {
        owners.push_back(tree.owners()[below]);
        continue;
      }
      const auto* block = reinterpret_cast<const char*>(&tree.level(open.level - 1)[below]);
      for (std::size_t line = 0; line < sizeof(BoxBlock); line += 64) hwy::Prefetch(block + line);
      stack[depth++] = {open.level - 1, below};
    }
  }
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(FindOverlaps);

void findOverlaps(const BoxTree& tree, const FloatBox& box, std::vector<std::uint32_t>& owners) {
  SWEPT_DISPATCH(FindOverlaps)(tree, box, owners);
}

}  // namespace swept::detail
#endif
