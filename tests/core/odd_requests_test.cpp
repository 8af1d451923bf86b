// SPDX-License-Identifier: BSD-3-Clause
// Counts, sizes and places that nobody asks for on purpose: an answer or a clear refusal.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/segment_query.hpp"
#include "swept/core/sensed_space.hpp"
#include "swept/core/solid_depth.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d at(const Vector3d& place) {
  return Isometry3d(Eigen::Translation3d(place));
}

BvhModel<Obb> modelOf(const test::Soup& soup, int maxLeaf = 2) {
  BvhOptions<Obb> options;
  options.maxLeaf = maxLeaf;
  BvhModel<Obb> model(options);
  model.begin();
  model.addMesh(soup.vertices, soup.triangles);
  model.end();
  return model;
}

test::Soup cube(double half) {
  return test::boxSoup(Vector3d::Constant(-half), Vector3d::Constant(half));
}

TEST(OddRequests, WithoutPairsTheAnswerIsYesOrNo) {
  const test::Soup soup = cube(0.5);
  const BvhModel<Obb> model = modelOf(soup);
  test::Soup two = soup;
  two.append(soup.moved(at({0.3, 0.2, 0.1})));
  DeformingWorkspace workspace;
  MeshCollisionResult result;
  for (const std::size_t most : {0u, 1u}) {
    for (const double x : {0.5, 2.0}) {
      collideMeshes(model, model, at({x, 0.1, 0.2}), {most}, result);
      EXPECT_EQ(result.touching, x < 1.0) << most;
      EXPECT_EQ(result.pairs.size(), x < 1.0 ? most : 0u);
    }
    for (const bool meets : {false, true}) {
      const test::Soup& own = meets ? two : soup;
      selfCollideMesh(modelOf(own), {most}, result);
      EXPECT_EQ(result.touching, meets) << most;
      EXPECT_EQ(result.pairs.size(), meets ? most : 0u);
      selfCollide(DeformingMesh::build(own.vertices, own.triangles), {most}, result, workspace);
      EXPECT_EQ(result.touching, meets) << most;
      EXPECT_EQ(result.pairs.size(), meets ? most : 0u);
    }
  }
}

TEST(OddRequests, LeavesHoldAtLeastOnePrimitive) {
  for (const int maxLeaf : {0, -1}) {
    try {
      modelOf(cube(1.0), maxLeaf);
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                "BvTree: maxLeaf is " + std::to_string(maxLeaf) + "; allowed: at least 1");
    }
  }
}

TEST(OddRequests, WhatWasMovedFromIsGivenAStateAgain) {
  SweepAndPrune first;
  const BoxHandle a = first.registerBox({Vector3d::Zero(), Vector3d::Ones()});
  SweepAndPrune second = std::move(first);
  const BoxHandle b = second.registerBox({Vector3d::Zero(), Vector3d::Ones()});
  first = second;
  int pairs = 0;
  first.collide([&](BoxHandle one, BoxHandle other) {
    EXPECT_EQ(std::minmax(one, other), std::minmax(a, b));
    ++pairs;
    return false;
  });
  EXPECT_EQ(pairs, 1);
}

TEST(OddRequests, OccludedSpaceOfTinyPointsIsRefused) {
  for (const double radius : {1e-13, 1e-8}) {
    const std::vector<Vector3d> points(20, Vector3d::UnitX());
    try {
      static_cast<void>(occludedBalls(points, radius, Vector3d::Zero(), 2.0));
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()),
                std::string("the occluded space of points of radius ") +
                    (radius < 1e-10 ? "1e-13" : "1e-08") +
                    " up to a range of 2 takes more than 10000000 balls; a larger radius takes "
                    "fewer");
    }
  }
}

/// Squares of these do not fit a double.
TEST(OddRequests, NoDepthIsProvenOfMeshesOfHugeSize) {
  for (const double half : {1e150, 1e154, 1e200}) {
    const test::Soup soup = cube(half);
    const double depth =
        solidDepth(TriangleMesh::build(soup.vertices, soup.triangles), Vector3d::Zero());
    EXPECT_LE(depth, half);
    EXPECT_GE(depth, half < 1e152 ? 0.99 * half : 0.0);
  }
}

/// Doubles are farther apart out there than libccd's accuracy.
TEST(OddRequests, LibccdEndsFarOut) {
  DistanceOptions options;
  options.backend = Backend::Libccd;
  for (const double x : {1e9, 1e11, 1e15})
    EXPECT_NEAR(distance(Sphere{1.0}, Sphere{1.0}, at({x, 0, 0}), options).upper, x - 2.0,
                1e-3 + 1e-12 * x);
}

