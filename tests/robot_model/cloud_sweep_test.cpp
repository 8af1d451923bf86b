// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../core/mesh_samples.hpp"
#include "certify/pair_query.hpp"
#include "model_robots.hpp"
#include "swept/core/cloud_parts.hpp"
#include "swept/core/distance.hpp"
#include "version_arms.hpp"

/// PairQuery::staysApartFrom(), what it rests on, and motions among clouds, beside every ball.
namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::uniform;

double toSegment(const LineSegment& segment, const Vector3d& p) {
  const Vector3d y = segment.center - p;
  const double squared = segment.half.squaredNorm();
  const double s = squared > 0.0 ? std::clamp(-y.dot(segment.half) / squared, -1.0, 1.0) : 0.0;
  return (y + s * segment.half).norm();
}

/// Flat and bent patches of very different density, far from the origin of the first.
std::vector<Vector3d> patches(std::mt19937& random, int count) {
  std::vector<Vector3d> points;
  for (int patch = 0; patch < 8; ++patch) {
    const Isometry3d pose = test::randomPose(random, 0.7);
    const double size = std::pow(10.0, uniform(random, -2.0, -0.3));
    for (int i = 0; i < count / 8; ++i) {
      const Vector3d at = test::uniformPoint(random, size);
      points.push_back(pose * Vector3d(at.x(), at.y(), at.x() * at.x()));
    }
  }
  return points;
}

/// Every ball that is near enough is in a part.
TEST(CloudParts, ContainTheBallsNearASegment) {
  std::mt19937 random(1);
  int near = 0, far = 0, deep = 0;
  for (const double offset : {0.0, 1e4}) {
    std::vector<Vector3d> points = patches(random, 900);
    for (Vector3d& point : points) point.x() += offset;
    std::vector<double> radii;
    for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(uniform(random, 0.0, 0.01));
    const PointCloud cloud = PointCloud::build(points, radii);
    for (int i = 0; i < 60; ++i) {
      const LineSegment segment{points[random() % points.size()] + test::uniformPoint(random, 0.05),
                                test::uniformPoint(random, 0.1)};
      const double radius = uniform(random, 0.0, 0.1);
      std::vector<detail::CloudPart> open, found;
      detail::addPartsNear(cloud, 0, segment, radius, open);
      std::vector<detail::CloudPart> balls;
      while (!open.empty()) {
        const detail::CloudPart part = open.back();
        open.pop_back();
        if (part.isBall()) {
          balls.push_back(part);
          continue;
        }
        found.clear();
        detail::addPartsNear(cloud, part.node, segment, radius, found);
        ++deep;
        for (const detail::CloudPart& below : found) {
          if (below.isBall()) {
            ASSERT_LE((below.center - part.center).norm() + below.radius,
                      part.radius + 1e-12 * (1.0 + offset));
          }
          open.push_back(below);
        }
      }
      for (std::size_t k = 0; k < points.size(); ++k) {
        const bool isNear = toSegment(segment, points[k]) - radii[k] < radius;
        const bool isFound = std::ranges::any_of(
            balls, [&](const detail::CloudPart& ball) { return ball.center == points[k]; });
        ASSERT_TRUE(isFound || !isNear);
        ++(isNear ? near : far);
      }
    }
  }
  EXPECT_GT(near, 2000);
  EXPECT_GT(far, 50000);
  EXPECT_GT(deep, 1000);
}

/// Whether shapes of all kinds are farther from a segment than a radius, beside distance() to a
/// capsule.
TEST(IsBodyFarther, AgreesWithTheDistanceOfACapsule) {
  std::mt19937 random(2);
  const test::Soup soup = test::torusSoup(14, 8, 0.4, 0.15);
  std::vector<Vector3d> corners;
  for (int i = 0; i < 30; ++i) corners.push_back(test::uniformPoint(random, 0.4));
  const std::vector<Shape> shapes{makeSphere(0.3),
                                  makeBox({0.5, 0.3, 0.7}),
                                  Cylinder{0.2, 0.3},
                                  Capsule{0.2, 0.3},
                                  Cone{0.3, 0.25},
                                  ConvexHull::of(corners),
                                  TriangleMesh::build(soup.vertices, soup.triangles),
                                  PointCloud::build(corners, 0.05)};
  int farther = 0, nearer = 0, missed = 0;
  for (const Shape& shape : shapes) {
    for (int i = 0; i < 400; ++i) {
      const LineSegment segment{test::uniformPoint(random, 0.9),
                                uniform(random, 0.0, 0.3) * test::unitVector(random)};
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = segment.center;
      pose.linear() =
          Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), segment.half).toRotationMatrix();
      const DistanceResult truth = distance(shape, Capsule{0.0, segment.half.norm()}, pose, {});
      const double radius = uniform(random, 0.0, 0.9);
      const bool found = isBodyFarther(shape, segment, radius);
      if (found) {
        ASSERT_GT(truth.upper + 1e-9, radius) << shape.index();
      }
      missed += !found && truth.lower > radius + 1e-5;
      ++(found ? farther : nearer);
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(farther, 500);
  EXPECT_GT(nearer, 1000);
}

