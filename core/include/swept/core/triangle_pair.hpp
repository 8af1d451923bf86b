// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "swept/core/arithmetic.hpp"

namespace swept {

/// The corners of a triangle, a closed set in space. It may be degenerate (a segment, a point).
using TriangleCorners = std::array<Eigen::Vector3d, 3>;  ///< m

/// Whether two triangles, as closed sets in one frame, share a point: touching counts.
///
/// The decision is exact (no tolerance, every degeneracy included) for coordinates that are zero or
/// of a magnitude in [1e-90, 1e90] m. Outside that range, and for NaN, the answer errs only towards
/// true. It is symmetric in its arguments and independent of the order of the corners. The decision
/// follows Devillers and Guigue, "Faster triangle-triangle intersection tests" (2002); the signs
/// are those of Shewchuk's expansions (1997) behind a floating-point filter.
bool trianglesTouch(const TriangleCorners& a, const TriangleCorners& b);

/// Whether two triangles of one mesh, given by the indices of their vertices, have a vertex in
/// common. Such triangles always touch.
inline bool shareVertex(const Eigen::Vector3i& t, const Eigen::Vector3i& u) {
  for (const int v : u) {
    if (t[0] == v || t[1] == v || t[2] == v) return true;
  }
  return false;
}

/// The distance between two triangles, bounded on both sides.
struct TriangleDistance {
  double lower;            ///< m; proven, rounding included: no two points are nearer; >= 0
  double upper;            ///< m; |pointB - pointA|; 0 exactly if the triangles touch
  Eigen::Vector3d pointA;  ///< m; a nearest point of the first triangle, up to rounding
  Eigen::Vector3d pointB;  ///< m; its partner on the second triangle; pointA itself if they touch
};

/// The distance of two triangles in one frame (m). upper is 0 if and only if trianglesTouch() is
/// true, and then lower is 0 too. In the range where that is exact, upper is within 1e-14, and
/// upper - lower within 1e-13, of the largest coordinate difference between the two triangles, also
/// for slivers and triangles without an area. If a coordinate is not finite, lower is 0 and upper
/// is infinite.
TriangleDistance triangleDistance(const TriangleCorners& a, const TriangleCorners& b);

/// As above, but may stop once the distance is proven to exceed `enough` (m): then lower > enough,
/// upper is infinity and the points are corners of their triangles, not nearest ones.
TriangleDistance triangleDistance(const TriangleCorners& a, const TriangleCorners& b,
                                  double enough);

/// One contact of two triangles that touch.
///
/// Its depth is the local penetration of the FCL paper (Pan, Chitta, Manocha 2012, section IV): the
/// least translation along the normal of one of the two triangles' planes that separates them. A
/// triangle has no inside, so both directions along each normal are candidates. Unlike a depth
/// under the whole plane, only the part of one triangle over the other one counts.
struct TriangleContact {
  Eigen::Vector3d pointA;  ///< m; the point of the first triangle that goes deepest
  Eigen::Vector3d pointB;  ///< m; pointA - depth * normal
  Eigen::Vector3d point;   ///< m; a common point: middle of the shared segment, or of the region
  Eigen::Vector3d normal;  ///< unit, first to second: moving b by depth * normal separates
  double depth;            ///< m; >= 0; 0 if they merely touch
};

/// A contact of two triangles for which trianglesTouch() is true, in their frame (m); exact up to
/// rounding for triangles that are not slivers. Two triangles without an area have depth 0. One
/// without an area is separated along the other one's normal. For triangles that do not touch, the
/// answer is finite, of depth 0, and otherwise unspecified.
TriangleContact triangleContact(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace swept
