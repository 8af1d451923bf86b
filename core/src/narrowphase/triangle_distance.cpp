// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/triangle_features.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_pair.hpp"

/// The nearest points are guessed fast and then proven. For any direction n, the gap between the
/// two triangles along n is a lower bound on their distance, and only a right guess makes it as
/// large as the distance of the points. Pairs that cannot be proven this way (touching triangles,
/// slivers, nearly parallel features in near contact) are left to exact predicates and the complete
/// enumeration.
namespace swept {

namespace {

using detail::PointPair;
using detail::TrianglePair;
using Eigen::Vector3d;

/// Relative to the size. A guess proven this close is accepted: a few roundings more than
/// separationAlong() subtracts for itself.
constexpr double kProven = 2e-14;

struct Found {
  PointPair points;
  double lower = 0.0;
};

/// Closes the gap between the distance of the points and the separation along n.
bool proves(const TrianglePair& pair, const Vector3d& n, const PointPair& points, Found& found) {
  const double lower = detail::separationAlong(pair, n);
  if (!(std::sqrt(points.squared) - lower <= kProven * pair.size)) return false;
  found = {points, lower};
  return true;
}

/// The corner nearest the other triangle's plane, if all three are on one side of it and its foot
/// is in the other triangle.
template <bool kFirst>
bool cornerOverFace(const TrianglePair& pair, const Vector3d& normal, Found& found) {
  const auto& corners = kFirst ? pair.p : pair.q;
  const auto& face = kFirst ? pair.q : pair.p;
  const auto& edges = kFirst ? pair.f : pair.e;
  const std::array<double, 3> h{normal.dot(corners[0] - face[0]), normal.dot(corners[1] - face[0]),
                                normal.dot(corners[2] - face[0])};
  const bool above = h[0] > 0.0 && h[1] > 0.0 && h[2] > 0.0;
  if (!above && !(h[0] < 0.0 && h[1] < 0.0 && h[2] < 0.0)) return false;
  int k = std::abs(h[1]) < std::abs(h[0]) ? 1 : 0;
  if (std::abs(h[2]) < std::abs(h[k])) k = 2;
  for (int j = 0; j < 3; ++j) {
    if (!(normal.cross(edges[j]).dot(corners[k] - face[j]) >= 0.0)) return false;
  }
  const Vector3d drop = (-h[k] / normal.squaredNorm()) * normal;
  const Vector3d foot = corners[k] + drop;
  const PointPair points = kFirst ? PointPair{corners[k], foot, drop.squaredNorm()}
                                  : PointPair{foot, corners[k], drop.squaredNorm()};
  const bool fromFirst = kFirst != above;
  return proves(pair, fromFirst ? normal : Vector3d(-normal), points, found);
}

/// Data of each edge for all nine edge pairs.
struct EdgeTable {
  explicit EdgeTable(const std::array<Vector3d, 3>& edges) {
    for (int i = 0; i < 3; ++i) {
      squared[i] = edges[i].squaredNorm();
      inverse[i] = squared[i] > 0.0 ? 1.0 / squared[i] : 0.0;
    }
  }
  std::array<double, 3> squared;
  std::array<double, 3> inverse;
};

/// Parameters of the nearest points of two edges. The rounded determinant decides only where to
/// start: each parameter is then the best one for the other.
struct EdgeParameters {
  double s;
  double t;
  bool insideFirst;
  bool insideSecond;
};

EdgeParameters nearestOnEdges(double ee, double inverseE, double ff, double inverseF, double ef,
                              double er, double fr) {
  const double determinant = ee * ff - ef * ef;
  double s = 0.0;
  if (determinant > 0.0) s = std::clamp((ef * fr - er * ff) / determinant, 0.0, 1.0);
  double t = (ef * s + fr) * inverseF;
  bool insideSecond = true;
  if (!(t > 0.0 && t < 1.0)) {
    t = t > 0.0 ? 1.0 : 0.0;
    s = std::clamp((ef * t - er) * inverseE, 0.0, 1.0);
    insideSecond = false;
  }
  return {s, t, s > 0.0 && s < 1.0, insideSecond};
}

/// The direction that proves the distance of a pair of points on two edges: their difference
/// without what rounding put along an edge in whose interior the point lies. This matters more the
/// nearer the triangles are.
Vector3d provingDirection(const Vector3d& v, const Vector3d& e, double inverseE, const Vector3d& f,
                          double inverseF, const EdgeParameters& at) {
  if (at.insideFirst && at.insideSecond) {
    const Vector3d n = e.cross(f);
    return n.dot(v) >= 0.0 ? n : Vector3d(-n);
  }
  if (at.insideFirst) return v - (v.dot(e) * inverseE) * e;
  if (at.insideSecond) return v - (v.dot(f) * inverseF) * f;
  return v;
}

/// Tries edge pairs until one is proven; otherwise false.
bool edgePairs(const TrianglePair& pair, Found& found) {
  const EdgeTable tableE(pair.e);
  const EdgeTable tableF(pair.f);
  const double slack = kProven * pair.size;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector3d& e = pair.e[i];
      const Vector3d& f = pair.f[j];
      const Vector3d r = pair.p[i] - pair.q[j];
      const EdgeParameters at =
          nearestOnEdges(tableE.squared[i], tableE.inverse[i], tableF.squared[j], tableF.inverse[j],
                         e.dot(f), e.dot(r), f.dot(r));
      const Vector3d p = pair.p[i] + at.s * e;
      const Vector3d q = pair.q[j] + at.t * f;
      const Vector3d v = q - p;
      const double squared = v.squaredNorm();
      if (!(squared < least)) continue;
      least = squared;
      // The pair can be the nearest one only if neither third corner is ahead.
      const double aheadP = v.dot(pair.p[(i + 2) % 3] - p);
      const double aheadQ = -v.dot(pair.q[(j + 2) % 3] - q);
      const double ahead = std::max({aheadP, aheadQ, 0.0});
      if (ahead * ahead > slack * slack * squared) continue;
      const Vector3d n = provingDirection(v, e, tableE.inverse[i], f, tableF.inverse[j], at);
      if (proves(pair, n, {p, q, squared}, found)) return true;
    }
  }
  return false;
}

