// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/convex_pair.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "narrowphase/box_box.hpp"
#include "narrowphase/closed_form.hpp"
#include "narrowphase/extreme_pair.hpp"
#include "narrowphase/face_look.hpp"
#include "narrowphase/flat_pair.hpp"
#include "narrowphase/grown_cores.hpp"
#include "narrowphase/signed_pair.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Core = Convex::Core;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kCores = static_cast<std::size_t>(Core::HalfSpace) + 1;  // the last one

template <Core kind>
constexpr bool kFlat = Convex::isFlat(kind);

/// A core that is used only with a ball around it.
template <Core kind>
constexpr bool kRound = kind == Core::Point || kind == Core::Segment;

Contact contactOf(const GjkResult& result) {
  if (result.lower > 0.0) return Contact::Separate;
  return result.upper <= 0.0 ? Contact::Touching : Contact::Unknown;
}

SignedDistanceResult boxesSigned(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                                 double tolerance) {
  SignedDistanceResult result;
  BoxAxes axes(a, b, a_from_b);
  const double separation = axes.largest(std::numeric_limits<double>::infinity(), result.normal);
  const double rounding = pairRounding(a, b, a_from_b);
  if (!(separation < -rounding)) return signedByEpa(a, b, a_from_b, result.normal, tolerance);
  result.lower = separation - rounding;
  result.upper = separation + rounding;
  result.iterations = 1;
  if (!axes.deepest(result.normal, result.pointA, result.pointB)) {
    deepestPoints(a, b, a_from_b, -separation, result);
  }
  return result;
}

Contact boxesCollide(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
  Vector3d normal;
  const double rounding = pairRounding(a, b, a_from_b);
  const double separation = BoxAxes(a, b, a_from_b).largest(rounding, normal);
  if (separation > rounding) return Contact::Separate;
  if (separation < -rounding) return Contact::Touching;
  return contactOf(gjk(a, b, a_from_b, normal, Goal(0.0), 0.0, 0.0, GjkMode::Exact));
}

/// The three queries of one kind of pair. GJK and EPA answer for pairs without a closed form.
template <Core kindA, Core kindB>
struct PairQueries {
  static GjkResult distance(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                            const Vector3d& guess, const Goal& goal, double contact,
                            double tolerance, GjkMode mode) {
    if constexpr (kFlat<kindA> || kFlat<kindB>) {
      return flatPair(a, b, a_from_b, goal);
    } else {
      if (isExtreme(magnitudeOf(a, b, a_from_b))) return extremePair(a, b, a_from_b, goal);
      if constexpr (HasClosedForm<kindA, kindB>) {
        CoreGap gap;
        if (closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, a, b, a_from_b, gap)) {
          return grown(gap, a, b, goal);
        }
      }
      if constexpr (probe::kHasFaces<kindA> || probe::kHasFaces<kindB>) {
        // A warm start is better than the faces.
        if (mode == GjkMode::Exact && guess.isZero()) {
          const Look found = look<kindA, kindB>(a, b, a_from_b);
          if (found.inside || found.exact) return grown(found.gap, a, b, goal);
        }
      }
      return gjk(a, b, a_from_b, guess, goal, contact, tolerance, mode);
    }
  }

  static SignedDistanceResult signedDistance(const Convex& a, const Convex& b,
                                             const Isometry3d& a_from_b, double tolerance) {
    if constexpr (kFlat<kindA> || kFlat<kindB>) {
      return flatPairSigned(a, b, a_from_b);
    } else {
      if (isExtreme(magnitudeOf(a, b, a_from_b))) return extremePairSigned(a, b, a_from_b);
      if constexpr (kindA == Core::Box && kindB == Core::Box) {
        return boxesSigned(a, b, a_from_b, tolerance);
      }
      if constexpr (HasClosedForm<kindA, kindB>) {
        CoreGap gap;
        if (closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, a, b, a_from_b, gap)) {
          return grownSigned(gap, a, b);
        }
      }
      Vector3d guess = Vector3d::Zero();
      if constexpr (probe::kHasFaces<kindA> || probe::kHasFaces<kindB>) {
        const Look found = look<kindA, kindB>(a, b, a_from_b);
        if (found.exact) return grownSigned(found.gap, a, b);
        guess = found.normal;
      }
      return signedByEpa(a, b, a_from_b, guess, tolerance);
    }
  }

  /// True, with the gap of the cores, if these have a closed form that answers.
  [[gnu::always_inline]] static bool inClosedForm(const Convex& a, const Convex& b,
                                                  const Isometry3d& a_from_b, CoreGap& gap) {
    if constexpr (HasClosedForm<kindA, kindB>) {
      if (isExtreme(magnitudeOf(a, b, a_from_b))) return false;
      return closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, a, b, a_from_b, gap);
    }
    return false;
  }

  static Contact collide(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
    constexpr bool flat = kFlat<kindA> || kFlat<kindB>;
    if (!flat && isExtreme(magnitudeOf(a, b, a_from_b))) {
      return contactOf(extremePair(a, b, a_from_b, Goal(0.0)));
    }
    if constexpr (flat) {
      return flatCollide(a, b, a_from_b);
    } else if constexpr (kindA == Core::Box && kindB == Core::Box) {
      return boxesCollide(a, b, a_from_b);
    } else {
      if constexpr (HasClosedForm<kindA, kindB>) {
        CoreGap gap;
        if (closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, a, b, a_from_b, gap)) {
          const double apart = gap.distance - a.radius - b.radius;
          if (apart > gap.rounding) return Contact::Separate;
          return apart <= 0.0 ? Contact::Touching : Contact::Unknown;
        }
      }
      if constexpr (!kRound<kindA> && !kRound<kindB>) {
        const Look found = look<kindA, kindB>(a, b, a_from_b);
        if (found.inside) return Contact::Touching;
        if (found.separation > pairRounding(a, b, a_from_b)) return Contact::Separate;
        const Contact contact = meet(a, b, a_from_b);
        if (contact != Contact::Unknown) return contact;
      }
      return contactOf(
          distance(a, b, a_from_b, Vector3d::Zero(), Goal(0.0), 0.0, 0.0, GjkMode::Exact));
    }
  }
};

