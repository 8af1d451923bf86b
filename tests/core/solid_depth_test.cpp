// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/solid_depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "mesh_samples.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

constexpr double kHalf[3] = {0.3, 0.2, 0.5};
/// Of the extent and the distance from the middle, in 1-norms: what single precision costs in a
/// mesh's tree.
constexpr double kOfSize = 4e-6;

/// Perhaps with every side turned inside out.
TriangleMesh boxMesh(bool flipped, MeshInterior interior) {
  const Vector3d half(kHalf[0], kHalf[1], kHalf[2]);
  const test::Soup soup = test::boxSoup(-half, half);
  const test::Soup& turned = flipped ? soup.inverted() : soup;
  return TriangleMesh::build(turned.vertices, turned.triangles, interior);
}

double depthInBox(const Vector3d& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) depth = std::min(depth, kHalf[k] - std::abs(p[k]));
  return std::max(0.0, depth);
}

TEST(SolidDepth, IsTheDistanceFromTheSurfaceAndNeverMore) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> coordinate(-0.6, 0.6);
  const Shape box = Box{{kHalf[0], kHalf[1], kHalf[2]}};
  const Shape mesh = boxMesh(false, MeshInterior::Solid);
  const Shape flipped = boxMesh(true, MeshInterior::Solid);
  const Shape ball = Sphere{0.4};
  const double size = 2.0 * (kHalf[0] + kHalf[1] + kHalf[2]);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p{coordinate(engine), coordinate(engine), coordinate(engine)};
    const double expected = depthInBox(p);
    inside += expected > 0.0 ? 1 : 0;
    for (const Shape* shape : {&box, &mesh, &flipped}) {
      const double depth = solidDepth(*shape, p);
      EXPECT_LE(depth, expected + 1e-15);
      EXPECT_GE(depth, expected - (kOfSize * (size + p.lpNorm<1>()) + 1e-14));
    }
    const double inBall = std::max(0.0, 0.4 - p.norm());
    EXPECT_LE(solidDepth(ball, p), inBall + 1e-15);
    EXPECT_GE(solidDepth(ball, p), inBall - 1e-9);
  }
  EXPECT_GT(inside, 300);
  EXPECT_LT(inside, 2700);
}

TEST(SolidDepth, NothingIsInASurfaceNorWhereThereIsNoPoint) {
  const Shape surface = boxMesh(false, MeshInterior::Surface);
  const Shape mesh = boxMesh(false, MeshInterior::Solid);
  EXPECT_EQ(solidDepth(surface, Vector3d::Zero()), 0.0);
  EXPECT_GT(solidDepth(mesh, Vector3d::Zero()), 0.19);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(solidDepth(mesh, Vector3d(0.0, bad, 0.0)), 0.0);
}

}  // namespace
}  // namespace swept
