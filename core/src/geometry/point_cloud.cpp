// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/point_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "bvh/wide_bvh.hpp"

namespace swept {

namespace {

void requireUsable(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) throw std::invalid_argument("point cloud has no points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    std::ostringstream message;
    message << "point " << i << " of the point cloud is (" << points[i].transpose()
            << "); allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
}

bool isRadius(double radius) {
  return radius >= 0.0 && std::isfinite(radius);
}

}  // namespace

PointCloud PointCloud::build(std::span<const Eigen::Vector3d> points, double radius) {
  if (!isRadius(radius)) {
    std::ostringstream message;
    message << "point cloud radius is " << radius << "; allowed: finite and not negative";
    throw std::invalid_argument(message.str());
  }
  return build(points, std::vector<double>(points.size(), radius));
}

PointCloud PointCloud::build(std::span<const Eigen::Vector3d> points,
                             std::span<const double> radii) {
  requireUsable(points);
  if (radii.size() != points.size()) {
    std::ostringstream message;
    message << "point cloud has " << points.size() << " points, but " << radii.size() << " radii";
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (isRadius(radii[i])) continue;
    std::ostringstream message;
    message << "radius " << i << " of the point cloud is " << radii[i]
            << "; allowed: finite and not negative";
    throw std::invalid_argument(message.str());
  }
  const auto tree =
      TreeTopology::build({points, 1, radii}, SurfaceAreaSplit{}, detail::WideNode::kLanes);
  std::vector<Eigen::Vector3d> ordered;
  std::vector<double> orderedRadii;
  ordered.reserve(points.size());
  orderedRadii.reserve(points.size());
  for (const int source : tree.order) {
    ordered.push_back(points[source]);
    orderedRadii.push_back(radii[source]);
  }
  auto bvh =
      std::make_shared<const detail::WideBvh>(tree, PrimitivePoints{ordered, 1, orderedRadii});
  const auto [least, largest] = std::minmax_element(radii.begin(), radii.end());
  const ConvexHull hull = ConvexHull::of(points);
  return PointCloud(std::make_shared<const Data>(Data{std::move(ordered), std::move(orderedRadii),
                                                      tree.order, hull, ConvexHull::coarser(hull),
                                                      *largest, *least, std::move(bvh)}));
}

}  // namespace swept
