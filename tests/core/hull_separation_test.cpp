// SPDX-License-Identifier: BSD-3-Clause
// Points of moving bodies, one by one, against the bound along a direction.
#include "swept/core/hull_separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "mesh_samples.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::uniform;
using test::unitVector;

/// A body and many points of it, its outermost among them (m).
struct Sampled {
  Shape shape;
  std::vector<Vector3d> points;
};

void addAround(const Vector3d& center, double radius, std::mt19937& random,
               std::vector<Vector3d>& points) {
  for (int i = 0; i < 200; ++i) points.push_back(center + radius * unitVector(random));
}

Sampled sampled(int kind, std::mt19937& random) {
  const double a = uniform(random, 0.05, 0.3), b = uniform(random, 0.05, 0.3);
  Sampled body{Sphere{a}, {}};
  if (kind == 0) addAround(Vector3d::Zero(), a, random, body.points);
  if (kind == 1) {
    body.shape = Box{{a, b, 0.1}};
    body.points = test::boxSoup(Vector3d(-a, -b, -0.1), Vector3d(a, b, 0.1)).vertices;
  }
  if (kind == 2) {
    body.shape = Cylinder{a, b};
    for (int i = 0; i < 400; ++i) {
      const double turn = uniform(random, -3.2, 3.2);
      body.points.emplace_back(a * std::cos(turn), a * std::sin(turn), i % 2 == 0 ? b : -b);
    }
  }
  if (kind == 3) {
    body.shape = Capsule{a, b};
    for (const double z : {-b, b}) addAround({0.0, 0.0, z}, a, random, body.points);
  }
  if (kind == 4) {
    const test::Soup soup = test::torusSoup(16, 8, 0.25, 0.06);
    body.shape = TriangleMesh::build(soup.vertices, soup.triangles);
    body.points = soup.vertices;
  }
  if (kind == 5) {
    std::vector<Vector3d> centers;
    for (int i = 0; i < 30; ++i) centers.push_back(test::uniformPoint(random, 0.2));
    body.shape = PointCloud::build(centers, 0.03);
    for (const Vector3d& center : centers) addAround(center, 0.03, random, body.points);
  }
  return body;
}
constexpr int kKinds = 6;

/// m. The separation of the points along n when each has moved by s of its displacement.
double separationAt(double s, const Sampled& a, const Sampled& b, const Isometry3d& a_from_b,
                    const ApproachBound& motion, const Vector3d& n) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : a.points)
    farthest = std::max(farthest, n.dot(p + s * motion.spinA.cross(p - motion.ballA.center)));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3d& inB : b.points) {
    const Vector3d p = a_from_b * inB;
    nearest = std::min(
        nearest, n.dot(p + s * (motion.linear + motion.spinB.cross(p - motion.ballB.center))));
  }
  return nearest - farthest;
}

ApproachBound randomMotion(const Isometry3d& a_from_b, std::mt19937& random) {
  ApproachBound motion;
  motion.travel = std::numeric_limits<double>::infinity();
  motion.linear = test::uniformPoint(random, 0.1);
  motion.spinA = test::uniformPoint(random, 0.4);
  motion.spinB = test::uniformPoint(random, 0.4);
  motion.ballA = {test::uniformPoint(random, 0.1), 0.5};
  motion.ballB = {a_from_b * test::uniformPoint(random, 0.1), 0.5};
  return motion;
}

TEST(HullSeparation, NoPointComesNearerAndSomePointComesAsNear) {
  std::mt19937 random(11);
  int apart = 0, inward = 0, better = 0, cases = 0;
  for (int i = 0; i < 600; ++i) {
    const Sampled a = sampled(i % kKinds, random), b = sampled(i / kKinds % kKinds, random);
    const Isometry3d pose = test::randomPose(random, 0.8);
    const ApproachBound motion = randomMotion(pose, random);
    const Vector3d n = (pose.translation() + test::uniformPoint(random, 0.2)).normalized();
    const HullSeparation found = hullSeparation(a.shape, b.shape, pose, motion, n);
    double least = std::numeric_limits<double>::infinity();
    for (int k = -10; k <= 10; ++k) {
      const double now = separationAt(0.1 * k, a, b, pose, motion, n);
      EXPECT_LE(found.least, now + 1e-12);
      if (k == 0) {
        EXPECT_LE(found.atMiddle, now + 1e-12);
        EXPECT_GE(found.atMiddle, now - 0.02);  // samples of round bodies miss as much
      }
      least = std::min(least, now);
    }
    EXPECT_GE(found.least, least - 0.02);
    ++cases;
    apart += found.least > 0.0;
    inward += found.atMiddle > 0.0 && found.least <= 0.0;
    better += found.least > found.atMiddle + motion.required - motion.along(n);
  }
  EXPECT_GT(apart, cases / 5);
  EXPECT_GT(inward, cases / 20);
  EXPECT_GT(better, cases / 2);
}

TEST(HullSeparation, SubtractsCurvatureAndNoMoreThanTravel) {
  const Isometry3d pose(Eigen::Translation3d(1.0, 0.0, 0.0));
  ApproachBound motion;
  motion.travel = std::numeric_limits<double>::infinity();
  motion.linear = Vector3d(-0.3, 0.0, 0.0);
  motion.curvature = 0.05;
  const Vector3d n = 2.0 * Vector3d::UnitX();
  HullSeparation found = hullSeparation(Sphere{0.2}, Sphere{0.1}, pose, motion, n);
  EXPECT_NEAR(found.atMiddle, 0.7, 1e-12);
  EXPECT_NEAR(found.least, 0.35, 1e-12);
  motion.travel = 0.1;
  found = hullSeparation(Sphere{0.2}, Sphere{0.1}, pose, motion, n);
  EXPECT_NEAR(found.least, 0.6, 1e-12);
}

TEST(HullSeparation, PlanesAndHalfSpacesHaveOneDirection) {
  const Isometry3d pose = Isometry3d::Identity();
  ApproachBound motion;
  motion.travel = std::numeric_limits<double>::infinity();
  motion.linear = Vector3d(0.0, 0.0, 0.1);
  motion.spinA = Vector3d(0.2, 0.0, 0.0);
  const Box box{{0.1, 0.1, 0.1}};
  const Vector3d down(0.1, 0.0, -1.0);
  for (const bool solid : {false, true}) {
    const Shape floor =
        solid ? Shape(HalfSpace{Vector3d::UnitZ(), -0.5}) : Shape(Plane{Vector3d::UnitZ(), -0.5});
    const HullSeparation found = hullSeparation(box, floor, pose, motion, down);
    EXPECT_NEAR(found.atMiddle, 0.4, 1e-12);
    EXPECT_NEAR(found.least, 0.4 - 0.1 - 0.02, 1e-12);
    // From behind, only a plane is a boundary.
    const HullSeparation behind =
        hullSeparation(box, floor, Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0)), motion, -down);
    EXPECT_NEAR(behind.atMiddle, solid ? -0.6 : 0.4, 1e-12);
    ApproachBound turning = motion;
    turning.spinB = Vector3d(1e-3, 0.0, 0.0);
    EXPECT_EQ(hullSeparation(box, floor, pose, turning, down).least,
              -std::numeric_limits<double>::infinity());
    EXPECT_EQ(hullSeparation(floor, box, pose, motion, down).least,
              -std::numeric_limits<double>::infinity());
  }
}

}  // namespace
}  // namespace swept
