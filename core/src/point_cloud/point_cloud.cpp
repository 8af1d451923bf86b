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
#include "threads/crew.hpp"

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

/// Enough to be worth a thread of their own: a millisecond of work.
constexpr std::size_t kPointsOfThread = 16384;

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
  detail::Crew crew(detail::threadsFor(points.size(), kPointsOfThread));
  std::vector<int> order = detail::curveOrder(points, Aabb::fit(points), crew);
  std::vector<Eigen::Vector3d> ordered(points.size());
  std::vector<double> orderedRadii(radii.size());
  crew.forPieces(points.size(), kPointsOfThread / 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto source = static_cast<std::size_t>(order[i]);
      ordered[i] = points[source];
      if (!radii.empty()) orderedRadii[i] = radii[source];
    }
  });
  const detail::CloudTree tree({ordered, orderedRadii, largest}, crew);
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
