// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "swept/core/point_cloud.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {

/// The points center + s half, |s| <= 1, such as the path of a moving ball's centre.
struct LineSegment {
  Eigen::Vector3d center;                          ///< m
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< m
};

///@{
/// Whether all triangles (not what they enclose), or all balls of a cloud, are proven to be farther
/// than `radius` (m, not negative) from the whole segment (in their frame). It does not compute the
/// distance, and is therefore many times faster than distance(). It may miss a proof if the
/// distance is within about 1e-6 of the shape's size of that radius. False for non-finite input.
bool isFarther(const TriangleMesh& mesh, const LineSegment& segment, double radius);
bool isFarther(const PointCloud& cloud, const LineSegment& segment, double radius);
///@}

/// Whether all of a body, what its mesh encloses included, is proven to be farther than `radius`
/// (m, not negative) from the whole segment (in its frame). As for isFarther(), a proof may be
/// missed if the distance is near that radius.
bool isBodyFarther(const Shape& body, const LineSegment& segment, double radius);

/// m. Proven lower bound of the distance from `point` (m, the cloud's frame) to the nearest ball;
/// it is too small only by some roundings of the coordinates. Within balls it is minus the depth in
/// the ball where the point is deepest. If the bound is `enough` (m) or more, returns `enough`,
/// which is faster. Minus infinity for a non-finite point. For a ball around the point, subtract
/// its radius.
double clearance(const PointCloud& cloud, const Eigen::Vector3d& point,
                 double enough = std::numeric_limits<double>::infinity());

///@{
/// A point (m) of a triangle, or in a ball of a cloud, that is at most `radius` (m) from `point`,
/// up to rounding in double precision; the first one found. No value: there is no such point. (One
/// whose distance is within about 1e-6 of the shape's size of that radius may be missed.)
std::optional<Eigen::Vector3d> pointWithin(const TriangleMesh& mesh, const Eigen::Vector3d& point,
                                           double radius);
std::optional<Eigen::Vector3d> pointWithin(const PointCloud& cloud, const Eigen::Vector3d& point,
                                           double radius);
///@}

}  // namespace swept