/// A lower bound in metres. Unscaling is exact but for subnormal numbers, which could be rounded
/// up.
double boundInMetres(const TrianglePair& pair, double lower) {
  const double metres = lower / pair.scale;
  return metres >= std::numeric_limits<double>::min() ? metres : 0.0;
}

/// The points in metres and in the frame of the input.
TriangleDistance inMetres(const TrianglePair& pair, const Found& found, const Vector3d& origin) {
  const double metres = 1.0 / pair.scale;
  // Points may round to one although the triangles do not touch.
  const double upper =
      std::max(metres * std::sqrt(found.points.squared), std::numeric_limits<double>::min());
  return {std::min(boundInMetres(pair, found.lower), upper), upper,
          origin + metres * found.points.p, origin + metres * found.points.q};
}

TriangleDistance unknownDistance(const TriangleCorners& a, const TriangleCorners& b) {
  return {0.0, std::numeric_limits<double>::infinity(), a[0], b[0]};
}

/// The pairs that the fast guesses did not settle.
TriangleDistance hardDistance(const TrianglePair& pair, const TriangleCorners& a,
                              const TriangleCorners& b) {
  if (!std::isfinite(pair.size)) return unknownDistance(a, b);
  if (trianglesTouch(a, b)) {
    const Vector3d point = triangleContact(a, b).point;
    return {0.0, 0.0, point, point};
  }
  Found found;
  found.points = detail::nearestFeatures(pair);
  found.lower = detail::bestSeparation(pair, found.points.q - found.points.p);
  return inMetres(pair, found, a[0]);
}

}  // namespace

TriangleDistance triangleDistance(const TriangleCorners& a, const TriangleCorners& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return triangleDistance(a, b); });
  }
  return triangleDistance(a, b, std::numeric_limits<double>::infinity());
}

TriangleDistance triangleDistance(const TriangleCorners& a, const TriangleCorners& b,
                                  double enough) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, enough] { return triangleDistance(a, b, enough); });
  }
  const TrianglePair pair(a, b);
  if (enough < std::numeric_limits<double>::infinity()) {
    const Vector3d between = (pair.q[0] + pair.q[1] + pair.q[2]) - (pair.p[1] + pair.p[2]);
    const double lower = boundInMetres(pair, detail::separationAlong(pair, between));
    if (lower > enough) return {lower, std::numeric_limits<double>::infinity(), a[0], b[0]};
  }
  Found found;
  if (cornerOverFace<true>(pair, pair.f[0].cross(pair.f[1]), found) ||
      cornerOverFace<false>(pair, pair.e[0].cross(pair.e[1]), found) || edgePairs(pair, found)) {
    // Proven apart only if the bound is positive; otherwise the exact predicate decides.
    if (found.lower > 0.0) return inMetres(pair, found, a[0]);
  }
  return hardDistance(pair, a, b);
}

}  // namespace swept
