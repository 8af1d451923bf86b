// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/signed_pair.hpp"

#include <utility>

#include "narrowphase/core_gap.hpp"
#include "narrowphase/epa.hpp"
#include "narrowphase/gjk.hpp"

namespace swept::detail {

using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

/// An ellipsoid as a smaller core and a ball. Lemma (Blaschke's rolling theorem): a ball of the
/// least radius of curvature, (least semi-axis)^2 / greatest, is a summand of the ellipsoid.
/// Overlaps shallower than that are gaps of the cores, and need no EPA.
Convex insetCore(const Convex& body) {
  constexpr double kWithin = 0.999;  // of that radius: the core stays round
  Convex core = body;
  if (body.core != Convex::Core::Ellipsoid) return core;
  const double least = body.size.minCoeff();
  const double most = body.size.maxCoeff();
  if (!(least > 0.0)) return core;
  core.inset = kWithin * least * (least / most);
  core.radius += core.inset;
  return core;
}

}  // namespace

/// The cores decide; growing both by balls lowers the signed distance by the two radii, whether
/// they are apart or not.
SignedDistanceResult signedByEpa(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                                 const Vector3d& guess, double tolerance) {
  Convex coreA = insetCore(a);
  Convex coreB = insetCore(b);
  const double radii = coreA.radius + coreB.radius;
  const double radiusA = std::exchange(coreA.radius, 0.0);
  const double radiusB = std::exchange(coreB.radius, 0.0);
  Simplex simplex;
  const GjkResult apart =
      gjk(coreA, coreB, a_from_b, guess, Goal(std::numeric_limits<double>::infinity()), 0.0,
          tolerance, GjkMode::Exact, &simplex);
  SignedDistanceResult result;
  result.lower = apart.lower;
  result.upper = apart.upper;
  result.normal = apart.normal;
  result.pointA = apart.pointA;
  result.pointB = apart.pointB;
  result.iterations = apart.iterations;
  if (!(apart.lower > 0.0)) {
    const EpaResult depth = epa(coreA, coreB, a_from_b, simplex, tolerance);
    result.lower = -depth.upper;
    result.iterations += depth.iterations;
    result.normal = depth.normal;
    if (!(apart.upper > 0.0)) {
      result.upper = -depth.lower;
      result.pointA = depth.pointA;
      result.pointB = depth.pointB;
    }
  }
  const double rounding = tolerance::kSupportRounding * radii;
  result.lower -= radii + rounding;
  result.upper -= radii - rounding;
  // Points witness a distance; for the depth that they leave, their rounding counts.
  if (result.upper < 0.0) result.upper += pairRounding(coreA, coreB, a_from_b);
  // The normal proves the bound, but the distance of the points is that along the way between them.
  const Vector3d way = result.pointB - result.pointA;
  const double length = way.norm();
  const Vector3d n = apart.lower > 0.0 && length > 0.0 ? Vector3d(way / length) : result.normal;
  result.pointA += radiusA * n;
  result.pointB -= radiusB * n;
  return result;
}

void deepestPoints(const Convex& a, const Convex& b, const Isometry3d& a_from_b, double depth,
                   SignedDistanceResult& result) {
  constexpr double kFarther = 1e-3;  // of the sizes
  const double rounding = pairRounding(a, b, a_from_b);
  const Vector3d shift = (depth + kFarther * (a.extent + b.extent)) * result.normal;
  Isometry3d apart = a_from_b;
  apart.translation() += shift;
  const GjkResult nearest =
      gjk(a, b, apart, result.normal, Goal(std::numeric_limits<double>::infinity()), 0.0,
          0.01 * rounding, GjkMode::Exact);
  result.iterations += nearest.iterations;
  result.pointA = nearest.pointA;
  result.pointB = nearest.pointB - shift;
}

}  // namespace swept::detail
