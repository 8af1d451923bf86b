// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/libccd_backend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::uniform;

/// A pair whose distance is known in closed form.
struct Case {
  Shape a;
  Shape b;
  Isometry3d a_from_b;
  double distance;
};

/// Runs random cases, of which overlapping and separate ones have to be common.
void expectDistances(const std::function<Case(std::mt19937&)>& draw, int count = 500) {
  std::mt19937 random(51);
  int overlaps = 0;
  for (int i = 0; i < count; ++i) {
    const Case test = draw(random);
    const DistanceResult found = libccdDistance(test.a, test.b, test.a_from_b, {});
    ASSERT_NEAR(found.upper, test.distance, 1.1 * tolerance::kLibccdDistance) << "case " << i;
    ASSERT_EQ(found.lower, 0.0);
    ASSERT_GT(found.iterations, test.distance > 0.0 ? 0 : -1);
    const DistanceResult swapped = libccdDistance(test.b, test.a, test.a_from_b.inverse(), {});
    ASSERT_NEAR(swapped.upper, test.distance, 1.1 * tolerance::kLibccdDistance) << "case " << i;
    overlaps += test.distance == 0.0 ? 1 : 0;
    if (test.distance == 0.0 || test.distance > 1e-6) {
      ASSERT_EQ(libccdIntersect(test.a, test.b, test.a_from_b),
                test.distance == 0.0 ? Contact::Touching : Contact::Separate);
    }
  }
  EXPECT_GE(overlaps, count / 20);
  EXPECT_LE(overlaps, count - count / 4);
}

Isometry3d shifted(const Vector3d& by) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = by;
  return pose;
}

Vector3d halfSizes(std::mt19937& random) {
  return Vector3d::Constant(0.3) + test::uniformPoint(random, 0.2);
}

