// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh with two equal corners are lines of the shape. They were dropped, all of
// them: harmless where another triangle has the line for an edge, as on closed surfaces, but of an
// open one 2e12 m large, on which rounding put a corner of a needle on another one, a hull 2e-5 m
// from that needle was proven to be 8 km away.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/segment_query.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

Isometry3d at(const Vector3d& place) {
  return Isometry3d(Eigen::Translation3d(place));
}

/// A triangle, and a needle beside it, along x, whose corners at the far end are `width` (m) apart.
Soup triangleAndNeedle(double size, double width) {
  return {{{0.0, 0.0, 0.0},
           {0.0, size, 0.0},
           {0.0, 0.0, size},
           {4e-9 * size, 0.0, 0.0},
           {size, 0.0, 0.0},
           {size + width, 0.0, 0.0}},
          {{0, 1, 2}, {3, 4, 5}}};
}

TEST(LineTriangles, OfAnOpenMeshAreNotLost) {
  const double size = 2e12;
  const Soup soup = triangleAndNeedle(size, 1e-5);
  ASSERT_EQ(soup.vertices[5], soup.vertices[4]);
  const TriangleMesh mesh = build(soup);
  const Shape hull = ConvexHull::of(std::vector<Vector3d>{{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
  // Nothing but the needle's far end is near.
  const double truth = 2e-5;
  const Isometry3d pose = at({size, 0.0, truth});
  EXPECT_LE(distance(mesh, hull, pose).lower, truth);
  EXPECT_LE(distance(hull, mesh, pose.inverse()).lower, truth);
  EXPECT_LE(signedDistance(mesh, hull, pose).lower, truth);
  EXPECT_NE(collide(mesh, hull, at({size, 0.0, 0.0})), Contact::Separate);
  SeparationQuery query;
  query.approach.required = truth;
  EXPECT_NE(separate(mesh, hull, pose, query).status, Separation::Separated);
}

TEST(LineTriangles, AreSeenByEveryQuery) {
  const Soup soup = triangleAndNeedle(1.0, 0.0);
  const TriangleMesh mesh = build(soup);
  const Vector3d beside(0.5, 0.0, 0.1);
  const Shape ball = Sphere{0.05};
  EXPECT_NEAR(distance(mesh, ball, at(beside)).upper, 0.05, 1e-9);
  const LineSegment across{beside, {0.0, 0.1, 0.0}};
  EXPECT_FALSE(isFarther(mesh, across, 0.11));
  EXPECT_TRUE(isFarther(mesh, across, 0.09));
  EXPECT_LE(ClearanceGrid::build(mesh).clearance(beside), 0.1);
  EXPECT_GE(mesh.hull().extent(), 1.0);
  EXPECT_DOUBLE_EQ(boundingBox(Shape(mesh)).upper.x(), 1.0);

  std::vector<Vector3d> moved = soup.vertices;
  for (Vector3d& vertex : moved) vertex.z() += 1.0;
  EXPECT_NEAR(distance(mesh.moved(moved), ball, at(beside + Vector3d::UnitZ())).upper, 0.05, 1e-9);

  // Corners that scaling puts on each other.
  Soup thin = soup;
  thin.vertices[5] = {1.0, 1e-17, 0.0};
  const Shape half = scaled(build(thin), 0.5);
  EXPECT_EQ(std::get<TriangleMesh>(half).triangles().size(), 2u);
  EXPECT_NEAR(distance(half, Sphere{0.0}, at({0.75, 0.25, 0.25})).upper, 0.0, 1e-9);
}

TEST(LineTriangles, ThatOthersHaveAreDropped) {
  Soup soup = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  const std::size_t own = soup.triangles.size();
  for (const Vector3i& edge : {Vector3i(0, 2, 2), Vector3i(2, 0, 2), Vector3i(5, 5, 5)})
    soup.triangles.push_back(edge);
  const TriangleMesh dropped = build(soup);
  EXPECT_EQ(dropped.report().degenerateDropped, 3);
  EXPECT_EQ(dropped.triangles().size(), own);
  EXPECT_TRUE(dropped.isClosed());

  // A diagonal of the inside, twice, and its end, a vertex by itself and one that is not used.
  const int corner = static_cast<int>(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), {{3, 0, 0}, {4, 0, 0}, {9, 9, 9}});
  for (const Vector3i& line : {Vector3i(0, 7, 7), Vector3i(7, 7, 0), Vector3i(7, 7, 7)})
    soup.triangles.push_back(line);
  soup.triangles.emplace_back(corner, corner, corner);
  soup.triangles.emplace_back(corner + 1, corner + 1, corner + 1);
  const TriangleMesh kept = build(soup);
  EXPECT_EQ(kept.report().degenerateDropped, 5);
  EXPECT_EQ(kept.triangles().size(), own + 3);
  EXPECT_EQ(kept.vertices().size(), 10u);
  EXPECT_EQ(kept.report().closedComponents, 1);
  EXPECT_EQ(kept.report().openComponents, 3);
  EXPECT_TRUE(kept.encloses({0.5, 0.4, 0.3}));
  EXPECT_FALSE(kept.encloses({3.0, 0.0, 0.0}));
  // What is in another solid is in contact, though no surfaces meet.
  const Shape around = build(test::boxSoup(Vector3d::Constant(-0.5), Vector3d::Constant(0.5)));
  EXPECT_EQ(collide(kept, around, at({3.0, 0.0, 0.0})), Contact::Touching);
  EXPECT_EQ(collide(kept, around, at({3.0, 0.0, 0.6})), Contact::Separate);
  EXPECT_EQ(build({kept.vertices(), kept.triangles()}).triangles().size(), own + 3);
}

/// Triangles by themselves, and joined ones, with corners that are equal by index or by place.
/// Two lines with an end in common have each of their edges twice, as closed surfaces do, and were
/// taken for a solid of no triangle where a mesh of two solids has covers.
TEST(LineTriangles, ThatMeetBoundNoSolid) {
  Soup soup = test::boxSoup(Vector3d::Zero(), Vector3d::Constant(0.01));
  const Soup other = soup;
  const auto count = static_cast<int>(soup.vertices.size());
  for (const Vector3d& vertex : other.vertices)
    soup.vertices.push_back(vertex + Vector3d::Constant(0.9));
  for (const Vector3i& triangle : other.triangles)
    soup.triangles.push_back(triangle + Vector3i::Constant(count));
  for (int i = 0; i < 3; ++i) soup.vertices.push_back(Vector3d::Unit(i));
  const int first = 2 * count;
  soup.triangles.push_back({first, first + 2, first + 2});
  soup.triangles.push_back({first + 1, first + 2, first + 2});
  const TriangleMesh mesh = build(soup);
  EXPECT_EQ(mesh.report().closedComponents, 2);
  EXPECT_EQ(mesh.report().openComponents, 2);
  const SphereCover cover = sphereCover(mesh, {});
  // Their middles are in the cover, too.
  for (const Vector3d& middle : {Vector3d(0.5, 0.0, 0.5), Vector3d(0.0, 0.5, 0.5)})
    EXPECT_TRUE(std::ranges::any_of(cover.nodes, [&](const SphereCover::Node& node) {
      return (node.ball.center.cast<double>() - middle).norm() <=
             static_cast<double>(node.ball.radius) + 1e-6;
    }));
}

TEST(LineTriangles, AreAsFarAsTheyAre) {
  std::mt19937 random(5);
  int lines = 0, nearest = 0, asked = 0;
  for (int i = 0; i < 300; ++i) {
    Soup soup{{{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, {{0, 1, 2}}};
    for (int k = 0; k < 6; ++k) {
      const int first = static_cast<int>(soup.vertices.size());
      for (int corner = 0; corner < 3; ++corner)
        soup.vertices.push_back(test::uniformPoint(random, 1.0));
      if (k % 2 == 0) soup.vertices[first + 1] = soup.vertices[first + (k % 4)];
      soup.triangles.emplace_back(first, first + 1, k == 1 ? first : first + 2);
      if (k == 5) soup.triangles.emplace_back(first, first + 1, first);
    }
    const TriangleMesh mesh = build(soup);
    const reference::Triangles triangles = reference::trianglesOf(soup.vertices, soup.triangles);
    for (int q = 0; q < 10; ++q) {
      const Vector3d p = test::uniformPoint(random, 2.0);
      double least = std::numeric_limits<double>::infinity(), ofLines = least;
      for (const auto& t : triangles) {
        const double away = reference::pointTriangle(p, t);
        least = std::min(least, away);
        const bool line = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        lines += line ? 1 : 0;
        if (line) ofLines = std::min(ofLines, away);
      }
      ++asked;
      nearest += ofLines == least ? 1 : 0;
      const DistanceResult found = distance(mesh, Sphere{0.0}, at(p));
      ASSERT_LE(found.lower, least + 1e-14);
      ASSERT_GE(found.upper, least - 1e-14);
      ASSERT_LE(found.upper - found.lower, 2e-9);
    }
  }
  EXPECT_GT(lines, asked);
  EXPECT_GT(nearest, asked / 5);
  EXPECT_LT(nearest, asked * 4 / 5);
}

}  // namespace
}  // namespace swept
