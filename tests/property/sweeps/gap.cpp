// SPDX-License-Identifier: BSD-3-Clause
#include "gap.hpp"

#include <algorithm>

#include "../../core/shape_oracle.hpp"

namespace sweeps {
namespace {

/// Of points of one core minus points of the other.
struct Simplex {
  Simplex() { vertex.fill(Vector3d::Zero()); }

  std::array<Vector3d, 4> vertex;
  std::array<double, 4> weight{};
  int count = 0;

  Vector3d nearest() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < count; ++i) sum += weight[i] * vertex[i];
    return sum;
  }
};

Simplex single(const Vector3d& v) {
  Simplex s;
  s.vertex[0] = v;
  s.weight[0] = 1.0;
  s.count = 1;
  return s;
}

Simplex ofSegment(const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double length = d.squaredNorm();
  const double u = length > 0.0 ? -a.dot(d) / length : 0.0;
  if (!(u > 0.0)) return single(a);
  if (u >= 1.0) return single(b);
  Simplex s;
  s.vertex[0] = a;
  s.vertex[1] = b;
  s.weight = {1.0 - u, u};
  s.count = 2;
  return s;
}

Simplex nearer(const Simplex& s, const Simplex& t) {
  return s.nearest().squaredNorm() <= t.nearest().squaredNorm() ? s : t;
}

/// The nearest of the edges' points and, if inside, the foot on the plane.
Simplex ofTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Simplex best = nearer(nearer(ofSegment(a, b), ofSegment(b, c)), ofSegment(c, a));
  const Vector3d &p = a, &q = b, &r = c;
  const Vector3d n = (q - p).cross(r - p);
  const double u = n.dot(q.cross(r)), v = n.dot(r.cross(p)), w = n.dot(p.cross(q));
  if (!(u > 0.0 && v > 0.0 && w > 0.0)) return best;
  Simplex s;
  s.vertex = {a, b, c, c};
  const double sum = u + v + w;
  s.weight = {u / sum, v / sum, w / sum};
  s.count = 3;
  return nearer(best, s);
}

Simplex ofTetrahedron(const std::array<Vector3d, 4>& v) {
  std::array<double, 4> volume;
  for (int i = 0; i < 4; ++i) {
    const Vector3d &p = v[(i + 1) % 4], &q = v[(i + 2) % 4], &r = v[(i + 3) % 4];
    volume[i] = (i % 2 == 0 ? 1.0 : -1.0) * p.cross(q).dot(r);
  }
  Simplex best = nearer(nearer(ofTriangle(v[1], v[2], v[3]), ofTriangle(v[0], v[2], v[3])),
                        nearer(ofTriangle(v[0], v[1], v[3]), ofTriangle(v[0], v[1], v[2])));
  const bool positive = std::all_of(volume.begin(), volume.end(), [](double x) { return x > 0.0; });
  const bool negative = std::all_of(volume.begin(), volume.end(), [](double x) { return x < 0.0; });
  if (!positive && !negative) return best;
  Simplex s;
  s.vertex = v;
  s.count = 4;
  const double sum = volume[0] + volume[1] + volume[2] + volume[3];
  for (int i = 0; i < 4; ++i) s.weight[i] = volume[i] / sum;
  return nearer(best, s);
}

Simplex nearestOf(const Simplex& s, const Vector3d& next) {
  switch (s.count) {
    case 1:
      return ofSegment(s.vertex[0], next);
    case 2:
      return ofTriangle(s.vertex[0], s.vertex[1], next);
    case 3:
      return ofTetrahedron({s.vertex[0], s.vertex[1], s.vertex[2], next});
    default:
      return s;
  }
}

/// Gilbert, Johnson, Keerthi 1988: of the cores, less their balls.
double between(const Part& a, const Part& b, const Isometry3d& a_from_b) {
  const Matrix3d b_from_a = a_from_b.linear().transpose();
  const auto vertex = [&](const Vector3d& towardsA) -> Vector3d {
    return a.support(towardsA) - a_from_b * b.support(-(b_from_a * towardsA));
  };
  const double balls = a.ball + b.ball;
  Simplex s = single(vertex(a_from_b * b.center - a.center));
  Vector3d nearest = s.nearest();
  for (int i = 0; i < 60; ++i) {
    const double length = nearest.norm();
    if (length <= balls || !(length > 0.0) || s.count == 4) break;
    const Vector3d next = vertex(-nearest);
    if (nearest.dot(nearest - next) <= 1e-13 * length * length) break;
    const Simplex better = nearestOf(s, next);
    const Vector3d closer = better.nearest();
    if (!(closer.squaredNorm() < nearest.squaredNorm())) break;
    s = better;
    nearest = closer;
  }
  return std::max(0.0, nearest.norm() - balls);
}

