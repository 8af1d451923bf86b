// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/signed_distance.hpp"

#include <algorithm>

#include "narrowphase/epa.hpp"
#include "narrowphase/gjk.hpp"
#include "narrowphase/piecewise.hpp"

namespace swept {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// The cores decide; growing both by balls lowers the signed distance by the two radii, apart or
/// not.
SignedDistanceResult betweenConvex(detail::Convex a, detail::Convex b, const Isometry3d& a_from_b,
                                   double tolerance) {
  const double radiusA = a.radius;
  const double radiusB = b.radius;
  a.radius = 0.0;
  b.radius = 0.0;
  detail::Simplex simplex;
  const detail::GjkResult apart = detail::gjk(a, b, a_from_b, Vector3d::Zero(),
                                              detail::Goal(std::numeric_limits<double>::infinity()),
                                              0.0, tolerance, detail::GjkMode::Exact, &simplex);
  SignedDistanceResult result;
  result.lower = apart.lower;
  result.upper = apart.upper;
  result.normal = apart.normal;
  result.pointA = apart.pointA;
  result.pointB = apart.pointB;
  result.iterations = apart.iterations;
  if (!(apart.lower > 0.0)) {
    const detail::EpaResult depth = detail::epa(a, b, a_from_b, simplex, tolerance);
    result.lower = -depth.upper;
    result.iterations += depth.iterations;
    result.normal = depth.normal;
    if (!(apart.upper > 0.0)) {
      result.upper = -depth.lower;
      result.pointA = depth.pointA;
      result.pointB = depth.pointB;
    }
  }
  const double rounding = tolerance::kSupportRounding * (radiusA + radiusB);
  result.lower -= radiusA + radiusB + rounding;
  result.upper -= radiusA + radiusB - rounding;
  result.pointA += radiusA * result.normal;
  result.pointB -= radiusB * result.normal;
  return result;
}

}  // namespace

SignedDistanceResult signedDistance(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                                    double tolerance) {
  if (!a_from_b.matrix().allFinite()) return {};
  const detail::Side sideA = detail::Side::of(a);
  const detail::Side sideB = detail::Side::of(b);
  if (sideA.mesh == nullptr && sideB.mesh == nullptr) {
    return betweenConvex(sideA.convex, sideB.convex, a_from_b, tolerance);
  }
  detail::PieceGoal goal;
  goal.tolerance = tolerance;
  const detail::PieceResult found =
      detail::searchPieces(sideA, sideB, a_from_b, Vector3d::Zero(), goal);
  SignedDistanceResult result;
  result.lower = found.lower;
  result.upper = found.upper;
  result.pointA = found.pointA;
  result.pointB = found.pointB;
  result.iterations = found.iterations;
  if (found.lower > 0.0) return result;
  const SignedDistanceResult hulls = betweenConvex(sideA.convex, sideB.convex, a_from_b, tolerance);
  result.lower = std::min(0.0, hulls.lower);
  result.normal = hulls.normal;
  result.iterations += hulls.iterations;
  return result;
}

}  // namespace swept
