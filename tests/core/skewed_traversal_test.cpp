// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies, worlds and noisy clouds under poses whose linear part is not quite a rotation. Boxes
// were turned by the transpose, or by axes that were not orthonormal, and triangles by the linear
// part as it is: touching pairs were missed, and bounds were above the distance.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "all_volumes.hpp"
#include "bvh_models.hpp"
#include "mesh_samples.hpp"
#include "swept/core/broadphase/body_tree.hpp"
#include "swept/core/collision_probability.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_distance.hpp"
#include "swept/core/traversal/mesh_shape.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::modelOf;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

Isometry3d skewed(Isometry3d pose, double by, std::mt19937& random) {
  Matrix3d skew = Matrix3d::Identity();
  for (int k = 0; k < 3; ++k) skew.col(k) += by * test::uniformPoint(random, 1.0);
  pose.linear() = (pose.linear() * skew).eval();
  return pose;
}

Isometry3d straightened(Isometry3d pose) {
  const Eigen::JacobiSVD<Matrix3d> svd(pose.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  return pose;
}

/// A blob of triangles around `at`.
test::Soup blobAt(std::mt19937& random, const Vector3d& at) {
  test::Soup soup = test::blobSoup(random, 6, 8);
  for (Vector3d& v : soup.vertices) v += at;
  return soup;
}

/// Of two blobs far from their origins, the second one 1.5 m from the first.
Isometry3d poseBeside(std::mt19937& random, const Vector3d& at) {
  Isometry3d pose = test::randomPose(random, 0.0);
  pose.translation() = at + 1.5 * test::unitVector(random) - pose.linear() * at;
  return pose;
}

template <typename BV>
class SkewedTraversals : public testing::Test {};
TYPED_TEST_SUITE(SkewedTraversals, test::AllVolumes);

TYPED_TEST(SkewedTraversals, AreThoseOfTheNearestRotation) {
  std::mt19937 random(71);
  const Vector3d at(40.0, -30.0, 20.0);
  int touching = 0;
  for (int i = 0; i < 40; ++i) {
    const auto a = modelOf<TypeParam>(blobAt(random, at));
    const auto b = modelOf<TypeParam>(blobAt(random, at));
    const Isometry3d pose = skewed(poseBeside(random, at), i % 2 == 0 ? 1e-5 : 1e-4, random);
    const Isometry3d rigid = straightened(pose);
    MeshCollisionResult found, expected;
    collideMeshes(a, b, pose, {kAll}, found);
    for (int t = 0; t < static_cast<int>(a.triangles().size()); ++t) {
      for (int u = 0; u < static_cast<int>(b.triangles().size()); ++u) {
        const TriangleCorners c = b.corners(u);
        if (trianglesTouch(a.corners(t), {rigid * c[0], rigid * c[1], rigid * c[2]}))
          expected.pairs.push_back({t, u});
      }
    }
    std::sort(found.pairs.begin(), found.pairs.end());
    EXPECT_EQ(found.pairs, expected.pairs);
    touching += expected.pairs.empty() ? 0 : 1;
    const MeshDistanceResult near = meshDistance(a, b, pose), same = meshDistance(a, b, rigid);
    EXPECT_LE(near.lower, same.upper + 1e-11);
    EXPECT_GE(near.upper, same.lower - 1e-11);
    EXPECT_LE(near.upper - near.lower, 1e-9);

    const Shape box = makeBox({90.0, 70.0, 50.0});
    const MeshDistanceResult beside = meshShapeDistance(a, box, pose);
    const MeshDistanceResult exact = meshShapeDistance(a, box, rigid);
    EXPECT_LE(beside.lower, exact.upper + 1e-11);
    EXPECT_GE(beside.upper, exact.lower - 1e-11);
    EXPECT_EQ(collideMeshShape(a, box, pose).contact, collideMeshShape(a, box, rigid).contact);
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT(touching, 38);
}

TYPED_TEST(SkewedTraversals, FarFromRigidAreNotFinite) {
  std::mt19937 random(72);
  const auto a = modelOf<TypeParam>(blobAt(random, Vector3d::Zero()));
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = 100.0;
  pose.linear()(0, 1) = 0.1;
  MeshCollisionResult found;
  collideMeshes(a, a, pose, {kAll}, found);
  EXPECT_TRUE(found.touching);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(meshDistance(a, a, pose).lower, 0.0);
  EXPECT_EQ(collideMeshShape(a, makeSphere(1.0), pose).contact, Contact::Unknown);
  EXPECT_EQ(meshShapeDistance(a, makeSphere(1.0), pose).lower, 0.0);
}

/// In the world of another body, too, which is where bodies were placed with the transpose.
TEST(SkewedBodies, AreThoseOfTheNearestRotation) {
  std::mt19937 random(73);
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    // Long bodies: an angle that is off moves their ends.
    const Shape rod = makeBox({0.1, 0.1, 80.0});
    const Isometry3d body = skewed(test::randomPose(random, 10.0), 1e-5, random);
    const Isometry3d moved = skewed(test::randomPose(random, 10.0), 1e-5, random);
    const BodyTree tree({{7, rod, body}}), same({{7, rod, straightened(body)}});
    const Isometry3d rigid = straightened(moved);
    const Shape other = makeBox({8.0, 8.0, 80.0});
    const BodyTree::Nearest near = tree.nearest(other, moved), exact = same.nearest(other, rigid);
    EXPECT_LE(near.lower, exact.upper + 1e-11);
    EXPECT_GE(near.upper, exact.lower - 1e-11);
    EXPECT_EQ(tree.collides(other, moved).status, same.collides(other, rigid).status);
    touching += exact.upper == 0.0 ? 1 : 0;
    EXPECT_EQ(tree.bodies().front().world_from_body.linear(),
              BodyTree({{7, rod, tree.bodies().front().world_from_body}})
                  .bodies()
                  .front()
                  .world_from_body.linear());
  }
  EXPECT_GT(touching, 40);
  EXPECT_LT(touching, 180);
  Isometry3d sheared = Isometry3d::Identity();
  sheared.translation().x() = 100.0;
  sheared.linear()(0, 1) = 0.1;
  const BodyTree tree({{7, makeSphere(1.0), Isometry3d::Identity()}});
  EXPECT_EQ(tree.collides(makeSphere(1.0), sheared).status, Contact::Unknown);
  EXPECT_EQ(tree.nearest(makeSphere(1.0), sheared).lower, 0.0);
}

/// 40 m from the origin a skew of 1e-4 moves a point by as many millimetres as its noise has.
TEST(SkewedClouds, AreThoseOfTheNearestRotation) {
  std::mt19937 random(74);
  const Vector3d at(0.0, 0.0, 40.0);
  const auto a = NoisyPointCloud::build({{at}}, 0.01, 0.003);
  for (int i = 0; i < 20; ++i) {
    Isometry3d pose = test::randomPose(random, 0.0);
    pose.translation() = at - pose.linear() * at + 0.015 * test::unitVector(random);
    pose = skewed(pose, 1e-4, random);
    const Isometry3d rigid = straightened(pose);
    const auto b = NoisyPointCloud::build({{at}}, 0.005, 0.001);
    const CollisionProbability pair = collisionProbability(a, b, pose);
    const CollisionProbability same = collisionProbability(a, b, rigid);
    EXPECT_NEAR(pair.lower, same.lower, 1e-9);
    EXPECT_NEAR(pair.upper, same.upper, 1e-9);
    const Shape box = makeBox({0.02, 0.02, 80.01});
    const CollisionProbability beside = collisionProbability(a, box, pose);
    const CollisionProbability exact = collisionProbability(a, box, rigid);
    EXPECT_LE(beside.lower, exact.upper + 1e-9);
    EXPECT_GE(beside.upper, exact.lower - 1e-9);
  }
}

}  // namespace
}  // namespace swept
