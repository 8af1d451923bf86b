// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// Whether the core's surface has curvature that its support function can give.
inline bool isCurved(const Convex& body) {
  switch (body.core) {
    case Convex::Core::Cylinder:
    case Convex::Core::Cone:
    case Convex::Core::Ellipsoid:
      return true;
    case Convex::Core::Point:
    case Convex::Core::Segment:
    case Convex::Core::Box:
    case Convex::Core::Points:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      return false;
  }
  return false;
}

/// The different points of a body, in its own frame, that a simplex holds.
struct Spots {
  int count = 0;
  std::array<Eigen::Vector3d, 3> points;  ///< m

  /// Points nearer to each other than `least` are one.
  void note(const Eigen::Vector3d& point, double least) {
    for (int i = 0; i < count; ++i) {
      if ((points[i] - point).squaredNorm() <= least * least) return;
    }
    if (count < 3) points[count++] = point;
  }
};

/// Newton's method on the normal of the slab between two separate cores, from a unit `normal` near
/// the solution; `rotation` and `offset` are b's pose in a's frame. Each step doubles the number of
/// digits, where a descent of GJK adds a part of a digit. It tries in turn: a smooth spot on either
/// body; a straight edge of one (of a box, of a polytope as the spots say, a line on the side of a
/// cylinder or cone) or a polytope's face, with a smooth spot of the other; an edge of each. True
/// if the gap is known to within `tolerance`: from below by the slab, from above by two points.
bool newtonGap(const Convex& a, const Convex& b, const Eigen::Matrix3d& rotation,
               const Eigen::Vector3d& offset, const Eigen::Vector3d& normal,
               const std::array<Spots, 2>& spots, double tolerance, CoreGap& gap, int& evaluations);

}  // namespace swept::detail
