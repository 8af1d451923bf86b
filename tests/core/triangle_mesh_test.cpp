// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/triangle_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "mesh_samples.hpp"
#include "message_of.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TEST(TriangleMeshReport, WeldsEqualPositionsAndDropsUnusedOnes) {
  // Like an STL file: every triangle brings its own corners. One corner is written as -0.0.
  const Soup box = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  Soup stl;
  for (const Vector3i& t : box.triangles) {
    for (int corner : t) stl.vertices.push_back(box.vertices[corner]);
    const int last = static_cast<int>(stl.vertices.size()) - 1;
    stl.triangles.emplace_back(last - 2, last - 1, last);
  }
  ASSERT_EQ(stl.vertices[0], Vector3d::Zero());
  stl.vertices[0] = Vector3d(-0.0, 0.0, -0.0);
  stl.vertices.emplace_back(7.0, 7.0, 7.0);

  const TriangleMesh mesh = build(stl);
  EXPECT_EQ(mesh.report().verticesGiven, 37);
  EXPECT_EQ(mesh.report().verticesKept, 8);
  EXPECT_EQ(mesh.vertices().size(), 8u);
  EXPECT_EQ(mesh.report().trianglesGiven, 12);
  EXPECT_EQ(mesh.report().degenerateDropped, 0);
  EXPECT_EQ(mesh.report().duplicatesDropped, 0);
  EXPECT_EQ(mesh.report().closedComponents, 1);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_THAT(mesh.vertices(), testing::Not(testing::Contains(Vector3d(7.0, 7.0, 7.0))));
}

TEST(TriangleMeshReport, DoesNotWeldNearlyEqualPositions) {
  Soup soup = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  // One triangle gets its own copy of a corner, one ulp away: a gap, which no body fits through.
  soup.vertices.push_back(soup.vertices[7] * (1.0 + std::numeric_limits<double>::epsilon()));
  for (int& corner : soup.triangles.back()) {
    if (corner == 7) corner = 8;
  }
  const TriangleMesh exact =
      TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid, 0.0);
  EXPECT_EQ(exact.report().verticesKept, 9);
  EXPECT_EQ(exact.report().openComponents, 1);
  EXPECT_EQ(exact.report().closedComponents, 0);
  EXPECT_FALSE(exact.encloses(Vector3d::Constant(0.5)));
  const TriangleMesh mesh = build(soup);
  EXPECT_EQ(mesh.report().verticesKept, 9);
  EXPECT_EQ(mesh.report().closedComponents, 1);
  EXPECT_TRUE(mesh.encloses(Vector3d::Constant(0.5)));
}

TEST(TriangleMeshReport, DropsTrianglesWithEqualCornersOnly) {
  Soup soup = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  soup.triangles.emplace_back(3, 3, 5);
  soup.vertices.push_back(soup.vertices[3]);
  soup.triangles.emplace_back(8, 1, 3);
  const TriangleMesh mesh = build(soup);
  EXPECT_EQ(mesh.report().degenerateDropped, 2);
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_TRUE(mesh.isClosed());

  // A tetrahedron whose face holds a point of its own edge: the sliver has no area but closes it.
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
  const std::vector<Vector3i> faces = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3},
                                       {0, 3, 2}, {1, 2, 3}, {0, 1, 4}};
  const TriangleMesh sliver = TriangleMesh::build(corners, faces);
  EXPECT_EQ(sliver.report().degenerateDropped, 0);
  EXPECT_TRUE(sliver.isClosed());
  EXPECT_TRUE(sliver.encloses(Vector3d(0.2, 0.2, 0.2)));
  EXPECT_FALSE(sliver.encloses(Vector3d(0.4, 0.4, 0.4)));
}