TriangleMesh boxMesh(const Vector3d& half) {
  const test::Soup soup = test::boxSoup(-half, half);
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TEST(LibccdDistance, SphereSphere) {
  expectDistances([](std::mt19937& random) {
    const double r = uniform(random, 0.1, 0.6);
    const double s = uniform(random, 0.1, 0.6);
    const Isometry3d pose = test::randomPose(random, 1.0);
    return Case{makeSphere(r), makeSphere(s), pose,
                std::max(0.0, pose.translation().norm() - r - s)};
  });
}

TEST(LibccdDistance, SphereBox) {
  expectDistances([](std::mt19937& random) {
    const Vector3d half = halfSizes(random);
    const double r = uniform(random, 0.1, 0.4);
    const Isometry3d pose = test::randomPose(random, 1.0);
    return Case{makeBox(2.0 * half), makeSphere(r), pose,
                std::max(0.0, reference::pointBox(pose.translation(), half) - r)};
  });
}

TEST(LibccdDistance, AlignedBoxes) {
  expectDistances([](std::mt19937& random) {
    const Vector3d half = halfSizes(random);
    const Vector3d other = halfSizes(random);
    const Vector3d offset = test::uniformPoint(random, 1.2);
    return Case{makeBox(2.0 * half), makeBox(2.0 * other), shifted(offset),
                reference::pointBox(offset, half + other)};
  });
}

TEST(LibccdDistance, CapsuleCapsule) {
  expectDistances([](std::mt19937& random) {
    const auto capsule = [&] {
      const double r = uniform(random, 0.1, 0.3);
      return makeCapsule(r, uniform(random, 0.2, 1.0));
    };
    const Capsule a = capsule();
    const Capsule b = capsule();
    const Isometry3d pose = test::randomPose(random, 0.8);
    const Vector3d endA = a.halfLength * Vector3d::UnitZ();
    const Vector3d endB = b.halfLength * Vector3d::UnitZ();
    const double axes = reference::segmentSegment(-endA, endA, pose * Vector3d(-endB), pose * endB);
    return Case{a, b, pose, std::max(0.0, axes - a.radius - b.radius)};
  });
}

TEST(LibccdDistance, CylinderSphere) {
  expectDistances([](std::mt19937& random) {
    const double radius = uniform(random, 0.1, 0.5);
    const Cylinder cylinder = makeCylinder(radius, uniform(random, 0.2, 1.0));
    const double r = uniform(random, 0.1, 0.4);
    const Isometry3d pose = test::randomPose(random, 1.0);
    const Vector3d p = pose.translation();
    const double fromCenter = reference::pointCylinder(p, cylinder.radius, cylinder.halfLength);
    return Case{cylinder, makeSphere(r), pose, std::max(0.0, fromCenter - r)};
  });
}

TEST(LibccdDistance, HullBox) {
  expectDistances([](std::mt19937& random) {
    const Vector3d half = halfSizes(random);
    const Vector3d other = halfSizes(random);
    const Vector3d offset = test::uniformPoint(random, 1.2);
    // Off its own origin, so that the point inside it is not the origin.
    test::Soup soup = test::boxSoup(-half, half);
    for (Vector3d& v : soup.vertices) v += Vector3d(0.5, -2.0, 1.0);
    return Case{makeBox(2.0 * other), ConvexHull::of(soup.vertices),
                shifted(offset - Vector3d(0.5, -2.0, 1.0)),
                reference::pointBox(offset, half + other)};
  });
}

TEST(LibccdDistance, MeshSphere) {
  expectDistances([](std::mt19937& random) {
    const Vector3d half = halfSizes(random);
    const double r = uniform(random, 0.05, 0.4);
    const Isometry3d pose = test::randomPose(random, 0.9);
    return Case{boxMesh(half), makeSphere(r), pose,
                std::max(0.0, reference::pointBox(pose.translation(), half) - r)};
  });
}

TEST(LibccdDistance, MeshMesh) {
  expectDistances(
      [](std::mt19937& random) {
        const Vector3d half = halfSizes(random);
        const Vector3d other = 0.5 * halfSizes(random);
        const Vector3d offset = test::uniformPoint(random, 0.9);
        return Case{boxMesh(half), boxMesh(other), shifted(offset),
                    reference::pointBox(offset, half + other)};
      },
      150);
}

TEST(LibccdDistance, EnclosedShapesTouch) {
  const TriangleMesh room = boxMesh(Vector3d::Ones());
  const Isometry3d pose = shifted({0.3, -0.2, 0.1});
  for (const Shape& inner : {Shape(makeSphere(0.1)), Shape(makeCylinder(0.1, 0.2)),
                             Shape(boxMesh(Vector3d::Constant(0.1)))}) {
    EXPECT_EQ(libccdIntersect(room, inner, pose), Contact::Touching);
    EXPECT_EQ(libccdIntersect(inner, room, pose.inverse()), Contact::Touching);
  }
  const test::Soup soup = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  const TriangleMesh walls =
      TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
  EXPECT_EQ(libccdIntersect(walls, makeSphere(0.1), pose), Contact::Separate);
  EXPECT_NEAR(libccdDistance(walls, makeSphere(0.1), pose, {}).upper, 0.6, 2e-6);
}

TEST(LibccdDistance, StopsWhereAsked) {
  const Isometry3d pose = shifted({3.0, 0.0, 0.0});
  const Shape ball = makeSphere(0.5);
  const DistanceResult full = libccdDistance(ball, ball, pose, {});
  DistanceOptions enough;
  enough.enough = 0.5;
  const DistanceResult early = libccdDistance(ball, ball, pose, enough);
  EXPECT_GT(early.upper, 2.0);
  EXPECT_LT(early.iterations, full.iterations);
  DistanceOptions contact;
  contact.contact = 2.5;
  EXPECT_LE(libccdDistance(ball, ball, pose, contact).upper, 2.5);
}

// Of needles like these ccdMPRIntersect goes round for ever, its portal no longer getting smaller.
TEST(LibccdIntersect, EndsWhereItsPortalNoLongerGetsSmaller) {
  std::mt19937 random(52);
  int unknown = 0;
  for (int i = 0; i < 1000; ++i) {
    const Shape needle = makeCylinder(1e-11, 0.06);
    const Shape longOne = makeCylinder(2e-9, 1e8);
    const Isometry3d pose = test::randomPose(random, 0.1);
    unknown += libccdIntersect(needle, longOne, pose) == Contact::Unknown ? 1 : 0;
    const DistanceResult found = libccdDistance(needle, longOne, pose, {});
    ASSERT_EQ(found.lower, 0.0);
  }
  EXPECT_GE(unknown, 100);
  EXPECT_LE(unknown, 900);
}

TEST(LibccdDistance, AnswersNothingForAPoseThatIsNoNumber) {
  const Isometry3d pose = shifted({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  const DistanceResult result = libccdDistance(makeSphere(1.0), makeSphere(1.0), pose, {});
  EXPECT_EQ(result.lower, 0.0);
  EXPECT_EQ(result.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(libccdIntersect(makeSphere(1.0), makeSphere(1.0), pose), Contact::Unknown);
}

}  // namespace
}  // namespace swept::detail
