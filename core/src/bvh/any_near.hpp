// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "bvh/near_boxes.hpp"
#include "bvh/pending_boxes.hpp"
#include "bvh/wide_bvh.hpp"
#include "swept/core/segment_query.hpp"

namespace swept::detail {

/// A segment and a radius around it (m), as segmentBoxes() takes them for a node.
struct NearQuery {
  NearQuery(const WideNode& node, const LineSegment& segment, double radius) {
    double size = static_cast<double>(node.reach);
    for (int i = 0; i < 3; ++i) {
      const double center = segment.center[i] - node.origin[i];
      near.center[i] = static_cast<float>(center);
      near.half[i] = static_cast<float>(segment.half[i]);
      size += std::abs(center) + std::abs(segment.half[i]);
    }
    // Lemma: see segmentBoxes. The square, rounded to single precision, is off by less than one
    // more 2^-24 of the size: no bound is larger than that, so where the square is nothing is left
    // out. Where squares underflow they are off by less than kNormalSquare.
    const double reach = radius + 50.0 * 0x1p-24 * size;
    most = static_cast<float>(reach * reach + kNormalSquare);
  }

  NearSegment near;
  float most;  ///< m^2
};

/// Visits the primitives whose boxes are not proven to be farther than `radius` from the segment,
/// roughly nearest first, until `stop` is true for one. Returns whether it was.
template <typename Stop>
bool anyNear(const WideBvh& bvh, const LineSegment& segment, double radius, const Stop& stop) {
  PendingBoxes pending;
  while (!pending.isEmpty()) {
    const std::int32_t top = pending.pop().child;
    if (top < 0) {
      if (stop(~top)) return true;
      continue;
    }
    if (bvh.isBucket(top)) {
      // Testing balls is as quick as testing boxes around them.
      const auto [first, last] = bvh.pointsOf(top);
      for (std::int32_t point = first; point < last; ++point) {
        if (stop(point)) return true;
      }
      continue;
    }
    const WideNode& node = bvh.nodes()[static_cast<std::size_t>(top)];
    const NearQuery query(node, segment, radius);
    alignas(32) std::array<float, WideNode::kLanes> squared;
    for (std::uint32_t open = segmentBoxes(node, query.near, query.most, squared); open != 0;
         open &= open - 1) {
      const int lane = std::countr_zero(open);
      pending.push({squared[lane], node.child[lane]});
    }
  }
  return false;
}

}  // namespace swept::detail
