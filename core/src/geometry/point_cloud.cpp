// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/point_cloud.hpp"

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
  const auto tree =
      TreeTopology::build({points, 1, radii}, SurfaceAreaSplit{}, detail::WideNode::kLanes);
  std::vector<Eigen::Vector3d> ordered;
  ordered.reserve(points.size());
  for (const int source : tree.order) ordered.push_back(points[source]);
  auto bvh = std::make_shared<const detail::WideBvh>(tree, PrimitivePoints{ordered, 1, radii});
  const ConvexHull hull = ConvexHull::of(points);
  return PointCloud(std::make_shared<const Data>(Data{
      std::move(ordered), tree.order, hull, ConvexHull::coarser(hull), radius, std::move(bvh)}));
}

}  // namespace swept
