// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/gjk.hpp"

#include <algorithm>
#include <cmath>

#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

Vector3d firstDirection(const Vector3d& guess, const Vector3d& offset) {
  for (const Vector3d& candidate : {guess, offset}) {
    const double norm = candidate.norm();
    if (norm > 0.0 && std::isfinite(norm)) return candidate / norm;
  }
  return Vector3d::UnitX();
}

/// Direction of the nearest point v, which is perpendicular to the simplex. Near contact v is a
/// small difference of large coordinates and its direction worth little; a triangle's edges still
/// know it.
Vector3d separatingDirection(const Simplex& simplex, const Vector3d& v, double distance,
                             double magnitude) {
  constexpr double kNear = 1e-5;        // relative: below, v has lost five digits
  constexpr double kWellShaped = 1e-6;  // sine of the angle between the edges
  if (simplex.size == 3 && distance < kNear * magnitude) {
    const Vector3d e = simplex.vertices[1].difference - simplex.vertices[0].difference;
    const Vector3d f = simplex.vertices[2].difference - simplex.vertices[0].difference;
    const Vector3d normal = e.cross(f);
    const double norm = normal.norm();
    if (norm > kWellShaped * e.norm() * f.norm())
      return normal / (v.dot(normal) < 0.0 ? -norm : norm);
  }
  return v / distance;
}

/// Moves the core's witness points out to the surfaces of the grown bodies, or to a common point
/// when these overlap.
void growWitness(GjkResult& result, const Vector3d& v, double distance, double radiusA,
                 double radiusB) {
  const double gap = distance - radiusA - radiusB;
  if (gap > 0.0) {
    const Vector3d n = v / distance;
    result.pointA += radiusA * n;
    result.pointB -= radiusB * n;
    result.upper = (result.pointB - result.pointA).norm();
    return;
  }
  if (radiusA + radiusB > 0.0 && distance > 0.0) {
    // Any point at s from A's core, distance - radiusB <= s <= radiusA, belongs to both.
    const double s = std::clamp(0.5 * (radiusA + distance - radiusB), 0.0, distance);
    result.pointA += (s / distance) * v;
    result.pointB = result.pointA;
  }
  result.upper = 0.0;
}

}  // namespace

GjkResult gjk(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Vector3d& guess, const Goal& goal, double contact, double tolerance,
              GjkMode mode, Simplex* last) {
  const Vector3d offset = a_from_b.translation();
  const Eigen::Matrix3d rotation = a_from_b.linear();
  const double radii = a.radius + b.radius;
  // Lemma (support rounding): with direction n as given, the computed n . (b - a) over the computed
  // support points is at least the true minimum less this. Each dot product of three terms, the
  // rotation of n and of a point, and the norm of n contribute at most a few ulps of the
  // coordinates' magnitude.
  const double magnitude = a.extent + b.extent + offset.norm() + radii;
  const double rounding = tolerance::kSupportRounding * magnitude + a.error + b.error;

  GjkResult result;
  Simplex simplex;
  Vector3d n = firstDirection(guess, offset);
  Vector3d v = Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();  // |v|, between the cores

  for (int i = 0; i < tolerance::kMaxGjkIterations; ++i) {
    ++result.iterations;
    const Vector3d onA = a.support(n);
    const Vector3d onB = rotation * b.support(-(rotation.transpose() * n)) + offset;
    const Vector3d w = onB - onA;
    const double separation = n.dot(w);
    const double lower = separation - radii - rounding;
    if (lower > result.lower) {
      result.lower = lower;
      result.normal = n;
    }
    const double needed = goal.along(n);
    if (lower > needed) {
      result.satisfied = true;
      result.lower = lower;
      result.normal = n;
      return result;
    }
    if (mode != GjkMode::Exact && distance - radii <= needed &&
        (mode == GjkMode::BoundOnly || result.lower > contact)) {
      break;
    }
    // Without a proven separation the bodies may overlap, and only the origin inside will tell.
    if (distance - separation <= tolerance && result.lower > 0.0) break;
    if (simplex.contains(w)) break;

    Simplex next = simplex;
    next.add(onA, onB);
    const Vector3d nearest = next.reduceToNearest();
    const double reached = nearest.norm();
    if (!(reached < distance)) break;
    simplex = next;
    v = nearest;
    distance = reached;
    if (simplex.size == 4 || distance - radii <= contact || distance <= rounding) break;
    n = separatingDirection(simplex, v, distance, magnitude);
  }

  if (last != nullptr) *last = simplex;
  if (!std::isfinite(distance)) return result;
  result.pointA = simplex.pointA();
  result.pointB = simplex.pointB();
  // The origin inside the simplex means that the weighted points coincide up to rounding.
  if (distance <= rounding) distance = 0.0;
  growWitness(result, v, distance, a.radius, b.radius);
  result.upper = std::max(result.upper, result.lower);
  if (result.normal.isZero()) result.normal = n;
  return result;
}

}  // namespace swept::detail
