// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
  return TriangleMesh::build(soup.vertices, soup.triangles, interior);
}

double windingNumber(const Soup& soup, const Vector3d& point) {
  return reference::windingNumber(reference::trianglesOf(soup.vertices, soup.triangles), point);
}

bool inside(const std::vector<Soup>& shells, const Vector3d& point) {
  for (const Soup& shell : shells) {
    if (std::abs(windingNumber(shell, point)) > 0.5) return true;
  }
  return false;
}

/// From the planes of the triangles, no farther than from the triangles: leaves out every point
/// where the solid angle itself is uncertain, and few others.
double distanceToPlanes(const Soup& soup, const Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3i& t : soup.triangles) {
    const Vector3d a = soup.vertices[t[0]];
    const Vector3d n = (soup.vertices[t[1]] - a).cross(soup.vertices[t[2]] - a).normalized();
    nearest = std::min(nearest, std::abs(n.dot(point - a)));
  }
  return nearest;
}

/// Compares encloses() with the winding numbers of the shells, one by one; both answers have to be
/// common.
void expectSameInside(const TriangleMesh& mesh, const std::vector<Soup>& shells, double reach,
                      int points, std::mt19937& random) {
  int hits = 0;
  for (int i = 0; i < points; ++i) {
    const Vector3d point = test::uniformPoint(random, reach);
    bool uncertain = false;
    for (const Soup& shell : shells) {
      if (distanceToPlanes(shell, point) < 1e-9) uncertain = true;
    }
    if (uncertain) continue;
    const bool expected = inside(shells, point);
    hits += expected ? 1 : 0;
    ASSERT_EQ(mesh.encloses(point), expected) << "point " << point.transpose();
  }
  EXPECT_GT(hits, points / 40);
  EXPECT_LT(hits, points - points / 40);
}

TEST(TriangleMeshEncloses, AgreesWithTheWindingNumberOfRandomSolids) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 12; ++trial) {
    const Soup blob = test::blobSoup(random, 8, 11).moved(test::randomPose(random, 0.3));
    const TriangleMesh mesh = build(blob);
    ASSERT_TRUE(mesh.isClosed());
    expectSameInside(mesh, {blob}, 1.2, 800, random);
    expectSameInside(build(blob.inverted()), {blob}, 1.2, 200, random);
  }
}

TEST(TriangleMeshEncloses, IgnoresOrientation) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 6; ++trial) {
    const Soup blob = test::blobSoup(random, 7, 9);
    Soup mixed = blob;
    for (Vector3i& t : mixed.triangles) {
      if (test::uniform(random, 0.0, 1.0) < 0.5) std::swap(t[0], t[1]);
    }
    expectSameInside(build(mixed), {blob}, 1.0, 800, random);
  }
}

TEST(TriangleMeshEncloses, FillsCavitiesAndJoinsOverlaps) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 6; ++trial) {
    // A cavity (inverted, inside), an overlapping solid, and one apart.
    Soup cavity = test::blobSoup(random, 6, 7).inverted();
    for (Vector3d& v : cavity.vertices) v *= 0.3;
    Soup beside = test::blobSoup(random, 6, 7);
    for (Vector3d& v : beside.vertices) v += Vector3d(0.7, 0.2, 0.1);
    Soup apart = test::boxSoup(Vector3d::Constant(-1.8), Vector3d::Constant(-1.0));
    const std::vector<Soup> shells = {test::blobSoup(random, 6, 7), cavity, beside, apart};
    Soup all;
    for (const Soup& shell : shells) all.append(shell);
    const TriangleMesh mesh = build(all);
    EXPECT_EQ(mesh.report().closedComponents, 4);
    EXPECT_TRUE(mesh.encloses(Vector3d(0.01, 0.02, 0.03)));
    expectSameInside(mesh, shells, 1.9, 2000, random);
  }
}

TEST(TriangleMeshEncloses, CountsWhereASolidOverlapsItself) {
  // A tube that goes round twice before it closes: the winding number is 2 where its turns overlap.
  const Soup coil = test::wrappedGrid(64, 12, [](double u, double v) {
    const double a = 4.0 * std::numbers::pi * u;
    const double b = 2.0 * std::numbers::pi * v;
    const double radial = 1.0 + 0.3 * std::cos(b) + 0.15 * std::cos(0.5 * a);
    return Vector3d(radial * std::cos(a), radial * std::sin(a), 0.3 * std::sin(b));
  });
  const TriangleMesh mesh = build(coil);
  ASSERT_EQ(mesh.report().closedComponents, 1);
  std::mt19937 random(14);
  int twice = 0;
  for (int i = 0; i < 4000; ++i) {
    Vector3d p = test::uniformPoint(random, 1.5);
    p.z() *= 0.25;
    if (distanceToPlanes(coil, p) < 1e-9) continue;
    const double winding = std::abs(windingNumber(coil, p));
    twice += winding > 1.5 ? 1 : 0;
    ASSERT_EQ(mesh.encloses(p), winding > 0.5) << p.transpose();
  }
  EXPECT_GT(twice, 200);
}

