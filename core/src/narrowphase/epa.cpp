// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/epa.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/polytope.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Deepest points: the point of the boundary nearest to the origin, mapped to the two bodies. It is
/// not always in the face whose plane is nearest: thin faces have inaccurate planes.
void witness(const Polytope& polytope, EpaResult& result) {
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](int face) {
    Simplex simplex = polytope.triangle(face);
    const double distance = simplex.reduceToNearest().norm();
    if (!(distance < least)) return;
    least = distance;
    result.pointA = simplex.pointA();
    result.pointB = simplex.pointB();
  };
  consider(polytope.nearestFace());
  for (int i = 0; i < polytope.faceSlots(); ++i) {
    if (polytope.distance(i) < least) consider(i);
  }
}

}  // namespace

EpaResult epa(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Simplex& start, double tolerance) {
  Polytope polytope(a, b, a_from_b);
  const double rounding = polytope.rounding();
  EpaResult result;
  result.pointA = start.pointA();
  result.pointB = start.pointB();
  result.upper = std::numeric_limits<double>::infinity();
  // Lemma: the depth is the least support value of B - A over all directions, hence at most the one
  // along any normal tried, and at least the distance of the nearest face of a polytope inside.
  const auto tryWayOut = [&](const Vector3d& n, const Polytope::Vertex& farthest) {
    const double height = n.dot(farthest.difference);
    if (height + rounding < result.upper) {
      result.upper = height + rounding;
      result.normal = -n;
    }
    return height;
  };
  Vector3d flat = Vector3d::UnitX();
  if (!polytope.start(start, flat)) {
    for (const Vector3d& axis : {flat, Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()),
                                 Vector3d(Vector3d::UnitZ())}) {
      tryWayOut(axis, polytope.support(axis));
      tryWayOut(-axis, polytope.support(-axis));
    }
    result.upper = std::max(result.upper, 0.0);
    result.iterations = polytope.evaluations();
    return result;
  }
  while (true) {
    const int nearest = polytope.nearestFace();
    const Vector3d normal = polytope.face(nearest).normal;
    const double distance = polytope.distance(nearest);
    result.lower = std::max(result.lower, distance - rounding);
    const Polytope::Vertex found = polytope.support(normal);
    const double height = tryWayOut(normal, found);
    if (height - distance <= tolerance || !polytope.expand(found, nearest)) break;
  }
  witness(polytope, result);
  result.upper = std::max(result.upper, 0.0);
  result.lower = std::clamp(result.lower, 0.0, result.upper);
  result.iterations = polytope.evaluations();
  return result;
}

}  // namespace swept::detail
