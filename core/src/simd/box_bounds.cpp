// SPDX-License-Identifier: BSD-3-Clause
#include "simd/box_bounds.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/box_bounds.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::kLanes>;
using Lanes = hn::Vec<Tag>;

/// What one call needs of the other box, the same for all lanes.
struct Other {
  float center[3];         ///< in the first frame
  float spread[3];         ///< half extents of its projection on the first frame's axes
  float half[3];           ///< along its own axes
  float edgeSpread[3][3];  ///< of its projection on axis i x axis j
};

Other prepare(const BoxFrames& frames, const BoxF& box) {
  Other other;
  for (int i = 0; i < 3; ++i) {
    const auto& axis = frames.axes[i];
    const auto& spread = frames.absAxes[i];
    other.center[i] = (axis[0] * box.center[0] + axis[1] * box.center[1]) +
                      (axis[2] * box.center[2] + frames.translation[i]);
    other.spread[i] = spread[0] * box.half[0] + spread[1] * box.half[1] + spread[2] * box.half[2];
    other.half[i] = box.half[i];
    other.edgeSpread[i][0] = spread[2] * box.half[1] + spread[1] * box.half[2];
    other.edgeSpread[i][1] = spread[2] * box.half[0] + spread[0] * box.half[2];
    other.edgeSpread[i][2] = spread[1] * box.half[0] + spread[0] * box.half[1];
  }
  return other;
}

/// Largest of the bounds of the nine edge axes.
HWY_INLINE Lanes edgeBounds(const BoxFrames& frames, const Other& other, const Lanes (&offset)[3],
                            const Lanes (&half)[3], Lanes best) {
  const Tag tag;
  const auto rounding = hn::Set(tag, frames.rounding);
  for (int i = 0; i < 3; ++i) {
    const int next = i == 2 ? 0 : i + 1;
    const int last = 3 - i - next;
    for (int j = 0; j < 3; ++j) {
      // axis i x axis j has the components (next) -axes[last][j] and (last) axes[next][j].
      const auto along = hn::AbsDiff(hn::Mul(offset[last], hn::Set(tag, frames.axes[next][j])),
                                     hn::Mul(offset[next], hn::Set(tag, frames.axes[last][j])));
      const auto extents =
          hn::MulAdd(half[next], hn::Set(tag, frames.absAxes[last][j]),
                     hn::MulAdd(half[last], hn::Set(tag, frames.absAxes[next][j]),
                                hn::Add(hn::Set(tag, other.edgeSpread[i][j]), rounding)));
      best = hn::Max(best, hn::Mul(hn::Sub(along, extents), hn::Set(tag, frames.edgeScale[i][j])));
    }
  }
  return best;
}

/// Distance that the gaps along the axes of one box prove together, or the largest of them if none
/// is positive.
HWY_INLINE Lanes together(const Lanes (&gap)[3]) {
  const Tag tag;
  const auto zero = hn::Zero(tag);
  const auto x = hn::Max(gap[0], zero);
  const auto y = hn::Max(gap[1], zero);
  const auto z = hn::Max(gap[2], zero);
  return hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
}

void LowerBounds(const WideNode& node, const BoxFrames& frames, const BoxF& box, float enough,
                 float* lower) {
  const Tag tag;
  const Other other = prepare(frames, box);
  const auto rounding = hn::Set(tag, frames.rounding);
  // The square root and the sum of squares round by a few units in the last place.
  const auto shrink = hn::Set(tag, 1.0F - 1e-6F);
  for (std::size_t at = 0; at < WideNode::kLanes; at += hn::Lanes(tag)) {
    Lanes offset[3];
    Lanes half[3];
    Lanes gap[3];
    for (int i = 0; i < 3; ++i) {
      half[i] = hn::Load(tag, node.half[i].data() + at);
      offset[i] = hn::Sub(hn::Set(tag, other.center[i]), hn::Load(tag, node.center[i].data() + at));
      const auto extents = hn::Add(half[i], hn::Set(tag, other.spread[i] + frames.rounding));
      gap[i] = hn::Sub(hn::Abs(offset[i]), extents);
    }
    auto best = together(gap);
    for (int j = 0; j < 3; ++j) {
      const auto along =
          hn::MulAdd(offset[0], hn::Set(tag, frames.axes[0][j]),
                     hn::MulAdd(offset[1], hn::Set(tag, frames.axes[1][j]),
                                hn::Mul(offset[2], hn::Set(tag, frames.axes[2][j]))));
      const auto extents =
          hn::MulAdd(half[0], hn::Set(tag, frames.absAxes[0][j]),
                     hn::MulAdd(half[1], hn::Set(tag, frames.absAxes[1][j]),
                                hn::MulAdd(half[2], hn::Set(tag, frames.absAxes[2][j]),
                                           hn::Add(hn::Set(tag, other.half[j]), rounding))));
      gap[j] = hn::Sub(hn::Abs(along), extents);
    }
    best = hn::Max(best, together(gap));
    if (!hn::AllTrue(tag, hn::Gt(best, hn::Set(tag, enough)))) {
      best = edgeBounds(frames, other, offset, half, best);
    }
    hn::StoreU(hn::Mul(best, shrink), tag, lower + at);
  }
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

HWY_EXPORT(LowerBounds);

void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const BoxF& other, float enough,
                    std::array<float, WideNode::kLanes>& lower) {
  HWY_DYNAMIC_DISPATCH(LowerBounds)(node, frames, other, enough, lower.data());
}

}  // namespace swept::detail
#endif