TEST(OddRequests, HullsThatLeaveOutVerticesTouchWhereTheyDo) {
  std::mt19937 random(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i) points.push_back(test::unitVector(random));
  const ConvexHull full = ConvexHull::of(points), coarse = ConvexHull::coarser(full);
  ASSERT_GT(coarse.error(), 0.01);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const Isometry3d pose = at((2.0 + 1e-4 * i) * test::unitVector(random));
    const DistanceResult truth = distance(full, full, pose);
    const DistanceResult found = distance(coarse, coarse, pose);
    EXPECT_LE(found.lower, truth.upper);
    EXPECT_GE(found.upper, truth.lower);
    if (!(truth.lower > 0.0)) continue;
    ++apart;
    EXPECT_NE(collide(coarse, coarse, pose), Contact::Touching) << i;
    EXPECT_GT(found.upper, 0.0) << i;
  }
  EXPECT_GT(apart, 100);
}

TEST(OddRequests, WhatIsProvenUpToEnoughIsNoMoreThanTheTruth) {
  std::mt19937 random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d point = test::uniformPoint(random, 1.0), q = test::uniformPoint(random, 1.0);
    const PointCloud cloud = PointCloud::build(std::vector<Vector3d>{point}, 0.0);
    const auto square = [](long double x) { return x * x; };
    const long double truth = std::sqrt(square(static_cast<long double>(q.x()) - point.x()) +
                                        square(static_cast<long double>(q.y()) - point.y()) +
                                        square(static_cast<long double>(q.z()) - point.z()));
    const double enough = (q - point).norm();
    const double found = clearance(cloud, q, enough);
    EXPECT_LE(static_cast<long double>(found), truth);
    EXPECT_GE(found, enough - 1e-13);
    EXPECT_EQ(clearance(cloud, q, 0.5 * enough), 0.5 * enough);
  }
}

TEST(OddRequests, NothingIsFartherThanANegativeRadiusFromNowhere) {
  const test::Soup soup = cube(1.0);
  const ClearanceGrid grid =
      ClearanceGrid::build(TriangleMesh::build(soup.vertices, soup.triangles));
  for (const double x : {0.0, 1.0, 5.0, 1e200})
    EXPECT_TRUE(grid.isFarther({x, 0.0, 0.0}, -1.0)) << x;
  EXPECT_FALSE(grid.isFarther({NAN, 0.0, 0.0}, -1.0));
  EXPECT_FALSE(grid.isFarther({INFINITY, 0.0, 0.0}, -1.0));
  EXPECT_FALSE(grid.isFarther({5.0, 0.0, 0.0}, NAN));
}

TEST(OddRequests, GridsFarOutAreBuilt) {
  for (const double far : {1e6, 1e9, 1e12}) {
    const Vector3d low(far, far, far), high = low + Vector3d(2.0, 2.0, 0.0);
    test::Soup soup = test::boxSoup(low, {high.x(), high.y(), std::nextafter(far, 2.0 * far)});
    const TriangleMesh slab = TriangleMesh::build(soup.vertices, soup.triangles);
    const ClearanceGrid grid = ClearanceGrid::build(slab);
    EXPECT_EQ(grid.clearance(low), 0.0);
    const Vector3d above = high + Vector3d(0.0, 0.0, 1e-5 * far);
    EXPECT_LE(grid.clearance(above), 1e-5 * far);
    EXPECT_GT(grid.clearance(above), 0.5e-5 * far);
  }
}

/// Columns of a rotation that is orthonormal to 1e-14 may be longer than one.
TEST(OddRequests, BoundsAlongEdgesHoldForRotationsThatAreNotQuiteSuch) {
  const double angle = 1.02e-3;
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix();
  pose.linear().array() += 0.5e-14;
  pose.translation() = Vector3d(0.0, 1.0, 0.0);
  // A segment: with another one it has its middle nearest, 1 m away.
  const Obb segment{Eigen::Matrix3d::Identity(), Vector3d::Zero(), Vector3d(0.0, 0.0, 1.0)};
  EXPECT_LE(segment.distanceBound(segment, pose), 1.0 + 1e-12);
  EXPECT_GE(segment.distanceBound(segment, pose), 1.0 - 1e-9);
}

}  // namespace
}  // namespace swept
