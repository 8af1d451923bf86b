// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gap.hpp"

namespace oracle {
namespace {

constexpr double kShrink = 1e-9;  // m, what a hit between curved solids found by iteration is worth

/// Whether the segment p-q passes through the inside of the triangle; touching its border is not
/// enough.
bool crosses(const Vector3d& p, const Vector3d& q, const Triangle& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above = n.dot(p - t[0]), below = n.dot(q - t[0]);
  if (!((above > 0 && below < 0) || (above < 0 && below > 0))) return false;
  const Vector3d d = q - p;
  double side[3];
  for (int i = 0; i < 3; ++i) side[i] = d.dot((t[i] - p).cross(t[(i + 1) % 3] - p));
  return (side[0] > 0 && side[1] > 0 && side[2] > 0) || (side[0] < 0 && side[1] < 0 && side[2] < 0);
}

bool onOneSide(const Triangle& plane, const Triangle& t) {
  const Vector3d n = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
  const double a = n.dot(t[0] - plane[0]), b = n.dot(t[1] - plane[0]), c = n.dot(t[2] - plane[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool hits(const Sphere& s, const Triangle& t) {
  return closestPoint(t, Vector3d::Zero()).norm() <= s.radius;
}

bool hits(const Capsule& c, const Triangle& t) {
  const Vector3d a(0, 0, -c.half), b(0, 0, c.half);
  if (crosses(a, b, t)) return true;
  return segmentDistance(t, a, b) <= c.radius;
}

bool hits(const Box& b, const Triangle& t) {
  // A box and a triangle are apart exactly when one of 13 directions separates them.
  auto separates = [&](const Vector3d& l) {
    const double r = b.half.dot(l.cwiseAbs());
    const double p0 = t[0].dot(l), p1 = t[1].dot(l), p2 = t[2].dot(l);
    return std::min({p0, p1, p2}) > r || std::max({p0, p1, p2}) < -r;
  };
  for (int i = 0; i < 3; ++i)
    if (separates(Vector3d::Unit(i))) return false;
  if (separates((t[1] - t[0]).cross(t[2] - t[0]))) return false;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (separates(Vector3d::Unit(i).cross(t[(k + 1) % 3] - t[k]))) return false;
  return true;
}

/// The part of a convex polygon with sign * z <= h.
std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon, double sign, double h) {
  std::vector<Vector3d> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& p = polygon[i];
    const Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double dp = h - sign * p.z(), dq = h - sign * q.z();
    if (dp >= 0) kept.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

bool hits(const Cylinder& c, const Triangle& t) {
  const double lowest = std::min({t[0].z(), t[1].z(), t[2].z()});
  const double highest = std::max({t[0].z(), t[1].z(), t[2].z()});
  if (lowest > c.half || highest < -c.half) return false;
  std::vector<Vector3d> polygon(t.begin(), t.end());
  if (highest > c.half) polygon = clipped(polygon, 1.0, c.half);
  if (lowest < -c.half) polygon = clipped(polygon, -1.0, c.half);
  // Seen along the axis: is the centre in the polygon, or within the radius of its border?
  int left = 0, right = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    Vector3d p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    p.z() = q.z() = 0;
    if (closestOnSegment(p, q, Vector3d::Zero()).norm() <= c.radius) return true;
    const double turn = p.x() * q.y() - p.y() * q.x();
    left += turn > 1e-13;
    right += turn < -1e-13;
  }
  const int n = static_cast<int>(polygon.size());
  return n > 2 && (left == n || right == n);
}

bool boxesOverlap(const Box& a, const Box& b, const Isometry3d& a_from_b) {
  const Eigen::Matrix3d r = a_from_b.linear();
  const Vector3d c = a_from_b.translation();
  auto separates = [&](const Vector3d& l) {
    const double reach = a.half.dot(l.cwiseAbs()) + b.half.dot((r.transpose() * l).cwiseAbs());
    return std::abs(c.dot(l)) > reach;
  };
  for (int i = 0; i < 3; ++i)
    if (separates(Vector3d::Unit(i)) || separates(r.col(i))) return false;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (separates(Vector3d::Unit(i).cross(r.col(k)))) return false;
  return true;
}

bool cylinderBox(const Cylinder& c, const Box& b, const Isometry3d& cylinder_from_box) {
  if (distanceTo(b, cylinder_from_box.inverse().translation()) <= 0) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double side : {-1.0, 1.0}) {
      Vector3d corner[4];
      for (int k = 0; k < 4; ++k) {
        Vector3d p;
        p[axis] = side * b.half[axis];
        p[u] = (k == 1 || k == 2 ? 1.0 : -1.0) * b.half[u];
        p[v] = (k >= 2 ? 1.0 : -1.0) * b.half[v];
        corner[k] = cylinder_from_box * p;
      }
      if (hits(c, {corner[0], corner[1], corner[2]}) || hits(c, {corner[0], corner[2], corner[3]}))
        return true;
    }
  }
  return false;
}

/// Whether a prism inside `b` meets `a`.
bool meetsInnerPrism(const Cylinder& a, const Cylinder& b, const Isometry3d& a_from_b) {
  constexpr int kSides = 64;
  if (distanceTo(b, a_from_b.inverse().translation()) <= 0) return true;
  auto at = [&](int i, double z) {
    const double angle = 2 * 3.141592653589793 * i / kSides;
    return a_from_b * Vector3d(b.radius * std::cos(angle), b.radius * std::sin(angle), z);
  };
  for (int i = 0; i < kSides; ++i) {
    const Vector3d p = at(i, -b.half), q = at(i + 1, -b.half), r = at(i + 1, b.half),
                   s = at(i, b.half);
    if (hits(a, {p, q, r}) || hits(a, {p, r, s})) return true;
    if (hits(a, {p, q, a_from_b * Vector3d(0, 0, -b.half)})) return true;
    if (hits(a, {s, r, a_from_b * Vector3d(0, 0, b.half)})) return true;
  }
  return false;
}

/// The iteration hits only if the solids made smaller by kShrink come within kShrink: then the
/// solids share a point. Where it converges too slowly to tell, the prism does, to a thousandth of
/// the radius.
bool cylindersOverlap(const Cylinder& a, const Cylinder& b, const Isometry3d& a_from_b) {
  const auto smaller = [](const Cylinder& c) {
    return Cylinder{std::max(0.0, c.radius - kShrink), std::max(0.0, c.half - kShrink)};
  };
  const Gap gap = cylinderGap(smaller(a), smaller(b), a_from_b, kShrink);
  if (gap.upper <= kShrink) return true;
  return !(gap.lower > kShrink) && meetsInnerPrism(a, b, a_from_b);
}

}  // namespace

bool overlap(const Triangle& a, const Triangle& b) {
  if (onOneSide(a, b) || onOneSide(b, a)) return false;
  for (int i = 0; i < 3; ++i)
    if (crosses(a[i], a[(i + 1) % 3], b) || crosses(b[i], b[(i + 1) % 3], a)) return true;
  return false;
}

bool overlap(const Primitive& solid, const Triangle& triangle) {
  return std::visit([&](const auto& s) { return hits(s, triangle); }, solid);
}

bool overlap(const Primitive& a, const Primitive& b, const Isometry3d& a_from_b) {
  const Isometry3d b_from_a = a_from_b.inverse();
  if (const auto* s = std::get_if<Sphere>(&a))
    return distanceTo(b, b_from_a.translation()) <= s->radius;
  if (const auto* s = std::get_if<Sphere>(&b))
    return distanceTo(a, a_from_b.translation()) <= s->radius;
  if (const auto* c = std::get_if<Capsule>(&a)) return axisDistance(*c, b, b_from_a) <= c->radius;
  if (const auto* c = std::get_if<Capsule>(&b)) return axisDistance(*c, a, a_from_b) <= c->radius;
  const auto* boxA = std::get_if<Box>(&a);
  const auto* boxB = std::get_if<Box>(&b);
  if (boxA && boxB) return boxesOverlap(*boxA, *boxB, a_from_b);
  if (boxA) return cylinderBox(std::get<Cylinder>(b), *boxA, b_from_a);
  if (boxB) return cylinderBox(std::get<Cylinder>(a), *boxB, a_from_b);
  return cylindersOverlap(std::get<Cylinder>(a), std::get<Cylinder>(b), a_from_b);
}

BoxFilter::BoxFilter(const Isometry3d& a_from_b)
    : a_from_b_(a_from_b), absolute_((a_from_b.linear().cwiseAbs().array() + 1e-12).matrix()) {}

bool BoxFilter::near(const Vector3d& centerA, const Vector3d& halfA, const Vector3d& centerB,
                     const Vector3d& halfB, double margin) const {
  const Vector3d c = a_from_b_ * centerB - centerA;
  if (((c.cwiseAbs() - halfA - absolute_ * halfB).array() > margin).any()) return false;
  const Vector3d inB = a_from_b_.linear().transpose() * c;
  return !((inB.cwiseAbs() - halfB - absolute_.transpose() * halfA).array() > margin).any();
}

}  // namespace oracle
