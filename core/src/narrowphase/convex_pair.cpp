// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/convex_pair.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "narrowphase/box_box.hpp"
#include "narrowphase/epa.hpp"
#include "narrowphase/extreme_pair.hpp"
#include "narrowphase/face_probe.hpp"
#include "narrowphase/flat_pair.hpp"
#include "narrowphase/point_box.hpp"
#include "narrowphase/point_cone.hpp"
#include "narrowphase/point_cylinder.hpp"
#include "narrowphase/point_point.hpp"
#include "narrowphase/point_segment.hpp"
#include "narrowphase/point_triangle.hpp"
#include "narrowphase/segment_segment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Core = Convex::Core;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kCores = 9;

/// A core that has a foot for any point makes a closed form with the point, whichever comes first.
template <Core kind>
concept HasFoot = requires(const Convex& body, const Vector3d& p, Foot& foot) {
  footOn(CoreTag<kind>{}, body, p, foot);
};

template <Core kind>
requires HasFoot<kind>
[[gnu::always_inline]] inline bool closedForm(PointCore, CoreTag<kind> tag, const Convex& a,
                                              const Convex& b, const Isometry3d& a_from_b,
                                              CoreGap& gap) {
  Foot foot;
  if (!footOn(tag, b, originOfAInB(a_from_b), foot)) return false;
  gap = gapFromPoint(foot, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Core kind>
requires HasFoot<kind>
[[gnu::always_inline]] inline bool closedForm(CoreTag<kind> tag, PointCore, const Convex& a,
                                              const Convex& b, const Isometry3d& a_from_b,
                                              CoreGap& gap) {
  Foot foot;
  if (!footOn(tag, a, a_from_b.translation(), foot)) return false;
  gap = gapToPoint(foot, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Core kindA, Core kindB>
concept HasClosedForm = requires(const Convex& body, const Isometry3d& pose, CoreGap& gap) {
  closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, body, body, pose, gap);
};

template <Core kind>
constexpr bool kFlat = kind == Core::Plane || kind == Core::HalfSpace;

/// A core that no one wants without a ball around it.
template <Core kind>
constexpr bool kRound = kind == Core::Point || kind == Core::Segment;

/// Grown by their balls, the bodies are apart by the cores' distance less both radii. Fills the
/// caller's result in place: copies of results cost as much as the closed forms of spheres.
template <typename Result>
[[gnu::always_inline]] inline void grow(const CoreGap& gap, const Convex& a, const Convex& b,
                                        Result& result) {
  result.iterations = 1;
  const double apart = gap.distance - a.radius - b.radius;
  if (apart > 0.0) {
    result.upper = apart;
    result.pointA = moved(gap.pointA, a.radius, gap.normal);
    result.pointB = moved(gap.pointB, -b.radius, gap.normal);
    result.lower = std::max(0.0, apart - gap.rounding);
    result.normal = gap.normal;
    return;
  }
  result.upper = 0.0;
  if (gap.distance > 0.0) {
    // Any point at s from A's core, distance - radiusB <= s <= radiusA, belongs to both.
    const double s = std::clamp(0.5 * (a.radius + gap.distance - b.radius), 0.0, gap.distance);
    result.pointA = moved(gap.pointA, s, gap.normal);
  } else {
    result.pointA = gap.common;
  }
  result.pointB = result.pointA;
  result.normal = gap.normal;
}

inline GjkResult grown(const CoreGap& gap, const Convex& a, const Convex& b, const Goal& goal) {
  GjkResult result;
  grow(gap, a, b, result);
  result.satisfied = result.lower > 0.0 && result.lower > goal.along(gap.normal);
  return result;
}

[[gnu::always_inline]] inline void growSigned(const CoreGap& gap, const Convex& a, const Convex& b,
                                              SignedDistanceResult& result) {
  const double apart = gap.distance - a.radius - b.radius;
  result.iterations = 1;
  result.lower = apart - gap.rounding;
  result.upper = apart + gap.rounding;
  result.normal = gap.normal;
  result.pointA = moved(gap.pointA, a.radius, gap.normal);
  result.pointB = moved(gap.pointB, -b.radius, gap.normal);
}

inline SignedDistanceResult grownSigned(const CoreGap& gap, const Convex& a, const Convex& b) {
  SignedDistanceResult result;
  growSigned(gap, a, b, result);
  return result;
}

/// The deepest points of two cores that overlap by `depth` along `normal`, the shortest way out:
/// moved a little farther than that, they are nearest to each other there.
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

Contact contactOf(const GjkResult& result) {
  if (result.lower > 0.0) return Contact::Separate;
  return result.upper <= 0.0 ? Contact::Touching : Contact::Unknown;
}

/// An ellipsoid as a smaller core and a ball. Lemma (Blaschke's rolling theorem): a ball of the
/// least radius of curvature, (least semi-axis)^2 / greatest, is a summand of the ellipsoid.
/// Overlaps shallower than that are gaps of the cores, and need no EPA.
Convex shaved(const Convex& body) {
  constexpr double kWithin = 0.999;  // of that radius: the core stays round
  Convex core = body;
  if (body.core != Core::Ellipsoid) return core;
  const double least = body.size.minCoeff();
  const double most = body.size.maxCoeff();
  if (!(least > 0.0)) return core;
  core.shave = kWithin * least * (least / most);
  core.radius += core.shave;
  return core;
}

/// The cores decide; growing both by balls lowers the signed distance by the two radii, apart or
/// not.
SignedDistanceResult signedByEpa(const Convex& a, const Convex& b, const Isometry3d& a_from_b,
                                 const Vector3d& guess, double tolerance) {
  Convex coreA = shaved(a);
  Convex coreB = shaved(b);
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
  // Points witness a distance; of a depth that they leave, their rounding counts.
  if (result.upper < 0.0) result.upper += pairRounding(coreA, coreB, a_from_b);
  // The normal proves, but the way between the points is what makes them as far apart as it says.
  const Vector3d way = result.pointB - result.pointA;
  const double length = way.norm();
  const Vector3d n = apart.lower > 0.0 && length > 0.0 ? Vector3d(way / length) : result.normal;
  result.pointA += radiusA * n;
  result.pointB -= radiusB * n;
  return result;
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

/// The flat faces of either body that look at the other one.
struct Look {
  double separation = -std::numeric_limits<double>::infinity();  ///< m, proven but for rounding
  Vector3d normal = Vector3d::Zero();  ///< of the face that separates most, from a to b
  bool inside = false;                 ///< `gap.common` is in both cores
  bool exact = false;                  ///< `gap` is the answer
  CoreGap gap;
};

/// Over a face, the point nearest to its plane is nearest to the body.
void note(const FaceProbe& found, Look& look) {
  if (found.separation > look.separation) {
    look.separation = found.separation;
    look.normal = found.normal;
    look.exact = found.over && found.separation > 0.0;
    if (look.exact) {
      look.gap.distance = found.separation;
      look.gap.normal = found.normal;
      look.gap.pointA = found.lowest - found.separation * found.normal;
      look.gap.pointB = found.lowest;
    }
  }
}

template <Core kindA, Core kindB>
Look look(const Convex& a, const Convex& b, const Isometry3d& a_from_b) {
  Look look;
  if constexpr (probe::kHasFaces<kindA>) {
    const FaceProbe found =
        probeFaces(CoreTag<kindA>{}, a, b, a_from_b.linear(), a_from_b.translation());
    if (found.inside) {
      look.inside = true;
      look.gap.distance = 0.0;
      look.gap.normal = found.normal;
      look.gap.common = found.lowest;
      return look;
    }
    note(found, look);
  }
  if constexpr (probe::kHasFaces<kindB>) {
    const FaceProbe found =
        probeFaces(CoreTag<kindB>{}, b, a, a_from_b.linear().transpose(), originOfAInB(a_from_b));
    if (found.inside) {
      look.inside = true;
      look.gap.distance = 0.0;
      look.gap.normal = -(a_from_b.linear() * found.normal);
      look.gap.common = a_from_b * found.lowest;
      return look;
    }
    if (found.separation > look.separation) {
      note(found, look);
      look.normal = -(a_from_b.linear() * look.normal);
      look.gap.normal = look.normal;
      std::swap(look.gap.pointA, look.gap.pointB);
      look.gap.pointA = a_from_b * look.gap.pointA;
      look.gap.pointB = a_from_b * look.gap.pointB;
    }
  }
  look.gap.rounding = pairRounding(a, b, a_from_b);
  return look;
}

/// The three queries of one kind of pair. What a pair has no closed form for, GJK and EPA answer.
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
        // A warm start says more than the faces do.
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

  /// True with the gap of the cores where these have a closed form that answers.
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
  return Core::Points;
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
