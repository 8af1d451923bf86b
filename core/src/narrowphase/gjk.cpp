// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/gjk.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/descent.hpp"
#include "narrowphase/newton.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

bool isUsable(double squared) {
  return squared > 1e-200 && squared < 1e200;
}

Vector3d firstDirection(const Vector3d& guess, const Vector3d& offset) {
  if (isUsable(guess.squaredNorm())) return guess;
  if (isUsable(offset.squaredNorm())) return offset;
  const double norm = offset.stableNorm();
  return norm > 0.0 ? Vector3d((offset / norm).normalized()) : Vector3d::UnitX();
}

/// Length of d, which is scaled where its square leaves the range of doubles.
double lengthOf(Vector3d& d) {
  const double squared = d.squaredNorm();
  if (isUsable(squared)) return std::sqrt(squared);
  const double norm = d.stableNorm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return 0.0;
  d = (d / norm).normalized();
  return 1.0;
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
  }
  result.pointB = result.pointA;
  result.upper = 0.0;
}

/// The two cores' difference B - A.
struct Pair {
  const Convex& a;
  const Convex& b;
  const Eigen::Vector3d offset;
  const Eigen::Matrix3d rotation;
  const double magnitude;  ///< m, of the coordinates
  /// m. Lemma (support rounding): with direction n as given, the computed n . (b - a) over the
  /// computed support points is at least the true minimum less this. Each dot product of three
  /// terms, the rotation of n and of a point, and the norm of n contribute at most a few ulps of
  /// the coordinates' magnitude.
  const double rounding;

  Pair(const Convex& bodyA, const Convex& bodyB, const Eigen::Isometry3d& a_from_b)
      : a(bodyA),
        b(bodyB),
        offset(a_from_b.translation()),
        rotation(a_from_b.linear()),
        magnitude(magnitudeOf(bodyA, bodyB, a_from_b)),
        rounding(tolerance::kSupportRounding * magnitude + a.error + b.error) {}

  /// The point of B - A that lies deepest along d, and A's part of it.
  void support(const Vector3d& d, Vector3d& w, Vector3d& onA) const {
    onA = a.support(d);
    w = (rotation * b.support(-(rotation.transpose() * d)) + offset) - onA;
  }
};

/// With weights that are shares whatever rounding did to them, so that the weighted points of the
/// bodies witness the nearest point. A flat tetrahedron that only seems to hold the origin is given
/// up for the nearest of its faces.
Simplex withShares(Simplex simplex, double rounding) {
  const bool shares = std::all_of(simplex.vertices.begin(), simplex.vertices.begin() + simplex.size,
                                  [](const auto& vertex) { return vertex.weight >= 0.0; });
  if (!shares) simplex.reduceToNearest();
  if (simplex.size < 4 || simplex.nearest().norm() <= rounding) return simplex;
  Simplex best;
  double least = std::numeric_limits<double>::infinity();
  for (int left = 0; left < 4; ++left) {
    Simplex face = simplex;
    face.vertices[left] = simplex.vertices[3];
    face.size = 3;
    const double squared = face.reduceToNearest().squaredNorm();
    if (left > 0 && !(squared < least)) continue;
    least = squared;
    best = face;
  }
  return best;
}

/// The slab between two bodies that Newton's method found.
GjkResult fromSlab(const CoreGap& gap, const Pair& pair, const Goal& goal, int iterations) {
  GjkResult result;
  result.iterations = iterations;
  result.normal = gap.normal;
  result.lower = std::max(0.0, gap.distance - pair.a.radius - pair.b.radius - pair.rounding);
  result.satisfied = result.lower > goal.along(gap.normal);
  result.pointA = gap.pointA;
  result.pointB = gap.pointB;
  const Vector3d apart = gap.pointB - gap.pointA;
  growWitness(result, apart, apart.norm(), pair.a.radius, pair.b.radius);
  result.upper = std::max(result.upper, result.lower);
  return result;
}

}  // namespace

