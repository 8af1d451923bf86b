// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

constexpr double kWidth = 1e-7;

TriangleMesh build(const Soup& soup, double crackWidth) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid, crackWidth);
}

/// As some programs write a solid: some triangles have corners of their own, each off by up to
/// `error` (m) along each axis.
Soup cracked(const Soup& solid, std::mt19937& random, double error) {
  Soup soup = solid;
  for (Vector3i& triangle : soup.triangles) {
    for (int& corner : triangle) {
      if (random() % 3 != 0) continue;
      soup.vertices.push_back(solid.vertices[corner] + test::uniformPoint(random, error));
      corner = static_cast<int>(soup.vertices.size()) - 1;
    }
  }
  return soup;
}

std::vector<Soup> solids(std::mt19937& random) {
  return {test::boxSoup(Vector3d::Zero(), Vector3d::Ones()), test::torusSoup(9, 7, 1.0, 0.3),
          test::blobSoup(random, 6, 8)};
}

TEST(MeshCracks, AreFilledSoThatWhatTheyOpenedIsSolid) {
  std::mt19937 random(20261123);
  int inside = 0;
  int pointsApart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    for (const Soup& solid : solids(random)) {
      const TriangleMesh whole = build(solid, 0.0);
      const Soup soup = cracked(solid, random, 0.5 * kWidth);
      ASSERT_GT(build(soup, 0.0).report().openComponents, 0);
      const TriangleMesh mesh = build(soup, kWidth);
      ASSERT_TRUE(mesh.isClosed());
      EXPECT_EQ(mesh.report().closedComponents, 1);
      EXPECT_GT(mesh.report().cracksFilled, 0);
      EXPECT_EQ(mesh.triangles().size(),
                soup.triangles.size() + static_cast<std::size_t>(mesh.report().cracksFilled));
      for (int i = 0; i < 50; ++i) {
        const Vector3d point = test::uniformPoint(random, 1.3);
        Eigen::Isometry3d mesh_from_point = Eigen::Isometry3d::Identity();
        mesh_from_point.translation() = point;
        const double apart = distance(whole, Sphere{0.0}, mesh_from_point).lower;
        const bool enclosed = whole.encloses(point);
        if (apart < 10.0 * kWidth && !enclosed) continue;
        EXPECT_EQ(mesh.encloses(point), enclosed);
        EXPECT_NEAR(distance(mesh, Sphere{0.0}, mesh_from_point).lower, apart, 10.0 * kWidth);
        ++(enclosed ? inside : pointsApart);
      }
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(pointsApart, 3000);
}

TEST(MeshCracks, NoVertexMovesAndAllTrianglesStay) {
  std::mt19937 random(3);
  for (const Soup& solid : solids(random)) {
    const Soup soup = cracked(solid, random, 0.5 * kWidth);
    const TriangleMesh open = build(soup, 0.0);
    const TriangleMesh mesh = build(soup, kWidth);
    EXPECT_EQ(mesh.vertices(), open.vertices());
    for (const Vector3i& triangle : open.triangles())
      EXPECT_THAT(mesh.triangles(), testing::Contains(triangle));
    // What fills a crack is as wide as that.
    for (const Vector3i& triangle : mesh.triangles()) {
      if (std::ranges::find(open.triangles(), triangle) != open.triangles().end()) continue;
      double shortest = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 3; ++i) {
        const Vector3d edge = mesh.vertices()[triangle[i]] - mesh.vertices()[triangle[(i + 1) % 3]];
        shortest = std::min(shortest, edge.cwiseAbs().maxCoeff());
      }
      EXPECT_LE(shortest, kWidth);
    }
  }
}

TEST(MeshCracks, SurfacesKeepTheirDirection) {
  // A tube that goes round twice and through itself: what it contains twice is inside only where
  // its winding number is known, as a ray from there crosses the surface twice.
  std::mt19937 random(11);
  const Soup tube = test::wrappedGrid(40, 9, [](double u, double v) {
    const double along = 4.0 * std::numbers::pi * u;
    const double around = 2.0 * std::numbers::pi * v;
    const double radial = 1.0 + 0.1 * std::cos(2.0 * std::numbers::pi * u) + 0.3 * std::cos(around);
    return Vector3d(radial * std::cos(along), radial * std::sin(along), 0.3 * std::sin(around));
  });
  const Vector3d twiceInside(1.0, 0.0, 0.0);
  ASSERT_TRUE(build(tube, 0.0).encloses(twiceInside));
  for (int trial = 0; trial < 20; ++trial) {
    const TriangleMesh mesh = build(cracked(tube, random, 0.5 * kWidth), kWidth);
    ASSERT_TRUE(mesh.isClosed());
    EXPECT_TRUE(mesh.encloses(twiceInside));
  }
}

