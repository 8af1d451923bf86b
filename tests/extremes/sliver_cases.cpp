// SPDX-License-Identifier: BSD-3-Clause
#include "core/error_table_shapes.hpp"
#include "sample.hpp"

namespace extremes {

namespace {

using namespace error_table;
using Corners = swept::TriangleCorners;

constexpr double kThin = 1e-8;

Sample exactly(const Corners& a, const Corners& b) {
  Sample sample{triangleOf(a[0], a[1], a[2]), triangleOf(b[0], b[1], b[2])};
  const Real truth = oracle::touch(a, b) ? Real(-depthOf(sample.a.body, sample.b.body, sample.pose))
                                         : oracle::distance(a, b);
  sample.truth = {truth, truth};
  return sample;
}

using DrawCorners = Corners (*)(Random&);

Corners ordinary(Random& random) {
  return {random.inBall(), random.inBall(), random.inBall()};
}
/// The third corner almost on the opposite side.
Corners sliver(Random& random) {
  Corners t = ordinary(random);
  const double share = random.uniform(0.1, 0.9);
  t[2] = share * t[0] + (1.0 - share) * t[1] + kThin * t[2];
  return t;
}
/// Two corners almost the same.
Corners needle(Random& random) {
  Corners t = ordinary(random);
  t[2] = t[1] + kThin * t[2];
  return t;
}
double eighth(Random& random) {
  return 0.125 * (random.below(33) - 16);
}
Vector3d gridPoint(Random& random) {
  Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = eighth(random);
  return p;
}
/// Corners on a line, or one point, to the last bit.
Corners withoutArea(Random& random) {
  const Vector3d p = gridPoint(random);
  if (random.chance(0.1)) return {p, p, p};
  const Vector3d way = gridPoint(random);
  return {p, p + way, p + 0.125 * random.below(17) * way};
}

Vector3d inside(const Corners& t, Random& random) {
  const double u = random.uniform(0.1, 0.5);
  const double v = random.uniform(0.1, 0.4);
  return u * t[0] + v * t[1] + (1.0 - u - v) * t[2];
}

/// With a point of each in the same place, or almost.
PairCase triangles(const std::string& name, DrawCorners drawA, double workLimit) {
  return {name, "ordinary triangles", workLimit, [drawA](Random& random, int i) {
            for (;;) {
              const Corners a = drawA(random);
              Corners b = random.chance(0.5) ? ordinary(random) : drawA(random);
              const bool apart = i % 2 == 0;
              const double off = apart ? random.decades(-9.0, 0.0) : 0.0;
              const Vector3d shift =
                  inside(a, random) - inside(b, random) + off * random.direction();
              for (Vector3d& corner : b) corner += shift;
              if (oracle::touch(a, b) == apart) continue;
              return random.chance(0.5) ? exactly(a, b) : exactly(b, a);
            }
          }};
}

/// In the plane z = 0, or one of its turns, to the last bit.
Sample coplanar(Random& random, int i) {
  for (;;) {
    const Matrix3d turn = random.permutation();
    Corners a, b;
    for (Corners* t : {&a, &b}) {
      for (Vector3d& corner : *t) corner = turn * Vector3d(eighth(random), eighth(random), 0.0);
    }
    const Vector3d shift = turn * Vector3d(4.0, 0.0, 0.0);
    if (i % 2 == 0 && random.chance(0.5)) {
      for (Vector3d& corner : b) corner += shift;
    }
    if (oracle::touch(a, b) == (i % 2 == 0)) continue;
    return exactly(a, b);
  }
}

struct Thin {
  double size = 0.0;  ///< m; 0: none is
  int sides = 0;      ///< of each box, at most
};

/// Boxes on a grid, whose sides are often in the same planes.
Sample onGrid(Random& random, int i, const Thin& thin, Solid (*solid)(const Vector3d&)) {
  const auto half = [&] {
    Vector3d h;
    for (int k = 0; k < 3; ++k) h[k] = 0.125 * (1 + random.below(8));
    for (int k = 0; k < thin.sides; ++k) h[random.below(3)] = thin.size;
    return h;
  };
  for (;;) {
    const Vector3d halfA = half();
    const Vector3d halfB = half();
    const Matrix3d turn = random.permutation();
    const Vector3d reach = halfA + turn.cwiseAbs() * halfB;
    Vector3d translation;
    for (int k = 0; k < 3; ++k) {
      translation[k] = thin.sides > 0 ? random.sign() * reach[k] * random.uniform(0.0, 1.2)
                                      : 0.125 * (random.below(33) - 16);
    }
    Sample sample = alignedBoxes(solid(halfA), halfA, solid(halfB), halfB, turn, translation);
    if ((sample.truth.lower > 0) == (i % 2 == 0)) return sample;
  }
}

/// A box of which two opposite faces are fans of slivers, about points that crowd at a corner.
Solid crowded(const Vector3d& half) {
  Body body = boxBody(half);
  std::vector<Eigen::Vector3i> faces(body.faces.begin() + 4, body.faces.end());
  std::vector<Vector3d> points = body.points;
  // Of the faces z = -h and z = h; counterclockwise around them as seen from outside.
  for (const auto& [around, z] : {std::pair(Eigen::Vector4i(0, 2, 3, 1), -half.z()),
                                  std::pair(Eigen::Vector4i(4, 5, 7, 6), half.z())}) {
    const int hub = static_cast<int>(points.size());
    points.emplace_back(half.x() * (1.0 - kThin), half.y() * (1.0 - 3.0 * kThin), z);
    for (int k = 0; k < 4; ++k) faces.emplace_back(around[k], around[(k + 1) % 4], hub);
  }
  Solid solid = boxMeshOf(half);
  solid.shape = swept::TriangleMesh::build(points, faces);
  return solid;
}

PairCase boxes(const std::string& name, const Thin& thin, Solid (*solid)(const Vector3d&),
               double workLimit) {
  return {name, "ordinary meshes", workLimit,
          [=](Random& random, int i) { return onGrid(random, i, thin, solid); }};
}

}  // namespace

std::vector<PairCase> sliverCases() {
  return {
      triangles("ordinary triangles", ordinary, 1.0),
      triangles("slivers, 1e8 long", sliver, 4.0),
      triangles("needles, 1e8 long", needle, 4.0),
      triangles("triangles without area", withoutArea, 4.0),
      {"triangles in one plane", "ordinary triangles", 4.0, coplanar},
      {"ordinary meshes", "ordinary meshes", 1.0,
       [](Random& random, int i) {
         Wanted wanted;
         wanted.shapes = {Form::Mesh};
         return drawEither(random, wanted, i);
       },
       true, 400},
      boxes("meshes with faces in one plane", {}, boxMeshOf, 4.0),
      boxes("meshes, plates 1e-8 m thick", {kThin, 1}, boxMeshOf, 4.0),
      boxes("meshes, needles 1e-6 m thick", {1e-6, 2}, boxMeshOf, 4.0),
      boxes("meshes of slivers, 1e8 long", {}, crowded, 4.0),
  };
}

}  // namespace extremes
