// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TriangleMesh surface(const test::Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
}

TriangleCorners cornersOf(const TriangleMesh& mesh, std::size_t triangle) {
  const Eigen::Vector3i& t = mesh.triangles()[triangle];
  return {mesh.vertices()[t[0]], mesh.vertices()[t[1]], mesh.vertices()[t[2]]};
}

/// Over all pairs of triangles.
double leastDistance(const TriangleMesh& a, const TriangleMesh& b, const Isometry3d& a_from_b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < b.triangles().size(); ++j) {
    TriangleCorners moved = cornersOf(b, j);
    for (Vector3d& corner : moved) corner = a_from_b * corner;
    for (std::size_t i = 0; i < a.triangles().size(); ++i) {
      least = std::min(least, triangleDistance(cornersOf(a, i), moved, least).upper);
    }
  }
  return least;
}

/// Returns how many pairs the query looked at.
int compare(const TriangleMesh& a, const TriangleMesh& b, const Isometry3d& a_from_b) {
  const double expected = leastDistance(a, b, a_from_b);
  const DistanceResult found = distance(a, b, a_from_b);
  EXPECT_NEAR(found.upper, expected, 1e-12);
  EXPECT_LE(found.lower, expected + 1e-15);
  EXPECT_LE(found.upper - found.lower, tolerance::kDistance);
  // Not looked at again once it is known to be too far.
  DistanceOptions options;
  options.enough = 0.5 * expected;
  EXPECT_TRUE(expected == 0.0 || distance(a, b, a_from_b, options).lower > options.enough);
  return found.iterations;
}

/// One sphere in another: every piece of one is about as far from the other as any, more of them
/// than the search can put off, so that some are looked at out of order.
TEST(MeshDistance, HoldsWhereMorePairsAreAboutEquallyNearThanCanWait) {
  const auto sphere = [](double radius) {
    std::mt19937 same(5);
    test::Soup soup = test::blobSoup(same, 28, 28);
    for (Vector3d& p : soup.vertices) p = radius * p.normalized();
    return surface(soup);
  };
  const TriangleMesh outer = sphere(1.0), inner = sphere(0.7);
  std::mt19937 random(6);
  Isometry3d pose = test::randomPose(random, 0.0);
  pose.translation().setZero();
  EXPECT_GT(compare(outer, inner, pose), 4000);
}

TEST(MeshDistance, IsTheLeastOverAllPairsOfTriangles) {
  std::mt19937 random(7);
  int apart = 0;
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    const TriangleMesh a = surface(test::blobSoup(random, 10, 12));
    const TriangleMesh b = surface(test::torusSoup(14, 8, 1.0, 0.3));
    const Isometry3d pose = test::randomPose(random, 2.5);
    compare(a, b, pose);
    apart += distance(a, b, pose).upper > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, kRounds * 3 / 10);
  EXPECT_LT(apart, kRounds);
}

}  // namespace
}  // namespace swept
