// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace swept::detail {

/// Emits the corners of the part of a convex polygon (or segment, or point) on one side of an
/// axis-aligned plane: below `at` when `side` is 1, above it when -1. A triangle cut by the six
/// sides of a box has at most nine corners, unless rounding bends an edge across a plane.
///
/// Rounding: a new corner is off the edge that it cuts by at most four roundings of a coordinate.
/// Both sides of a cut compute the same corner, so a point of the polygon is within as much of one
/// of the two parts.
template <typename Emit>
void clipPolygon(std::span<const Eigen::Vector3d> polygon, int axis, double at, double side,
                 const Emit& emit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& p = polygon[i];
    const Eigen::Vector3d& q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const bool keepsP = side * (p[axis] - at) <= 0.0;
    const bool keepsQ = side * (q[axis] - at) <= 0.0;
    if (keepsP) emit(p);
    if (keepsP == keepsQ) continue;
    // The same end first on both sides.
    const Eigen::Vector3d& low = p[axis] < q[axis] ? p : q;
    const Eigen::Vector3d& high = p[axis] < q[axis] ? q : p;
    const double t = (at - low[axis]) / (high[axis] - low[axis]);
    Eigen::Vector3d crossing = low + t * (high - low);
    crossing[axis] = at;
    emit(crossing);
  }
}

}  // namespace swept::detail
