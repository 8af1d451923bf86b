// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/shapes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesh_samples.hpp"
#include "message_of.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::messageOf;

TEST(ShapesErrors, NameTheValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(messageOf([] { makeSphere(-0.5); }),
            "sphere radius is -0.5; allowed: finite and not negative");
  EXPECT_EQ(messageOf([=] { makeSphere(nan); }),
            "sphere radius is nan; allowed: finite and not negative");
  EXPECT_EQ(messageOf([] {
              makeBox({1, -2, 3});
            }),
            "box size y is -2; allowed: finite and not negative");
  EXPECT_EQ(messageOf([=] {
              makeBox({1, 2, infinity});
            }),
            "box size z is inf; allowed: finite and not negative");
  EXPECT_EQ(messageOf([] { makeCylinder(-1, 1); }),
            "cylinder radius is -1; allowed: finite and not negative");
  EXPECT_EQ(messageOf([=] { makeCylinder(1, nan); }),
            "cylinder length is nan; allowed: finite and not negative");
  EXPECT_EQ(messageOf([=] { makeCapsule(-infinity, 1); }),
            "capsule radius is -inf; allowed: finite and not negative");
  EXPECT_EQ(messageOf([] { makeCapsule(1, -1e-300); }),
            "capsule length is -1e-300; allowed: finite and not negative");
  EXPECT_EQ(messageOf([] { makeSphere(0.0); }), "");
}

TEST(ShapesErrors, SayWhichNormalsMakeAPlane) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string numbers = "; allowed: finite numbers, a normal that is not zero";
  EXPECT_EQ(messageOf([=] {
              makePlane({0, nan, 1}, 0.5);
            }),
            "plane has normal (0, nan, 1) and offset 0.5" + numbers);
  EXPECT_EQ(messageOf([] {
              makeHalfSpace({0, 0, 0}, 0.5);
            }),
            "half-space has normal (0, 0, 0) and offset 0.5" + numbers);
  // Not zero, and yet of no use.
  const std::string range =
      ", of a length from 2.22507e-308 to 1.79769e+308 by which the offset can be divided";
  EXPECT_EQ(messageOf([] {
              makePlane({0, 1e-310, 0}, 0);
            }),
            "plane has normal (0, 1e-310, 0) and offset 0" + numbers + range);
  EXPECT_EQ(messageOf([] {
              makePlane({1.5e308, 1.5e308, 0}, 0);
            }),
            "plane has normal (1.5e+308, 1.5e+308, 0) and offset 0" + numbers + range);
  EXPECT_EQ(messageOf([] {
              makePlane({0, 0, 1e-10}, 1e300);
            }),
            "plane has normal (0, 0, 1e-10) and offset 1e+300" + numbers + range);
  EXPECT_EQ(messageOf([=] {
              makeTriangle({0, 0, 0}, {1, nan, 0}, {0, 1, 0});
            }),
            "triangle corner 1 is (1, nan, 0); allowed: finite coordinates");
}

TEST(Shapes, HalveFullSizes) {
  EXPECT_EQ(makeBox({1, 2, 3}).halfExtents, Vector3d(0.5, 1.0, 1.5));
  EXPECT_EQ(makeCylinder(0.3, 2.0).halfLength, 1.0);
  EXPECT_EQ(makeCapsule(0.3, 2.0).halfLength, 1.0);
}

/// Points of the boundary, extreme ones among them.
std::vector<Vector3d> boundaryOf(const Shape& shape, std::mt19937& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i) {
    const double angle = test::uniform(random, 0.0, 2.0 * std::numbers::pi);
    const Vector3d round(std::cos(angle), std::sin(angle), 0.0);
    const Vector3d end = i % 2 == 0 ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitZ());
    const Vector3d unit = i < 4 ? end : test::unitVector(random);
    if (const auto* sphere = std::get_if<Sphere>(&shape)) points.push_back(sphere->radius * unit);
    if (const auto* box = std::get_if<Box>(&shape)) {
      points.push_back(unit.cwiseSign().cwiseProduct(box->halfExtents));
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      points.push_back(cylinder->radius * round + cylinder->halfLength * end);
    }
    if (const auto* capsule = std::get_if<Capsule>(&shape)) {
      const Vector3d cap = unit.z() < 0.0 ? Vector3d(-Vector3d::UnitZ()) : Vector3d::UnitZ();
      points.push_back(capsule->radius * unit + capsule->halfLength * cap);
    }
  }
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return hull->vertices();
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->vertices();
  return points;
}

