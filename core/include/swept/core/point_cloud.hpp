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

/// Points, each standing for a ball (what a sensor may be off by, or half a voxel), with a
/// hierarchy over them. A union of solids: what its balls surround is not part of it. Immutable;
/// copies share the data.
class PointCloud {
 public:
  /// `radius`: m. Throws std::invalid_argument when `points` is empty, for a non-finite coordinate,
  /// and for a radius that is negative or not finite; names the point or the value.
  static PointCloud build(std::span<const Eigen::Vector3d> points, double radius);
  /// With a radius (m) for each point. Throws likewise, and for another number of radii.
  static PointCloud build(std::span<const Eigen::Vector3d> points, std::span<const double> radii);

  /// m, in the order of the hierarchy.
  const std::vector<Eigen::Vector3d>& points() const { return data_->points; }
  /// For each of points(), its index among the points given.
  const std::vector<int>& sourceIndices() const { return data_->sourceIndices; }
  const std::vector<double>& radii() const { return data_->radii; }  ///< m, of points()
  double largestRadius() const { return data_->largestRadius; }      ///< m
  double leastRadius() const { return data_->leastRadius; }          ///< m
  const ConvexHull& hull() const { return data_->hull; }  ///< of the points, without their balls
  /// The same, but of few points and with an error() to match: quick to ask.
  const ConvexHull& coarseHull() const { return data_->coarseHull; }
  const detail::WideBvh& bvh() const { return *data_->bvh; }

 private:
  struct Data {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> radii;
    std::vector<int> sourceIndices;
    ConvexHull hull;
    ConvexHull coarseHull;
    double largestRadius = 0.0;
    double leastRadius = 0.0;
    std::shared_ptr<const detail::WideBvh> bvh;
  };
  explicit PointCloud(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