/// From a plane or half-space.
double fromFlat(const Body& flat, const Body& body, const Isometry3d& flat_from_body) {
  const Vector3d n = flat_from_body.linear().transpose() * flat.normal;
  const double shift = flat.normal.dot(flat_from_body.translation()) - flat.offset;
  double nearest = INFINITY;
  for (const Part& part : body.parts) {
    const double ball = part.ball * n.norm();
    const double least = shift + n.dot(part.support(-n)) - ball;
    const double most = shift + n.dot(part.support(n)) + ball;
    nearest = std::min(nearest, flat.kind == Kind::Plane ? std::max(least, -most) : least);
  }
  return std::max(0.0, nearest);
}

/// Two that are not all but parallel meet somewhere.
double betweenFlats(const Body& a, const Body& b, const Isometry3d& a_from_b) {
  const Vector3d n = a_from_b.linear() * b.normal;
  if (n.cross(a.normal).norm() > 1e-9) return 0.0;
  const double along = n.dot(a.normal) > 0.0 ? 1.0 : -1.0;
  const double offset = along * (b.offset + n.dot(a_from_b.translation()));
  const bool solidA = a.kind == Kind::HalfSpace, solidB = b.kind == Kind::HalfSpace;
  const double ahead = offset - a.offset;  // of b's boundary, along a's normal
  if (solidA && solidB) return along > 0.0 ? 0.0 : std::max(0.0, ahead);
  if (solidA) return std::max(0.0, ahead);
  if (solidB) return std::max(0.0, -along * ahead);
  return std::abs(ahead);
}

/// Of a part with points. Triangles of its points are within it and some of them are its surface,
/// so that the nearest one is right where the search stalls, as it does at needles.
double outside(const Part& part, const Vector3d& p) {
  Part point;
  point.points = {p};
  point.center = p;
  double least = between(part, point, Isometry3d::Identity());
  std::vector<Vector3d> corners = part.points;
  for (Vector3d& corner : corners) corner -= p;
  for (std::size_t i = 0; i < corners.size() && least > 0.0; ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (std::size_t k = j + 1; k < corners.size(); ++k)
        least = std::min(
            least, ofTriangle(corners[i], corners[j], corners[k]).nearest().norm() - part.ball);
  return least;
}

}  // namespace

double Gap::operator()(const Isometry3d& a_from_b) {
  if (a_.flat() && b_.flat()) return betweenFlats(a_, b_, a_from_b);
  if (a_.flat()) return fromFlat(a_, b_, a_from_b);
  if (b_.flat()) return fromFlat(b_, a_, a_from_b.inverse(Eigen::Isometry));
  return bounded(a_from_b);
}

double Gap::bounded(const Isometry3d& a_from_b) {
  double best = between(a_.parts[bestA_], b_.parts[bestB_], a_from_b);
  for (std::size_t k = 0; k < b_.parts.size() && best > 0.0; ++k) {
    const Vector3d center = a_from_b * b_.parts[k].center;
    for (std::size_t i = 0; i < a_.parts.size(); ++i) {
      const Part& part = a_.parts[i];
      const double near = best + part.radius + b_.parts[k].radius;
      if ((part.center - center).squaredNorm() >= near * near) continue;
      const double found = between(part, b_.parts[k], a_from_b);
      if (found < best) best = found, bestA_ = i, bestB_ = k;
    }
  }
  return best > 0.0 && enclosed(a_from_b) ? 0.0 : best;
}

/// Surfaces that do not touch are within a solid with all of their points or with none.
bool Gap::enclosed(const Isometry3d& a_from_b) const {
  const auto any = [](const Body& solid, const Body& other, const Isometry3d& solid_from_other) {
    if (solid.shell.empty()) return false;
    const bool joined = other.kind != Kind::Cloud;
    for (const Part& part : other.parts) {
      const Vector3d p = solid_from_other * part.support(Vector3d::UnitX());
      if (p.norm() < solid.reach && windsAround(solid.shell, p)) return true;
      if (joined) break;
    }
    return false;
  };
  return any(a_, b_, a_from_b) || any(b_, a_, a_from_b.inverse(Eigen::Isometry));
}

Isometry3d relative(const Path& a, const Path& b, Real t) {
  const Placement inA = a.curve(t), inB = b.curve(t);
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = (inA.rotation.transpose() * inB.rotation).cast<double>();
  pose.translation() = (inA.rotation.transpose() * (inB.position - inA.position)).cast<double>();
  return pose;
}

bool windsAround(const std::vector<std::array<Vector3d, 3>>& shell, const Vector3d& p) {
  return std::abs(reference::windingNumber(shell, p)) > 0.5;
}

double outside(const Body& body, const Vector3d& p) {
  if (!body.shell.empty() && windsAround(body.shell, p)) return 0.0;
  if (body.parts.empty() || body.parts[0].core != Part::Core::Points) {
    return oracle::outside(body.shape, p);
  }
  double least = INFINITY;
  for (const Part& part : body.parts) least = std::min(least, outside(part, p));
  return std::max(0.0, least);
}

}  // namespace sweeps
