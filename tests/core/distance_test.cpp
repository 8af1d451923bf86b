// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"
#include "swept/core/tolerances.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using reference::Random;
using swept::Box;
using swept::Capsule;
using swept::Contact;
using swept::Cylinder;
using swept::DistanceResult;
using swept::Shape;
using swept::Sphere;

constexpr double kAccuracy =
    2e-9;  // m, the query's default convergence and the reference's rounding

/// The contract of distance(): an interval that holds the truth, witnessed by points, and
/// converged.
void expectInterval(const DistanceResult& result, double truth) {
  EXPECT_LE(result.lower, truth + 1e-12);
  EXPECT_GE(result.upper, truth - 1e-12);
  EXPECT_LE(result.upper - result.lower, kAccuracy);
  EXPECT_NEAR((result.pointB - result.pointA).norm(), result.upper, 1e-12);
  if (result.lower > 0.0 && !result.normal.isZero()) {
    EXPECT_NEAR(result.normal.norm(), 1.0, 1e-12);
  }
}

/// Counts how a suite's cases fall, and asserts that both kinds are well represented.
struct Mix {
  int overlapping = 0;
  int cases = 0;
  void count(double truth) {
    ++cases;
    overlapping += truth <= 0.0;
  }
  ~Mix() {
    EXPECT_GT(overlapping, cases / 5);
    EXPECT_LT(overlapping, 4 * cases / 5);
  }
};

TEST(Distance, SphereToEveryPrimitiveMatchesTheClosedForm) {
  Random random(1);
  Mix mix;
  for (int i = 0; i < 4000; ++i) {
    const double radius = random.uniform(0.01, 0.3);
    const Isometry3d a_from_b = random.pose(0.6);
    const Vector3d local = a_from_b.inverse().translation();  // a's centre in b's frame
    const Vector3d half = random.vector(0.4).cwiseAbs() + Vector3d::Constant(0.01);
    Shape other = Box{half};
    double truth = reference::pointBox(local, half);
    if (i % 4 == 1) {
      other = Cylinder{half.x(), half.z()};
      truth = reference::pointCylinder(local, half.x(), half.z());
    } else if (i % 4 == 2) {
      other = Capsule{half.x(), half.z()};
      const Vector3d tip(0, 0, half.z());
      truth = reference::pointSegment(local, -tip, tip) - half.x();
    } else if (i % 4 == 3) {
      other = Sphere{half.x()};
      truth = local.norm() - half.x();
    }
    truth = std::max(0.0, truth - radius);
    mix.count(truth);
    expectInterval(swept::distance(Sphere{radius}, other, a_from_b), truth);
  }
}

TEST(Distance, CapsulesMatchSegmentToSegment) {
  Random random(2);
  Mix mix;
  for (int i = 0; i < 2000; ++i) {
    const Capsule a{random.uniform(0.05, 0.2), random.uniform(0.0, 0.5)};
    const Capsule b{random.uniform(0.05, 0.2), random.uniform(0.0, 0.5)};
    const Isometry3d pose = random.pose(0.5);
    const Vector3d tipA(0, 0, a.halfLength);
    const Vector3d tipB(0, 0, b.halfLength);
    const double axes = reference::segmentSegment(-tipA, tipA, pose * Vector3d(-tipB), pose * tipB);
    const double truth = std::max(0.0, axes - a.radius - b.radius);
    mix.count(truth);
    expectInterval(swept::distance(a, b, pose), truth);
  }
}

TEST(Distance, BoxesMatchTheirFeatures) {
  Random random(3);
  Mix mix;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d a = random.vector(0.4).cwiseAbs() + Vector3d::Constant(0.02);
    const Vector3d b = random.vector(0.4).cwiseAbs() + Vector3d::Constant(0.02);
    const Isometry3d pose = random.pose(0.7);
    double truth = reference::surfaces(reference::boxTriangles(a, Isometry3d::Identity()),
                                       reference::boxTriangles(b, pose));
    if (reference::pointBox(pose.translation(), a) == 0.0) truth = 0.0;
    if (reference::pointBox(pose.inverse().translation(), b) == 0.0) truth = 0.0;
    mix.count(truth);
    expectInterval(swept::distance(Box{a}, Box{b}, pose), truth);
  }
}

