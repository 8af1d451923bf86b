// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/shapes.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

std::vector<Shape> everyBoundedKind() {
  std::mt19937 random(3);
  const test::Soup blob = test::blobSoup(random, 10, 12);
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i)
    points.push_back(Vector3d(0.3, 0.1, -0.2) + 0.5 * test::unitVector(random));
  std::vector<double> radii;
  for (std::size_t i = 0; i < points.size(); ++i)
    radii.push_back(0.01 * static_cast<double>(i % 7));
  return {makeSphere(0.4),
          makeBox({0.5, 0.6, 0.7}),
          makeCylinder(0.3, 0.8),
          makeCapsule(0.2, 0.7),
          makeCone(0.3, 0.9),
          makeEllipsoid({0.2, 0.4, 0.6}),
          ConvexHull::of(points),
          makeTriangle({0, 0, 0}, {0.5, 0.1, 0}, {0.2, 0.6, 0.3}),
          TriangleMesh::build(blob.vertices, blob.triangles),
          PointCloud::build(points, radii)};
}

double distanceTo(const Shape& shape, const Vector3d& point) {
  return distance(Sphere{0.0}, shape, Eigen::Isometry3d(Eigen::Translation3d(-point))).upper;
}

TEST(Scaled, DistancesGrowByTheFactorAroundTheMiddleOfTheBox) {
  std::mt19937 random(5);
  for (const Shape& shape : everyBoundedKind()) {
    const Aabb box = boundingBox(shape);
    const Vector3d middle = 0.5 * (box.lower + box.upper);
    int apart = 0;
    for (const double factor : {0.25, 1.0, 1.7, 30.0}) {
      const Shape larger = scaled(shape, factor);
      EXPECT_EQ(larger.index(), shape.index());
      for (int i = 0; i < 40; ++i) {
        const Vector3d point = middle + 0.9 * test::unitVector(random);
        const double before = distanceTo(shape, point);
        const double after = distanceTo(larger, middle + factor * (point - middle));
        EXPECT_NEAR(after, factor * before, 1e-6 * factor) << "kind " << shape.index();
        apart += before > 0.01 ? 1 : 0;
      }
    }
    EXPECT_GT(apart, 100) << "kind " << shape.index();
  }
}

TEST(Scaled, KeepsWhatAMeshMeansAndWhatAHullMayBeOffBy) {
  std::mt19937 random(7);
  const test::Soup blob = test::blobSoup(random, 8, 10);
  const auto mesh = TriangleMesh::build(blob.vertices, blob.triangles, MeshInterior::Surface);
  EXPECT_EQ(std::get<TriangleMesh>(scaled(mesh, 2.0)).interior(), MeshInterior::Surface);
  std::vector<Vector3d> ball;
  for (int i = 0; i < 4000; ++i) ball.push_back(test::unitVector(random));
  const ConvexHull coarse = ConvexHull::coarser(ConvexHull::of(ball));
  ASSERT_GT(coarse.error(), 1e-4);
  EXPECT_GE(std::get<ConvexHull>(scaled(coarse, 3.0)).error(), 3.0 * coarse.error());
}

TEST(Scaled, WhatHasNoEndStaysAsItIs) {
  const HalfSpace space = makeHalfSpace({0, 0, 1}, 0.3);
  EXPECT_EQ(std::get<HalfSpace>(scaled(space, 5.0)).offset, space.offset);
  EXPECT_EQ(std::get<Plane>(scaled(makePlane({0, 0, 1}, 0.3), 5.0)).offset, 0.3);
}

TEST(Scaled, ImpossibleFactorsAreErrors) {
  const std::pair<double, std::string> cases[] = {
      {0.0, "0"}, {-1.0, "-1"}, {-1e-9, "-1e-09"}, {std::nan(""), "nan"}, {HUGE_VAL, "inf"}};
  for (const auto& [bad, text] : cases) {
    try {
      (void)scaled(makeSphere(1.0), bad);
      ADD_FAILURE() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()),
                "scaled: the factor is " + text + "; allowed: finite and above zero");
    }
  }
}

}  // namespace
}  // namespace swept
