// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// From the nearest point of an edge to a point, which is `fromStart` from the edge's start.
inline Eigen::Vector3d awayFromEdge(const Eigen::Vector3d& fromStart, const Eigen::Vector3d& edge) {
  const double t = std::clamp(fromStart.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return fromStart - t * edge;
}

/// On a triangle, by the regions of its corners, edges and face (Ericson 2005, section 5.1.5).
/// False for a point on the triangle, where the normal has no digits, and if the triangle is so
/// thin that the slab along the normal is not as wide as the distance.
[[gnu::always_inline]] inline bool closestPointOn(PointsCore, const Convex& triangle,
                                                  const Eigen::Vector3d& p, ClosestPoint& closest) {
  if (triangle.points.size() != 3) return false;
  const Eigen::Vector3d& a = triangle.points[0];
  const Eigen::Vector3d& b = triangle.points[1];
  const Eigen::Vector3d& c = triangle.points[2];
  const Eigen::Vector3d e = b - a;
  const Eigen::Vector3d f = c - a;
  const Eigen::Vector3d toA = p - a;
  const double d1 = e.dot(toA);
  const double d2 = f.dot(toA);
  const double ee = e.squaredNorm();
  const double ef = e.dot(f);
  const double ff = f.squaredNorm();
  const double d3 = d1 - ee;  // e . (p - b)
  const double d4 = d2 - ef;  // f . (p - b)
  const double d5 = d1 - ef;  // e . (p - c)
  const double d6 = d2 - ff;  // f . (p - c)
  const double areaA = d3 * d6 - d5 * d4;
  const double areaB = d5 * d2 - d1 * d6;
  const double areaC = d1 * d4 - d3 * d2;
  Eigen::Vector3d away;
  bool onFace = false;
  if (d1 <= 0.0 && d2 <= 0.0) {
    away = toA;
  } else if (d3 >= 0.0 && d4 <= d3) {
    away = p - b;
  } else if (d6 >= 0.0 && d5 <= d6) {
    away = p - c;
  } else if (areaC <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    away = toA - (d1 / ee) * e;
  } else if (areaB <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    away = toA - (d2 / ff) * f;
  } else if (areaA <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    away = (p - b) - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  } else {
    // Lemma: each d is off by a few ulps of the sum of squares and is at most that, so an area is
    // off by less than 150 ulps of the sum's square. If the closest point may be beside the
    // triangle, it is searched on the nearby edge.
    constexpr double kAreaRounding = 4e-14;
    const double squares = ee + ff + toA.squaredNorm();
    const double least = std::min(areaA, std::min(areaB, areaC));
    if (least > kAreaRounding * squares * squares) {
      // Along the normal, which keeps the digits that a difference of near points loses.
      const Eigen::Vector3d normal = e.cross(f);
      away = (normal.dot(toA) / normal.squaredNorm()) * normal;
      onFace = true;
    } else if (least == areaC) {
      away = awayFromEdge(toA, e);
    } else if (least == areaB) {
      away = awayFromEdge(toA, f);
    } else {
      away = awayFromEdge(p - b, c - b);
    }
  }
  const double squared = away.squaredNorm();
  if (!(squared > 1e-280 && squared < 1e280)) return false;
  closest.distance = std::sqrt(squared);
  closest.normal = away * (1.0 / closest.distance);
  closest.point = p - away;
  const double alongA = closest.normal.dot(toA);
  const double alongB = closest.normal.dot(p - b);
  const double alongC = closest.normal.dot(p - c);
  const double allowed =
      kSlab * (triangle.extent + std::abs(p.x()) + std::abs(p.y()) + std::abs(p.z()));
  // The normal of a thin triangle has few digits: the closest point is on the triangle only if all
  // corners are in the closest point's plane.
  const bool flat = std::max(alongA, std::max(alongB, alongC)) - closest.distance <= allowed;
  return closest.distance - std::min(alongA, std::min(alongB, alongC)) <= allowed &&
         (flat || !onFace);
}

}  // namespace swept::detail