/// Cylinders have no closed form: the truth is bracketed by alternating projections between the
/// exact solids, which only ever come closer.
TEST(Distance, CylindersAgreeWithAlternatingProjections) {
  Random random(4);
  const auto project = [](const Vector3d& p, const Cylinder& c) -> Vector3d {
    const double across = std::hypot(p.x(), p.y());
    const double scale = across > c.radius ? c.radius / across : 1.0;
    return {p.x() * scale, p.y() * scale, std::clamp(p.z(), -c.halfLength, c.halfLength)};
  };
  int separate = 0;
  for (int i = 0; i < 300; ++i) {
    const Cylinder a{random.uniform(0.02, 0.3), random.uniform(0.02, 0.4)};
    const Cylinder b{random.uniform(0.02, 0.3), random.uniform(0.02, 0.4)};
    const Isometry3d pose = random.pose(0.6);
    const Isometry3d inverse = pose.inverse();
    Vector3d p = Vector3d::Zero();
    Vector3d q;
    for (int k = 0; k < 20000; ++k) {
      q = pose * project(inverse * p, b);
      p = project(q, a);
    }
    const double above = (p - q).norm();
    const DistanceResult result = swept::distance(a, b, pose);
    EXPECT_LE(result.lower, above + 1e-12);
    EXPECT_LE(result.upper - result.lower, kAccuracy);
    EXPECT_LT((project(result.pointA, a) - result.pointA).norm(), 1e-9);
    if (above > 1e-3) {
      ++separate;
      EXPECT_NEAR(result.upper, above, 1e-6);
    }
  }
  EXPECT_GT(separate, 60);
  EXPECT_LT(separate, 280);
}

swept::TriangleMesh ringMesh(double major, double minor, int around, int tube) {
  const swept::test::Soup soup = swept::test::torusSoup(around, tube, major, minor);
  return swept::TriangleMesh::build(soup.vertices, soup.triangles);
}

reference::Triangles trianglesOf(const swept::TriangleMesh& mesh, const Isometry3d& pose) {
  reference::Triangles result;
  for (const auto& t : mesh.triangles()) {
    result.push_back(
        {pose * mesh.vertices()[t[0]], pose * mesh.vertices()[t[1]], pose * mesh.vertices()[t[2]]});
  }
  return result;
}

TEST(Distance, MeshesMatchBruteForceOverTheirTriangles) {
  Random random(5);
  const swept::TriangleMesh ring = ringMesh(0.3, 0.08, 16, 8);
  const swept::TriangleMesh other = ringMesh(0.25, 0.06, 12, 6);
  ASSERT_TRUE(ring.isClosed());
  Mix mix;
  for (int i = 0; i < 80; ++i) {
    const Isometry3d pose = random.pose(0.5);
    const double truth =
        reference::surfaces(trianglesOf(ring, Isometry3d::Identity()), trianglesOf(other, pose));
    mix.count(truth);
    expectInterval(swept::distance(ring, other, pose), truth);
  }
}

TEST(Distance, BoxAndMeshMatchBruteForceInBothOrders) {
  Random random(6);
  const swept::TriangleMesh ring = ringMesh(0.3, 0.08, 24, 10);
  Mix mix;
  for (int i = 0; i < 150; ++i) {
    const Vector3d half = random.vector(0.2).cwiseAbs() + Vector3d::Constant(0.01);
    const Isometry3d pose = random.pose(0.4);
    double truth = reference::surfaces(trianglesOf(ring, Isometry3d::Identity()),
                                       reference::boxTriangles(half, pose));
    for (const Vector3d& v : ring.vertices()) {
      if (reference::pointBox(pose.inverse() * v, half) == 0.0) truth = 0.0;
    }
    mix.count(truth);
    expectInterval(swept::distance(ring, Box{half}, pose), truth);
    expectInterval(swept::distance(Box{half}, ring, pose.inverse()), truth);
  }
}

/// A cube of 0.4 m with a pit of 0.1 m in the middle of one side, and that many squares along an
/// edge.
swept::TriangleMesh pittedCube(int squares) {
  swept::test::Soup soup;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
    const double side = face % 2 == 0 ? 0.2 : -0.2;
    swept::test::Soup part;
    for (int i = 0; i <= squares; ++i) {
      for (int k = 0; k <= squares; ++k) {
        Vector3d p;
        p[axis] = side;
        p[first] = 0.4 * i / squares - 0.2;
        p[second] = 0.4 * k / squares - 0.2;
        const bool inside = 0 < i && i < squares && 0 < k && k < squares;
        if (face == 0 && inside) p[axis] -= 0.1;
        part.vertices.push_back(p);
      }
    }
    const int row = squares + 1;
    for (int i = 0; i < squares; ++i) {
      for (int k = 0; k < squares; ++k) {
        const int at = i * row + k;
        part.triangles.emplace_back(at, at + row, at + row + 1);
        part.triangles.emplace_back(at, at + row + 1, at + 1);
      }
    }
    soup.append(side > 0.0 ? part : part.inverted());
  }
  return swept::TriangleMesh::build(soup.vertices, soup.triangles);
}

