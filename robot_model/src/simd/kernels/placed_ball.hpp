// SPDX-License-Identifier: BSD-3-Clause
// Balls of covers in all lanes. Included once per instruction set.
#if defined(SWEPT_SIMD_PLACED_BALL) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_PLACED_BALL
#undef SWEPT_SIMD_PLACED_BALL
#else
#define SWEPT_SIMD_PLACED_BALL
#endif

#include <bit>
#include <cstdint>

#include "rounding/error_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/simd_scratch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

/// Points x + s g, |s| <= 1.
struct Segment {
  V3 x;
  V3 g;
};

/// Square of the least |y + s h|, |s| <= 1. L8 of ERROR_MODEL.md: for what s is off, the distance
/// is off by less than 8 kSingle |y|.
HWY_INLINE F8 nearestSquared(const V3& y, const V3& h) {
  const F8 length = larger(dot(h, h), set(1e-30F));
  const F8 s = smaller(larger(-(dot(y, h) / length), set(-1.0F)), set(1.0F));
  const V3 p = along(y, s, h);
  return dot(p, p);
}

/// m per unit t squared, of every ball centre of a body relative to the reference.
HWY_INLINE float accelerationOf(const SimdReference& reference, const SimdBounds& bounds,
                                int body) {
  const int slot = reference.slot[body];
  return slot < 0 ? 0.0F : bounds.acceleration[slot / kLanes].lane[slot % kLanes];
}

/// m; half^2 / 2 of an acceleration, rounded up by more than the roundings.
HWY_INLINE F8 inflation(const F8& half, float acceleration) {
  return half * half * set(acceleration * kHalfOutward);
}

/// Its centre.
template <typename Ball>
HWY_INLINE V3 place(const Ball& ball, const SimdBodyState& state) {
  return addRotated(load3(state.origin), state.rotation, set3(ball.center));
}

/// Where a ball's centre is in the sub-interval, or rests; see world_walk.hpp.
HWY_INLINE Segment segmentOf(const SimdNode& node, const SimdBodyState& state, const F8& half,
                             bool moving) {
  const V3 x = place(node, state);
  if (!moving) return {x, set3({0.0F, 0.0F, 0.0F})};
  return {x, half * addCross(load3(state.linear), load3(state.angular), x)};
}

HWY_INLINE Segment segmentOf(const SimdRoot& ball, bool moving) {
  if (!moving) return {load3(ball.at), set3({0.0F, 0.0F, 0.0F})};
  return {load3(ball.at), load3(ball.by)};
}

/// Eight points of a link in one lane.
template <typename Eight>
HWY_INLINE V3 placedAt(const SimdBodyState& state, int lane, const Eight& eight) {
  const auto entry = [lane](const Row& row) { return set(row.lane[lane]); };
  const V3 local = {load(eight.x), load(eight.y), load(eight.z)};
  const auto& r = state.rotation;
  const auto line = [&](std::size_t i) {
    return multiplyAdd(
        entry(r[3 * i]), local.x,
        multiplyAdd(entry(r[3 * i + 1]), local.y,
                    multiplyAdd(entry(r[3 * i + 2]), local.z, entry(state.origin[i]))));
  };
  return {line(0), line(1), line(2)};
}

/// Of the given lanes.
HWY_INLINE int lowestLane(const F8& values, Lanes lanes) {
  Row row;
  store(values, row);
  int lowest = std::countr_zero(lanes);
  for (Lanes left = lanes & (lanes - 1); left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (row.lane[lane] < row.lane[lowest]) lowest = lane;
  }
  return lowest;
}

/// Notes contacts at these points. True: the walk is over.
HWY_INLINE bool claim(SimdBlock& block, std::uint32_t pair, Lanes lanes, const V3& points,
                      float inside) {
  Row row[3];
  store3(points, row);
  block.contactLanes |= lanes;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    block.contacts[lane] = {
        pair, {row[0].lane[lane], row[1].lane[lane], row[2].lane[lane]}, inside};
  }
  return block.mode != SimdMode::States || block.contactLanes == kAllLanes;
}

/// Leaves a pair open in these lanes; `final`: shorter intervals would not help. `depths`: m, a
/// guess of how deep the two are in each other.
HWY_INLINE void markUnresolved(SimdBlock& block, std::uint32_t pair, Lanes lanes, bool final,
                               const F8& depths) {
  if (block.openLanes[pair] == 0) block.open.push_back(pair);
  block.openLanes[pair] |= static_cast<std::uint8_t>(lanes);
  if (final) block.finalLanes[pair] |= static_cast<std::uint8_t>(lanes);
  if (!block.stopAtContact || (lanes & above(depths, set(block.likelyContact.depth))) == 0) return;
  Row row;
  store(depths, row);
  for (int lane = 0; lane < kLanes; ++lane)
    if ((lanes >> lane & 1U) != 0 && row.lane[lane] > block.likelyContact.depth)
      block.likelyContact = {pair, lane, row.lane[lane]};
}

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
