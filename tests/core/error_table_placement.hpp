// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "error_table_body.hpp"

namespace error_table {

/// The signed distance is between these.
struct Truth {
  Real lower, upper;  ///< m
};

struct Placement {
  Isometry3d a_from_b = Isometry3d::Identity();
  Truth truth;
  Feature featureA = Feature::Curve;
  Feature featureB = Feature::Curve;
};

/// A direction in which a body is touched at a chosen feature: exactly `exact`, or exactly across
/// it, or anything near `normal`. In the body's frame.
struct Wish {
  enum class Tie : std::uint8_t { None, Across, Along };
  Tie tie = Tie::None;
  Point exact{};
  Vector3d normal = Vector3d::UnitX();
};

inline Wish along(const Point& n) {
  return {Wish::Tie::Along, n, rounded(n)};
}

inline Wish drawPointsWish(const Body& body, Random& random) {
  const int choice = random.below(3);
  if (choice == 0 && !body.faces.empty()) {
    return along(body.faceNormal(random.below(body.faces.size())));
  }
  if (choice == 1 && !body.edges.empty()) {
    const int edge = random.below(body.edges.size());
    const Body::Edge& e = body.edges[edge];
    const Vector3d end = random.chance(0.5) ? e.first : e.last;
    const Vector3d normal =
        body.faces.empty() ? random.across(Vector3d::UnitZ())
                           : (e.middle + random.uniform(0.0, 0.99) * (end - e.middle)).normalized();
    return {Wish::Tie::Across, body.edgeVector(edge), normal};
  }
  return {.normal = random.direction()};
}

inline Wish drawWish(const Body& body, Random& random) {
  if (body.isFlat()) {
    const Point n = unit(real(body.size));
    return along(body.halfSpace || random.chance(0.5) ? n : n * Real(-1));
  }
  if (body.core == Body::Core::Points) return drawPointsWish(body, random);
  const int choice = body.core == Body::Core::Ellipsoid ? 3 : random.below(4);
  const bool cone = body.core == Body::Core::Cone;
  if (choice == 0) return along(basis(2) * Real(cone ? -1.0 : random.sign()));
  if (choice == 1 && !cone) {
    return {Wish::Tie::Across, basis(2), random.across(Vector3d::UnitZ())};
  }
  if (choice == 1) {  // the normal of the cone's side
    const Point aside = unit(real(random.across(Vector3d::UnitZ())));
    const Point across = unit(Point{aside.x, aside.y, 0});
    return along(unit(across * Real(2.0 * body.size.z()) + basis(2) * Real(body.size.x())));
  }
  if (choice == 2 && cone) {  // the apex of a slender one is touched from a few directions only
    const double slope = random.uniform(0.0, 2.0 * body.size.z() / body.size.x());
    return {.normal = (slope * random.across(Vector3d::UnitZ()) +
                       Vector3d(0.0, 0.0, 1.0 + slope * body.size.x() / body.size.z()))
                          .normalized()};
  }
  return {.normal = random.direction()};
}

/// Brings b's wish against a's, up to a small angle now and then.
inline Matrix3d drawTurn(const Vector3d& normalA, Vector3d normalB, Random& random) {
  if (random.chance(0.2)) return random.permutation();
  if (random.chance(0.3)) {
    const double angle = random.decades(-14.0, -3.0);
    normalB = (normalB + angle * random.direction()).normalized();
  }
  const Vector3d u = random.across(normalA);
  const Vector3d v = random.across(normalB);
  Matrix3d frameA, frameB;
  frameA << normalA, u, normalA.cross(u);
  frameB << -normalB, v, -normalB.cross(v);
  return Eigen::Quaterniond(Matrix3d(frameA * frameB.transpose())).normalized().toRotationMatrix();
}

inline Point projected(const Vector3d& n, const Point& across) {
  const Point exact = real(n);
  return unit(exact - across * (exact.dot(across) / across.dot(across)));
}

/// The direction from a to b, in a's frame, which does as much of both wishes as can be done.
inline Point direction(const Wish& a, const Wish& b, const ExactTurn& turn, bool firstA) {
  using Tie = Wish::Tie;
  if (a.tie == Tie::Along && (firstA || b.tie != Tie::Along)) return a.exact;
  if (b.tie == Tie::Along) return unit(turn.normal(b.exact)) * Real(-1);
  if (a.tie == Tie::Across && b.tie == Tie::Across) {
    const Point cross = a.exact.cross(turn * b.exact);
    const Real length2 = cross.dot(cross);
    if (length2 > Real("1e-30") * a.exact.dot(a.exact) * b.exact.dot(b.exact)) {
      return unit(cross) * Real(rounded(unit(cross)).dot(a.normal) < 0.0 ? -1 : 1);
    }
  }
  if (a.tie == Tie::Across) return projected(a.normal, a.exact);
  if (b.tie == Tie::Across) return projected(a.normal, turn * b.exact);
  return unit(real(a.normal));
}

/// Two bodies whose support points along `n` coincide: by their support planes they touch.
struct Touch {
  Matrix3d linear;
  Point n{};
  Point shift{};  ///< m, the translation of b at which they touch
  Feature featureA, featureB;
};

inline Touch drawTouch(const Body& a, const Body& b, Random& random) {
  const Wish wishA = drawWish(a, random);
  const Wish wishB = drawWish(b, random);
  Touch touch;
  touch.linear = drawTurn(wishA.normal, wishB.normal, random);
  const ExactTurn turn(touch.linear);
  const bool firstA = a.isFlat() || (!b.isFlat() && random.chance(0.5));
  touch.n = direction(wishA, wishB, turn, firstA);
  const double spread = random.chance(0.5) ? 0.0 : std::max(a.extent, b.extent);
  const Support pointA = supportOf(a, touch.n, spread, random);
  // The ball of b turns into itself, whatever the rounding of the turn.
  const Point back = turn.transposed(touch.n) * Real(-1);
  Body core = b;
  core.radius = 0.0;
  const Support pointB = supportOf(core, unit(back), spread, random);
  touch.featureA = pointA.feature;
  touch.featureB = b.points.size() == 1 ? Feature::Curve : pointB.feature;
  touch.shift = pointA.point - turn * pointB.point + touch.n * Real(b.radius);
  return touch;
}

inline Placement placed(const Touch& touch, const Point& translation) {
  Placement result;
  result.a_from_b.linear() = touch.linear;
  result.a_from_b.translation() = rounded(translation);
  result.featureA = touch.featureA;
  result.featureB = touch.featureB;
  return result;
}

/// Of a plane or a half-space the gap is exact, and negative in overlap with what faces it.
inline Placement placedAlong(const Touch& touch, const Real& gap) {
  const Point exact = touch.shift + touch.n * gap;
  Placement result = placed(touch, exact);
  const Point e = real(Vector3d(result.a_from_b.translation())) - exact;
  result.truth.lower = result.truth.upper = gap + touch.n.dot(e);
  return result;
}

/// Lemma: at translation shift + g n + e the bodies are between the support planes apart, g + n.e,
/// and no farther than the support points, |g n + e|. Here e is the rounding of the translation.
inline Placement placeApart(const Body& a, const Body& b, Random& random) {
  const Touch touch = drawTouch(a, b, random);
  const double size = random.chance(0.5) ? a.extent : b.extent;
  const Real gap = random.chance(0.05) ? Real(0) : Real(size * random.decades(-13.0, 1.0));
  if (a.isFlat() || b.isFlat()) return placedAlong(touch, gap);
  const Point exact = touch.shift + touch.n * gap;
  Placement result = placed(touch, exact);
  const Point e = real(Vector3d(result.a_from_b.translation())) - exact;
  result.truth = {gap + touch.n.dot(e), length(touch.n * gap + e)};
  return result;
}

/// A bounded body across a plane, or reaching into a half-space; the depth has to be looked for.
inline Placement placeAcross(const Body& a, const Body& b, Random& random) {
  const double size = a.isFlat() ? b.extent : a.extent;
  const Real depth = size * (random.chance(0.5) ? random.decades(-9.0, 0.0) : random.uniform(0, 2));
  return placedAlong(drawTouch(a, b, random), -depth);
}

/// Lemma: the difference of the bodies is a convex set grown by a ball of radius r, the sum of
/// those that roll inside them. A translation p < r inside it is r - p away from that set at
/// distance r from the surface, so that the lemma above gives the depth p.
inline Placement placeShallow(const Body& a, const Body& b, Random& random) {
  const Touch touch = drawTouch(a, b, random);
  const Real r = a.rolling + b.rolling;
  const Real depth =
      r * Real(0.95 * (random.chance(0.5) ? random.decades(-9.0, 0.0) : random.uniform(0.0, 1.0)));
  const Point exact = touch.shift - touch.n * depth;
  Placement result = placed(touch, exact);
  const Point e = real(Vector3d(result.a_from_b.translation())) - exact;
  result.truth = {touch.n.dot(e) - depth, length(touch.n * (r - depth) + e) - r};
  return result;
}

/// With a point inside both; the depth has to be looked for.
inline Placement placeDeep(const Body& a, const Body& b, Random& random) {
  const auto inside = [&](const Body& body) {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    for (int i = 0; i < 5; ++i) {
      const double weight = random.uniform(0.1, 1.0);
      const Point n = unit(real(random.direction()));
      sum += weight * rounded(supportOfCore(body, n, 0.0, random).point);
      weights += weight;
    }
    return Vector3d(sum / weights);
  };
  Placement result;
  const Wish wishA = drawWish(a, random);
  const Wish wishB = drawWish(b, random);
  result.a_from_b.linear() = drawTurn(wishA.normal, wishB.normal, random);
  const Vector3d pointA = inside(a);
  result.a_from_b.translation() = pointA - result.a_from_b.linear() * inside(b);
  return result;
}

}  // namespace error_table
