// SPDX-License-Identifier: BSD-3-Clause
// Clouds beside and within a solid that their balls do not touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

constexpr double kMajor = 0.5, kMinor = 0.15, kBall = 0.001;

/// m, of a point from the surface of the torus; negative within it.
double depthOf(const Vector3d& point) {
  return std::hypot(std::hypot(point.x(), point.y()) - kMajor, point.z()) - kMinor;
}

/// Near the solid, and at least 2 cm from its surface: its facets are within 3 mm of the torus.
Vector3d pointOn(bool inside, std::mt19937& random) {
  for (;;) {
    const Vector3d point = test::uniformPoint(random, 0.8);
    const double depth = depthOf(point);
    if (inside ? depth < -0.02 : depth > 0.02) return point;
  }
}

Shape torus() {
  const test::Soup soup = test::torusSoup(48, 24, kMajor, kMinor);
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid);
}

/// Clouds of `outside` points beside the solid and `inside` points within it, at random poses.
void expectFound(const Shape& solid, int outside, int inside, std::mt19937& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < outside; ++i) points.push_back(pointOn(false, random));
  for (int i = 0; i < inside; ++i) points.push_back(pointOn(true, random));
  std::ranges::shuffle(points, random);
  Eigen::Isometry3d solid_from_cloud = Eigen::Isometry3d::Identity();
  solid_from_cloud.translation() = test::uniformPoint(random, 2.0);
  solid_from_cloud.linear() = Eigen::AngleAxisd(test::uniformPoint(random, 3.0).x(),
                                                test::uniformPoint(random, 1.0).normalized())
                                  .toRotationMatrix();
  double nearest = std::numeric_limits<double>::infinity();
  for (Vector3d& point : points) {
    nearest = std::min(nearest, depthOf(point));
    point = solid_from_cloud.inverse() * point;
  }
  const Shape cloud = PointCloud::build(points, kBall);
  const DistanceResult found = distance(solid, cloud, solid_from_cloud);
  const DistanceResult turned = distance(cloud, solid, solid_from_cloud.inverse());
  if (inside > 0) {
    EXPECT_EQ(found.upper, 0.0) << outside << " and " << inside;
    EXPECT_EQ(turned.upper, 0.0) << outside << " and " << inside;
    EXPECT_LT(depthOf(found.pointA), -0.01);
  } else {
    EXPECT_GE(found.lower, nearest - kBall - 0.003);
    EXPECT_LE(found.upper, nearest - kBall + 0.003);
    EXPECT_NEAR(turned.lower, found.lower, 1e-5);
  }
}

TEST(CloudEnclosure, OnePointAmongManyIsFound) {
  const Shape solid = torus();
  std::mt19937 random(1);
  for (const int outside : {0, 1, 7, 8, 9, 100, 1000, 20000})
    for (const int inside : {0, 1, 2, 30})
      for (int turn = 0; turn < 4; ++turn)
        if (outside + inside > 0) expectFound(solid, outside, inside, random);
}

TEST(CloudEnclosure, ManyPointsWithinAreFound) {
  const Shape solid = torus();
  std::mt19937 random(2);
  for (const int outside : {0, 1, 20000})
    for (const int inside : {1000, 20000}) expectFound(solid, outside, inside, random);
}

/// The hole of a torus and what is around it are not within it, however near the points are to
/// each other.
TEST(CloudEnclosure, WhatIsAroundIsNotWithin) {
  const Shape solid = torus();
  std::vector<Vector3d> points;
  for (double x = -0.8; x <= 0.8; x += 0.02)
    for (double y = -0.8; y <= 0.8; y += 0.02)
      for (double z = -0.3; z <= 0.3; z += 0.02)
        if (const Vector3d point(x, y, z); depthOf(point) > 0.005) points.push_back(point);
  const Shape cloud = PointCloud::build(points, kBall);
  EXPECT_GT(distance(solid, cloud, Eigen::Isometry3d::Identity()).lower, 0.003);
}

}  // namespace
}  // namespace swept