TEST(TriangleMeshReport, DropsRepeatedSurfaces) {
  const Soup box = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  for (const Soup& repetition : {box, box.inverted()}) {
    Soup twice = box;
    twice.append(repetition);
    const TriangleMesh mesh = build(twice);
    EXPECT_EQ(mesh.report().duplicatesDropped, 12);
    EXPECT_EQ(mesh.report().closedComponents, 1);
    EXPECT_TRUE(mesh.encloses(Vector3d::Constant(0.5)));
    EXPECT_FALSE(mesh.encloses(Vector3d(0.5, 0.5, 1.5)));
  }
  // A double-sided sheet encloses nothing, and stays a surface.
  Soup sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}};
  EXPECT_EQ(build(sheet).report().duplicatesDropped, 1);
  EXPECT_EQ(build(sheet).report().openComponents, 1);
}

TEST(TriangleMeshReport, KeepsTheFaceThatTwoShellsShare) {
  const Soup left = test::boxSoup({0, 0, 0}, {1, 1, 1});
  // The mirror image at x = 1, so that both boxes split the shared face along the same diagonal.
  Soup right = left;
  for (Vector3d& v : right.vertices) v.x() = 2.0 - v.x();
  for (const Soup& other : {right, right.inverted()}) {
    Soup both = left;
    both.append(other);
    const TriangleMesh mesh = build(both);
    EXPECT_EQ(mesh.report().duplicatesDropped, 0);
    EXPECT_EQ(mesh.report().verticesKept, 12);
    EXPECT_EQ(mesh.report().closedComponents, 1);
    EXPECT_TRUE(mesh.isClosed());
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p = test::uniformPoint(random, 2.5);
      const bool expected =
          p.x() > 0 && p.x() < 2 && p.y() > 0 && p.y() < 1 && p.z() > 0 && p.z() < 1;
      ASSERT_EQ(mesh.encloses(p), expected) << p.transpose();
    }
  }
}

TEST(TriangleMeshReport, CountsComponents) {
  Soup soup = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  soup.append(test::boxSoup(Vector3d::Constant(2.0), Vector3d::Constant(3.0)));
  Soup open = test::boxSoup(Vector3d::Constant(4.0), Vector3d::Constant(5.0));
  open.triangles.pop_back();
  soup.append(open);
  const TriangleMesh mesh = build(soup);
  EXPECT_EQ(mesh.report().closedComponents, 2);
  EXPECT_EQ(mesh.report().openComponents, 1);
  EXPECT_FALSE(mesh.isClosed());
  EXPECT_TRUE(mesh.encloses(Vector3d::Constant(0.5)));
  EXPECT_TRUE(mesh.encloses(Vector3d::Constant(2.5)));
  EXPECT_FALSE(mesh.encloses(Vector3d::Constant(4.5)));
  EXPECT_EQ(mesh.componentPoints().size(), 3u);
  for (double shift : {0.0, 2.0, 4.0}) {
    EXPECT_TRUE(std::any_of(mesh.componentPoints().begin(), mesh.componentPoints().end(),
                            [&](const Vector3d& p) {
                              return (p.array() >= shift).all() && (p.array() <= shift + 1).all();
                            }));
  }
  // Two boxes that touch in one point share no edge: two components.
  Soup touching = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  touching.append(test::boxSoup(Vector3d::Ones(), Vector3d::Constant(2.0)));
  EXPECT_EQ(build(touching).report().closedComponents, 2);
  EXPECT_EQ(build(touching).report().verticesKept, 15);
}

std::string messageOf(const Soup& soup) {
  return test::messageOf([&] { build(soup); });
}

TEST(TriangleMeshErrors, NameTheValue) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(messageOf({corners, {{0, 1, 2}, {0, 1, 3}}}),
            "mesh triangle 1 has corner 3; allowed: 0 to 2");
  EXPECT_EQ(messageOf({corners, {{0, -1, 2}}}), "mesh triangle 0 has corner -1; allowed: 0 to 2");
  EXPECT_EQ(messageOf({corners, {{0, 1, 1}}}),
            "mesh has no triangle with three distinct corners (of 1 given)");
  EXPECT_EQ(messageOf({corners, {}}),
            "mesh has no triangle with three distinct corners (of 0 given)");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf({{{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{0, 1, 2}}}),
            "mesh vertex 1 is (1, nan, 0); allowed: finite coordinates");
}

}  // namespace
}  // namespace swept
