// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/gjk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "narrowphase/gjk_simplex.hpp"
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

/// Length of d, which is scaled if its square leaves the range of doubles.
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
    // Any point at distance s from A's core, distance - radiusB <= s <= radiusA, belongs to both.
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
  /// m. Points this near may coincide: this is their actual rounding, not the allowed one.
  const double coincident;

  Pair(const Convex& bodyA, const Convex& bodyB, const Eigen::Isometry3d& a_from_b)
      : a(bodyA),
        b(bodyB),
        offset(a_from_b.translation()),
        rotation(a_from_b.linear()),
        magnitude(magnitudeOf(bodyA, bodyB, a_from_b)),
        rounding(tolerance::kSupportRounding * magnitude + a.error + b.error),
        coincident(0.25 * tolerance::kSupportRounding * magnitude + a.error - a.omitted + b.error -
                   b.omitted) {}

  /// The point of B - A that lies deepest along d, and A's part of it.
  void support(const Vector3d& d, Vector3d& w, Vector3d& onA) const {
    onA = a.support(d);
    w = (rotation * b.support(-(rotation.transpose() * d)) + offset) - onA;
  }
};

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

/// The proofs and witnesses of two descents together.
GjkResult better(const GjkResult& one, const GjkResult& other) {
  GjkResult result = other.upper <= one.upper || other.satisfied ? other : one;
  const GjkResult& prover = other.lower >= one.lower || other.satisfied ? other : one;
  result.lower = prover.lower;
  result.normal = prover.normal;
  result.satisfied = other.satisfied;
  result.iterations = one.iterations + other.iterations;
  return result;
}

/// The goal of a descent.
struct Request {
  const Goal& goal;
  double contact;    ///< m
  double tolerance;  ///< m
  GjkMode mode;
};

enum class Care : std::uint8_t { Quick, Careful };

/// One descent of GJK. A quick one trusts the features that signs choose. A careful one examines
/// all of them and measures each by its weighted sum, for pairs so near or so slender that the
/// signs are noise.
class Search {
 public:
  Search(const Pair& pair, const Request& request, Care care)
      : pair_(pair),
        request_(request),
        carefully_(care == Care::Careful),
        radii_(pair.a.radius + pair.b.radius),
        curved_(request.mode == GjkMode::Exact && (isCurved(pair.a) || isCurved(pair.b))) {}

  GjkResult& run(Vector3d d) {
    for (int i = 0; i < tolerance::kMaxGjkIterations; ++i) {
      ++result_.iterations;
      if (!step(d)) break;
    }
    if (!result_.satisfied && !bySlab_) measure(d);
    return result_;
  }

  /// Whether rounding, and not the goal, ended the descent.
  bool stuck() const {
    if (result_.satisfied || ended_) return false;
    const double width = result_.upper - result_.lower;
    return !(width <= std::max(request_.tolerance, 8.0 * pair_.rounding));
  }

  const Simplex& nearest() const { return nearest_; }

 private:
  /// Evaluates the support along d and turns d; false at the end.
  bool step(Vector3d& d) {
    const double length = lengthOf(d);
    if (!(length > 0.0)) return false;
    Vector3d w;
    Vector3d onA;
    pair_.support(d, w, onA);
    const double scale = 1.0 / length;
    const double separation = d.dot(w) * scale;
    const double lower = separation - radii_ - pair_.rounding;
    const Vector3d n = scale * d;
    const double needed = request_.goal.along(n);
    proven_ = std::max(proven_, separation);
    result_.satisfied = lower > needed;
    if (lower > result_.lower || result_.satisfied) {
      result_.lower = lower;
      result_.normal = n;
    }
    if (result_.satisfied) return false;
    if (request_.mode != GjkMode::Exact && distance_ - radii_ <= needed &&
        (request_.mode == GjkMode::BoundOnly || result_.lower > request_.contact)) {
      ended_ = true;
      return false;
    }
    // Without a proven separation the bodies may overlap, and only the origin inside can show it.
    if (distance_ - separation <= request_.tolerance && result_.lower > 0.0) return false;
    if (simplex_.contains(w)) return false;
    simplex_.propose(w, onA);
    if (!reduce(d)) return false;
    if (!curved_ || result_.iterations < tryNewton_ || !(result_.lower > 0.0)) return true;
    tryNewton_ = 2 * result_.iterations;
    CoreGap gap;
    bySlab_ = newtonGap(pair_.a, pair_.b, pair_.rotation, pair_.offset, result_.normal,
                        simplex_.spots(pair_.rotation, pair_.offset), request_.tolerance, gap,
                        result_.iterations);
    if (bySlab_) result_ = fromSlab(gap, pair_, request_.goal, result_.iterations);
    return !bySlab_;
  }

