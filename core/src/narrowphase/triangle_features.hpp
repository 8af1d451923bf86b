// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "swept/core/triangle_pair.hpp"

/// What distance and contact of two triangles share: a frame in which nothing overflows, nearest
/// points by a complete enumeration of the features, and proven separations.
namespace swept::detail {

/// Two triangles relative to the first corner of the first and scaled by a power of two, so that
/// the largest coordinate is near 1 unless it was near enough already. Scaling is exact; the
/// subtraction rounds each coordinate by at most its own 2^-53.
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

/// Proven lower bound on n . (y - x) / |n| over all x of the first triangle and y of the second
/// one: their distance if it is positive. -infinity for directions too short or not finite.
double separationAlong(const TrianglePair& pair, const Eigen::Vector3d& n);

/// The best of separationAlong() over every direction in which two polytopes can be farthest apart:
/// face normals, edge crosses, and `towards` (from the first to the second) itself, as it is and
/// across each edge.
double bestSeparation(const TrianglePair& pair, const Eigen::Vector3d& towards);

/// Perpendicular to x and y. Unlike the rounded cross product it is so up to rounding for nearly
/// parallel x and y as well.
Eigen::Vector3d perpendicular(const Eigen::Vector3d& x, const Eigen::Vector3d& y);

/// A normal of a triangle given by its edges in order, as perpendicular() gives it. Of no use for a
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
