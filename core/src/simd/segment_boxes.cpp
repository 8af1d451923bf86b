// SPDX-License-Identifier: BSD-3-Clause
#include "simd/segment_boxes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/segment_boxes.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::kLanes>;

/// Coordinate j of every point of the segment, along axis j of a box, is at least |a . x| - |a . g|
/// in magnitude.
std::uint32_t SegmentBoxes(const WideNode& node, const NearSegment& segment, float most,
                           float* squared) {
  const Tag tag;
  std::uint32_t within = 0;
  for (std::size_t first = 0; first < WideNode::kLanes; first += hn::Lanes(tag)) {
    const auto loaded = [&](const WideNode::Row& row) { return hn::Load(tag, row.data() + first); };
    const auto x = hn::Sub(hn::Set(tag, segment.center[0]), loaded(node.center[0]));
    const auto y = hn::Sub(hn::Set(tag, segment.center[1]), loaded(node.center[1]));
    const auto z = hn::Sub(hn::Set(tag, segment.center[2]), loaded(node.center[2]));
    const auto gx = hn::Set(tag, segment.half[0]);
    const auto gy = hn::Set(tag, segment.half[1]);
    const auto gz = hn::Set(tag, segment.half[2]);
    auto sum = hn::Zero(tag);
    for (int j = 0; j < 3; ++j) {
      const auto ax = loaded(node.axes[j][0]);
      const auto ay = loaded(node.axes[j][1]);
      const auto az = loaded(node.axes[j][2]);
      const auto along = hn::MulAdd(ax, x, hn::MulAdd(ay, y, hn::Mul(az, z)));
      const auto sweep = hn::MulAdd(ax, gx, hn::MulAdd(ay, gy, hn::Mul(az, gz)));
      const auto beyond = hn::Sub(hn::Sub(hn::Abs(along), hn::Abs(sweep)), loaded(node.half[j]));
      const auto gap = hn::Max(beyond, hn::Zero(tag));
      sum = hn::MulAdd(gap, gap, sum);
    }
    hn::StoreU(sum, tag, squared + first);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(hn::Gt(sum, hn::Set(tag, most))), bits);
    within |= std::uint32_t{bits[0]} << first;
  }
  return within;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

HWY_EXPORT(SegmentBoxes);

std::uint32_t segmentBoxes(const WideNode& node, const NearSegment& segment, float most,
                           std::array<float, WideNode::kLanes>& squared) {
  const std::uint32_t inUse = (std::uint32_t{1} << node.count) - 1;
  return HWY_DYNAMIC_DISPATCH(SegmentBoxes)(node, segment, most, squared.data()) & inUse;
}

}  // namespace swept::detail
#endif
