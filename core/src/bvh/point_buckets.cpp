// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bvh/box_fit.hpp"
#include "bvh/wide_bvh.hpp"
#include "geometry/error_model.hpp"

namespace swept::detail {

/// Lemma: the origin is a point of the bucket, too. The offset of a point from it rounds by half an
/// epsilon of the coordinates, and in single precision by 2^-24 of itself, or by less than the
/// least normal number, which aboveInSingle adds.
void makeNode(const PointBuckets& buckets, std::int32_t bucket, WideNode& node) {
  constexpr double kLargest = 1e30;  // m; boxes of farther points are unbounded
  const std::size_t first = static_cast<std::size_t>(bucket) * WideNode::kLanes;
  const std::size_t count = std::min<std::size_t>(buckets.points.size() - first, WideNode::kLanes);
  const Eigen::Vector3d* points = buckets.points.data() + first;
  node.origin = points[0];
  node.count = static_cast<std::int32_t>(count);
  double far = 0.0;
  std::array<double, WideNode::kLanes> radius;
  for (std::size_t lane = 0; lane < WideNode::kLanes; ++lane) {
    const std::size_t point = std::min(lane, count - 1);
    radius[lane] = buckets.radiusOf(first + point);
    far = std::max(far, points[point].lpNorm<Eigen::Infinity>() + radius[lane]);
    node.child[lane] = ~static_cast<std::int32_t>(first + point);
  }
  const double slack =
      far < kLargest ? kBucketRounding * far : std::numeric_limits<double>::infinity();
  std::array<double, WideNode::kLanes> size{};
  for (int i = 0; i < 3; ++i) {
    for (std::size_t lane = 0; lane < WideNode::kLanes; ++lane) {
      const double apart = points[std::min(lane, count - 1)][i] - node.origin[i];
      const double offset = far < kLargest ? apart : 0.0;
      const double half = radius[lane] + slack + 0x1p-24 * std::abs(offset);
      node.center[i][lane] = static_cast<float>(offset);
      node.half[i][lane] = aboveInSingle(half);
      size[lane] += static_cast<double>(std::abs(node.center[i][lane])) +
                    static_cast<double>(node.half[i][lane]);
    }
    for (int j = 0; j < 3; ++j) node.axes[j][i].fill(i == j ? 1.0F : 0.0F);
  }
  node.reach = aboveInSingle(*std::ranges::max_element(size));
}

}  // namespace swept::detail
