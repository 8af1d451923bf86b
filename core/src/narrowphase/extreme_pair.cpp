// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/extreme_pair.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Lemma: the balls' signed distance is at most that of their contents. Its few sums and the norm
/// are off by a few ulps of the terms, and by the least double if these underflow.
double ballSeparation(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                      Vector3d& normal) {
  const Vector3d& t = a_from_b.translation();
  const double apart = t.stableNorm();
  const double most = t.cwiseAbs().maxCoeff();
  normal = most > 0.0 ? Vector3d((t / most).normalized()) : Vector3d(Vector3d::UnitX());
  const double reach = a.extent + a.radius + a.error + b.extent + b.radius + b.error;
  const double rounding = tolerance::kSupportRounding * (apart + reach) +
                          4.0 * std::numeric_limits<double>::denorm_min();
  const double separation = apart - reach - rounding;
  // Infinite sums prove nothing.
  return std::isfinite(separation) ? separation : -std::numeric_limits<double>::infinity();
}

/// The farthest points along x; false if they are too far away for a double.
bool somePoints(const Convex& a, const Convex& b, const Isometry3d& a_from_b, Vector3d& pointA,
                Vector3d& pointB, double& distance) {
  pointA = a.support(Vector3d::UnitX());
  pointB = a_from_b * b.support(Vector3d::UnitX());
  const Vector3d apart = pointB - pointA;
  distance = apart.stableNorm();
  if (pointA.allFinite() && pointB.allFinite() && std::isfinite(distance)) return true;
  pointA.setZero();
  pointB.setZero();
  distance = std::numeric_limits<double>::infinity();
  return false;
}

}  // namespace

GjkResult extremePair(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                      const Goal& goal) {
  GjkResult result;
  result.iterations = 1;
  const double separation = ballSeparation(a, b, a_from_b, result.normal);
  result.lower = std::max(0.0, separation);
  result.satisfied = result.lower > goal.along(result.normal);
  if (somePoints(a, b, a_from_b, result.pointA, result.pointB, result.upper)) {
    result.upper = std::max(result.upper, result.lower);
  }
  return result;
}

SignedDistanceResult extremePairSigned(const Convex& a, const Convex& b,
                                       const Isometry3d& a_from_b) {
  SignedDistanceResult result;
  result.iterations = 1;
  result.lower = ballSeparation(a, b, a_from_b, result.normal);
  somePoints(a, b, a_from_b, result.pointA, result.pointB, result.upper);
  return result;
}

}  // namespace swept::detail
