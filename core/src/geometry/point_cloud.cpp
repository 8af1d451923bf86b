// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/point_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "bvh/wide_bvh.hpp"

namespace swept {

namespace {

void requireUsable(std::span<const Eigen::Vector3d> points, double radius) {
  std::ostringstream message;
  if (points.empty()) throw std::invalid_argument("point cloud has no points");
  if (!(radius >= 0.0) || !std::isfinite(radius)) {
    message << "point cloud radius is " << radius << "; allowed: finite and not negative";
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    message << "point " << i << " of the point cloud is (" << points[i].transpose()
            << "); allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

PointCloud PointCloud::build(std::span<const Eigen::Vector3d> points, double radius) {
  requireUsable(points, radius);
  const std::vector<double> radii(points.size(), radius);
  const auto tree = BvTree<Aabb>::build({points, 1, radii}, SurfaceAreaSplit{});
  auto data = std::make_shared<Data>();
  data->sourceIndices = tree.order();
  data->points.reserve(points.size());
  for (const int source : tree.order()) {
    data->points.push_back(points[source]);
    data->extent = std::max(data->extent, points[source].norm());
  }
  data->radius = radius;
  data->bvh = std::make_shared<const detail::WideBvh>(tree);
  return PointCloud(std::move(data));
}

}  // namespace swept
