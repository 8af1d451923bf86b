// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/point_cloud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "mesh_samples.hpp"
#include "message_of.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

std::vector<Vector3d> randomPoints(std::mt19937& random, int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(test::uniformPoint(random, 0.5));
  return points;
}

/// One in four is a point, the others reach up to `most`.
std::vector<double> randomRadii(std::mt19937& random, int count, double most) {
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) {
    radii.push_back(i % 4 == 0 ? 0.0 : std::uniform_real_distribution<double>(0.0, most)(random));
  }
  return radii;
}

PointCloud randomCloud(std::mt19937& random, int count, double most) {
  const auto points = randomPoints(random, count);
  return PointCloud::build(points, randomRadii(random, count, most));
}

std::vector<Shape> partners(std::mt19937& random) {
  const test::Soup blob = test::blobSoup(random, 8, 10);
  return {makeSphere(0.1),
          makeBox({0.3, 0.2, 0.4}),
          makeCylinder(0.1, 0.5),
          makeCapsule(0.1, 0.4),
          makeCone(0.2, 0.4),
          makeEllipsoid({0.1, 0.2, 0.3}),
          ConvexHull::of(randomPoints(random, 20)),
          makeTriangle({0, 0, 0}, {0.4, 0, 0}, {0, 0.5, 0.1}),
          makePlane({0.0, 0.6, 0.8}, 0.2),
          makeHalfSpace({0.0, 0.6, 0.8}, -0.6),
          TriangleMesh::build(blob.vertices, blob.triangles),
          randomCloud(random, 70, 0.03)};
}

Isometry3d fromPoint(const Isometry3d& cloud_from_b, const Vector3d& point) {
  Isometry3d pose = cloud_from_b;
  pose.translation() -= point;
  return pose;
}

/// The least over the balls, each asked alone.
DistanceResult byBalls(const PointCloud& cloud, const Shape& b, const Isometry3d& cloud_from_b) {
  DistanceResult least;
  least.lower = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const DistanceResult one =
        distance(Sphere{cloud.radius(i)}, b, fromPoint(cloud_from_b, cloud.points()[i]));
    least.lower = std::min(least.lower, one.lower);
    least.upper = std::min(least.upper, one.upper);
  }
  return least;
}

TEST(PointCloud, HoldsEveryPointOnceAndKnowsWhereItWas) {
  std::mt19937 random(1);
  const auto given = randomPoints(random, 1000);
  const auto radii = randomRadii(random, 1000, 0.02);
  const PointCloud cloud = PointCloud::build(given, radii);
  ASSERT_EQ(cloud.points().size(), given.size());
  std::set<int> seen;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const int source = cloud.sourceIndices()[i];
    EXPECT_EQ(cloud.points()[i], given[source]);
    EXPECT_EQ(cloud.radius(i), radii[source]);
    seen.insert(source);
  }
  EXPECT_EQ(seen.size(), given.size());
  EXPECT_EQ(cloud.leastRadius(), 0.0);
  EXPECT_EQ(cloud.largestRadius(), *std::max_element(radii.begin(), radii.end()));
}

TEST(PointCloud, BoundsContainEveryBall) {
  std::mt19937 random(2);
  const PointCloud cloud = randomCloud(random, 300, 0.05);
  const BoundingSphere ball = boundingSphere(cloud);
  const Aabb box = boundingBox(cloud);
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const Vector3d& point = cloud.points()[i];
    const double radius = cloud.radius(i);
    EXPECT_LE((point - ball.center).norm() + radius, ball.radius);
    EXPECT_TRUE(((point.array() - radius) >= box.lower.array()).all());
    EXPECT_TRUE(((point.array() + radius) <= box.upper.array()).all());
  }
}

