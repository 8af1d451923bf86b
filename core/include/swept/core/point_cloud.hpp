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

/// Points, each standing for a ball of one radius (what a sensor may be off by, or half a voxel),
/// with a hierarchy over them. A union of solids: what its balls surround is not part of it.
/// Immutable; copies share the data.
class PointCloud {
 public:
  /// `radius`: m. Throws std::invalid_argument when `points` is empty, for a non-finite coordinate,
  /// and for a radius that is negative or not finite; names the point or the value.
  static PointCloud build(std::span<const Eigen::Vector3d> points, double radius);

  /// m, in the order of the hierarchy.
  const std::vector<Eigen::Vector3d>& points() const { return data_->points; }
  /// For each of points(), its index among the points given.
  const std::vector<int>& sourceIndices() const { return data_->sourceIndices; }
  double radius() const { return data_->radius; }         ///< m
  const ConvexHull& hull() const { return data_->hull; }  ///< of the points, without their balls
  /// The same, but of few points and with an error() to match: quick to ask.
  const ConvexHull& coarseHull() const { return data_->coarseHull; }
  const detail::WideBvh& bvh() const { return *data_->bvh; }

 private:
  struct Data {
    std::vector<Eigen::Vector3d> points;
    std::vector<int> sourceIndices;
    ConvexHull hull;
    ConvexHull coarseHull;
    double radius = 0.0;
    std::shared_ptr<const detail::WideBvh> bvh;
  };
  explicit PointCloud(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
