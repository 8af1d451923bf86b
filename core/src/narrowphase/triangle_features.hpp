// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "swept/core/triangle_pair.hpp"

/// Shared by distance and contact of two triangles: a frame in which nothing overflows, nearest
/// points by a complete enumeration of the features, and proven separations.
namespace swept::detail {

/// Two triangles relative to the first corner of the first, scaled by a power of two so that the
/// largest coordinate is near 1, unless it already was. Scaling is exact; the subtraction rounds
/// each coordinate by at most 2^-53 of itself.
struct TrianglePair {
  TrianglePair(const TriangleCorners& a, const TriangleCorners& b);

  std::array<Eigen::Vector3d, 3> p;  ///< corners of the first
  std::array<Eigen::Vector3d, 3> q;  ///< corners of the second
  std::array<Eigen::Vector3d, 3> e;  ///< e[i] leads from p[i] to p[i + 1]
  std::array<Eigen::Vector3d, 3> f;  ///< f[j] leads from q[j] to q[j + 1]
  double size = 0.0;                 ///< largest coordinate magnitude; NaN unless all are finite
  double scale = 1.0;                ///< coordinates here per metre
};

/// A point of each triangle.
struct PointPair {
  Eigen::Vector3d p;
  Eigen::Vector3d q;
  double squared;  ///< of their distance
};

/// Proven lower bound on n . (y - x) / |n| over all x of the first triangle and y of the second: a
/// bound on their distance if it is positive. -infinity for directions that are too short or not
/// finite.
double separationAlong(const TrianglePair& pair, const Eigen::Vector3d& n);

/// The best of separationAlong() over every direction that can give the distance of two polytopes:
/// face normals, cross products of edges, and `towards` (from the first to the second), as it is
/// and orthogonal to each edge.
double bestSeparation(const TrianglePair& pair, const Eigen::Vector3d& towards);

/// Perpendicular to x and y, up to rounding even for nearly parallel x and y, unlike the rounded
/// cross product.
Eigen::Vector3d perpendicular(const Eigen::Vector3d& x, const Eigen::Vector3d& y);

/// A normal of a triangle given by its edges in order, by perpendicular(). Not usable for a
/// triangle without an area.
Eigen::Vector3d faceNormal(const std::array<Eigen::Vector3d, 3>& edges);

/// Nearest point of a triangle, whose edges are in order. Within a few roundings of the
/// coordinates, slivers included.
Eigen::Vector3d nearestOnTriangle(const Eigen::Vector3d& point,
                                  const std::array<Eigen::Vector3d, 3>& corners,
                                  const std::array<Eigen::Vector3d, 3>& edges);

/// Nearest points over all vertex-face, edge-edge and vertex-edge pairs. Within a few roundings of
/// the coordinates of the distance of triangles that do not cross each other, slivers included.
PointPair nearestFeatures(const TrianglePair& pair);

}  // namespace swept::detail
