// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/near_boxes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/near_boxes.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::kLanes>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes dot(const Lanes (&a)[3], const Lanes (&b)[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

/// For a set of points around `center`: `away` gives the least distance of the set from a box's
/// middle plane across an axis. Its arguments are the axis and the distance of `center` from that
/// plane.
template <typename Away>
HWY_INLINE std::uint32_t within(const WideNode& node, const float* center, const Away& away,
                                float most, float* squared) {
  const Tag tag;
  std::uint32_t found = 0;
  for (std::size_t first = 0; first < WideNode::kLanes; first += hn::Lanes(tag)) {
    const auto loaded = [&](const WideNode::Row& row) { return hn::Load(tag, row.data() + first); };
    const Lanes between[3] = {hn::Sub(hn::Set(tag, center[0]), loaded(node.center[0])),
                              hn::Sub(hn::Set(tag, center[1]), loaded(node.center[1])),
                              hn::Sub(hn::Set(tag, center[2]), loaded(node.center[2]))};
    auto sum = hn::Zero(tag);
    for (int j = 0; j < 3; ++j) {
      const Lanes axis[3] = {loaded(node.axes[j][0]), loaded(node.axes[j][1]),
                             loaded(node.axes[j][2])};
      const auto beyond = hn::Sub(away(axis, hn::Abs(dot(axis, between))), loaded(node.half[j]));
      const auto gap = hn::Max(beyond, hn::Zero(tag));
      sum = hn::MulAdd(gap, gap, sum);
    }
    hn::StoreU(sum, tag, squared + first);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(hn::Gt(sum, hn::Set(tag, most))), bits);
    found |= std::uint32_t{bits[0]} << first;
  }
  return found;
}

std::uint32_t PointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         float* squared) {
  float at[3];
  for (int i = 0; i < 3; ++i) at[i] = static_cast<float>(p[i] - node.origin[i]);
  const auto same = [](const Lanes(&)[3], const Lanes& along) { return along; };
  return within(node, at, same, most, squared);
}

/// Coordinate j of every point of the segment, along axis j of a box, is at least |a . x| - |a . g|
/// in magnitude.
std::uint32_t SegmentBoxes(const WideNode& node, const NearSegment& segment, float most,
                           float* squared) {
  const Tag tag;
  const Lanes half[3] = {hn::Set(tag, segment.half[0]), hn::Set(tag, segment.half[1]),
                         hn::Set(tag, segment.half[2])};
  const auto nearer = [&](const Lanes(&axis)[3], const Lanes& along) {
    return hn::Sub(along, hn::Abs(dot(axis, half)));
  };
  return within(node, segment.center.data(), nearer, most, squared);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(PointBoxes);
SWEPT_DISPATCH_TABLE(SegmentBoxes);

namespace {

std::uint32_t inUse(const WideNode& node) {
  return (std::uint32_t{1} << node.count) - 1;
}

}  // namespace

std::uint32_t pointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         std::array<float, WideNode::kLanes>& squared) {
  return SWEPT_DISPATCH(PointBoxes)(node, p, most, squared.data()) & inUse(node);
}

std::uint32_t segmentBoxes(const WideNode& node, const NearSegment& segment, float most,
                           std::array<float, WideNode::kLanes>& squared) {
  return SWEPT_DISPATCH(SegmentBoxes)(node, segment, most, squared.data()) & inUse(node);
}

}  // namespace swept::detail
#endif
