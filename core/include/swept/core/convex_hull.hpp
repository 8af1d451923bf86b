// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "swept/core/arithmetic.hpp"
#include "swept/core/bounding_sphere.hpp"

namespace swept {

namespace detail {
class SupportPoints;
}

/// Solid convex hull of a set of points.
///
/// It keeps the extreme points. Every given point lies in the hull of the kept points grown by
/// `error()`. Queries add that error to their rounding bound, so a dropped point can never make
/// something Free.
class ConvexHull {
 public:
  /// The hull of `points` (m). Flat and degenerate sets (a point, a segment, a polygon) are hulls
  /// too. Throws std::invalid_argument when `points` is empty or holds a non-finite coordinate.
  static ConvexHull of(std::span<const Eigen::Vector3d> points);
  /// The hull of at most kCoarse vertices of `hull`: those farthest along evenly spread directions.
  /// The other vertices lie within `error()` of it. A hull of at most kFew vertices stays as it is.
  static ConvexHull coarser(const ConvexHull& hull);
  /// The hull scaled by a factor above zero about the point `middle` (m); `error()` is scaled, too.
  static ConvexHull scaled(const ConvexHull& hull, double factor, const Eigen::Vector3d& middle);
  static constexpr std::size_t kFew = 400;  ///< vertices
  static constexpr int kCoarse = 192;       ///< vertices

  /// m, in the local frame.
  const std::vector<Eigen::Vector3d>& vertices() const { return data_->vertices; }
  /// Outward-oriented triangles over `vertices()`; empty when the hull has no volume.
  const std::vector<Eigen::Vector3i>& faces() const { return data_->faces; }
  double error() const { return data_->error; }    ///< m
  double extent() const { return data_->extent; }  ///< m, no vertex is farther from the origin
  /// The smallest ball around the vertices, up to rounding. The hull itself is larger by `error()`.
  const BoundingSphere& ball() const { return data_->ball; }
  /// The vertices in the form that support queries read.
  const detail::SupportPoints& supportPoints() const { return *data_->supportPoints; }

 private:
  struct Data {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Eigen::Vector3i> faces;
    std::shared_ptr<const detail::SupportPoints> supportPoints;
    BoundingSphere ball{};
    double error = 0.0;
    double extent = 0.0;
  };
  explicit ConvexHull(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