TEST(PointCloud, DistanceIsThatOfItsNearestBall) {
  std::mt19937 random(3);
  const PointCloud cloud = randomCloud(random, 120, 0.05);
  int touching = 0, total = 0;
  for (const Shape& partner : partners(random)) {
    for (int i = 0; i < 60; ++i) {
      const Isometry3d pose = test::randomPose(random, 1.2);
      const DistanceResult found = distance(cloud, partner, pose);
      const DistanceResult expected = byBalls(cloud, partner, pose);
      EXPECT_LE(found.lower, expected.upper);
      EXPECT_GE(found.upper, expected.lower);
      EXPECT_LE(found.upper - found.lower, 2e-9);
      EXPECT_EQ(found.upper <= 0.0, expected.upper <= 0.0) << partner.index();
      const DistanceResult swapped = distance(partner, cloud, pose.inverse());
      EXPECT_NEAR(swapped.upper, found.upper, 3e-9);
      EXPECT_EQ(collide(cloud, partner, pose) == Contact::Touching, found.upper <= 0.0);
      touching += found.upper <= 0.0 ? 1 : 0;
      ++total;
    }
  }
  EXPECT_GT(touching, total / 10);
  EXPECT_LT(touching, total * 9 / 10);
}

/// The surface is nowhere near; only that one point is inside tells of the contact.
TEST(PointCloud, OneBallInsideAMeshIsAContact) {
  std::mt19937 random(13);
  const test::Soup soup = test::boxSoup({-0.2, -0.3, -0.5}, {0.2, 0.3, 0.5});
  const TriangleMesh solid = TriangleMesh::build(soup.vertices, soup.triangles);
  const TriangleMesh surface =
      TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
  for (int i = 0; i < 60; ++i) {
    const Isometry3d mesh_from_cloud = test::randomPose(random, 1.0);
    std::vector<Vector3d> points;
    while (points.size() < 300) {
      const Vector3d at = test::uniformPoint(random, 1.0);
      const Vector3d beyond = at.cwiseAbs() - Vector3d(0.2, 0.3, 0.5);
      if (beyond.maxCoeff() > 0.02) points.push_back(mesh_from_cloud.inverse() * at);
    }
    const bool contact = i % 2 == 0;
    const Vector3d inside = 0.15 * test::unitVector(random);
    if (contact) points[random() % 300] = mesh_from_cloud.inverse() * inside;
    const PointCloud cloud = PointCloud::build(points, 0.01);
    const DistanceResult found = distance(solid, cloud, mesh_from_cloud);
    const DistanceResult swapped = distance(cloud, solid, mesh_from_cloud.inverse());
    EXPECT_EQ(found.upper == 0.0, contact);
    EXPECT_EQ(swapped.upper == 0.0, contact);
    if (contact) {
      EXPECT_LT((found.pointA - inside).norm(), 1e-12);
      EXPECT_LT((mesh_from_cloud * swapped.pointA - inside).norm(), 1e-12);
    }
    EXPECT_GT(distance(surface, cloud, mesh_from_cloud).upper, 0.0);
  }
}

TEST(PointCloud, AgreesWithTheOtherBackend) {
  std::mt19937 random(4);
  const PointCloud cloud = randomCloud(random, 15, 0.1);
  DistanceOptions other;
  other.backend = Backend::Libccd;
  for (const Shape& partner : partners(random)) {
    for (int i = 0; i < 4; ++i) {
      const Isometry3d pose = test::randomPose(random, 1.0);
      EXPECT_NEAR(distance(cloud, partner, pose).upper, distance(cloud, partner, pose, other).upper,
                  1e-5)
          << partner.index();
    }
  }
}

TEST(PointCloud, SignedDistanceHoldsTheDepthOfItsDeepestBall) {
  std::mt19937 random(5);
  const PointCloud cloud = randomCloud(random, 40, 0.1);
  int deep = 0;
  for (int i = 0; i < 300; ++i) {
    const Isometry3d pose = test::randomPose(random, 0.6);
    const SignedDistanceResult found = signedDistance(cloud, makeSphere(0.1), pose);
    // Every ball has to come out, so the deepest one bounds the depth from below.
    double deepest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < cloud.points().size(); ++k) {
      const double apart = (cloud.points()[k] - pose.translation()).norm();
      deepest = std::min(deepest, apart - 0.1 - cloud.radius(k));
    }
    EXPECT_LE(found.lower, deepest + 1e-12);
    if (deepest >= 0.0) {
      EXPECT_NEAR(found.upper, deepest, 1e-8);
    } else {
      EXPECT_LE(found.upper, deepest + 1e-9);
      ++deep;
    }
  }
  EXPECT_GT(deep, 60);
  EXPECT_LT(deep, 240);
}