TEST(TriangleMeshEncloses, HandlesRaysThroughEdgesAndCorners) {
  // All points of a regular grid see corners, edges and diagonals of the box in many directions.
  const TriangleMesh mesh = build(test::boxSoup(-Vector3d::Ones(), Vector3d::Ones()));
  for (int i = -6; i <= 6; ++i) {
    for (int j = -6; j <= 6; ++j) {
      for (int k = -6; k <= 6; ++k) {
        const Vector3d p(0.25 * i, 0.25 * j, 0.25 * k);
        const double largest = p.cwiseAbs().maxCoeff();
        if (largest == 1.0) continue;
        ASSERT_EQ(mesh.encloses(p), largest < 1.0) << p.transpose();
      }
    }
  }
  // Next to a face, far from rounding.
  EXPECT_TRUE(mesh.encloses(Vector3d(0.3, 0.2, 1.0 - 1e-12)));
  EXPECT_FALSE(mesh.encloses(Vector3d(0.3, 0.2, 1.0 + 1e-12)));
}

TEST(TriangleMeshEncloses, CountsMoreNestedShellsThanFitInline) {
  Soup nested;
  for (int i = 1; i <= 100; ++i) {
    nested.append(test::boxSoup(Vector3d::Constant(-0.01 * i), Vector3d::Constant(0.01 * i)));
  }
  const TriangleMesh mesh = build(nested);
  EXPECT_EQ(mesh.report().closedComponents, 100);
  EXPECT_TRUE(mesh.encloses(Vector3d(0.001, 0.002, 0.003)));
  EXPECT_TRUE(mesh.encloses(Vector3d(0.991, 0.002, 0.003)));
  EXPECT_FALSE(mesh.encloses(Vector3d(1.001, 0.002, 0.003)));
}

TEST(TriangleMeshEncloses, IsFalseForSurfacesAndForPointsThatAreNoNumbers) {
  const Soup box = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  EXPECT_TRUE(build(box).encloses(Vector3d::Zero()));
  EXPECT_FALSE(build(box, MeshInterior::Surface).encloses(Vector3d::Zero()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(build(box).encloses(Vector3d(nan, 0.0, 0.0)));
  EXPECT_FALSE(build(box).encloses(Vector3d(infinity, 0.0, 0.0)));
}

TEST(TriangleMeshEncloses, WorksAtAllScales) {
  for (double scale : {1e-60, 1e-9, 1e9, 1e60}) {
    Soup torus = test::torusSoup(24, 12, 1.0, 0.4);
    for (Vector3d& v : torus.vertices) v *= scale;
    const TriangleMesh mesh = build(torus);
    EXPECT_TRUE(mesh.encloses(scale * Vector3d(1.0, 0.05, 0.1))) << scale;
    EXPECT_FALSE(mesh.encloses(scale * Vector3d(0.1, 0.05, 0.1))) << scale;
  }
}

/// Products of three coordinates are out of range: no ray was sure, and the hole of a ring was
/// inside, which made what lies in it a collision.
TEST(TriangleMeshEncloses, KeepsTheHoleOfARingOpenAtAnyScale) {
  for (const int exponent : {-1010, -900, -520, -345, -333, 333, 345, 520, 900, 1010}) {
    const double scale = std::ldexp(1.0, exponent);
    Soup ring = test::torusSoup(16, 12, 0.7, 0.25);
    for (Vector3d& vertex : ring.vertices) vertex *= scale;
    const TriangleMesh mesh = build(ring);
    int astray = 0;
    for (int i = 0; i < 100; ++i) {
      const double angle = 0.7 * i;
      const Vector3d around(std::cos(angle), std::sin(angle), 0.0);
      const Vector3d up(0.0, 0.0, 0.03 * (i % 5));
      astray += mesh.encloses(scale * (0.35 * around + up)) ? 1 : 0;
      astray += mesh.encloses(scale * (0.7 * around + up)) ? 0 : 1;
    }
    EXPECT_EQ(astray, 0) << exponent;
  }
}

TEST(TriangleMeshEncloses, ShellsThatTouchAlongAnEdgeAreClosed) {
  const Soup tetrahedron{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                         {{0, 1, 3}, {0, 3, 2}, {0, 2, 1}, {1, 2, 3}}};
  Soup mirrored = tetrahedron;
  for (Vector3d& v : mirrored.vertices) v.head<2>() *= -1.0;
  for (const Soup& other : {mirrored, mirrored.inverted()}) {
    Soup both = tetrahedron;
    both.append(other);
    const TriangleMesh mesh = build(both);
    EXPECT_EQ(mesh.report().closedComponents, 1);
    EXPECT_EQ(mesh.report().verticesKept, 6);
    std::mt19937 random(5);
    expectSameInside(mesh, {tetrahedron, other}, 0.6, 2000, random);
  }
}

}  // namespace
}  // namespace swept
