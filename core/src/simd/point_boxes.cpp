// SPDX-License-Identifier: BSD-3-Clause
#include "simd/point_boxes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/point_boxes.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::kLanes>;

std::uint32_t PointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         float* squared) {
  const Tag tag;
  float at[3];
  for (int i = 0; i < 3; ++i) at[i] = static_cast<float>(p[i] - node.origin[i]);
  std::uint32_t within = 0;
  for (std::size_t first = 0; first < WideNode::kLanes; first += hn::Lanes(tag)) {
    const auto loaded = [&](const WideNode::Row& row) { return hn::Load(tag, row.data() + first); };
    const auto x = hn::Sub(hn::Set(tag, at[0]), loaded(node.center[0]));
    const auto y = hn::Sub(hn::Set(tag, at[1]), loaded(node.center[1]));
    const auto z = hn::Sub(hn::Set(tag, at[2]), loaded(node.center[2]));
    auto sum = hn::Zero(tag);
    for (int j = 0; j < 3; ++j) {
      const std::array<WideNode::Row, 3>& axis = node.axes[j];
      const auto along = hn::MulAdd(loaded(axis[0]), x,
                                    hn::MulAdd(loaded(axis[1]), y, hn::Mul(loaded(axis[2]), z)));
      const auto gap = hn::Max(hn::Sub(hn::Abs(along), loaded(node.half[j])), hn::Zero(tag));
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

HWY_EXPORT(PointBoxes);

std::uint32_t pointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         std::array<float, WideNode::kLanes>& squared) {
  const std::uint32_t inUse = (std::uint32_t{1} << node.count) - 1;
  return HWY_DYNAMIC_DISPATCH(PointBoxes)(node, p, most, squared.data()) & inUse;
}

}  // namespace swept::detail
#endif
