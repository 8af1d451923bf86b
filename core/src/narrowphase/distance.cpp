// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/distance.hpp"

#include <algorithm>
#include <variant>

#include "geometry/nearest_rotation.hpp"
#include "narrowphase/convex_pair.hpp"
#include "narrowphase/libccd_backend.hpp"
#include "narrowphase/piecewise.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

bool isUnbounded(const Shape& shape) {
  return std::holds_alternative<Plane>(shape) || std::holds_alternative<HalfSpace>(shape);
}

/// Planes and half-spaces use closed forms with either backend.
bool wantsLibccd(const Shape& a, const Shape& b, Backend backend) {
  return backend == Backend::Libccd && !isUnbounded(a) && !isUnbounded(b);
}

DistanceResult distanceOfPieces(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                                const DistanceOptions& options) {
  detail::PieceGoal goal;
  goal.enough = options.enough;
  goal.contact = options.contact;
  goal.tolerance = options.tolerance;
  const detail::PieceResult found =
      detail::searchPieces(detail::Side::of(a), detail::Side::of(b), a_from_b, options.guess, goal);
  DistanceResult result;
  result.lower = found.lower;
  result.upper = found.upper;
  result.pointA = found.pointA;
  result.pointB = found.pointB;
  result.normal = found.normal;
  result.iterations = found.iterations;
  return result;
}

}  // namespace

DistanceResult distance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                        const DistanceOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distance(a, b, a_from_b, options); });
  }
  if (!detail::isRigidPose(a_from_b)) {
    const auto rigid = detail::nearestRigidPose(a_from_b);
    return rigid ? distance(a, b, *rigid, options) : DistanceResult{};
  }
  if (wantsLibccd(a, b, options.backend)) return detail::libccdDistance(a, b, a_from_b, options);
  DistanceResult result;
  if (detail::convexDistance(a, b, a_from_b, options, result)) return result;
  return distanceOfPieces(a, b, a_from_b, options);
}

Contact collide(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                Backend backend) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, backend] { return collide(a, b, a_from_b, backend); });
  }
  if (!detail::isRigidPose(a_from_b)) {
    const auto rigid = detail::nearestRigidPose(a_from_b);
    return rigid ? collide(a, b, *rigid, backend) : Contact::Unknown;
  }
  if (wantsLibccd(a, b, backend)) return detail::libccdIntersect(a, b, a_from_b);
  Contact contact = Contact::Unknown;
  if (detail::convexCollide(a, b, a_from_b, contact)) return contact;
  DistanceOptions options;
  options.enough = 0.0;
  const DistanceResult result = distanceOfPieces(a, b, a_from_b, options);
  if (result.lower > 0.0) return Contact::Separate;
  return result.upper <= 0.0 ? Contact::Touching : Contact::Unknown;
}

}  // namespace swept
