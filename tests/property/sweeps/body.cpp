// SPDX-License-Identifier: BSD-3-Clause
#include "body.hpp"

#include <algorithm>

#include "../../core/mesh_samples.hpp"

namespace sweeps {
namespace {

using swept::test::Soup;

Vector3d farthest(const std::vector<Vector3d>& points, const Vector3d& n) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return a.dot(n) < b.dot(n);
  });
}

Vector3d rim(double radius, const Vector3d& n) {
  const double across = std::hypot(n.x(), n.y());
  if (!(across > 0.0)) return {radius, 0.0, 0.0};
  return {radius * (n.x() / across), radius * (n.y() / across), 0.0};
}

Part round(Part::Core core, const Vector3d& size) {
  Part part;
  part.core = core;
  part.size = size;
  part.radius = size.norm();
  return part;
}

Part ofPoints(std::vector<Vector3d> points, double ball) {
  Part part;
  for (const Vector3d& p : points) part.center += p / static_cast<double>(points.size());
  for (const Vector3d& p : points) part.radius = std::max(part.radius, (p - part.center).norm());
  part.radius += ball;
  part.points = std::move(points);
  part.ball = ball;
  return part;
}

std::vector<Vector3d> corners(const Vector3d& half) {
  return swept::test::boxSoup(-half, half).vertices;
}

/// Plump, thin like a plate, thin like a rod, or without extent along an axis.
Vector3d sizes(double size, Random& random) {
  Vector3d all;
  for (int i = 0; i < 3; ++i) all[i] = size * random.uniform(0.2, 1.0);
  const double form = random.uniform(0.0, 1.0);
  const int axis = random.below(3);
  const double thin = random.decades(-6.0, -1.0);
  if (form < 0.3) all[axis] *= thin;
  if (form > 0.85) all[(axis + 1) % 3] *= thin, all[(axis + 2) % 3] *= thin;
  if (form > 0.8 && form < 0.85) all[axis] = 0.0;
  return all;
}

std::vector<Vector3d> scattered(int count, const Vector3d& size, Random& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(size.cwiseProduct(random.direction()));
  return points;
}

/// Heights over a grid: not flat, nor closed.
Soup sheet(const Vector3d& size, Random& random) {
  Soup soup;
  constexpr int kSide = 4;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int row = i / kSide, column = i % kSide;
    const double x = 2.0 * column / (kSide - 1.0) - 1.0;
    const double y = 2.0 * row / (kSide - 1.0) - 1.0;
    soup.vertices.push_back(size.cwiseProduct(Vector3d(x, y, random.uniform(-1.0, 1.0))));
  }
  for (int i = 0; i + kSide < kSide * kSide; ++i) {
    if (i % kSide == kSide - 1) continue;
    soup.triangles.emplace_back(i, i + 1, i + kSide);
    soup.triangles.emplace_back(i + 1, i + kSide + 1, i + kSide);
  }
  return soup;
}

Soup torus(double size, Random& random) {
  const double major = random.uniform(0.5, 0.8);
  const double minor = random.uniform(0.05, 0.2);
  return swept::test::torusSoup(6, 4, size * major, size * minor);
}

void mesh(Body& body, const Soup& soup, swept::MeshInterior interior) {
  // As it is: a sliver that is missing would be filled.
  body.shape = swept::TriangleMesh::build(soup.vertices, soup.triangles, interior, 0.0);
  for (const Eigen::Vector3i& t : soup.triangles) {
    body.parts.push_back(
        ofPoints({soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]}, 0.0));
    if (body.kind == Kind::ClosedMesh) {
      body.shell.push_back({soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]});
    }
  }
}

void makeMesh(Body& body, double size, Random& random) {
  if (body.kind == Kind::OpenMesh) {
    return mesh(body, sheet(sizes(size, random), random), swept::MeshInterior::Solid);
  }
  const auto interior =
      body.kind == Kind::ClosedMesh ? swept::MeshInterior::Solid : swept::MeshInterior::Surface;
  if (random.chance(0.5)) return mesh(body, torus(size, random), interior);
  body.half = sizes(size, random).cwiseMax(1e-6 * size);
  body.boxy = true;
  mesh(body, swept::test::boxSoup(-body.half, body.half), interior);
}

void makeFlat(Body& body, double size, Random& random) {
  body.normal = random.chance(0.3) ? Vector3d(random.sign() * Vector3d::Unit(random.below(3)))
                                   : random.direction();
  body.offset = random.chance(0.3) ? 0.0 : random.uniform(-size, size);
  body.reach = std::abs(body.offset);
  if (body.kind == Kind::Plane)
    body.shape = swept::Plane{body.normal, body.offset};
  else
    body.shape = swept::HalfSpace{body.normal, body.offset};
}

