// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/triangle_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/error_model.hpp"
#include "narrowphase/exact_sign.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

void keepNearer(PointPair& best, const Vector3d& p, const Vector3d& q) {
  const double squared = (q - p).squaredNorm();
  if (squared < best.squared) best = {p, q, squared};
}

/// Nearest point of the segment from `start` along `edge`.
Vector3d onSegment(const Vector3d& point, const Vector3d& start, const Vector3d& edge) {
  const double along = (point - start).dot(edge);
  const double length = edge.squaredNorm();
  if (!(along > 0.0)) return start;
  if (!(along < length)) return start + edge;
  return start + (along / length) * edge;
}

/// The component of y orthogonal to x. x must be the longer one. The second subtraction removes
/// what rounding left along x in the first; this matters as soon as the orthogonal part is small.
Vector3d across(const Vector3d& y, const Vector3d& x) {
  const double length = x.squaredNorm();
  if (!(length > 0.0)) return y;
  const Vector3d once = y - (y.dot(x) / length) * x;
  return once - (once.dot(x) / length) * x;
}

/// Where two edges are nearest within both of their interiors; other features handle their ends. It
/// uses `across`, so that nearly parallel edges cost no accuracy: the error of `t` is that of the
/// coordinates over the length of `rise`, and moving by it changes the distance by the error of the
/// coordinates.
bool insideEdges(const Vector3d& start, const Vector3d& edge, const Vector3d& otherStart,
                 const Vector3d& otherEdge, Vector3d& on, Vector3d& onOther) {
  const Vector3d rise = across(otherEdge, edge);
  const Vector3d offset = otherStart - start;
  const double height = rise.squaredNorm();
  if (height == 0.0) return false;  // parallel
  const double t = -offset.dot(rise) / height;
  if (!(t > 0.0 && t < 1.0)) return false;
  onOther = otherStart + t * otherEdge;
  const double s = (onOther - start).dot(edge) / edge.squaredNorm();
  if (!(s > 0.0 && s < 1.0)) return false;
  on = start + s * edge;
  return true;
}

/// ClosestPoint of the perpendicular from a point to a triangle, if it falls inside. Built on the
/// longest edge and the height over it, for the same reason as insideEdges().
bool insideFace(const Vector3d& point, const std::array<Vector3d, 3>& corners,
                const std::array<Vector3d, 3>& edges, Vector3d& foot) {
  int k = 0;
  for (int i = 1; i < 3; ++i) {
    if (edges[i].squaredNorm() > edges[k].squaredNorm()) k = i;
  }
  const Vector3d& base = edges[k];
  const Vector3d side = -edges[(k + 2) % 3];
  const Vector3d rise = across(side, base);
  const double length = base.squaredNorm();
  const double height = rise.squaredNorm();
  if (height == 0.0) return false;  // a triangle without area
  const double top = (point - corners[k]).dot(rise) / height;
  if (!(top >= 0.0 && top <= 1.0)) return false;
  const Vector3d level = corners[k] + top * side;
  const double along = (point - level).dot(base) / length;
  if (!(along >= 0.0 && along <= 1.0 - top)) return false;
  foot = level + along * base;
  return true;
}

}  // namespace

TrianglePair::TrianglePair(const TriangleCorners& a, const TriangleCorners& b) {
  for (int i = 0; i < 3; ++i) {
    p[i] = a[i] - a[0];
    q[i] = b[i] - a[0];
  }
  Vector3d most = q[0].cwiseAbs();
  for (const Vector3d& corner : {p[1], p[2], q[1], q[2]}) most = most.cwiseMax(corner.cwiseAbs());
  const Vector3d poison = 0.0 * (p[1] + p[2] + q[0] + q[1] + q[2]);
  size = most.maxCoeff() + poison.sum();
  // Sixth powers of lengths have to stay in range.
  if (!(size >= 1e-30 && size <= 1e30) && size > 0.0 && std::isfinite(size)) {
    scale = std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000));
    for (int i = 0; i < 3; ++i) {
      p[i] *= scale;
      q[i] *= scale;
    }
    size *= scale;
  }
  for (int i = 0; i < 3; ++i) {
    e[i] = p[(i + 1) % 3] - p[i];
    f[i] = q[(i + 1) % 3] - q[i];
  }
}