GjkResult gjk(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Vector3d& guess, const Goal& goal, double contact, double tolerance,
              GjkMode mode, Simplex* last) {
  const Pair pair(a, b, a_from_b);
  const double radii = a.radius + b.radius;
  GjkResult result;
  Descent simplex;
  const bool curved = mode == GjkMode::Exact && (isCurved(a) || isCurved(b));
  int tryNewton = 4;
  Vector3d d = firstDirection(guess, pair.offset);
  double squared = std::numeric_limits<double>::infinity();
  double distance = squared;  // between the cores, so far

  for (int i = 0; i < tolerance::kMaxGjkIterations; ++i) {
    ++result.iterations;
    const double length = lengthOf(d);
    if (!(length > 0.0)) break;
    Vector3d w;
    Vector3d onA;
    pair.support(d, w, onA);
    const double scale = 1.0 / length;
    const double separation = d.dot(w) * scale;
    const double lower = separation - radii - pair.rounding;
    const Vector3d n = scale * d;
    const double needed = goal.along(n);
    if (lower > result.lower) {
      result.lower = lower;
      result.normal = n;
    }
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

    simplex.propose(w, onA);
    const Descent::Step step = simplex.step<true>();
    if (step.size < 4 && step.squared < squared) {
      simplex.take(step);
      squared = step.squared;
      d = step.direction;
    } else {
      const Simplex careful = withShares(simplex.reducedCarefully(), pair.rounding);
      const Vector3d nearest = careful.nearest();
      if (!(nearest.squaredNorm() < squared)) break;
      simplex.take(careful);
      squared = nearest.squaredNorm();
      d = nearest;
    }
    distance = std::sqrt(squared);
    if (curved && result.iterations >= tryNewton && result.lower > 0.0) {
      tryNewton = 2 * result.iterations;
      CoreGap gap;
      if (newtonGap(a, b, a_from_b, result.normal, simplex.spots(a_from_b), tolerance, gap,
                    result.iterations)) {
        return fromSlab(gap, pair, goal, result.iterations);
      }
    }
    if (simplex.size() == 4 || distance - radii <= contact || distance <= pair.rounding) break;
  }

  if (simplex.size() == 0) {
    if (last != nullptr) last->size = 0;
    return result;
  }
  const Simplex nearest = withShares(simplex.weighted(), pair.rounding);
  if (last != nullptr) *last = nearest;
  const Vector3d apart = nearest.nearest();
  result.pointA = nearest.pointA();
  result.pointB = result.pointA + apart;
  distance = apart.norm();
  if (distance <= pair.rounding) distance = 0.0;
  growWitness(result, apart, distance, a.radius, b.radius);
  result.upper = std::max(result.upper, result.lower);
  if (result.normal.isZero()) {
    const double length = lengthOf(d);
    result.normal = length > 0.0 ? Vector3d(d / length) : firstDirection(guess, pair.offset);
  }
  return result;
}

Contact meet(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b) {
  constexpr int kIterations = 32;  // what takes more is left to gjk()
  const Pair pair(a, b, a_from_b);
  Descent simplex;
  Vector3d d = firstDirection(Vector3d::Zero(), pair.offset);
  for (int i = 0; i < kIterations; ++i) {
    Vector3d w;
    Vector3d onA;
    pair.support(d, w, onA);
    const double separation = d.dot(w);
    if (separation > 0.0 && separation > pair.rounding * d.norm()) return Contact::Separate;
    if (simplex.contains(w)) break;
    simplex.propose(w, onA);
    const Descent::Step step = simplex.step<false>();
    simplex.take(step);
    if (step.size == 4) {
      return simplex.enclosesOrigin(pair.magnitude) ? Contact::Touching : Contact::Unknown;
    }
    d = step.direction;
    if (!isUsable(d.squaredNorm())) break;
  }
  return Contact::Unknown;
}

}  // namespace swept::detail
