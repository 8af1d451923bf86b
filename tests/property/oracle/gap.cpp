// SPDX-License-Identifier: BSD-3-Clause
#include "gap.hpp"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

/// Least value of a convex function on the segment from p to q, by golden section.
template <class Function>
double leastAlong(const Vector3d& p, const Vector3d& q, const Function& at) {
  constexpr double kGolden = 0.6180339887498949;
  double lo = 0, hi = 1, best = std::min(at(p), at(q));
  double x = hi - kGolden, y = lo + kGolden;
  double fx = at(p + x * (q - p)), fy = at(p + y * (q - p));
  for (int i = 0; i < 48; ++i) {
    best = std::min({best, fx, fy});
    if (fx <= fy) {
      hi = y, y = x, fy = fx, x = hi - kGolden * (hi - lo), fx = at(p + x * (q - p));
    } else {
      lo = x, x = y, fx = fy, y = lo + kGolden * (hi - lo), fy = at(p + y * (q - p));
    }
  }
  return best;
}

/// Whether a coordinate plane or one of the triangles' own keeps them more than `enough` apart.
bool apart(const Triangle& a, const Triangle& b, double enough) {
  const auto beyond = [&](const Vector3d& n, double margin) {
    const double a0 = n.dot(a[0]), a1 = n.dot(a[1]), a2 = n.dot(a[2]);
    const double b0 = n.dot(b[0]), b1 = n.dot(b[1]), b2 = n.dot(b[2]);
    return std::min({a0, a1, a2}) > std::max({b0, b1, b2}) + margin ||
           std::min({b0, b1, b2}) > std::max({a0, a1, a2}) + margin;
  };
  for (int i = 0; i < 3; ++i)
    if (beyond(Vector3d::Unit(i), enough)) return true;
  for (const Triangle* t : {&a, &b}) {
    const Vector3d n = ((*t)[1] - (*t)[0]).cross((*t)[2] - (*t)[0]);
    if (beyond(n, enough * n.norm())) return true;
  }
  return false;
}

double between(const Sphere& s, const Triangle& t) {
  return closestPoint(t, Vector3d::Zero()).norm() - s.radius;
}

double between(const Capsule& c, const Triangle& t) {
  return segmentDistance(t, {0, 0, -c.half}, {0, 0, c.half}) - c.radius;
}

Vector3d corner(const Box& b, int i) {
  return {i & 1 ? b.half.x() : -b.half.x(), i & 2 ? b.half.y() : -b.half.y(),
          i & 4 ? b.half.z() : -b.half.z()};
}

/// Calls use(p, q) for the twelve edges.
template <class Use>
void forEdges(const Box& b, Use use) {
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if (!(i & bit)) use(corner(b, i), corner(b, i | bit));
}

double between(const Box& b, const Triangle& t) {
  double d = INFINITY;
  for (const Vector3d& p : t) d = std::min(d, distanceTo(b, p));
  for (int i = 0; i < 8; ++i) {
    const Vector3d p = corner(b, i);
    d = std::min(d, (closestPoint(t, p) - p).norm());
  }
  forEdges(b, [&](const Vector3d& p, const Vector3d& q) {
    for (int i = 0; i < 3; ++i) d = std::min(d, perpendicular(p, q, t[i], t[(i + 1) % 3]));
  });
  return d;
}

/// Closest is a point of an edge, or else the triangle's plane separates and what the cylinder
/// reaches farthest towards it decides: a rim point, or with a flat or upright triangle the ends of
/// a line or the middle of an end disc.
double between(const Cylinder& c, const Triangle& t) {
  double d = INFINITY;
  for (int i = 0; i < 3; ++i)
    d = std::min(
        d, leastAlong(t[i], t[(i + 1) % 3], [&](const Vector3d& p) { return distanceTo(c, p); }));
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double across = std::hypot(n.x(), n.y());
  for (const double z : {-c.half, c.half}) {
    for (const double side : {-1.0, 0.0, 1.0}) {
      const double reach = across > 0 ? side * c.radius / across : 0.0;
      const Vector3d p(reach * n.x(), reach * n.y(), z);
      d = std::min(d, (closestPoint(t, p) - p).norm());
    }
  }
  return d;
}

/// Whether the triangle's plane, or the sides of the cylinder seen along its axis, keep the two
/// more than `enough` apart.
bool apart(const Cylinder& c, const Triangle& t, double enough) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  if (std::abs(n.dot(t[0])) > support(c, n) + enough * n.norm()) return true;
  Triangle seen = t;
  for (Vector3d& p : seen) p.z() = 0;
  return closestPoint(seen, Vector3d::Zero()).norm() > c.radius + enough;
}

double between(const Box& a, const Box& b, const Isometry3d& a_from_b) {
  double d = INFINITY;
  const Isometry3d b_from_a = a_from_b.inverse();
  for (int i = 0; i < 8; ++i)
    d = std::min(
        {d, distanceTo(a, a_from_b * corner(b, i)), distanceTo(b, b_from_a * corner(a, i))});
  forEdges(b, [&](const Vector3d& p, const Vector3d& q) {
    const Vector3d r = a_from_b * p, s = a_from_b * q;
    forEdges(a, [&](const Vector3d& u, const Vector3d& v) {
      d = std::min(d, perpendicular(r, s, u, v));
    });
  });
  return d;
}