void makeConvex(Body& body, double size, Random& random) {
  const Vector3d s = sizes(size, random);
  switch (body.kind) {
    case Kind::Sphere: {
      const double radius = random.chance(0.05) ? 0.0 : s.x();
      body.shape = swept::Sphere{radius};
      body.parts.push_back(ofPoints({Vector3d::Zero()}, radius));
      return;
    }
    case Kind::Box:
      body.shape = swept::Box{s};
      body.half = s;
      body.boxy = true;
      body.parts.push_back(round(Part::Core::Box, s));
      return;
    case Kind::Cylinder:
      body.shape = swept::Cylinder{s.x(), s.z()};
      body.parts.push_back(round(Part::Core::Cylinder, {s.x(), 0.0, s.z()}));
      return;
    case Kind::Capsule:
      body.shape = swept::Capsule{s.x(), s.z()};
      body.parts.push_back(ofPoints({{0.0, 0.0, s.z()}, {0.0, 0.0, -s.z()}}, s.x()));
      return;
    case Kind::Cone:
      body.shape = swept::Cone{s.x(), s.z()};
      body.parts.push_back(round(Part::Core::Cone, {s.x(), 0.0, s.z()}));
      return;
    case Kind::Ellipsoid:
      body.shape = swept::Ellipsoid{s};
      body.parts.push_back(round(Part::Core::Ellipsoid, s));
      return;
    case Kind::Hull: {
      body.boxy = random.chance(0.4);
      body.half = s;
      const int count = 1 + random.below(20);
      const auto points = body.boxy ? corners(s) : scattered(count, s, random);
      body.shape = swept::ConvexHull::of(points);
      body.parts.push_back(ofPoints(points, 0.0));
      return;
    }
    case Kind::Triangle: {
      auto points = scattered(3, s, random);
      if (random.chance(0.05)) points[2] = points[1];
      if (random.chance(0.05)) points[2] = 0.5 * (points[0] + points[1]);
      body.shape = swept::Triangle{{points[0], points[1], points[2]}};
      body.parts.push_back(ofPoints(points, 0.0));
      return;
    }
    case Kind::Plane:
    case Kind::HalfSpace:
    case Kind::ClosedMesh:
    case Kind::OpenMesh:
    case Kind::SurfaceMesh:
    case Kind::Cloud:
      return;  // none of them is convex and bounded
  }
}

}  // namespace

Vector3d Part::support(const Vector3d& n) const {
  const Vector3d end(0.0, 0.0, n.z() < 0.0 ? -size.z() : size.z());
  switch (core) {
    case Core::Box:
      return size.cwiseProduct(n.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; }));
    case Core::Cylinder:
      return rim(size.x(), n) + end;
    case Core::Cone: {
      const Vector3d apex(0.0, 0.0, size.z());
      const Vector3d base = rim(size.x(), n) - apex;
      return n.dot(apex) > n.dot(base) ? apex : base;
    }
    case Core::Ellipsoid: {
      const Vector3d stretched = size.cwiseProduct(n);
      const double length = stretched.norm();
      if (!(length > 0.0)) return Vector3d::Zero();
      return size.cwiseProduct(stretched / length);
    }
    case Core::Points:
      break;
  }
  return farthest(points, n);
}

double Body::extent(const Vector3d& n) const {
  double most = -INFINITY;
  for (const Part& part : parts) {
    most = std::max(most, n.dot(part.support(n)) + part.ball * n.norm());
  }
  return most;
}

Body makeBody(Kind kind, double size, Random& random) {
  Body body;
  body.kind = kind;
  if (body.flat()) {
    makeFlat(body, size, random);
    return body;
  }
  if (kind == Kind::Cloud) {
    const Vector3d s = sizes(size, random);
    const auto points = scattered(1 + random.below(12), s, random);
    const double most = random.chance(0.2) ? 0.0 : random.uniform(0.02, 0.3) * s.maxCoeff();
    const bool alike = random.chance(0.5);
    std::vector<double> radii;
    for (const Vector3d& p : points) {
      radii.push_back(alike ? most : random.uniform(0.0, most));
      body.parts.push_back(ofPoints({p}, radii.back()));
    }
    body.shape = swept::PointCloud::build(points, radii);
  } else if (kind == Kind::ClosedMesh || kind == Kind::OpenMesh || kind == Kind::SurfaceMesh) {
    makeMesh(body, size, random);
  } else {
    makeConvex(body, size, random);
  }
  for (const Part& part : body.parts) {
    body.reach = std::max(body.reach, part.center.norm() + part.radius);
  }
  return body;
}

}  // namespace sweeps
