// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <type_traits>

#include "geometry/error_model.hpp"
#include "narrowphase/by_coordinates.hpp"
#include "narrowphase/convex.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

/// The result of a closed form for two cores. All vectors are in a's frame.
struct CoreGap {
  double distance;         ///< m; minus the penetration depth where the cores overlap
  double rounding;         ///< m, bound on the error of `distance`
  Eigen::Vector3d normal;  ///< unit, from a to b; in overlap, the shortest way out for b
  Eigen::Vector3d pointA;  ///< m, of a's core: nearest, or deepest in b's
  Eigen::Vector3d pointB;  ///< m, of b's core
  Eigen::Vector3d common;  ///< m, of both cores; valid in overlap
};

template <Convex::Core kind>
using CoreTag = std::integral_constant<Convex::Core, kind>;

using PointCore = CoreTag<Convex::Core::Point>;
using SegmentCore = CoreTag<Convex::Core::Segment>;
using BoxCore = CoreTag<Convex::Core::Box>;
using CylinderCore = CoreTag<Convex::Core::Cylinder>;
using ConeCore = CoreTag<Convex::Core::Cone>;
using EllipsoidCore = CoreTag<Convex::Core::Ellipsoid>;
using PointsCore = CoreTag<Convex::Core::Points>;

/// m. Upper bound on the coordinates of the two cores' points, of their differences and of their
/// witnesses.
[[gnu::always_inline]] inline double magnitudeOf(const Convex& a, const Convex& b,
                                                 const Eigen::Isometry3d& a_from_b) {
  return a.extent + b.extent + a_from_b.translation().cwiseAbs().sum() + a.radius + b.radius;
}

/// m. Lemma: a closed form takes a few dozen operations on coordinates of at most the magnitudes
/// summed here, each with an error of half an epsilon; differences of such coordinates keep that
/// absolute error, and so do norms of differences.
[[gnu::always_inline]] inline double pairRounding(const Convex& a, const Convex& b,
                                                  const Eigen::Isometry3d& a_from_b) {
  return tolerance::kSupportRounding * magnitudeOf(a, b, a_from_b) + a.error + b.error;
}

/// The boundary point of a core nearest to a given point, in the core's frame.
struct ClosestPoint {
  double distance;         ///< m, negative inside
  Eigen::Vector3d normal;  ///< unit, outward
  Eigen::Vector3d point;   ///< m
};

/// A point against a core, from the core's closest point in its own frame.
[[gnu::always_inline]] inline CoreGap gapFromPoint(const ClosestPoint& closestPointOnB,
                                                   const Eigen::Isometry3d& a_from_b,
                                                   double rounding) {
  return {closestPointOnB.distance,
          rounding,
          -turned(a_from_b.linear(), closestPointOnB.normal),
          Eigen::Vector3d::Zero(),
          moved(a_from_b.translation(), 1.0, turned(a_from_b.linear(), closestPointOnB.point)),
          Eigen::Vector3d::Zero()};
}

/// A core against a point, from the core's closest point.
[[gnu::always_inline]] inline CoreGap gapToPoint(const ClosestPoint& closestPointOnA,
                                                 const Eigen::Isometry3d& a_from_b,
                                                 double rounding) {
  return {closestPointOnA.distance, rounding,
          closestPointOnA.normal,   closestPointOnA.point,
          a_from_b.translation(),   a_from_b.translation()};
}

/// The origin of a in the frame of b.
[[gnu::always_inline]] inline Eigen::Vector3d originOfAInB(const Eigen::Isometry3d& a_from_b) {
  return -turnedBack(a_from_b.linear(), a_from_b.translation());
}

}  // namespace swept::detail
