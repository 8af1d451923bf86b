// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <span>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// The point of a set of triangles, or of a set of points, nearest to a given one.
///
/// Lemma: the distance found is off by less than `error(p)`, either way. Above: each compared value
/// is the distance of p from a convex combination of corners. Below, there are two losses. (1) A
/// box is skipped if its distance, in single precision, exceeds the best. Fewer than twelve
/// roundings of coordinates relative to the origin of its node, each 2^-24 of at most twice the
/// extent of the tree and the distance of p from its middle, are below 2e-6 of these. If squares
/// underflow they are off by less than kNormalSquare, by which they may exceed the best. (2) The
/// distance from the three sides of a triangle is exact up to rounding in double, about 1e-16 of
/// the coordinates. A nearest point strictly inside it can be missed only if its barycentric
/// coordinates, whose error is about u L / w for a triangle of length L and width w, have the wrong
/// sign: then a side is as near up to the smaller of w and u L^2 / w, which is below 1e-7 L.
/// Together, 4e-6 of the extent and the distance from the middle, and 1e-15 of the coordinates,
/// cover all of this.
class Nearest {
 public:
  struct Found {
    double squared = std::numeric_limits<double>::infinity();  ///< m^2
    Eigen::Vector3d point = Eigen::Vector3d::Zero();           ///< m
    int primitive = -1;  ///< -1: nothing is nearer than the bound given
  };

  /// `triangles` are in the order of the tree's leaves; all arguments must outlive this.
  Nearest(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles,
          const WideBvh& bvh);
  /// For points, in the order of the tree's leaves.
  Nearest(std::span<const Eigen::Vector3d> points, const WideBvh& bvh);

  /// Searches only for something nearer than `bound` (m).
  Found find(const Eigen::Vector3d& p, double bound) const;
  double error(const Eigen::Vector3d& p) const;  ///< m
  /// Normal of the triangle; zero if rounding leaves none, and for points.
  Eigen::Vector3d unitNormal(int primitive) const;

 private:
  void test(int primitive, const Eigen::Vector3d& p, Found& best) const;

  std::span<const Eigen::Vector3d> vertices_;  ///< or points
  std::span<const Eigen::Vector3i> triangles_;
  const WideBvh& bvh_;
};

}  // namespace swept::detail
