// SPDX-License-Identifier: BSD-3-Clause
#include "primitive.hpp"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

Vector3d closest(const Sphere& s, const Vector3d& p) {
  const double norm = p.norm();
  return norm <= s.radius ? p : Vector3d(p * (s.radius / norm));
}

Vector3d closest(const Box& b, const Vector3d& p) {
  return p.cwiseMax(-b.half).cwiseMin(b.half);
}

Vector3d closest(const Cylinder& c, const Vector3d& p) {
  const double rho = std::hypot(p.x(), p.y());
  const double scale = rho > c.radius ? c.radius / rho : 1.0;
  return {p.x() * scale, p.y() * scale, std::clamp(p.z(), -c.half, c.half)};
}

Vector3d closest(const Capsule& c, const Vector3d& p) {
  const Vector3d onAxis(0, 0, std::clamp(p.z(), -c.half, c.half));
  return onAxis + closest(Sphere{c.radius}, p - onAxis);
}

double reach(const Sphere& s, const Vector3d& d) {
  return s.radius * d.norm();
}
double reach(const Box& b, const Vector3d& d) {
  return b.half.dot(d.cwiseAbs());
}
double reach(const Cylinder& c, const Vector3d& d) {
  return c.radius * std::hypot(d.x(), d.y()) + c.half * std::abs(d.z());
}
double reach(const Capsule& c, const Vector3d& d) {
  return c.radius * d.norm() + c.half * std::abs(d.z());
}

}  // namespace

Vector3d closestPoint(const Primitive& solid, const Vector3d& p) {
  return std::visit([&](const auto& s) { return closest(s, p); }, solid);
}

double distanceTo(const Primitive& solid, const Vector3d& p) {
  return (closestPoint(solid, p) - p).norm();
}

double support(const Primitive& solid, const Vector3d& direction) {
  return std::visit([&](const auto& s) { return reach(s, direction); }, solid);
}

Vector3d bounds(const Primitive& solid) {
  return {support(solid, Vector3d::UnitX()), support(solid, Vector3d::UnitY()),
          support(solid, Vector3d::UnitZ())};
}

Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d d = b - a;
  const double length2 = d.squaredNorm();
  if (!(length2 > 0)) return a;
  return a + std::clamp((p - a).dot(d) / length2, 0.0, 1.0) * d;
}

Vector3d closestPoint(const Triangle& t, const Vector3d& p) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool above = n.squaredNorm() > 0;
  for (int i = 0; i < 3 && above; ++i) {
    const Vector3d& a = t[i];
    above = n.cross(t[(i + 1) % 3] - a).dot(p - a) >= 0;
  }
  if (above) return p - n * ((p - t[0]).dot(n) / n.squaredNorm());
  Vector3d best = closestOnSegment(t[0], t[1], p);
  for (int i = 1; i < 3; ++i) {
    const Vector3d next = closestOnSegment(t[i], t[(i + 1) % 3], p);
    if ((next - p).squaredNorm() < (best - p).squaredNorm()) best = next;
  }
  return best;
}

double perpendicular(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v);
  const double det = uu * vv - uv * uv;
  if (!(det > 1e-14 * uu * vv)) return INFINITY;
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / det;
  const double r = (uu * v.dot(w) - uv * u.dot(w)) / det;
  return s >= 0 && s <= 1 && r >= 0 && r <= 1 ? (w + s * u - r * v).norm() : INFINITY;
}

double segmentDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return std::min({perpendicular(a, b, c, d), (closestOnSegment(c, d, a) - a).norm(),
                   (closestOnSegment(c, d, b) - b).norm(), (closestOnSegment(a, b, c) - c).norm(),
                   (closestOnSegment(a, b, d) - d).norm()});
}

double segmentDistance(const Triangle& t, const Vector3d& a, const Vector3d& b) {
  double d = std::min((closestPoint(t, a) - a).norm(), (closestPoint(t, b) - b).norm());
  for (int i = 0; i < 3; ++i) d = std::min(d, segmentDistance(a, b, t[i], t[(i + 1) % 3]));
  return d;
}

Triangle moved(const Isometry3d& pose, const Triangle& t) {
  return {pose * t[0], pose * t[1], pose * t[2]};
}

}  // namespace oracle
