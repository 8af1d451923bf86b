// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/point_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bvh/wide_bvh.hpp"
#include "geometry/point_text.hpp"
#include "point_cloud/cloud_hull.hpp"
#include "point_cloud/cloud_tree.hpp"
#include "point_cloud/curve_order.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

void requireUsable(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) throw std::invalid_argument("point cloud has no points");
  constexpr std::size_t kMostPoints = std::size_t{1} << 30;
  if (points.size() > kMostPoints) {
    throw std::invalid_argument("point cloud has " + std::to_string(points.size()) +
                                " points; allowed: at most " + std::to_string(kMostPoints));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    std::ostringstream message;
    message << "point " << i << " of the point cloud is " << detail::pointText(points[i])
            << "; allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
}

bool isRadius(double radius) {
  return radius >= 0.0 && std::isfinite(radius);
}

}  // namespace

PointCloud PointCloud::build(std::span<const Eigen::Vector3d> points, double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points, radius] { return build(points, radius); });
  }
  if (!isRadius(radius)) {
    std::ostringstream message;
    message << "point cloud radius is " << radius << "; allowed: finite and not negative";
    throw std::invalid_argument(message.str());
  }
  requireUsable(points);
  return ofUsable(points, {}, radius, radius);
}

PointCloud PointCloud::build(std::span<const Eigen::Vector3d> points,
                             std::span<const double> radii) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points, radii] { return build(points, radii); });
  }
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
  const auto [least, largest] = std::ranges::minmax(radii);
  return ofUsable(points, least < largest ? radii : std::span<const double>(), least, largest);
}

PointCloud PointCloud::ofUsable(std::span<const Eigen::Vector3d> points,
                                std::span<const double> radii, double least, double largest) {
  std::vector<int> order = detail::curveOrder(points, Aabb::fit(points));
  std::vector<Eigen::Vector3d> ordered;
  std::vector<double> orderedRadii;
  ordered.reserve(points.size());
  orderedRadii.reserve(radii.size());
  for (const int source : order) {
    ordered.push_back(points[static_cast<std::size_t>(source)]);
    if (!radii.empty()) orderedRadii.push_back(radii[static_cast<std::size_t>(source)]);
  }
  const detail::CloudTree tree({ordered, orderedRadii, largest});
  const ConvexHull hull = detail::cloudHull(ordered, tree);
  auto bvh = std::make_shared<const detail::WideBvh>(tree.bvh());
  return PointCloud(
      std::make_shared<const Data>(Data{std::move(ordered), std::move(orderedRadii),
                                        std::move(order), hull, largest, least, std::move(bvh)}));
}

std::size_t PointCloud::bytes() const {
  return data_->points.capacity() * sizeof(Eigen::Vector3d) +
         data_->radii.capacity() * sizeof(double) + data_->sourceIndices.capacity() * sizeof(int) +
         data_->bvh->bytes();
}

}  // namespace swept
