// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/flat_pair.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/by_coordinates.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// m. Sums of larger coordinates may not be finite, and the answer is then the widest interval.
constexpr double kFarthest = 1e300;

/// A signed gap with the points that witness it. All in a's frame.
struct Gap {
  double value = 0.0;     ///< m, negative in overlap
  double rounding = 0.0;  ///< m
  Vector3d pointA = Vector3d::Zero();
  Vector3d pointB = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  ///< from a to b
  Vector3d common = Vector3d::Zero();  ///< in both; valid in overlap
  bool endless = false;                ///< no translation separates the two
};

/// A plane or half-space and the bounded body, both in a's frame.
struct Wall {
  const Convex& flat;
  const Convex& body;
  const Isometry3d& a_from_b;
  const bool flatIsA;
  Vector3d n;     ///< unit, of the flat
  double offset;  ///< m

  Wall(const Convex& a, const Convex& b, const Isometry3d& pose)
      : flat(a.isFlat() ? a : b), body(a.isFlat() ? b : a), a_from_b(pose), flatIsA(a.isFlat()) {
    n = flatIsA ? flat.size : Vector3d(pose.linear() * flat.size);
    offset = flatIsA ? flat.offset : flat.offset + n.dot(pose.translation());
  }

  Vector3d farthest(const Vector3d& d) const {
    if (!flatIsA) return body.support(d);
    const Vector3d local = body.support(turnedBack(a_from_b.linear(), d));
    return moved(a_from_b.translation(), 1.0, turned(a_from_b.linear(), local));
  }
  /// m. Lemma: the support point, its transformation and the dot product round by at most a few
  /// ulps of the coordinates, like a step of GJK.
  double rounding() const {
    const double magnitude =
        body.extent + body.radius + a_from_b.translation().cwiseAbs().sum() + std::abs(flat.offset);
    return tolerance::kSupportRounding * magnitude + body.error;
  }
};

/// The body's least coordinate along the normal is that of one support point; a plane has two
/// sides.
Gap againstBounded(const Wall& wall) {
  const double radius = wall.body.radius;
  const Vector3d lowest = wall.farthest(-wall.n);
  Gap gap;
  gap.rounding = wall.rounding();
  gap.normal = wall.n;
  gap.value = (wall.n.dot(lowest) - wall.offset) - radius;
  gap.pointB = lowest - radius * wall.n;
  gap.common = gap.pointB;
  if (wall.flat.core == Convex::Core::Plane) {
    const Vector3d highest = wall.farthest(wall.n);
    const double above = (wall.offset - wall.n.dot(highest)) - radius;
    const Vector3d top = highest + radius * wall.n;
    // On the way from the lowest point to the highest, the point where it crosses the plane.
    const double both = gap.value + above;
    const double share = both < 0.0 ? std::clamp(gap.value / both, 0.0, 1.0) : 0.0;
    gap.common += share * (top - gap.pointB);
    if (above > gap.value) {
      gap.value = above;
      gap.normal = -wall.n;
      gap.pointB = top;
    }
  }
  gap.pointA = gap.pointB - gap.value * gap.normal;
  if (wall.flatIsA) return gap;
  std::swap(gap.pointA, gap.pointB);
  gap.normal = -gap.normal;
  return gap;
}

