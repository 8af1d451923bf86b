// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "../../core/mesh_samples.hpp"
#include "swept/core/height_field.hpp"

namespace pairs {
namespace {

using error_table::length;
using error_table::real;
using error_table::rounded;
using error_table::unit;
using sweeps::Part;
using swept::test::Soup;

/// A share of a width, down to one that rounding makes zero.
double tiny(Random& random) {
  return random.decades(-20.0, -2.0);
}

Vector3d stretch(Random& random) {
  Vector3d all = Vector3d::Ones();
  for (double& s : all)
    if (random.chance(0.3)) s = random.decades(-8.0, 0.0);
  return all;
}

/// Open surfaces with needles and slivers of all widths, of which some have two corners that are
/// the same to the last bit.
Soup ragged(double size, Random& random) {
  Soup soup;
  const Vector3d scale = size * stretch(random);
  const auto somewhere = [&] { return Vector3d(scale.cwiseProduct(random.inCube())); };
  if (random.chance(0.5)) {
    const int rows = 2 + random.below(8);
    const int columns = 2 + random.below(8);
    for (int i = 0; i < rows * columns; ++i) {
      const double x = i / columns, y = i % columns;
      soup.vertices.push_back(
          scale.cwiseProduct(Vector3d(x / rows, y / columns, random.uniform(-1.0, 1.0))));
      if (i % columns > 0 && random.chance(0.2)) {
        soup.vertices[i] = soup.vertices[i - 1] + size * tiny(random) * random.direction();
      }
      if (i % columns == 0 || i < columns) continue;
      soup.triangles.emplace_back(i - columns - 1, i - columns, i - 1);
      soup.triangles.emplace_back(i - 1, i - columns, i);
    }
    return soup;
  }
  for (int i = random.below(12) * 3; i >= 0; i -= 3) {
    const Vector3d a = somewhere(), b = somewhere();
    const int first = static_cast<int>(soup.vertices.size());
    const Vector3d beside = size * tiny(random) * random.direction();
    const double along = random.chance(0.5) ? 1.0 : random.uniform(0.0, 1.0);
    soup.vertices.insert(soup.vertices.end(), {a, b, a + along * (b - a) + beside});
    if (random.chance(0.3)) soup.vertices.back() = somewhere();
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  return soup;
}

void addParts(Body& body, const std::vector<Vector3d>& vertices,
              const std::vector<Eigen::Vector3i>& triangles) {
  for (const Eigen::Vector3i& t : triangles) {
    Part part;
    part.points = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    for (const Vector3d& p : part.points) body.reach = std::max(body.reach, p.norm());
    body.parts.push_back(std::move(part));
  }
}

/// Of some of the kinds there is more to try than sweeps do.
Body drawBody(Kind kind, double size, Random& random) {
  Body body;
  body.kind = kind;
  if (kind == Kind::OpenMesh) {
    Soup soup = ragged(size, random);
    // One triangle that has an area, without which there is no mesh.
    soup.append(
        {{size * random.inCube(), size * random.inCube(), size * random.inCube()}, {{0, 1, 2}}});
    // As it is: what is nearly closed would be filled.
    body.shape =
        swept::TriangleMesh::build(soup.vertices, soup.triangles, swept::MeshInterior::Solid, 0.0);
    addParts(body, soup.vertices, soup.triangles);
    return body;
  }
  if (kind == Kind::ClosedMesh && random.chance(0.3)) {
    Eigen::MatrixXd heights(2 + random.below(6), 2 + random.below(6));
    for (double& height : heights.reshaped()) height = size * random.uniform(0.0, 1.0);
    const auto field = swept::heightField(size, size * random.decades(-4.0, 0.0), heights, -size);
    body.shape = field;
    addParts(body, field.vertices(), field.triangles());
    return body;
  }
  if (kind == Kind::Hull && random.chance(0.6)) {
    Part part;
    const Vector3d scale = size * stretch(random);
    for (int i = 3 + random.below(random.chance(0.5) ? 60 : 400); i >= 0; --i)
      part.points.push_back(scale.cwiseProduct(random.direction()));
    for (const Vector3d& p : part.points) body.reach = std::max(body.reach, p.norm());
    body.shape = swept::ConvexHull::of(part.points);
    body.parts.push_back(std::move(part));
    return body;
  }
  return sweeps::makeBody(kind, size, random);
}

/// Weights of at least zero, of one in all.
Point mix(const std::array<Vector3d, 3>& c, double u, double v) {
  return real(c[0]) * (1 - Real(u) - Real(v)) + real(c[1]) * Real(u) + real(c[2]) * Real(v);
}

Spot onTriangle(const std::array<Vector3d, 3>& given, Random& random) {
  const int first = random.below(3);
  const std::array<Vector3d, 3> c{given[first], given[(first + 1) % 3], given[(first + 2) % 3]};
  const Vector3d edge = (c[1] - c[0]).stableNormalized();
  const Vector3d face = edge.cross((c[2] - c[0]).stableNormalized());
  const double u = random.uniform(0.0, 1.0);
  const double v = random.uniform(0.0, 1.0 - u);
  const int feature = random.below(3);
  if (feature == 0 && face.norm() > 1e-9) return {mix(c, u, v), random.sign() * face.normalized()};
  if (feature == 1 && edge.norm() > 0.5) return {mix(c, u, 0.0), random.across(edge)};
  return {real(c[0]), random.direction()};
}

/// The point of a round core that is nearest to a given one along the way to its middle: itself but
/// for the rounding that put it outside.
Point into(const Part& part, const Vector3d& given) {
  Point p = real(given);
  if (part.core == Part::Core::Ellipsoid) {
    Real sum = 0;
    const std::array<Real, 3> at{p.x, p.y, p.z};
    for (int i = 0; i < 3; ++i)
      if (part.size[i] > 0.0) sum += at[i] * at[i] / (Real(part.size[i]) * part.size[i]);
    const Vector3d flat(part.size.x() > 0.0, part.size.y() > 0.0, part.size.z() > 0.0);
    p = {p.x * flat.x(), p.y * flat.y(), p.z * flat.z()};
    return sum > 1 ? p * (1 / sqrt(sum)) : p;
  }
  if (part.core == Part::Core::Box) {
    return real(Vector3d(given.cwiseMin(part.size).cwiseMax(-part.size)));
  }
  const Real half = part.size.z();
  p.z = std::clamp(p.z, Real(-half), half);
  Real radius = part.size.x();
  if (part.core == Part::Core::Cone && half > 0) radius *= (half - p.z) / (2 * half);
  const Real rho = sqrt(p.x * p.x + p.y * p.y);
  if (rho > radius) {
    const Real share = rho > 0 ? Real(radius / rho) : Real(0);
    p.x *= share;
    p.y *= share;
  }
  return p;
}

/// Of a hull, of the balls' middles, of an axis; grown by the ball.
Spot onPoints(const Body& body, const Part& part, Random& random) {
  Spot spot;
  spot.normal = random.direction();
  const auto* hull = std::get_if<swept::ConvexHull>(&body.shape);
  if (part.points.size() == 3) {
    spot = onTriangle({part.points[0], part.points[1], part.points[2]}, random);
  } else if (part.points.size() == 2 && random.chance(0.5)) {
    spot.normal = random.across((part.points[1] - part.points[0]).stableNormalized());
    spot.point = mix({part.points[0], part.points[1], part.points[0]}, random.uniform(0.0, 1.0), 0);
  } else if (hull != nullptr && !hull->faces().empty() && random.chance(0.7)) {
    const Eigen::Vector3i f = hull->faces()[random.below(hull->faces().size())];
    const auto& v = hull->vertices();
    spot = onTriangle({v[f[0]], v[f[1]], v[f[2]]}, random);
    const Vector3d face = (v[f[1]] - v[f[0]]).cross(v[f[2]] - v[f[0]]);
    if (spot.normal.dot(face) < 0.0) spot.normal = -spot.normal;
  } else {
    spot.point = real(part.support(spot.normal));
  }
  if (part.ball > 0.0) spot.point = spot.point + unit(real(spot.normal)) * Real(part.ball);
  return spot;
}

Spot onBody(const Body& body, double size, Random& random) {
  Spot spot;
  if (body.flat()) {
    const sweeps::Touch touch = sweeps::touchOn(body, size, random);
    const Point n = real(body.normal);
    const Point p = real(touch.point);
    return {p + n * ((Real(body.offset) - n.dot(p)) / n.dot(n)), touch.normal, true};
  }
  const Part& part = body.parts[random.below(body.parts.size())];
  if (part.core == Part::Core::Points) {
    spot = onPoints(body, part, random);
  } else {
    const sweeps::Touch touch = sweeps::touchOn(body, size, random);
    spot = {into(part, touch.point), touch.normal};
  }
  const double beyond = body.extent(spot.normal) - spot.normal.dot(rounded(spot.point));
  spot.extreme = beyond <= 4e-16 * body.reach;
  return spot;
}

/// Turns b so that its normal is against a's, but for a small angle now and then.
Matrix3d turnAgainst(const Vector3d& normalA, Vector3d normalB, Random& random) {
  if (random.chance(0.2)) return random.rotation();
  if (random.chance(0.3))
    normalB = (normalB + random.decades(-16.0, -2.0) * random.direction()).normalized();
  const Vector3d u = random.across(normalA), v = random.across(normalB);
  Matrix3d frameA, frameB;
  frameA << normalA, u, normalA.cross(u);
  frameB << -normalB, v, -normalB.cross(v);
  return Eigen::Quaterniond(Matrix3d(frameA * frameB.transpose())).normalized().toRotationMatrix();
}

}  // namespace

Pair makePair(std::uint64_t seed, std::uint64_t index, Random& random) {
  random = Random(seed, index);
  const std::uint64_t kinds = index % (kKinds * kKinds);
  Pair pair;
  const double size = random.decades(-12.0, 12.5);
  const double other = random.chance(0.7) ? 1.0 : random.decades(-9.0, 0.0);
  pair.sizeA = pair.sizeB = size;
  (random.chance(0.5) ? pair.sizeA : pair.sizeB) *= other;
  pair.a = drawBody(static_cast<Kind>(kinds / kKinds), pair.sizeA, random);
  pair.b = drawBody(static_cast<Kind>(kinds % kKinds), pair.sizeB, random);
  return pair;
}

Placing place(const Pair& pair, Random& random) {
  Placing placing;
  placing.onA = onBody(pair.a, pair.sizeA, random);
  placing.onB = onBody(pair.b, pair.sizeB, random);
  const Vector3d n = placing.onA.normal;
  // Turned axis onto axis and without a gap, many spots are the same to the last bit.
  const bool same = random.chance(0.1);
  placing.a_from_b.linear() =
      same ? random.permutation() : turnAgainst(n, placing.onB.normal, random);
  const ExactTurn turn(placing.a_from_b.linear());
  const double size = std::max(pair.sizeA, pair.sizeB);
  const double gap = same || random.chance(0.1) ? 0.0 : size * random.decades(-18.0, 1.0);
  const Point turnedB = turn * placing.onB.point;
  placing.a_from_b.translation() = rounded(placing.onA.point + real(n) * Real(gap) - turnedB);
  placing.apart = turnedB + real(Vector3d(placing.a_from_b.translation())) - placing.onA.point;
  placing.atMost = length(placing.apart);
  // Of a body against the turned normal, which is b's but for the rounding of the turn.
  const Vector3d back = -(placing.a_from_b.linear().transpose() * n);
  const bool facing = pair.b.flat() ? (back - placing.onB.normal).norm() <= 1e-15
                                    : pair.b.extent(back) - back.dot(rounded(placing.onB.point)) <=
                                          4e-16 * pair.b.reach;
  placing.atLeast = placing.onA.extreme && facing && !pair.a.flat() && !pair.b.flat()
                        ? real(n).dot(placing.apart).convert_to<double>()
                        : -std::numeric_limits<double>::infinity();
  return placing;
}

}  // namespace pairs
