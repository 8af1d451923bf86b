// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "swept/core/convex_hull.hpp"

namespace swept {

namespace detail {
class WideBvh;
}

/// Points with a hierarchy over them. Each point stands for a ball, whose radius is the sensor's
/// error or half a voxel. The cloud is the union of these solid balls; space that the balls
/// surround is not part of it. Immutable; copies share the data: less than 40 bytes a point, and 8
/// more if radii differ.
class PointCloud {
 public:
  /// A cloud of at most 2^30 points (m) with one radius (m). Throws std::invalid_argument when
  /// `points` is empty, for a non-finite coordinate, and for a radius that is negative or not
  /// finite; names the point or the value.
  static PointCloud build(std::span<const Eigen::Vector3d> points, double radius);
  /// With a radius (m) for each point. Throws likewise, and if the numbers of points and radii
  /// differ.
  static PointCloud build(std::span<const Eigen::Vector3d> points, std::span<const double> radii);

  /// m, in the order of the hierarchy.
  const std::vector<Eigen::Vector3d>& points() const { return data_->points; }
  /// For each of points(), its index among the points given.
  const std::vector<int>& sourceIndices() const { return data_->sourceIndices; }
  /// m, radius of the ball around points()[point].
  double radius(std::size_t point) const {
    return data_->radii.empty() ? data_->largestRadius : data_->radii[point];
  }
  double largestRadius() const { return data_->largestRadius; }  ///< m
  double leastRadius() const { return data_->leastRadius; }      ///< m
  /// Contains the points, without their balls. It is their convex hull, or a body of few vertices
  /// around it if there are more than ConvexHull::kFew points.
  const ConvexHull& hull() const { return data_->hull; }
  /// The hierarchy, for the queries.
  const detail::WideBvh& bvh() const { return *data_->bvh; }
  /// Bytes on the heap.
  std::size_t bytes() const;

 private:
  struct Data {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> radii;  ///< empty: all are the same
    std::vector<int> sourceIndices;
    ConvexHull hull;
    double largestRadius = 0.0;
    double leastRadius = 0.0;
    std::shared_ptr<const detail::WideBvh> bvh;  ///< refers to points and radii
  };
  static PointCloud ofUsable(std::span<const Eigen::Vector3d> points, std::span<const double> radii,
                             double least, double largest);
  explicit PointCloud(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