TEST(PointCloud, ContactsNameTheBalls) {
  std::mt19937 random(6);
  const PointCloud cloud = randomCloud(random, 200, 0.06);
  const Box box{{0.2, 0.2, 0.2}};
  int expected = 0;
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const Isometry3d pose = fromPoint(Isometry3d::Identity(), cloud.points()[i]);
    expected += collide(Sphere{cloud.radius(i)}, box, pose) == Contact::Touching ? 1 : 0;
  }
  std::vector<ContactPoint> contacts;
  const ContactsResult result = findContacts(cloud, box, Isometry3d::Identity(), 1000, contacts);
  EXPECT_EQ(result.status, Contact::Touching);
  EXPECT_TRUE(result.complete);
  ASSERT_GT(expected, 5);
  ASSERT_LT(expected, 150);
  EXPECT_EQ(contacts.size(), static_cast<std::size_t>(expected));
  for (const ContactPoint& contact : contacts) {
    const Vector3d& center = cloud.points()[contact.pieceA];
    EXPECT_NEAR((contact.pointA - center).norm(), cloud.radius(contact.pieceA), 1e-9);
    EXPECT_EQ(contact.pieceB, -1);
  }
}

TEST(PointCloud, ABallInsideASolidMeshTouchesIt) {
  const test::Soup soup = test::boxSoup(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
  const TriangleMesh box = TriangleMesh::build(soup.vertices, soup.triangles);
  const std::vector<Vector3d> points{{3.0, 0.0, 0.0}, {0.1, 0.0, 0.0}};
  EXPECT_EQ(distance(PointCloud::build(points, 0.0), box, Isometry3d::Identity()).upper, 0.0);
}

TEST(PointCloud, MotionsPastItAreProven) {
  const std::vector<Vector3d> points{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const PointCloud cloud = PointCloud::build(points, 0.01);
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = Vector3d(0.0, 0.0, 0.2);
  SeparationQuery query;
  query.approach.travel = 0.08;
  query.approach.linear = Vector3d(0.0, 0.0, 0.08);
  EXPECT_EQ(separate(cloud, makeSphere(0.1), pose, query).status, Separation::Separated);
  query.approach.travel = 0.1;
  query.approach.linear = Vector3d(0.0, 0.0, 0.1);
  EXPECT_EQ(separate(cloud, makeSphere(0.1), pose, query).status, Separation::Unproven);
  pose.translation().z() = 0.1;
  EXPECT_EQ(separate(cloud, makeSphere(0.1), pose, query).status, Separation::Contact);
}

TEST(PointCloud, BadInputIsNamed) {
  const auto messageOf = [](std::vector<Vector3d> points, double radius) {
    return test::messageOf([&] { PointCloud::build(points, radius); });
  };
  EXPECT_EQ(messageOf({}, 0.1), "point cloud has no points");
  EXPECT_EQ(messageOf({Vector3d::Zero()}, -1.0),
            "point cloud radius is -1; allowed: finite and not negative");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(messageOf({Vector3d::Zero(), {0.0, nan, 1.0}}, 0.1),
              HasSubstr("point 1 of the point cloud is (0, nan, 1)"));
}

TEST(PointCloud, BadRadiiAreNamed) {
  const std::vector<Vector3d> points{Vector3d::Zero(), Vector3d::UnitX()};
  const auto messageOf = [&](const std::vector<double>& radii) {
    return test::messageOf([&] { PointCloud::build(points, radii); });
  };
  EXPECT_EQ(messageOf({0.0, 0.1}), "");
  EXPECT_EQ(messageOf({0.1}), "point cloud has 2 points, but 1 radii");
  EXPECT_EQ(messageOf({0.1, -0.5}),
            "radius 1 of the point cloud is -0.5; allowed: finite and not negative");
  EXPECT_EQ(messageOf({std::numeric_limits<double>::infinity(), 0.1}),
            "radius 0 of the point cloud is inf; allowed: finite and not negative");
}

}  // namespace
}  // namespace swept
