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
/// Keeps the points that are extreme; every given point lies in the hull of the kept ones grown by
/// `error()`. Queries against a hull add that error to their rounding bound, so dropping a point
/// can never make something Free.
class ConvexHull {
 public:
  /// Throws std::invalid_argument when `points` is empty or holds a non-finite coordinate. Flat and
  /// degenerate sets (a point, a segment, a polygon) are hulls too.
  static ConvexHull of(std::span<const Eigen::Vector3d> points);
  /// Of at most kCoarse vertices of `hull`, those farthest along directions that are spread evenly;
  /// the others lie within `error()` of it. A hull of no more than kFew vertices stays as it is.
  static ConvexHull coarser(const ConvexHull& hull);
  /// Larger by a factor above zero from a middle (m), and so is `error()`.
  static ConvexHull scaled(const ConvexHull& hull, double factor, const Eigen::Vector3d& middle);
  static constexpr std::size_t kFew = 400;  ///< vertices
  static constexpr int kCoarse = 192;       ///< vertices

  /// m, in the local frame.
  const std::vector<Eigen::Vector3d>& vertices() const { return data_->vertices; }
  /// Outward-oriented triangles over `vertices()`; empty when the hull has no volume.
  const std::vector<Eigen::Vector3i>& faces() const { return data_->faces; }
  double error() const { return data_->error; }    ///< m
  double extent() const { return data_->extent; }  ///< m, no vertex is farther from the origin
  /// Of the vertices: the smallest, but for rounding. The hull itself is larger by `error()`.
  const BoundingSphere& ball() const { return data_->ball; }
  /// The vertices as support queries read them.
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
