// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/part_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "mesh_samples.hpp"
#include "screwing_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"

namespace {

using namespace swept;
using namespace swept::detail;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::test::approachOf;
using swept::test::randomPose;
using swept::test::Screwing;
using swept::test::uniform;
using swept::test::uniformPoint;
using swept::test::unitVector;

OrientedBox randomBox(std::mt19937& random, double far) {
  OrientedBox box;
  const Isometry3d pose = randomPose(random, far);
  box.center = pose.translation();
  for (int j = 0; j < 3; ++j) {
    box.half[j] = static_cast<float>(std::pow(10.0, uniform(random, -3.0, 0.0)));
    for (int i = 0; i < 3; ++i) box.axes[j][i] = static_cast<float>(pose.linear()(i, j));
  }
  return box;
}

/// No two points of two boxes approach faster than their bound says, and some two as fast: every
/// corner is looked at.
TEST(PartApproach, IsTheFastestApproachOfTheCorners) {
  std::mt19937 random(3);
  int oneWay = 0;
  for (int i = 0; i < 3000; ++i) {
    const double rateA = uniform(random, 0.0, 0.5), rateB = uniform(random, 0.0, 0.5);
    const Screwing moveA{randomPose(random, 2.0), uniformPoint(random, 0.1),
                         rateA * unitVector(random)};
    const Screwing moveB{randomPose(random, 2.0), uniformPoint(random, 0.1),
                         rateB * unitVector(random)};
    ApproachBound whole = approachOf(Sphere{1.0}, moveA, Sphere{2.0}, moveB);
    whole.travel = std::numeric_limits<double>::infinity();
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    const OrientedBox boxA = randomBox(random, 2.0);
    const OrientedBox boxB = randomBox(random, 2.0);
    const PartMotions motions(whole, a_from_b);
    const PartMotion partA = motions.of(true, boxA);
    const PartMotion partB = motions.of(false, boxB);
    const PartApproach approach(whole, partA, partB);
    const Vector3d n = unitVector(random);
    const Vector3d inWorld = moveA.middle.linear() * n;
    double fastest = 0.0, nearing = 0.0, receding = 0.0;
    for (int corners = 0; corners < 64; ++corners) {
      const auto corner = [&](const OrientedBox& box, int bits) {
        Vector3d p = box.center;
        for (int j = 0; j < 3; ++j) {
          const double along = (bits >> j & 1) != 0 ? box.half[j] : -box.half[j];
          p += along * Vector3d(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
        }
        return p;
      };
      const Vector3d relative = moveB.velocityOf(corner(boxB, corners >> 3)) -
                                moveA.velocityOf(corner(boxA, corners & 7));
      fastest = std::max(fastest, std::abs(inWorld.dot(relative)));
      nearing = std::max(nearing, -inWorld.dot(relative));
      receding = std::max(receding, inWorld.dot(relative));
    }
    const PartApproach::Loss loss = approach.lossAlong(n);
    const auto isLost = [&](double lost, double speed) {
      const double alone = lost - whole.curvature;
      return speed > 0.0 ? alone >= speed && alone <= speed + 1e-5 : alone <= 1e-5;
    };
    ASSERT_TRUE(isLost(loss.after, nearing)) << loss.after << ' ' << nearing;
    ASSERT_TRUE(isLost(loss.before, receding)) << loss.before << ' ' << receding;
    ASSERT_EQ(std::max(loss.before, loss.after) + whole.required, approach.along(n));
    oneWay += nearing == 0.0 || receding == 0.0;
    const double bound = approach.along(n) - whole.required - whole.curvature;
    ASSERT_GE(bound, fastest);
    ASSERT_LE(bound, fastest + 1e-5);
    ASSERT_GE(approach.most(), approach.along(n));
  }
  EXPECT_GT(oneWay, 50);
}

Vector3d cornerOf(const OrientedBox& box, int bits) {
  Vector3d p = box.center;
  for (int j = 0; j < 3; ++j) {
    const double along = (bits >> j & 1) != 0 ? box.half[j] : -box.half[j];
    p += along * Vector3d(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
  }
  return p;
}

/// Each error displaces the corners that it displaces most; one alone, exactly so.
TEST(PartApproach, ErrorsAddWhatTheyDisplace) {
  std::mt19937 random(5);
  double tightest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Screwing moveA{randomPose(random, 2.0), uniformPoint(random, 0.1),
                         uniform(random, 0.0, 0.5) * unitVector(random)};
    const Screwing moveB{randomPose(random, 2.0), uniformPoint(random, 0.1),
                         uniform(random, 0.0, 0.5) * unitVector(random)};
    ApproachBound whole = approachOf(Sphere{1.0}, moveA, Sphere{2.0}, moveB);
    whole.travel = std::numeric_limits<double>::infinity();
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    const OrientedBox boxA = randomBox(random, 2.0);
    const OrientedBox boxB = randomBox(random, 2.0);
    const Vector3d n = unitVector(random);
    const auto boundWith = [&](std::span<const ApproachError> errors) {
      whole.errors = errors;
      const PartMotions motions(whole, a_from_b);
      const PartMotion partA = motions.of(true, boxA);
      const PartMotion partB = motions.of(false, boxB);
      const PartApproach approach(whole, partA, partB);
      EXPECT_GE(approach.most(), approach.along(n));
      return approach.along(n);
    };
    const double alone = boundWith({});
    std::array<ApproachError, 3> errors;
    double all = 0.0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      errors[k].linear = uniformPoint(random, 0.3);
      if (k != 1) errors[k].spinA = uniform(random, 0.0, 0.3) * unitVector(random);
      if (k != 0) errors[k].spinB = uniform(random, 0.0, 0.3) * unitVector(random);
      double most = 0.0;
      for (int corners = 0; corners < 64; ++corners) {
        const Vector3d a = cornerOf(boxA, corners & 7) - whole.ballA.center;
        const Vector3d b = a_from_b * cornerOf(boxB, corners >> 3) - whole.ballB.center;
        most = std::max(most, std::abs(n.dot(errors[k].linear + errors[k].spinB.cross(b) -
                                             errors[k].spinA.cross(a))));
      }
      const double one = boundWith(std::span(errors).subspan(k, 1)) - alone;
      ASSERT_GE(one, most - 1e-12);
      if (k < 2) {
        ASSERT_LE(one, most + 1e-5);
      }
      tightest = std::max(tightest, most / one);
      all += one;
    }
    ASSERT_NEAR(boundWith(errors) - alone, all, 1e-9);
  }
  EXPECT_GT(tightest, 0.999);
}

TEST(PartApproach, WithoutNumbersOnlyTheTravelCounts) {
  std::mt19937 random(4);
  ApproachBound whole;
  whole.spinA = Vector3d(0.0, 0.1, 0.2);
  whole.travel = 0.3;
  OrientedBox box = randomBox(random, 1.0);
  const PartMotions motions(whole, Isometry3d::Identity());
  const PartMotion still = motions.of(false, box);
  box.half.fill(std::numeric_limits<float>::infinity());
  const PartMotion endless = motions.of(true, box);
  EXPECT_EQ(PartApproach(whole, endless, still).along(Vector3d::UnitX()), 0.3);
  EXPECT_EQ(PartApproach(whole, endless, still).most(), 0.3);
  EXPECT_EQ(PartApproach(whole, endless, still).lossAlong(Vector3d::UnitX()).before, 0.3);
  EXPECT_EQ(PartApproach(whole, endless, still).lossAlong(Vector3d::UnitX()).after, 0.3);
  whole.travel = std::nan("");
  EXPECT_FALSE(1.0 > PartApproach(whole, endless, still).along(Vector3d::UnitX()));
}

TriangleMesh meshOf(const test::Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

Shape randomBody(std::mt19937& random, int kind) {
  const auto scaled = [](test::Soup soup, double by) {
    for (Vector3d& v : soup.vertices) v *= by;
    return soup;
  };
  switch (kind % 5) {
    case 0: {
      const test::Soup ring = test::torusSoup(20, 8, uniform(random, 0.2, 0.4), 0.05);
      return meshOf(ring.moved(randomPose(random, 0.3)));
    }
    case 1:
      return Cylinder{uniform(random, 0.03, 0.2), uniform(random, 0.05, 0.4)};
    case 2:
      return meshOf(test::boxSoup(Vector3d(-0.05, -0.05, -0.4), Vector3d(0.05, 0.05, 0.4)));
    case 3:
      return Box{uniformPoint(random, 0.2).cwiseAbs() + Vector3d::Constant(0.02)};
    default:
      return meshOf(scaled(test::blobSoup(random, 8, 10), 0.3).moved(randomPose(random, 0.3)));
  }
}

/// What is called separated never meets at any sampled time. Of these the bound of whole bodies
/// would have left many open: their distance is less than it asks for along the nearest points.
TEST(PartApproach, ProofsOfTurningMeshesSurviveSampling) {
  std::mt19937 random(7);
  int separated = 0;
  int close = 0;
  int more = 0;
  const int cases = 1000;
  for (int i = 0; i < cases; ++i) {
    const Shape a = randomBody(random, i % 2 == 0 ? 0 : 4);
    const Shape b = randomBody(random, i / 2);
    const double pace = std::pow(10.0, uniform(random, -2.0, -0.3));
    const auto move = [&](double far) {
      return Screwing{randomPose(random, far), 0.1 * pace * uniformPoint(random, 1.0),
                      pace * unitVector(random)};
    };
    const Screwing moveA = move(0.25);
    const Screwing moveB = move(0.4);
    SeparationQuery query;
    query.approach = approachOf(a, moveA, b, moveB);
    query.thorough = i % 3 != 0;
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    if (separate(a, b, a_from_b, query).status != Separation::Separated) continue;
    ++separated;
    const DistanceResult middle = distance(a, b, a_from_b);
    const Vector3d n = (middle.pointB - middle.pointA).normalized();
    more += !(middle.upper > query.approach.along(n));
    double least = middle.upper;
    for (int k = -20; k <= 20; ++k) {
      const double s = k / 20.0;
      const double upper = distance(a, b, moveA.at(s).inverse() * moveB.at(s)).upper;
      ASSERT_GT(upper, 0.0) << "case " << i << " at s = " << s;
      least = std::min(least, upper);
    }
    close += least < 0.05;
  }
  EXPECT_GT(separated, cases / 5);
  EXPECT_GT(close, cases / 20);
  EXPECT_GT(more, cases / 40);
}

/// Meshes of more hull vertices than are asked, and round bodies that their nodes are compared
/// with: what is proven survives sampling, what touches is contact, and most free pairs are proven.
TEST(PartApproach, BigMeshesAgainstRoundBodies) {
  std::mt19937 random(8);
  int separated = 0, contact = 0, close = 0, open = 0;
  const int cases = 600;
  const Shape ball = meshOf(test::torusSoup(60, 40, 0.12, 0.1));
  const Shape bumpy = meshOf(test::blobSoup(random, 30, 40).moved(randomPose(random, 0.5)));
  ASSERT_GT(std::get<TriangleMesh>(ball).hull().vertices().size(), ConvexHull::kFew);
  for (int i = 0; i < cases; ++i) {
    const Shape& a = i % 2 == 0 ? ball : bumpy;
    const std::vector<Shape> bodies = {Cylinder{0.1, 0.3}, Cone{0.2, 0.2},
                                       Ellipsoid{Vector3d(0.3, 0.1, 0.2)}, ball};
    const Shape& b = bodies[static_cast<std::size_t>(i / 2 % 4)];
    const double far = i % 2 == 0 ? 0.3 : 0.8;
    const double pace = std::pow(10.0, uniform(random, -4.0, -1.0));
    const Screwing moveA{randomPose(random, 0.1), pace * uniformPoint(random, 0.1),
                         pace * unitVector(random)};
    const Screwing moveB{randomPose(random, far), Vector3d::Zero(), pace * unitVector(random)};
    SeparationQuery query;
    query.approach = approachOf(a, moveA, b, moveB);
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    const SeparationResult result = separate(a, b, a_from_b, query);
    const DistanceResult middle = distance(a, b, a_from_b);
    if (result.status == Separation::Contact) {
      ++contact;
      EXPECT_EQ(middle.upper, 0.0);
      continue;
    }
    EXPECT_GT(middle.upper, 0.0);
    if (result.status != Separation::Separated) {
      ++open;
      EXPECT_LE(middle.lower, query.approach.most() + 1e-9) << "case " << i;
      continue;
    }
    ++separated;
    close += middle.upper < 0.02;
    for (int k = -10; k <= 10; ++k) {
      const double s = k / 10.0;
      ASSERT_GT(distance(a, b, moveA.at(s).inverse() * moveB.at(s)).upper, 0.0) << "case " << i;
    }
  }
  EXPECT_GT(separated, cases / 5);
  EXPECT_GT(contact, cases / 5);
  EXPECT_GT(close, cases / 60);
  EXPECT_GT(open, 0);
}

/// A shaft that spins within a ring: all points of the shaft near the ring move along it.
TEST(PartApproach, AShaftSpinsWithinARing) {
  const Shape ring = meshOf(test::torusSoup(48, 16, 0.3, 0.1));
  const Shape shaft = meshOf(test::torusSoup(48, 16, 0.1, 0.07));
  const Screwing still{Isometry3d::Identity(), Vector3d::Zero(), Vector3d::Zero()};
  const Screwing spins{Isometry3d::Identity(), Vector3d::Zero(), Vector3d(0.0, 0.0, 0.2)};
  SeparationQuery query;
  query.approach = approachOf(ring, still, shaft, spins);
  query.approach.curvature = 0.5 * 0.17 * 0.04;
  const double gap = distance(ring, shaft, Isometry3d::Identity()).upper;
  ASSERT_GT(gap, 0.02);
  ASSERT_GT(query.approach.along(Vector3d::UnitX()), gap) << "the whole body's bound is enough";
  EXPECT_EQ(separate(ring, shaft, Isometry3d::Identity(), query).status, Separation::Separated);
  std::swap(query.approach.spinA, query.approach.spinB);
  std::swap(query.approach.ballA, query.approach.ballB);
  EXPECT_EQ(separate(shaft, ring, Isometry3d::Identity(), query).status, Separation::Separated);
}

}  // namespace