TEST(Distance, OfBodiesWithAPitIsThatOfTheirHullsWhereThePitDoesNotMatter) {
  Random random(8);
  const swept::TriangleMesh large = pittedCube(3), small = pittedCube(2);
  ASSERT_TRUE(large.isClosed());
  const reference::Triangles own = trianglesOf(large, Isometry3d::Identity());
  int ofHulls = 0, overPit = 0, touching = 0;
  for (int i = 0; i < 300; ++i) {
    Isometry3d pose = random.pose(0.6);
    // Every other body stands before the pit.
    if (i % 2 == 0) pose.translation() = Vector3d(0.45, 0.0, 0.0) + 0.2 * random.vector(1.0);
    const bool mesh = i % 4 < 2;
    const Vector3d half(0.05, 0.04, 0.2);
    const double truth = reference::surfaces(
        own, mesh ? trianglesOf(small, pose) : reference::boxTriangles(half, pose));
    const Shape other = mesh ? Shape(small) : Shape(Box{half});
    const DistanceResult result = swept::distance(large, other, pose);
    const DistanceResult turned = swept::distance(other, large, pose.inverse());
    EXPECT_EQ(result.upper == 0.0, turned.upper == 0.0);
    if (result.upper == 0.0) {  // the reference knows no inside
      ++touching;
      continue;
    }
    expectInterval(result, truth);
    expectInterval(turned, truth);
    for (const double cut : {0.5, 0.999, 1.001}) {
      swept::DistanceOptions options;
      options.enough = cut * truth;
      const DistanceResult quick = swept::distance(large, other, pose, options);
      EXPECT_LE(quick.lower, truth + 1e-12);
      EXPECT_GE(quick.upper, truth - 1e-12);
      EXPECT_EQ(quick.lower > options.enough, cut < 1.0) << cut;
    }
    const double hulls =
        swept::distance(large.hull(), mesh ? Shape(small.hull()) : other, pose).upper;
    const bool same = hulls > truth - 1e-9;
    EXPECT_EQ(same, !result.normal.isZero()) << truth - hulls;
    ++(same ? ofHulls : overPit);
  }
  EXPECT_GT(ofHulls, 60);
  EXPECT_GT(overPit, 30);
  EXPECT_GT(touching, 30);
}

TEST(Distance, ABoxInsideTheTubeOfARingTouchesTheSolidAndNotTheSurface) {
  const swept::TriangleMesh ring = ringMesh(0.3, 0.08, 48, 20);
  Isometry3d inTube = Isometry3d::Identity();
  inTube.translation() = Vector3d(0.3, 0.0, 0.0);
  const Box small{Vector3d::Constant(0.01)};
  EXPECT_EQ(swept::collide(ring, small, inTube), Contact::Touching);
  EXPECT_EQ(swept::collide(small, ring, inTube.inverse()), Contact::Touching);
  EXPECT_EQ(swept::collide(ring, small, Isometry3d::Identity()), Contact::Separate);

  const auto surface =
      swept::TriangleMesh::build(ring.vertices(), ring.triangles(), swept::MeshInterior::Surface);
  EXPECT_EQ(swept::collide(surface, small, inTube), Contact::Separate);
}

TEST(Distance, StopsEarlyWithProvenBounds) {
  Random random(7);
  int early = 0;
  for (int i = 0; i < 2000; ++i) {
    const Box a{random.vector(0.3).cwiseAbs() + Vector3d::Constant(0.02)};
    const Cylinder b{random.uniform(0.02, 0.2), random.uniform(0.02, 0.3)};
    const Isometry3d pose = random.pose(0.8);
    const DistanceResult full = swept::distance(a, b, pose);
    swept::DistanceOptions options;
    options.enough = 0.1;
    const DistanceResult quick = swept::distance(a, b, pose, options);
    EXPECT_LE(quick.lower, full.upper);
    EXPECT_LE(quick.iterations, full.iterations);
    EXPECT_EQ(quick.lower > options.enough, full.lower > options.enough) << full.lower;
    early += quick.iterations < full.iterations;
  }
  EXPECT_GT(early, 300);
}

