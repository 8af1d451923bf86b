// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/cloud_parts.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "bvh/any_near.hpp"
#include "bvh/near_boxes.hpp"
#include "bvh/node_ball.hpp"
#include "bvh/wide_bvh.hpp"
#include "geometry/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

CloudPart partAround(const WideNode& node, int lane) {
  const NodeBall ball(node, lane);
  return {ball.center, ball.radius, node.child[lane]};
}

}  // namespace

void addPartsNear(const PointCloud& cloud, std::int32_t index, const LineSegment& segment,
                  double radius, std::vector<CloudPart>& parts) {
  const WideBvh& bvh = cloud.bvh();
  if (bvh.isBucket(index)) {
    const double squaredLength = segment.half.squaredNorm();
    const double inverse = squaredLength > 0.0 ? 1.0 / squaredLength : 0.0;
    const double size = segment.center.lpNorm<1>() + segment.half.lpNorm<1>() + radius;
    const auto [first, last] = bvh.pointsOf(index);
    for (std::int32_t i = first; i < last; ++i) {
      const Vector3d& point = cloud.points()[static_cast<std::size_t>(i)];
      const double own = cloud.radius(static_cast<std::size_t>(i));
      const Vector3d y = segment.center - point;
      const double along = std::clamp(-y.dot(segment.half) * inverse, -1.0, 1.0);
      const double most = radius + own + kSegmentRounding * (size + point.lpNorm<1>());
      if (!((y + along * segment.half).squaredNorm() > most * most))
        parts.push_back({point, own, -1});
    }
    return;
  }
  const WideNode& node = bvh.nodes()[static_cast<std::size_t>(index)];
  const NearQuery query(node, segment, radius);
  alignas(32) std::array<float, WideNode::kLanes> squared;
  for (std::uint32_t open = segmentBoxes(node, query.near, query.most, squared); open != 0;
       open &= open - 1)
    parts.push_back(partAround(node, std::countr_zero(open)));
}

}  // namespace swept::detail
