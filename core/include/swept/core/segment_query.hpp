// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {

/// The points center + s half, |s| <= 1, such as the middle of a moving ball passes.
struct LineSegment {
  Eigen::Vector3d center;                          ///< m
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< m
};

///@{
/// Whether the triangles (not what they enclose), or the balls of a cloud, are all proven to be
/// farther than `radius` (m, not negative) from the whole segment (in their frame). Does not find
/// the distance, which makes it many times faster than distance(). May miss a proof where the two
/// are within about 1e-6 of the shape's size of that radius. False for what is not finite.
bool isFarther(const TriangleMesh& mesh, const LineSegment& segment, double radius);
bool isFarther(const PointCloud& cloud, const LineSegment& segment, double radius);
///@}

/// m; proven: how far `point` (m, the cloud's frame) is from the nearest ball at least, less by
/// some roundings of the coordinates alone; within balls, minus the depth in the one where it is
/// deepest. Where that is `enough` (m) or more, `enough`, which is found sooner. Minus infinity for
/// a point that is not finite. The clearance of a ball around the point is less by its radius.
double clearance(const PointCloud& cloud, const Eigen::Vector3d& point,
                 double enough = std::numeric_limits<double>::infinity());

///@{
/// A point (m) of a triangle, or in a ball of a cloud, that is not farther than `radius` (m) from
/// `point`, up to rounding in double precision; the first one found. None: there is no such point,
/// but perhaps where it is within about 1e-6 of the shape's size of that radius.
std::optional<Eigen::Vector3d> pointWithin(const TriangleMesh& mesh, const Eigen::Vector3d& point,
                                           double radius);
std::optional<Eigen::Vector3d> pointWithin(const PointCloud& cloud, const Eigen::Vector3d& point,
                                           double radius);
///@}

}  // namespace swept