double between(const Cylinder& c, const Box& b, const Isometry3d& cylinder_from_box) {
  double d = INFINITY;
  for (int i = 0; i < 8; ++i)
    for (const auto& [u, v] : {std::pair(1, 2), std::pair(2, 4), std::pair(4, 1)}) {
      // Half a face at each of its two corners that have both bits equal.
      if (bool(i & u) != bool(i & v)) continue;
      d = std::min(d, between(c, moved(cylinder_from_box,
                                       {corner(b, i), corner(b, i ^ u), corner(b, i ^ v)})));
    }
  return d;
}

}  // namespace

Gap gap(const Triangle& a, const Triangle& b, double enough) {
  if (apart(a, b, enough)) return {enough, enough};
  // Closest are a corner and a triangle, or the feet of two edges' common perpendicular.
  double d = INFINITY;
  for (int i = 0; i < 3; ++i) {
    d = std::min({d, (closestPoint(a, b[i]) - b[i]).norm(), (closestPoint(b, a[i]) - a[i]).norm()});
    for (int k = 0; k < 3; ++k)
      d = std::min(d, perpendicular(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return {d, d};
}

Gap gap(const Primitive& solid, const Triangle& t, double enough) {
  const Vector3d half = bounds(solid).array() + enough;
  for (int i = 0; i < 3; ++i)
    if (std::min({t[0][i], t[1][i], t[2][i]}) > half[i] ||
        std::max({t[0][i], t[1][i], t[2][i]}) < -half[i])
      return {enough, enough};
  if (const auto* c = std::get_if<Cylinder>(&solid); c && apart(*c, t, enough))
    return {enough, enough};
  const double d = std::max(0.0, std::visit([&](const auto& s) { return between(s, t); }, solid));
  return {d, d};
}

double axisDistance(const Capsule& c, const Primitive& solid,
                    const Isometry3d& solid_from_capsule) {
  return leastAlong(solid_from_capsule * Vector3d(0, 0, -c.half),
                    solid_from_capsule * Vector3d(0, 0, c.half),
                    [&](const Vector3d& p) { return distanceTo(solid, p); });
}

Gap gap(const Primitive& a, const Primitive& b, const Isometry3d& a_from_b) {
  const auto exactly = [](double d) { return Gap{std::max(0.0, d), std::max(0.0, d)}; };
  const Isometry3d b_from_a = a_from_b.inverse();
  if (const auto* s = std::get_if<Sphere>(&a))
    return exactly(distanceTo(b, b_from_a.translation()) - s->radius);
  if (const auto* c = std::get_if<Capsule>(&a))
    return exactly(axisDistance(*c, b, b_from_a) - c->radius);
  const auto* boxA = std::get_if<Box>(&a);
  const auto* boxB = std::get_if<Box>(&b);
  if (boxA && boxB) return exactly(between(*boxA, *boxB, a_from_b));
  if (!boxA && boxB) return exactly(between(std::get<Cylinder>(a), *boxB, a_from_b));
  const auto* cylinderA = std::get_if<Cylinder>(&a);
  const auto* cylinderB = std::get_if<Cylinder>(&b);
  if (cylinderA && cylinderB) return cylinderGap(*cylinderA, *cylinderB, a_from_b, 0.0);
  return gap(b, a, b_from_a);
}

/// Projecting to and fro between two convex sets tends to their closest points (Cheney and
/// Goldstein 1959); it is gradient descent on the squared distance, and is sped up as such
/// (Nesterov 1983, restarted when it overshoots). Any two points bound the distance from above, and
/// the plane between them from below.
Gap cylinderGap(const Cylinder& a, const Cylinder& b, const Isometry3d& a_from_b, double contact) {
  const Isometry3d b_from_a = a_from_b.inverse();
  Gap gap{0.0, INFINITY};
  Vector3d x = a_from_b.translation(), y = x;
  double momentum = 1;
  for (int i = 0; i < 300; ++i) {
    const Vector3d next = a_from_b * closestPoint(b, b_from_a * closestPoint(a, y));
    const Vector3d n = next - closestPoint(a, next);
    const double length = n.norm();
    if (length >= gap.upper) {
      if (momentum == 1) break;
      momentum = 1;
      y = x;
      continue;
    }
    gap.upper = length;
    if (length <= contact) return {0.0, length};
    const double lower =
        a_from_b.translation().dot(n) - support(a, n) - support(b, -(b_from_a.linear() * n));
    gap.lower = std::max(gap.lower, lower / length);
    if (gap.upper - gap.lower < 1e-10) break;
    const double faster = (1 + std::sqrt(1 + 4 * momentum * momentum)) / 2;
    y = next + (momentum - 1) / faster * (next - x);
    x = next;
    momentum = faster;
  }
  return gap;
}

}  // namespace oracle
