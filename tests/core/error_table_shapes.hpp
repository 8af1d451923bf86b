// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "error_table_body.hpp"

namespace error_table {

/// A row of the table is two of these. To add one: a function that draws it, and a line in kKinds.
struct Kind {
  const char* name;
  Solid (*draw)(Random& random, double size);  ///< m, its largest extent
  std::vector<Feature> features;               ///< each must occur
  bool isFlat = false;                         ///< a plane or a half-space
};

inline void finish(Body& body) {
  for (const Vector3d& p : body.points) body.extent = std::max(body.extent, p.norm());
  body.extent += body.radius;
  body.rolling += body.radius;
  if (body.surface.empty()) body.surface = body.faces;
}

/// Now and then, far from the origin of its frame.
inline bool moveAway(Body& body, Random& random, double size) {
  if (!random.chance(0.2)) return false;
  const double reach = size * random.decades(0.0, 3.0);
  const Vector3d shift = reach * random.direction();
  for (Vector3d& p : body.points) p += shift;
  return true;
}

inline Vector3d approximateNormal(const Body& body, const Eigen::Vector3i& f) {
  const Vector3d a = body.points[f[0]];
  return (body.points[f[1]] - a).cross(body.points[f[2]] - a).normalized();
}

/// Edges of a closed surface whose faces are not in one plane.
inline void findEdges(Body& body) {
  std::map<std::pair<int, int>, Vector3d> sides;
  for (const Eigen::Vector3i& f : body.faces) {
    const Vector3d n = approximateNormal(body, f);
    for (int i = 0; i < 3; ++i) sides[{f[i], f[(i + 1) % 3]}] = n;
  }
  for (const auto& [edge, n] : sides) {
    const Vector3d& other = sides.at({edge.second, edge.first});
    if (edge.first > edge.second || n.cross(other).norm() < 1e-9) continue;
    body.edges.push_back({edge.first, edge.second, n, (n + other).normalized(), other});
  }
}

/// Points on an ellipsoid: each is a vertex, and the faces are triangles.
inline Body randomPolytope(Random& random, double size) {
  Body body;
  const Vector3d axes{size, size * random.decades(-1.0, 0.0), size * random.decades(-1.0, 0.0)};
  const int count = 8 + random.below(5);
  for (int i = 0; i < count; ++i) body.points.push_back(axes.cwiseProduct(random.direction()));
  const auto isFace = [&](const Eigen::Vector3i& f) {
    const Vector3d n = approximateNormal(body, f);
    return std::all_of(body.points.begin(), body.points.end(), [&](const Vector3d& p) {
      return n.dot(p - body.points[f[0]]) < 1e-12 * size;
    });
  };
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        for (const Eigen::Vector3i& f : {Eigen::Vector3i(i, j, k), Eigen::Vector3i(i, k, j)}) {
          if (isFace(f)) body.faces.push_back(f);
        }
      }
    }
  }
  findEdges(body);
  return body;
}

inline Body boxBody(const Vector3d& half) {
  Body body;
  for (int k = 0; k < 8; ++k) {
    body.points.emplace_back(k & 1 ? half.x() : -half.x(), k & 2 ? half.y() : -half.y(),
                             k & 4 ? half.z() : -half.z());
  }
  body.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  findEdges(body);
  return body;
}

inline Vector3d boxSizes(Random& random, double size) {
  return {size * random.decades(-1.5, 0.0), size * random.decades(-1.5, 0.0), size};
}

inline Solid drawSphere(Random& random, double size) {
  Body body;
  body.points = {Vector3d::Zero()};
  body.radius = size * random.uniform(0.5, 1.0);
  finish(body);
  return {swept::Sphere{body.radius}, body};
}

inline Solid drawBox(Random& random, double size) {
  const Vector3d half = boxSizes(random, size);
  Body body = boxBody(half);
  finish(body);
  return {swept::Box{half}, body};
}

/// Radius and half length.
inline Body roundBody(Body::Core core, Random& random, double size) {
  Body body;
  body.core = core;
  body.size = size * Vector3d{random.decades(-1.5, 0.0), 0.0, random.decades(-1.5, 0.0)};
  body.extent = body.size.norm();
  return body;
}

inline Solid drawCylinder(Random& random, double size) {
  Body body = roundBody(Body::Core::Cylinder, random, size);
  return {swept::Cylinder{body.size.x(), body.size.z()}, body};
}

inline Solid drawCone(Random& random, double size) {
  Body body = roundBody(Body::Core::Cone, random, size);
  return {swept::Cone{body.size.x(), body.size.z()}, body};
}

inline Solid drawCapsule(Random& random, double size) {
  Body body;
  const double half = size * random.decades(-1.5, 0.0);
  body.points = {Vector3d(0.0, 0.0, -half), Vector3d(0.0, 0.0, half)};
  body.edges = {{0, 1, Vector3d::UnitX(), Vector3d::UnitX(), Vector3d::UnitX()}};
  body.radius = size * random.decades(-1.5, 0.0);
  finish(body);
  return {swept::Capsule{body.radius, half}, body};
}