/// For two unbounded bodies; `normalB`, `offsetB` describe the second in the frame of the first.
Gap betweenFlats(const Convex& a, const Convex& b, const Vector3d& normalB, double offsetB,
                 double translation) {
  Gap gap;
  gap.rounding =
      tolerance::kSupportRounding * (std::abs(a.offset) + std::abs(offsetB) + translation);
  gap.pointA = a.offset * a.size;
  gap.pointB = gap.pointA;
  gap.common = gap.pointA;
  gap.normal = a.size;
  if (a.size.cross(normalB).norm() > tolerance::kParallel) {
    gap.endless = true;
    // A point on both boundaries. The remainder of nearly parallel normals is mostly rounding, but
    // each step removes all but that share of the error.
    const double sineSquared = a.size.cross(normalB).squaredNorm();
    const Vector3d along = (normalB - a.size.dot(normalB) * a.size) / sineSquared;
    constexpr int kSteps = 5;
    for (int step = 0; step < kSteps; ++step) {
      gap.pointA += (offsetB - normalB.dot(gap.pointA)) * along;
      gap.pointA += (a.offset - a.size.dot(gap.pointA)) * a.size;
    }
    gap.pointB = gap.pointA;
    gap.common = gap.pointA;
    return gap;
  }
  const bool sameWay = a.size.dot(normalB) > 0.0;
  const double coordinateB = sameWay ? offsetB : -offsetB;  // along a's normal
  const double ahead = coordinateB - a.offset;
  const bool solidA = a.core == Convex::Core::HalfSpace;
  const bool solidB = b.core == Convex::Core::HalfSpace;
  if (solidA && solidB && sameWay) {
    gap.endless = true;
    gap.common += std::min(0.0, ahead) * a.size;
    gap.pointA = gap.pointB = gap.common;
    return gap;
  }
  // A solid on one side leaves one way to separate; two planes can be separated in either
  // direction.
  const bool bAhead = solidA || (solidB ? !sameWay : ahead >= 0.0);
  gap.normal = bAhead ? a.size : Vector3d(-a.size);
  gap.value = bAhead ? ahead : -ahead;
  gap.pointB = gap.pointA + gap.value * gap.normal;
  if (!solidB) gap.common = gap.pointB;  // of a plane, every point in the overlap is on it
  return gap;
}

Gap gapOf(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
  if (a.isFlat() && b.isFlat()) {
    const Vector3d normalB = a_from_b.linear() * b.size;
    return betweenFlats(a, b, normalB, b.offset + normalB.dot(a_from_b.translation()),
                        a_from_b.translation().cwiseAbs().sum());
  }
  return againstBounded(Wall(a, b, a_from_b));
}

}  // namespace

GjkResult flatPair(const Convex& a, const Convex& b, const Isometry3d& a_from_b, const Goal& goal) {
  const Gap gap = gapOf(a, b, a_from_b);
  GjkResult result;
  result.iterations = 1;
  result.normal = gap.normal;
  if (!(std::abs(gap.value) < kFarthest && gap.rounding < kFarthest)) return result;
  if (gap.endless || gap.value <= 0.0) {
    result.upper = 0.0;
    result.pointA = result.pointB = gap.common;
    return result;
  }
  result.pointA = gap.pointA;
  result.pointB = gap.pointB;
  result.upper = gap.value;
  result.lower = std::max(0.0, gap.value - gap.rounding);
  result.satisfied = result.lower > goal.along(gap.normal);
  return result;
}

Contact flatCollide(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
  double value = 0.0;
  double rounding = 0.0;
  if (a.isFlat() && b.isFlat()) {
    const Gap gap = gapOf(a, b, a_from_b);
    value = gap.endless ? -1.0 : gap.value;
    rounding = gap.rounding;
  } else {
    const Wall wall(a, b, a_from_b);
    rounding = wall.rounding();
    value = wall.n.dot(wall.farthest(-wall.n)) - wall.offset - wall.body.radius;
    if (!(value > rounding) && wall.flat.core == Convex::Core::Plane) {
      value = std::max(value, wall.offset - wall.n.dot(wall.farthest(wall.n)) - wall.body.radius);
    }
  }
  if (!(std::abs(value) < kFarthest && rounding < kFarthest)) return Contact::Unknown;
  if (value > rounding) return Contact::Separate;
  return value <= 0.0 ? Contact::Touching : Contact::Unknown;
}

SignedDistanceResult flatPairSigned(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
  const Gap gap = gapOf(a, b, a_from_b);
  SignedDistanceResult result;
  result.iterations = 1;
  result.normal = gap.normal;
  if (!(std::abs(gap.value) < kFarthest && gap.rounding < kFarthest)) return result;
  result.pointA = gap.pointA;
  result.pointB = gap.pointB;
  if (gap.endless) {
    result.lower = result.upper = -std::numeric_limits<double>::infinity();
  } else {
    result.lower = gap.value - gap.rounding;
    result.upper = gap.value + gap.rounding;
  }
  return result;
}

}  // namespace swept::detail
