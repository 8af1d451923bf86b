// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using test::Soup;

TriangleMesh solid(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TriangleMesh boxMesh(const Vector3d& half) {
  return solid(test::boxSoup(-half, half));
}

/// Moving b out by -lower along the normal ends the overlap, and no shorter translation that was
/// tried does.
void expectHonest(const Shape& a, const Shape& b, const Isometry3d& pose, std::mt19937& random) {
  const SignedDistanceResult found = signedDistance(a, b, pose);
  ASSERT_LE(found.lower, found.upper);
  ASSERT_LT(found.upper, 1e-12);
  Isometry3d moved = pose;
  moved.translation() += (-found.lower + 1e-9) * found.normal;
  EXPECT_NE(collide(a, b, moved), Contact::Touching);
  for (int i = 0; i < 40; ++i) {
    moved = pose;
    moved.translation() += -found.upper * 0.999 * test::unitVector(random);
    EXPECT_NE(collide(a, b, moved), Contact::Separate) << "the depth is less than claimed";
  }
}

TEST(MeshDepth, OfConvexSolidsIsTheTrueOne) {
  std::mt19937 random(1);
  int overlapping = 0;
  for (int round = 0; round < 200; ++round) {
    const Vector3d halfA = Vector3d::Constant(0.6) + test::uniformPoint(random, 0.4);
    const Vector3d halfB = Vector3d::Constant(0.6) + test::uniformPoint(random, 0.4);
    const Isometry3d pose = test::randomPose(random, 1.2);
    const SignedDistanceResult boxes = signedDistance(Box{halfA}, Box{halfB}, pose);
    const std::array<SignedDistanceResult, 3> meshes{
        signedDistance(boxMesh(halfA), boxMesh(halfB), pose),
        signedDistance(boxMesh(halfA), Box{halfB}, pose),
        signedDistance(Box{halfA}, boxMesh(halfB), pose)};
    for (const SignedDistanceResult& found : meshes) {
      EXPECT_NEAR(found.lower, boxes.lower, 1e-8);
      EXPECT_NEAR(found.upper, boxes.upper, 1e-8);
    }
    overlapping += boxes.upper < 0.0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 60);
  EXPECT_LT(overlapping, 180);
}

TEST(MeshDepth, KnowsWhichComponentsAreConvexSolids) {
  EXPECT_EQ(boxMesh({1, 2, 3}).convexParts().size(), 1u);
  EXPECT_EQ(solid(test::torusSoup(12, 8, 1.0, 0.3)).convexParts().size(), 0u);
  EXPECT_EQ(solid(test::boxSoup({0, 0, 0}, {1, 1, 1}).inverted()).convexParts().size(), 1u);
  const Soup box = test::boxSoup({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(TriangleMesh::build(box.vertices, box.triangles, MeshInterior::Surface)
                  .convexParts()
                  .empty());
  Soup two = box;
  two.append(test::boxSoup({3, 0, 0}, {4, 1, 1}));
  EXPECT_EQ(solid(two).convexParts().size(), 2u);
  // A dent of a micrometre in a face that is split in the middle.
  Soup dented = box;
  const int tip = static_cast<int>(dented.vertices.size());
  std::size_t top = 0;
  while (!(dented.vertices[dented.triangles[top][0]].z() == 1.0 &&
           dented.vertices[dented.triangles[top][1]].z() == 1.0 &&
           dented.vertices[dented.triangles[top][2]].z() == 1.0)) {
    ++top;
  }
  const Eigen::Vector3i face = dented.triangles[top];
  Vector3d middle = Vector3d::Zero();
  for (const int corner : face) middle += dented.vertices[corner] / 3.0;
  dented.vertices.push_back(middle - 1e-6 * Vector3d::UnitZ());
  dented.triangles[top] = {face[0], face[1], tip};
  dented.triangles.emplace_back(face[1], face[2], tip);
  dented.triangles.emplace_back(face[2], face[0], tip);
  EXPECT_EQ(solid(dented).report().closedComponents, 1);
  EXPECT_EQ(solid(dented).convexParts().size(), 0u);
  // Walls of no thickness, each written twice, are closed but enclose nothing.
  Soup walls = box;
  walls.triangles.resize(10);
  walls.append(Soup{walls.vertices, walls.triangles}.inverted());
  EXPECT_TRUE(solid(walls).convexParts().empty());
}

TEST(MeshDepth, IsBoundedOnBothSidesForAnyMesh) {
  std::mt19937 random(2);
  int rounds = 0, deep = 0;
  for (int round = 0; rounds < 60 && round < 400; ++round) {
    const TriangleMesh blob = solid(test::blobSoup(random, 8, 10));
    const TriangleMesh torus = solid(test::torusSoup(12, 8, 0.8, 0.3));
    const std::array<Shape, 5> others{torus, boxMesh({0.3, 0.4, 0.5}), makeSphere(0.4),
                                      makeCapsule(0.2, 0.6), makeCylinder(0.3, 0.5)};
    const Shape& other = others[round % others.size()];
    const Isometry3d pose = test::randomPose(random, 1.0);
    if (collide(blob, other, pose) != Contact::Touching) continue;
    ++rounds;
    expectHonest(blob, other, pose, random);
    expectHonest(other, blob, pose.inverse(), random);
    deep += signedDistance(blob, other, pose).upper < -0.05 ? 1 : 0;
  }
  EXPECT_EQ(rounds, 60);
  EXPECT_GT(deep, 20) << "depths are seldom proven";
}

TEST(MeshDepth, OfABallInASolidIsExactNearItsFace) {
  const Shape block = solid(test::torusSoup(64, 32, 2.0, 1.0));  // thick ring, not convex
  const double top = 1.0;
  for (const double height : {0.9, 0.5, 1.2}) {
    const Isometry3d pose(Translation3d(2.0, 0.0, height));
    const SignedDistanceResult found = signedDistance(block, makeSphere(0.3), pose);
    EXPECT_LE(-found.upper, 0.3 + top - height + 1e-9);
    EXPECT_GT(-found.upper, 0.95 * (0.3 + top - height));
    EXPECT_LE(found.lower, found.upper);
  }
}

TEST(MeshDepth, InAHalfSpaceIsThatOfTheDeepestPoint) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const TriangleMesh mesh = solid(test::blobSoup(random, 8, 10));
    const Isometry3d pose = test::randomPose(random, 0.8);
    double deepest = std::numeric_limits<double>::infinity();
    for (const Vector3d& p : mesh.vertices()) deepest = std::min(deepest, (pose * p).z() - 0.1);
    const Shape floor = makeHalfSpace(Vector3d::UnitZ(), 0.1);
    const SignedDistanceResult found = signedDistance(floor, mesh, pose);
    EXPECT_NEAR(found.lower, deepest, 1e-9);
    EXPECT_NEAR(found.upper, deepest, 1e-9);
    const SignedDistanceResult swapped = signedDistance(mesh, floor, pose.inverse());
    EXPECT_NEAR(swapped.lower, deepest, 1e-9);
    EXPECT_NEAR(swapped.upper, deepest, 1e-9);
  }
}

TEST(MeshDepth, OfASurfaceIsNotClaimed) {
  const Soup soup = test::boxSoup({-1, -1, -1}, {1, 1, 1});
  const Shape surface = TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
  const Isometry3d pose(Translation3d(0.9, 0.0, 0.0));
  const SignedDistanceResult found = signedDistance(surface, surface, pose);
  EXPECT_EQ(found.upper, 0.0);
  EXPECT_NEAR(found.lower, -1.1, 1e-9);
}

}  // namespace
}  // namespace swept