std::vector<Shape> sampleShapes() {
  std::mt19937 random(41);
  std::vector<Vector3d> cloud;
  for (int i = 0; i < 300; ++i)
    cloud.push_back(test::uniformPoint(random, 0.4) + Vector3d(1, 2, 3));
  const test::Soup blob = test::blobSoup(random, 9, 10).moved(test::randomPose(random, 1.0));
  return {makeSphere(0.3),        makeBox({0.2, 0.4, 1.7}),
          makeCylinder(0.3, 1.1), makeCapsule(0.3, 1.1),
          ConvexHull::of(cloud),  TriangleMesh::build(blob.vertices, blob.triangles)};
}

TEST(BoundingVolumes, ContainTheShapeAndAreTight) {
  std::mt19937 random(42);
  for (const Shape& shape : sampleShapes()) {
    SCOPED_TRACE(shape.index());
    const BoundingSphere ball = boundingSphere(shape);
    const Aabb box = boundingBox(shape);
    double farthest = 0.0;
    Aabb seen{Vector3d::Constant(1e9), Vector3d::Constant(-1e9)};
    for (const Vector3d& p : boundaryOf(shape, random)) {
      farthest = std::max(farthest, (p - ball.center).norm());
      seen.lower = seen.lower.cwiseMin(p);
      seen.upper = seen.upper.cwiseMax(p);
    }
    const double rounding = 1e-15;  // of the sampled points, not of the bounds
    EXPECT_LE(farthest, ball.radius + rounding);
    EXPECT_GE(farthest, 0.999 * ball.radius);
    EXPECT_TRUE((seen.lower.array() >= box.lower.array() - rounding).all());
    EXPECT_TRUE((seen.upper.array() <= box.upper.array() + rounding).all());
    EXPECT_LT((seen.lower - box.lower).maxCoeff(), 0.02);
    EXPECT_LT((box.upper - seen.upper).maxCoeff(), 0.02);
  }
}

TEST(BoundingVolumes, SphereOfPointsIsNearlySmallest) {
  // A ball through two opposite points, or three of a great circle, cannot be made smaller.
  std::mt19937 random(43);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d pose = test::randomPose(random, 2.0);
    std::vector<Vector3d> points;
    for (double angle : {0.3, 2.2, 4.5}) {
      points.push_back(pose * Vector3d(std::cos(angle), std::sin(angle), 0.0));
    }
    for (int i = 0; i < 200; ++i) {
      const double reach = std::cbrt(test::uniform(random, 0, 0.8));
      points.push_back(pose * Vector3d(reach * test::unitVector(random)));
    }
    const BoundingSphere ball = boundingSphere(ConvexHull::of(points));
    EXPECT_GE(ball.radius, 1.0);
    EXPECT_LE(ball.radius, 1.02);
  }
}

TEST(BoundingVolumes, RoundOutward) {
  const BoundingSphere ball = boundingSphere(makeBox({2.0, 2.0, 2.0}));
  EXPECT_GT(ball.radius * ball.radius, 3.0);
  EXPECT_LT(ball.radius, std::sqrt(3.0) * (1.0 + 1e-14));
  // Squares of such sizes underflow.
  EXPECT_GE(boundingSphere(makeCylinder(3e-200, 8e-200)).radius, 5e-200);
  EXPECT_GE(boundingSphere(makeBox({2e-310, 0, 0})).radius, 1e-310);
  EXPECT_EQ(boundingSphere(makeSphere(0.1)).radius, 0.1);
}

TEST(BoundingVolumes, CountTheErrorOfAHull) {
  std::mt19937 random(44);
  std::vector<Vector3d> points;
  for (int i = 0; i < 2000; ++i) points.push_back(test::uniformPoint(random, 1.0));
  const ConvexHull hull = ConvexHull::of(points);
  ASSERT_GT(hull.error(), 0.0);
  ASSERT_LT(hull.vertices().size(), points.size());
  const Aabb box = boundingBox(hull);
  const BoundingSphere ball = boundingSphere(hull);
  for (const Vector3d& v : hull.vertices()) {
    EXPECT_TRUE((v.array() - hull.error() >= box.lower.array()).all());
    EXPECT_TRUE((v.array() + hull.error() <= box.upper.array()).all());
    EXPECT_LE((v - ball.center).norm() + hull.error(), ball.radius * (1.0 + 1e-15));
  }
}

}  // namespace
}  // namespace swept