inline Solid drawEllipsoid(Random& random, double size) {
  Body body;
  body.core = Body::Core::Ellipsoid;
  body.size = size * Vector3d{random.decades(-1.0, 0.0), 1.0, random.decades(-1.0, 0.0)};
  body.extent = body.size.maxCoeff();
  // The least radius of curvature (Blaschke: such a ball rolls freely), less its rounding.
  body.rolling = 0.999 * body.size.minCoeff() * body.size.minCoeff() / body.extent;
  return {swept::Ellipsoid{body.size}, body};
}

inline Solid drawHull(Random& random, double size) {
  Body body = random.chance(0.25) ? boxBody(boxSizes(random, size)) : randomPolytope(random, size);
  moveAway(body, random, size);
  finish(body);
  return {swept::ConvexHull::of(body.points), body};
}

inline Solid drawTriangle(Random& random, double size) {
  Body body;
  for (int i = 0; i < 3; ++i) body.points.push_back(size * random.inBall());
  if (random.chance(0.1)) {  // a sliver
    body.points[2] = 0.4 * body.points[0] + 0.6 * body.points[1] + 1e-6 * body.points[2];
  }
  moveAway(body, random, size);
  body.faces = {{0, 1, 2}, {0, 2, 1}};
  const Vector3d n = approximateNormal(body, body.faces[0]);
  for (int i = 0; i < 3; ++i) {
    const Vector3d out = (body.points[(i + 1) % 3] - body.points[i]).cross(n).normalized();
    body.edges.push_back({i, (i + 1) % 3, n, out, -n});
  }
  finish(body);
  return {swept::Triangle{{body.points[0], body.points[1], body.points[2]}}, body};
}

inline Body flatBody(Random& random, double size) {
  Body body;
  body.core = Body::Core::Flat;
  body.size = random.direction();
  if (random.chance(0.3)) {
    const double sign = random.sign();
    body.size = sign * Vector3d::Unit(random.below(3));
  }
  body.offset = size * random.uniform(-1.0, 1.0);
  body.extent = std::abs(body.offset);
  return body;
}

inline Solid drawPlane(Random& random, double size) {
  Body body = flatBody(random, size);
  return {swept::Plane{body.size, body.offset}, body};
}

inline Solid drawHalfSpace(Random& random, double size) {
  Body body = flatBody(random, size);
  body.halfSpace = true;
  return {swept::HalfSpace{body.size, body.offset}, body};
}

/// A third are dented: a face drawn in to a point inside.
inline Solid drawMesh(Random& random, double size) {
  Body body = random.chance(0.25) ? boxBody(boxSizes(random, size)) : randomPolytope(random, size);
  body.surface = body.faces;
  if (body.points.size() > 8 && random.chance(0.4)) {
    body.convex = false;
    const Eigen::Vector3i f = body.faces.back();
    body.faces.pop_back();
    body.surface.pop_back();
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& p : body.points) middle += p / static_cast<double>(body.points.size());
    const Vector3d center = (body.points[f[0]] + body.points[f[1]] + body.points[f[2]]) / 3.0;
    const int apex = static_cast<int>(body.points.size());
    body.points.push_back(0.5 * (center + middle));
    for (int i = 0; i < 3; ++i) body.surface.emplace_back(f[i], f[(i + 1) % 3], apex);
  }
  // Rounding may make such a one not quite convex.
  if (moveAway(body, random, size)) body.convex = false;
  finish(body);
  return {swept::TriangleMesh::build(body.points, body.surface), body};
}

/// Balls; their hull touches where one of them does.
inline Solid drawCloud(Random& random, double size) {
  Body body;
  body.convex = false;
  for (int i = 0; i < 8; ++i) body.points.push_back(size * random.inBall());
  body.radius = size * random.decades(-3.0, -1.0);
  moveAway(body, random, size);
  finish(body);
  return {swept::PointCloud::build(body.points, body.radius), body};
}

inline const std::vector<Kind>& kinds() {
  using enum Feature;
  static const std::vector<Kind> all = {
      {"sphere", drawSphere, {Curve}},
      {"box", drawBox, {Vertex, Edge, Face}},
      {"cylinder", drawCylinder, {Curve, Edge, Face}},
      {"capsule", drawCapsule, {Vertex, Edge}},
      {"cone", drawCone, {Vertex, Edge, Face, Curve}},
      {"ellipsoid", drawEllipsoid, {Curve}},
      {"convex hull", drawHull, {Vertex, Edge, Face}},
      {"triangle", drawTriangle, {Vertex, Edge, Face}},
      {"plane", drawPlane, {Face}, true},
      {"half-space", drawHalfSpace, {Face}, true},
      {"closed mesh", drawMesh, {Vertex, Edge, Face}},
      {"point cloud", drawCloud, {Vertex}},
  };
  return all;
}

}  // namespace error_table
