// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "swept/core/point_cloud.hpp"
#include "swept/core/segment_query.hpp"

namespace swept::detail {

/// A ball around some of a cloud's balls, which are below a node of its hierarchy, or one of them.
struct CloudPart {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m, the cloud's frame
  double radius = 0.0;                               ///< m
  std::int32_t node = 0;                             ///< negative: the ball itself

  bool isBall() const { return node < 0; }
};

/// Adds the parts below a node that are not proven farther than `radius` (m) from the segment (the
/// cloud's frame). Node 0 is the root. Every ball below the node that is not farther is in one of
/// them.
void addPartsNear(const PointCloud& cloud, std::int32_t node, const LineSegment& segment,
                  double radius, std::vector<CloudPart>& parts);

}  // namespace swept::detail
