// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "error_table_arithmetic.hpp"
#include "swept/core/shapes.hpp"

namespace error_table {

/// Where a plane touches a body.
enum class Feature : std::uint8_t { Vertex, Edge, Face, Curve };
inline constexpr std::size_t kFeatures = 4;

/// A shape as the oracle sees it: a core grown by a ball. The hull of it, where it is not convex.
struct Body {
  enum class Core : std::uint8_t { Points, Cylinder, Cone, Ellipsoid, Flat };
  /// Of the convex core, with the outward normals of the faces beside it and one between.
  struct Edge {
    int from, to;
    Vector3d first, middle, last;
  };
  Core core = Core::Points;
  std::vector<Vector3d> points;          ///< m
  std::vector<Eigen::Vector3i> faces;    ///< outward, of the hull
  std::vector<Eigen::Vector3i> surface;  ///< of the shape itself
  std::vector<Edge> edges;
  Vector3d size = Vector3d::Zero();  ///< m; (radius, 0, half length); of Flat: its normal
  double offset = 0.0;               ///< m, of Flat
  double radius = 0.0;               ///< m, of the ball
  double extent = 0.0;               ///< m, from the origin
  double rolling = 0.0;  ///< m, such a ball rolls all over the surface from inside (with `radius`)
  bool convex = true;
  bool halfSpace = false;

  bool isFlat() const { return core == Core::Flat; }
  bool isCurved() const { return !isFlat() && core != Core::Points; }
  Point faceNormal(int face) const {
    const Eigen::Vector3i& f = faces[face];
    const Point a = real(points[f[0]]);
    return unit((real(points[f[1]]) - a).cross(real(points[f[2]]) - a));
  }
  Point edgeVector(int edge) const {
    return real(points[edges[edge].to]) - real(points[edges[edge].from]);
  }
  /// Support function of the core.
  double reach(const Vector3d& n) const;
};

struct Solid {
  swept::Shape shape;
  Body body;
};

inline double Body::reach(const Vector3d& n) const {
  const double across = std::hypot(n.x(), n.y());
  switch (core) {
    case Core::Cylinder:
      return size.x() * across + size.z() * std::abs(n.z());
    case Core::Cone:
      return std::max(size.z() * n.z(), size.x() * across - size.z() * n.z());
    case Core::Ellipsoid:
      return size.cwiseProduct(n).norm();
    case Core::Points:
    case Core::Flat:
      break;
  }
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) most = std::max(most, n.dot(p));
  return most;
}

/// A point of the core farthest along a unit vector; anywhere among them where there are many.
struct Support {
  Point point;
  Feature feature = Feature::Curve;
};

/// Relative: numbers closer than this are equal but for the rounding of 50 digits.
inline const Real kEqual("1e-40");

inline Support supportOfPoints(const Body& body, const Point& n, Random& random) {
  const Vector3d near = rounded(n);
  const double most = body.reach(near);
  const double slack = 1e-14 * body.extent;
  std::vector<std::pair<Real, Point>> found;
  Real best = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : body.points) {
    if (near.dot(p) < most - slack) continue;
    found.emplace_back(n.dot(real(p)), real(p));
    best = std::max(best, found.back().first);
  }
  Point sum = real(Vector3d::Zero());
  Real weights = 0;
  int count = 0;
  for (const auto& [along, p] : found) {
    if (best - along > kEqual * body.extent) continue;
    // A hull's points are all of the shape where it is convex; elsewhere only its vertices are.
    if (count > 0 && !body.convex) continue;
    const Real weight = random.uniform(0.05, 1.0);
    sum = sum + p * weight;
    weights += weight;
    ++count;
  }
  return {sum * (1 / weights),
          count == 1 ? Feature::Vertex : (count == 2 ? Feature::Edge : Feature::Face)};
}

inline Point inDisc(double radius, const Real& z, Random& random) {
  const Vector3d p = random.inBall();
  return {Real(p.x()) * radius, Real(p.y()) * radius, z};
}

inline Support supportOfRound(const Body& body, const Point& n, Random& random) {
  const Real r = body.size.x();
  const Real l = body.size.z();
  const Real across = sqrt(n.x * n.x + n.y * n.y);
  const bool cone = body.core == Body::Core::Cone;
  if (across < kEqual) {
    if (cone && n.z > 0) return {{0, 0, l}, Feature::Vertex};
    return {inDisc(body.size.x(), n.z > 0 ? l : -l, random), Feature::Face};
  }
  const Point rim{n.x / across * r, n.y / across * r, cone || n.z < 0 ? -l : l};
  const Point end = cone ? Point{0, 0, l} : Point{rim.x, rim.y, -rim.z};
  const Real lead = n.dot(rim - end);
  if (abs(lead) < kEqual * body.extent) {
    return {rim + (end - rim) * Real(random.uniform(0.0, 1.0)), Feature::Edge};
  }
  if (lead < 0) return {end, Feature::Vertex};
  return {rim, Feature::Curve};
}

/// Of a plane: `spread` m from its point nearest to the origin.
inline Support supportOfCore(const Body& body, const Point& n, double spread, Random& random) {
  switch (body.core) {
    case Body::Core::Points:
      return supportOfPoints(body, n, random);
    case Body::Core::Cylinder:
    case Body::Core::Cone:
      return supportOfRound(body, n, random);
    case Body::Core::Ellipsoid: {
      const Point stretched{n.x * body.size.x(), n.y * body.size.y(), n.z * body.size.z()};
      const Real scale = 1 / length(stretched);
      return {{stretched.x * body.size.x() * scale, stretched.y * body.size.y() * scale,
               stretched.z * body.size.z() * scale},
              Feature::Curve};
    }
    case Body::Core::Flat:
      break;
  }
  const Point normal = real(body.size);
  const Point aside = real(Vector3d(spread * random.inBall()));
  const Real along = (Real(body.offset) - normal.dot(aside)) / normal.dot(normal);
  return {aside + normal * along, Feature::Face};
}

/// The support point of the shape, ball included.
inline Support supportOf(const Body& body, const Point& n, double spread, Random& random) {
  Support found = supportOfCore(body, n, spread, random);
  if (body.radius > 0.0 && body.points.size() == 1) found.feature = Feature::Curve;
  found.point = found.point + n * Real(body.radius);
  return found;
}

}  // namespace error_table
