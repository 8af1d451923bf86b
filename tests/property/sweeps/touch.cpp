// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "body.hpp"

namespace sweeps {
namespace {

Touch onBox(const Vector3d& half, Random& random) {
  Vector3d n = Vector3d::Zero(), p;
  const int fixed = 1 + random.below(3);  // of a face, an edge, a vertex
  const int first = random.below(3);
  for (int k = 0; k < 3; ++k) {
    const int i = (first + k) % 3;
    const double side = random.sign();
    const double share = random.uniform(0.05, 1.0);
    p[i] = k < fixed ? side * half[i] : share * side * half[i];
    if (k < fixed) n[i] = side * share;
  }
  return {p, n.normalized(), true};
}

Touch onCylinder(const Vector3d& s, Random& random) {
  const Vector3d radial = random.across(Vector3d::UnitZ());
  const double end = random.sign(), share = random.uniform(0.0, 1.0);
  const Vector3d axis(0.0, 0.0, end);
  switch (random.below(3)) {
    case 0:
      return {share * s.x() * radial + s.z() * axis, axis, true};
    case 1:
      return {s.x() * radial + share * s.z() * axis, radial, true};
    default:
      return {s.x() * radial + s.z() * axis,
              ((0.05 + share) * radial + random.uniform(0.05, 1.0) * axis).normalized(), true};
  }
}

Touch onCone(const Part& part, Random& random) {
  const Vector3d radial = random.across(Vector3d::UnitZ());
  const double r = part.size.x(), h = part.size.z(), share = random.uniform(0.0, 1.0);
  const Vector3d apex(0.0, 0.0, h), base = r * radial - apex;
  switch (random.below(3)) {
    case 0:
      return {share * r * radial - apex, -Vector3d::UnitZ(), true};
    case 1: {
      const Vector3d n = 2.0 * h * radial + r * Vector3d::UnitZ();
      if (!(n.norm() > 0.0)) break;
      return {apex + share * (base - apex), n.normalized(), true};
    }
    default:
      break;
  }
  const Vector3d n = random.direction();
  return {part.support(n), n, true};
}

Touch onTriangle(const std::vector<Vector3d>& c, Random& random) {
  const int i = random.below(3);
  const Vector3d edge = c[(i + 1) % 3] - c[i];
  const Vector3d face = edge.cross(c[(i + 2) % 3] - c[i]);
  const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
  const int feature = random.below(3);
  if (feature == 0 && face.norm() > 0.0) {
    return {c[i] + u * edge + v * (c[(i + 2) % 3] - c[i]), random.sign() * face.normalized(), true};
  }
  if (feature == 1 && edge.norm() > 0.0) {
    return {c[i] + u * edge, random.across(edge.normalized()), true};
  }
  const Vector3d n = random.direction();
  return {*std::max_element(c.begin(), c.end(),
                            [&](const auto& a, const auto& b) { return a.dot(n) < b.dot(n); }),
          n, true};
}

Touch onFlat(const Body& body, double size, Random& random) {
  const Vector3d p =
      body.offset * body.normal + random.uniform(0.0, size) * random.across(body.normal);
  const double side = body.kind == Kind::Plane ? random.sign() : 1.0;
  return {p, side * body.normal, true};
}

Touch farthestOf(const Body& body, const Vector3d& n) {
  Touch best{Vector3d::Zero(), n, true};
  double most = -INFINITY;
  for (const Part& part : body.parts) {
    const Vector3d p = part.support(n) + part.ball * n;
    if (n.dot(p) > most) most = n.dot(p), best.point = p;
  }
  return best;
}

Touch pick(const Body& body, double size, Random& random) {
  if (body.flat()) return onFlat(body, size, random);
  if (body.boxy) return onBox(body.half, random);
  const Part& part = body.parts[random.below(static_cast<int>(body.parts.size()))];
  if (part.core == Part::Core::Cylinder) return onCylinder(part.size, random);
  if (part.core == Part::Core::Cone) return onCone(part, random);
  if (body.kind == Kind::Triangle || (!body.convex() && part.points.size() == 3)) {
    if (body.convex() || random.chance(0.5)) return onTriangle(part.points, random);
  }
  if (body.kind == Kind::Capsule && random.chance(0.4)) {
    const Vector3d n = random.across(Vector3d::UnitZ());
    return {part.ball * n + random.uniform(-1.0, 1.0) * part.points[0], n, true};
  }
  return farthestOf(body, random.direction());
}

}  // namespace

Touch touchOn(const Body& body, double size, Random& random) {
  Touch touch = pick(body, size, random);
  if (!body.flat()) {
    touch.extreme = body.extent(touch.normal) - touch.normal.dot(touch.point) <= 4e-16 * body.reach;
  }
  return touch;
}

Touch touchIn(const Body& body, double size, Random& random) {
  if (body.kind == Kind::HalfSpace) {
    Touch touch = onFlat(body, size, random);
    touch.point -= random.uniform(0.0, size) * body.normal;
    touch.extreme = false;
    return touch;
  }
  const bool hollow = !body.convex() && !(body.kind == Kind::ClosedMesh && body.boxy);
  if (body.flat() || (hollow && body.kind != Kind::Cloud)) return touchOn(body, size, random);
  const Part& part = body.parts[random.below(static_cast<int>(body.parts.size()))];
  const Vector3d n = random.direction(), m = random.direction();
  const double share = random.uniform(0.0, 1.0);
  if (body.boxy) return {random.inCube().cwiseProduct(body.half), n, false};
  const Vector3d p = part.support(n) + part.ball * n, q = part.support(m) + part.ball * m;
  return {share * p + (1.0 - share) * q, n, false};
}

}  // namespace sweeps
