// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/signed_distance.hpp"

#include <algorithm>

#include "geometry/nearest_rotation.hpp"
#include "narrowphase/convex_pair.hpp"
#include "narrowphase/mesh_depth.hpp"
#include "narrowphase/piecewise.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

using Eigen::Isometry3d;
using Eigen::Vector3d;

SignedDistanceResult signedDistance(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                                    double tolerance) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, tolerance] { return signedDistance(a, b, a_from_b, tolerance); });
  }
  if (!detail::isRigidPose(a_from_b)) {
    const auto rigid = detail::nearestRigidPose(a_from_b);
    return rigid ? signedDistance(a, b, *rigid, tolerance) : SignedDistanceResult{};
  }
  SignedDistanceResult result;
  if (detail::convexSigned(a, b, a_from_b, tolerance, result)) return result;
  const detail::Side sideA = detail::Side::of(a);
  const detail::Side sideB = detail::Side::of(b);
  detail::PieceGoal goal;
  goal.tolerance = tolerance;
  const detail::PieceResult found =
      detail::searchPieces(sideA, sideB, a_from_b, Vector3d::Zero(), goal);
  result.lower = found.lower;
  result.upper = found.upper;
  result.pointA = found.pointA;
  result.pointB = found.pointB;
  result.iterations = found.iterations;
  if (found.lower > 0.0) return result;
  const detail::MeshDepth depth = detail::meshDepth(sideA, sideB, a_from_b, tolerance);
  result.lower = -depth.upper;
  result.normal = depth.normal;
  result.iterations += depth.iterations;
  if (found.upper > 0.0) return result;  // within rounding of touching
  result.upper = -depth.lower;
  if (depth.lower > 0.0) {
    result.pointA = depth.pointA;
    result.pointB = depth.pointB;
  }
  return result;
}

}  // namespace swept