/// m, of a link's geometry from the nearest ball that is within `radius` of the path.
double nearestBall(const Shape& link, const Isometry3d& world_from_link, const PointCloud& cloud,
                   const LineSegment& path, double radius) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < cloud.points().size(); ++k) {
    if (toSegment(path, cloud.points()[k]) - cloud.radius(k) > radius) continue;
    Isometry3d ball = Isometry3d::Identity();
    ball.translation() = cloud.points()[k];
    nearest = std::min(
        nearest,
        distance(link, Sphere{cloud.radius(k)}, world_from_link.inverse() * ball, {}).upper);
  }
  return nearest;
}

TEST(CloudSweep, IsNotProvenWhereABallComesNear) {
  std::mt19937 random(3);
  const auto robot = test::modelRobot("rook7");
  int proven = 0, near = 0, missed = 0, tight = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const auto world = std::make_shared<World>();
    const PointCloud cloud = PointCloud::build(patches(random, 800), 0.004);
    world->add("cloud", cloud, Isometry3d::Identity());
    CheckerOptions options;
    options.margin = trial % 3 == 0 ? 0.06 : 0.0;
    const auto model = detail::compileChecker(robot, *robot->findGroup("arm"), world, options);
    detail::WorkspaceData workspace(*model);
    detail::PairQuery query(*model, workspace);
    std::vector<double> from(7), to(7);
    for (int i = 0; i < 30; ++i) {
      for (std::size_t k = 0; k < from.size(); ++k) {
        from[k] = uniform(random, -1.5, 1.5);
        to[k] = from[k] + uniform(random, -0.6, 0.6);
      }
      const detail::StraightPath path(model->kinematics, from, to);
      ASSERT_TRUE(query.start(path));
      for (std::uint32_t index = 0; index < model->worldPairs.size(); ++index) {
        const detail::GeometryPair pair = model->pair(index);
        const double half = std::pow(0.5, uniform(random, 1.0, 5.0));
        const double t = uniform(random, half, 1.0 - half);
        query.moveTo(t, half);
        const detail::RobotGeometry& link = model->robotGeometry[static_cast<std::size_t>(pair.a)];
        // Around the ball nearest to the middle of the link, or around the link's origin.
        const Vector3d middle = query.pose(pair.a) * boundingSphere(link.shape).center;
        const Vector3d& at = *std::ranges::min_element(
            cloud.points(), {}, [&](const Vector3d& p) { return (p - middle).norm(); });
        const LineSegment patch{i % 3 != 0 ? at : query.pose(pair.a).translation(),
                                test::uniformPoint(random, 0.05)};
        const double radius = uniform(random, 0.02, 0.3);
        const bool found = query.staysApartFrom({index, patch, radius}, t, half);
        double least = std::numeric_limits<double>::infinity();
        constexpr int kSamples = 12;
        for (int k = 0; k <= kSamples; ++k) {
          query.moveTo(t + half * (2.0 * k / kSamples - 1.0), 0.0);
          least =
              std::min(least, nearestBall(link.shape, query.pose(pair.a), cloud, patch, radius));
        }
        if (found) {
          ASSERT_GT(least, pair.margin) << trial << " " << i << " " << index;
        }
        proven += found && std::isfinite(least);
        tight += found && least < pair.margin + 0.01;
        near += least <= pair.margin;
        missed += !found && least > pair.margin + 0.02;
      }
    }
  }
  EXPECT_GT(proven, 300);
  EXPECT_GT(near, 100);
  EXPECT_GT(tight, 20);
  EXPECT_LT(missed, proven / 10);
}

}  // namespace
}  // namespace swept