/// Lemma. Let u = 2^-53, r = sqrt(3) * size >= every |p[i]|, |q[j]|. Each rounded dot product is
/// within 3.01 u |n| r of its exact value for the rounded corner, and that within u |n| r of the
/// one for the corner itself: the rounded gap is within (2 * 4.01 u |n| r + u |gap|) of the true
/// one, that is within 14 u |n| size + u |gap|. |n| itself is computed within 3 u, the division
/// rounds by u. kTriangleGap and kTriangleGapShare therefore cover everything. Underflow loses less
/// than 1e-320 of a dot product, which is far below the slack since |n| >= 1e-100 and size >=
/// 1e-30.
double separationAlong(const TrianglePair& pair, const Vector3d& n) {
  const double length = n.norm();
  if (!(length >= 1e-100 && length <= 1e100)) return -std::numeric_limits<double>::infinity();
  const double mostP = std::max({n.dot(pair.p[0]), n.dot(pair.p[1]), n.dot(pair.p[2])});
  const double leastQ = std::min({n.dot(pair.q[0]), n.dot(pair.q[1]), n.dot(pair.q[2])});
  const double gap = (leastQ - mostP) / length;
  return gap - kTriangleGap * pair.size - kTriangleGapShare * std::abs(gap);
}

double bestSeparation(const TrianglePair& pair, const Vector3d& towards) {
  double best = separationAlong(pair, towards);
  const auto tryBoth = [&](const Vector3d& n) {
    best = std::max(best, separationAlong(pair, n));
    best = std::max(best, separationAlong(pair, -n));
  };
  tryBoth(faceNormal(pair.e));
  tryBoth(faceNormal(pair.f));
  for (int i = 0; i < 3; ++i) {
    best = std::max(best, separationAlong(pair, across(towards, pair.e[i])));
    best = std::max(best, separationAlong(pair, across(towards, pair.f[i])));
    for (int j = 0; j < 3; ++j) tryBoth(perpendicular(pair.e[i], pair.f[j]));
  }
  return best;
}

Vector3d perpendicular(const Vector3d& x, const Vector3d& y) {
  return x.squaredNorm() >= y.squaredNorm() ? Vector3d(x.cross(across(y, x)))
                                            : Vector3d(across(x, y).cross(y));
}

Vector3d faceNormal(const std::array<Vector3d, 3>& edges) {
  int k = 0;
  for (int i = 1; i < 3; ++i) {
    if (edges[i].squaredNorm() > edges[k].squaredNorm()) k = i;
  }
  return edges[k].cross(across(edges[(k + 1) % 3], edges[k]));
}

Vector3d nearestOnTriangle(const Vector3d& point, const std::array<Vector3d, 3>& corners,
                           const std::array<Vector3d, 3>& edges) {
  PointPair best{point, corners[0], std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 3; ++i) keepNearer(best, point, onSegment(point, corners[i], edges[i]));
  Vector3d foot;
  if (insideFace(point, corners, edges, foot)) keepNearer(best, point, foot);
  return best.q;
}

PointPair nearestFeatures(const TrianglePair& pair) {
  PointPair best{pair.p[0], pair.q[0], (pair.q[0] - pair.p[0]).squaredNorm()};
  Vector3d on;
  Vector3d other;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      keepNearer(best, pair.p[i], onSegment(pair.p[i], pair.q[j], pair.f[j]));
      keepNearer(best, onSegment(pair.q[j], pair.p[i], pair.e[i]), pair.q[j]);
      const bool firstLonger = pair.e[i].squaredNorm() >= pair.f[j].squaredNorm();
      const bool inside = firstLonger
                              ? insideEdges(pair.p[i], pair.e[i], pair.q[j], pair.f[j], on, other)
                              : insideEdges(pair.q[j], pair.f[j], pair.p[i], pair.e[i], other, on);
      if (inside) keepNearer(best, on, other);
    }
    if (insideFace(pair.p[i], pair.q, pair.f, other)) keepNearer(best, pair.p[i], other);
    if (insideFace(pair.q[i], pair.p, pair.e, on)) keepNearer(best, on, pair.q[i]);
  }
  return best;
}

}  // namespace swept::detail