template <typename Body>
constexpr Core coreOf() {
  if constexpr (std::is_same_v<Body, Sphere>) return Core::Point;
  if constexpr (std::is_same_v<Body, Capsule>) return Core::Segment;
  if constexpr (std::is_same_v<Body, Box>) return Core::Box;
  if constexpr (std::is_same_v<Body, Cylinder>) return Core::Cylinder;
  if constexpr (std::is_same_v<Body, Cone>) return Core::Cone;
  if constexpr (std::is_same_v<Body, Ellipsoid>) return Core::Ellipsoid;
  if constexpr (std::is_same_v<Body, Plane>) return Core::Plane;
  if constexpr (std::is_same_v<Body, HalfSpace>) return Core::HalfSpace;
  if constexpr (std::is_same_v<Body, ConvexHull>) return Core::Points;
  if constexpr (std::is_same_v<Body, Triangle>) return Core::Points;
}

/// Calls `query` with the bodies of two convex shapes; false if one is not convex.
template <typename Query>
inline bool visitConvex(const Shape& a, const Shape& b, const Query& query) {
  return std::visit(
      [&](const auto& bodyA, const auto& bodyB) {
        using A = std::remove_cvref_t<decltype(bodyA)>;
        using B = std::remove_cvref_t<decltype(bodyB)>;
        if constexpr (ConvexShape<A> && ConvexShape<B>) {
          query(PairQueries<coreOf<A>(), coreOf<B>()>{}, Convex::of(bodyA), Convex::of(bodyB));
          return true;
        } else {
          return false;
        }
      },
      a, b);
}

template <std::size_t... pair>
constexpr auto distances(std::index_sequence<pair...>) {
  return std::array{&PairQueries<static_cast<Core>(pair / kCores),
                                 static_cast<Core>(pair % kCores)>::distance...};
}

template <std::size_t... pair>
constexpr auto signedDistances(std::index_sequence<pair...>) {
  return std::array{&PairQueries<static_cast<Core>(pair / kCores),
                                 static_cast<Core>(pair % kCores)>::signedDistance...};
}

constexpr auto kDistances = distances(std::make_index_sequence<kCores * kCores>{});
constexpr auto kSignedDistances = signedDistances(std::make_index_sequence<kCores * kCores>{});

std::size_t pairIndex(const Convex& a, const Convex& b) {
  return static_cast<std::size_t>(a.core) * kCores + static_cast<std::size_t>(b.core);
}

}  // namespace

GjkResult convexPair(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                     const Vector3d& guess, const Goal& goal, double contact, double tolerance,
                     GjkMode mode) {
  return kDistances[pairIndex(a, b)](a, b, a_from_b, guess, goal, contact, tolerance, mode);
}

SignedDistanceResult convexPairSigned(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                                      double tolerance) {
  return kSignedDistances[pairIndex(a, b)](a, b, a_from_b, tolerance);
}

bool convexDistance(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                    const DistanceOptions& options, DistanceResult& result) {
  return visitConvex(a, b, [&](auto queries, const Convex& bodyA, const Convex& bodyB) {
    CoreGap gap;
    if (queries.inClosedForm(bodyA, bodyB, a_from_b, gap)) {
      grow(gap, bodyA, bodyB, result);
      if (!(result.lower > 0.0)) result.normal.setZero();
      return;
    }
    const GjkResult found =
        queries.distance(bodyA, bodyB, a_from_b, options.guess, Goal(options.enough),
                         options.contact, options.tolerance, GjkMode::Exact);
    result.lower = std::min(found.lower, found.upper);
    result.upper = found.upper;
    result.pointA = found.pointA;
    result.pointB = found.pointB;
    if (found.lower > 0.0) result.normal = found.normal;
    result.iterations = found.iterations;
  });
}

bool convexSigned(const Shape& a, const Shape& b, const Isometry3d& a_from_b, double tolerance,
                  SignedDistanceResult& result) {
  return visitConvex(a, b, [&](auto queries, const Convex& bodyA, const Convex& bodyB) {
    CoreGap gap;
    if (queries.inClosedForm(bodyA, bodyB, a_from_b, gap)) {
      growSigned(gap, bodyA, bodyB, result);
      return;
    }
    result = queries.signedDistance(bodyA, bodyB, a_from_b, tolerance);
  });
}

bool convexCollide(const Shape& a, const Shape& b, const Isometry3d& a_from_b, Contact& result) {
  return visitConvex(a, b, [&](auto queries, const Convex& bodyA, const Convex& bodyB) {
    result = queries.collide(bodyA, bodyB, a_from_b);
  });
}

}  // namespace swept::detail