TEST(Distance, TouchingIsContactAndAHairlineGapIsNot) {
  const Box box{Vector3d(0.5, 0.5, 0.5)};
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = 1.0;
  EXPECT_EQ(swept::collide(box, box, pose), Contact::Touching);
  pose.translation().x() = 1.0 + 1e-12;
  EXPECT_EQ(swept::collide(box, box, pose), Contact::Separate);
  pose.translation() = Vector3d(0.1, -0.2, 0.3);
  EXPECT_EQ(swept::collide(box, box, pose), Contact::Touching);
}

TEST(Distance, NonFinitePosesGiveTheWidestInterval) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().y() = std::numeric_limits<double>::quiet_NaN();
  const DistanceResult result = swept::distance(Sphere{1.0}, Sphere{1.0}, pose);
  EXPECT_EQ(result.lower, 0.0);
  EXPECT_TRUE(std::isinf(result.upper));
  EXPECT_EQ(swept::collide(Sphere{1.0}, Sphere{1.0}, pose), Contact::Unknown);
}

/// Half-spaces that face each other, not quite parallel: what is proven of them is so within reach,
/// in 80-bit floats.
TEST(Distance, PlanesWithinTheToleranceOfParallelAreApartWithinReach) {
  constexpr double kParallel = swept::tolerance::kParallel;
  std::mt19937 random(22);
  double nearest = 1.0;
  for (const double angle : {0.0, 1e-14, 1e-13, 0.99e-12}) {
    for (int i = 0; i < 200; ++i) {
      const Isometry3d pose = swept::test::randomPose(random, 1.0);
      const Vector3d normal = swept::test::unitVector(random);
      const Vector3d across = normal.unitOrthogonal();
      const Vector3d tilted = normal + angle * across;
      const swept::HalfSpace a{normal, 0.0};
      const swept::HalfSpace b{-(pose.linear().transpose() * tilted), 0.0};
      Isometry3d apart = pose;
      apart.translation() = (0.5 - swept::test::uniform(random, 0.0, 0.2)) * normal;
      const swept::DistanceResult found = swept::distance(a, b, apart);
      ASSERT_GT(found.lower, 0.2) << angle;
      ASSERT_EQ(swept::collide(a, b, apart), Contact::Separate) << angle;
      // Where b's surface comes nearest to a's among points so far out.
      const Eigen::Matrix<long double, 3, 1> m = (apart.linear() * b.normal).cast<long double>(),
                                             n = normal.cast<long double>(),
                                             t = apart.translation().cast<long double>();
      for (const long double reach : {1e3L, 1e8L, 1e11L}) {
        for (const long double side : {-1.0L, 1.0L}) {
          const Eigen::Matrix<long double, 3, 1> out = side * reach * across.cast<long double>();
          const Eigen::Matrix<long double, 3, 1> onB = out - (m.dot(out - t) / m.dot(n)) * n;
          EXPECT_GE(n.dot(onB), found.lower - 2.0 * kParallel * onB.norm()) << angle;
          nearest = std::min(nearest, static_cast<double>(n.dot(onB) / found.lower));
        }
      }
    }
  }
  EXPECT_LT(nearest, 0.9);  // so far out the tilt counts
}

/// They cross far away, where a point is known to an ulp of its coordinates.
TEST(Distance, PlanesThatAreNearlyParallelMeetWhereItSays) {
  std::mt19937 random(21);
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-11, 2e-12}) {
    for (int i = 0; i < 50; ++i) {
      const Isometry3d pose = swept::test::randomPose(random, 1.0);
      const Vector3d normal = swept::test::unitVector(random);
      const Vector3d tilted = Eigen::AngleAxisd(angle, normal.unitOrthogonal()) *
                              Vector3d(i % 2 == 0 ? normal : -normal);
      const swept::Plane a = swept::makePlane(normal, swept::test::uniform(random, -1.0, 1.0));
      const swept::Plane b = swept::makePlane(pose.linear().transpose() * tilted, 0.3);
      const swept::DistanceResult found = swept::distance(a, b, pose);
      ASSERT_EQ(found.upper, 0.0) << angle;
      const double size = 1.0 + found.pointA.norm();
      EXPECT_LE(std::abs(a.normal.dot(found.pointA) - a.offset), 1e-14 * size) << angle;
      const Vector3d inB = pose.inverse() * found.pointB;
      EXPECT_LE(std::abs(b.normal.dot(inB) - b.offset), 1e-14 * size) << angle;
    }
  }
}

}  // namespace
