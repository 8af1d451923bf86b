// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "heap_counter.hpp"
#include "mesh_samples.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

std::vector<Shape> everyKind() {
  std::mt19937 random(1);
  const test::Soup blob = test::blobSoup(random, 10, 12);
  std::vector<Vector3d> points;
  for (int i = 0; i < 40; ++i) points.push_back(0.5 * test::unitVector(random));
  return {makeSphere(0.4),
          makeBox({0.5, 0.6, 0.7}),
          makeCylinder(0.3, 0.8),
          makeCapsule(0.2, 0.7),
          makeCone(0.4, 0.9),
          makeEllipsoid({0.3, 0.4, 0.6}),
          ConvexHull::of(points),
          makeTriangle({0, 0, 0}, {0.6, 0, 0}, {0, 0.7, 0.2}),
          makePlane(Vector3d::UnitZ(), 0.1),
          makeHalfSpace(Vector3d::UnitX(), -0.2),
          TriangleMesh::build(blob.vertices, blob.triangles),
          PointCloud::build(points, 0.05)};
}

TEST(Queries, AllocateNothing) {
  std::mt19937 random(2);
  const std::vector<Shape> shapes = everyKind();
  ASSERT_EQ(shapes.size(), std::variant_size_v<Shape>);
  std::vector<ContactPoint> contacts;
  contacts.reserve(1 << 16);
  SeparationQuery query;
  query.approach.travel = 0.05;
  const long before = test::allocations;
  int touching = 0, total = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      for (int round = 0; round < 6; ++round) {
        const Eigen::Isometry3d pose = test::randomPose(random, 0.8);
        const DistanceResult found = distance(shapes[i], shapes[j], pose);
        touching += found.upper <= 0.0 ? 1 : 0;
        ++total;
        collide(shapes[i], shapes[j], pose);
        signedDistance(shapes[i], shapes[j], pose);
        separate(shapes[i], shapes[j], pose, query);
        contacts.clear();
        findContacts(shapes[i], shapes[j], pose, contacts.capacity(), contacts);
      }
      ASSERT_EQ(test::allocations, before) << "kinds " << i << " and " << j;
    }
  }
  EXPECT_GT(touching, total / 5);
  EXPECT_LT(touching, total * 9 / 10);
}

/// Once its memory has grown to what it is used for.
TEST(ContinuousCollide, AllocatesNothingTheSecondTime) {
  const std::vector<Shape> shapes = everyKind();
  ContinuousWorkspace workspace;
  ContinuousOptions options;
  options.tolerance = 1e-5;
  int hits = 0, total = 0;
  const auto round = [&] {
    std::mt19937 random(3);
    hits = total = 0;
    for (const Shape& a : shapes) {
      for (const Shape& b : shapes) {
        const auto motion = [&] {
          const Eigen::Isometry3d start = test::randomPose(random, 1.5);
          return UniformMotion::turning(start, 2.0 * test::unitVector(random),
                                        -1.5 * start.translation());
        };
        const UniformMotion first = motion(), second = motion();
        const ContinuousResult found = continuousCollide(a, first, b, second, options, workspace);
        hits += found.verdict == Verdict::Collision && found.contactBy > 0.0 ? 1 : 0;
        ++total;
      }
    }
  };
  round();
  const long before = test::allocations;
  round();
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(hits, total / 5);
}

}  // namespace
}  // namespace swept