TEST(MeshCracks, HolesStayOpenAndWidthIsKept) {
  std::mt19937 random(5);
  const Soup solid = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  Soup holed = cracked(solid, random, 0.5 * kWidth);
  holed.triangles.pop_back();
  EXPECT_FALSE(build(holed, kWidth).isClosed());

  // A lid that is farther away than the width, and one that is not.
  Soup lid = solid;
  for (int& corner : lid.triangles.back()) {
    lid.vertices.push_back(lid.vertices[corner] + Vector3d(0.0, 0.0, 1.5 * kWidth));
    corner = static_cast<int>(lid.vertices.size()) - 1;
  }
  EXPECT_FALSE(build(lid, kWidth).isClosed());
  EXPECT_EQ(build(lid, kWidth).report().cracksFilled, 0);
  EXPECT_TRUE(build(lid, 2.0 * kWidth).isClosed());

  // Beside it the other component's cracks are closed.
  Soup both = cracked(test::boxSoup(Vector3d::Constant(3.0), Vector3d::Constant(4.0)), random,
                      0.5 * kWidth);
  both.append(lid);
  const TriangleMesh mesh = build(both, kWidth);
  EXPECT_EQ(mesh.report().openComponents, 2);
  EXPECT_EQ(mesh.report().closedComponents, 1);
  EXPECT_TRUE(mesh.encloses(Vector3d::Constant(3.5)));
  EXPECT_FALSE(mesh.encloses(Vector3d::Constant(0.5)));
}

TEST(MeshCracks, AThinSheetIsNoSolid) {
  // A triangle, and one that is narrower than the width.
  const Soup sheet = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, kWidth / 2, 0}},
                      {{0, 1, 2}, {3, 4, 5}}};
  const TriangleMesh mesh = build(sheet, kWidth);
  EXPECT_EQ(mesh.report().openComponents, 2);
  EXPECT_FALSE(mesh.encloses(Vector3d(0.2, 0.2, 0.0)));
  EXPECT_EQ(mesh.vertices().size(), 6u);
}

TEST(MeshCracks, FollowTheirVertices) {
  std::mt19937 random(7);
  Soup soup = cracked(test::boxSoup(Vector3d::Zero(), Vector3d::Ones()), random, 0.5 * kWidth);
  const TriangleMesh mesh = build(soup, kWidth);
  for (Vector3d& vertex : soup.vertices) vertex = 2.0 * vertex + Vector3d(5.0, 0.0, 0.0);
  const TriangleMesh next = mesh.moved(soup.vertices);
  EXPECT_TRUE(next.isClosed());
  EXPECT_TRUE(next.encloses(Vector3d(6.0, 1.0, 1.5)));
  EXPECT_FALSE(next.encloses(Vector3d(0.5, 0.5, 0.5)));
}

TEST(MeshCracks, AnyWidthEnds) {
  std::mt19937 random(9);
  const Soup soup = cracked(test::torusSoup(20, 20, 1.0, 0.3), random, 0.5 * kWidth);
  for (const double width : {std::numeric_limits<double>::denorm_min(), 1e-300, 1e-17, 0.01, 1.0,
                             1e300, std::numeric_limits<double>::max()}) {
    const TriangleMesh mesh = build(soup, width);
    EXPECT_EQ(mesh.vertices(), build(soup, 0.0).vertices());
    // One that is wider than the triangles may join what does not belong together.
    if (width < 0.1) {
      EXPECT_EQ(mesh.isClosed(), width >= kWidth) << width;
    }
  }
}

TEST(MeshCracks, WidthsThatAreNoneAreRefused) {
  const Soup box = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  for (const double width :
       {-1e-9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    try {
      build(box, width);
      ADD_FAILURE() << width;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::MatchesRegex("mesh crack width is .* m; allowed: from 0"));
    }
  }
}

}  // namespace
}  // namespace swept