  /// Moves to the feature of simplex and new point that is nearest to the origin; false if that is
  /// no progress, or progress enough.
  bool reduce(Vector3d& d) {
    if (!carefully_) {
      const GjkSimplex::Step step = simplex_.step<true>();
      // A distance below the proven one is noise.
      if (step.size < 4 && step.squared < squared_ &&
          !(proven_ > 0.0 && step.squared < kNearer * proven_ * proven_)) {
        simplex_.take(step);
        nearest_.size = 0;
        d = step.direction;
        return goOn(step.squared);
      }
      if (step.size == 4 && enclosed(step)) return false;
    }
    const Simplex careful = simplex_.reducedCarefully(std::min(4, simplex_.size() + 1));
    const Vector3d nearest = careful.nearest();
    const double squared = nearest.squaredNorm();
    if (!(squared < squared_)) return false;
    simplex_.take(careful);
    nearest_ = careful;
    d = simplex_.across(nearest);
    return goOn(squared);
  }

  bool goOn(double squared) {
    squared_ = squared;
    distance_ = std::sqrt(squared);
    return simplex_.size() < 4 && distance_ - radii_ > request_.contact &&
           distance_ > pair_.coincident;
  }

  /// Whether the weights of four points also show that they contain the origin.
  bool enclosed(const GjkSimplex::Step& step) {
    GjkSimplex whole = simplex_;
    whole.take(step);
    const Simplex weighted = whole.weighted();
    if (!(weighted.nearest().norm() <= pair_.coincident)) return false;
    simplex_ = whole;
    nearest_ = weighted;
    squared_ = distance_ = 0.0;
    return true;
  }

  /// The witness of the last simplex.
  void measure(const Vector3d& d) {
    if (simplex_.size() == 0) return;
    if (nearest_.size == 0) nearest_ = simplex_.weighted();
    if (!nearest_.hasShares()) nearest_.reduceToNearest();
    const Vector3d apart = nearest_.nearest();
    result_.pointA = nearest_.pointA();
    result_.pointB = result_.pointA + apart;
    double distance = apart.norm();
    if (distance <= pair_.coincident) distance = 0.0;
    growWitness(result_, apart, distance, pair_.a.radius, pair_.b.radius);
    result_.upper = std::max(result_.upper, result_.lower);
    if (!result_.normal.isZero()) return;
    Vector3d n = d;
    const double length = lengthOf(n);
    result_.normal = length > 0.0 ? Vector3d(n / length) : firstDirection(d, pair_.offset);
  }

  static constexpr double kNearer = 1.0 - 1e-6;  ///< relative, of squares

  const Pair& pair_;
  const Request& request_;
  const bool carefully_;
  const double radii_;  ///< m
  const bool curved_;
  bool bySlab_ = false;
  bool ended_ = false;  ///< by the mode
  int tryNewton_ = 4;
  GjkSimplex simplex_;
  Simplex nearest_;                                            ///< empty until measured
  double squared_ = std::numeric_limits<double>::infinity();   ///< m^2
  double distance_ = std::numeric_limits<double>::infinity();  ///< m, between the cores so far
  double proven_ = -std::numeric_limits<double>::infinity();   ///< m, between the cores
  GjkResult result_;
};

}  // namespace

GjkResult gjk(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Vector3d& guess, const Goal& goal, double contact, double tolerance,
              GjkMode mode, Simplex* last) {
  const Pair pair(a, b, a_from_b);
  const Request request{goal, contact, tolerance, mode};
  Search quick(pair, request, Care::Quick);
  GjkResult result = quick.run(firstDirection(guess, pair.offset));
  if (last != nullptr) *last = quick.nearest();
  if (!quick.stuck()) return result;
  Search slow(pair, request, Care::Careful);
  const GjkResult& careful = slow.run(firstDirection(result.normal, pair.offset));
  if (last != nullptr) *last = slow.nearest();
  return better(result, careful);
}

Contact meet(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b) {
  constexpr int kIterations = 32;  // longer descents are left to gjk()
  const Pair pair(a, b, a_from_b);
  GjkSimplex simplex;
  Vector3d d = firstDirection(Vector3d::Zero(), pair.offset);
  for (int i = 0; i < kIterations; ++i) {
    Vector3d w;
    Vector3d onA;
    pair.support(d, w, onA);
    const double separation = d.dot(w);
    if (separation > 0.0 && separation > pair.rounding * d.norm()) return Contact::Separate;
    if (simplex.contains(w)) break;
    simplex.propose(w, onA);
    const GjkSimplex::Step step = simplex.step<false>();
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
