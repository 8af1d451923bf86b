// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference_distance.hpp"
#include "screwing_samples.hpp"
#include "swept/core/distance.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using reference::Random;
using swept::Separation;
using swept::test::approachOf;
using swept::test::Screwing;

swept::Shape randomShape(Random& random, int kind) {
  const Vector3d size = random.vector(0.25).cwiseAbs() + Vector3d::Constant(0.02);
  switch (kind % 5) {
    case 0:
      return swept::Sphere{size.x()};
    case 1:
      return swept::Box{size};
    case 2:
      return swept::Cylinder{size.x(), size.y()};
    case 3:
      return swept::Capsule{size.x(), size.y()};
    default:
      break;
  }
  std::vector<Vector3d> points;
  for (int i = 0; i < 12; ++i) points.push_back(random.vector(0.25));
  return swept::ConvexHull::of(points);
}

/// What is called separated never comes within the margin at any sampled time; what is called
/// contact touches at the middle. Paces go from easy to prove to too fast.
TEST(Separation, ProofsSurviveSampling) {
  Random random(11);
  int separated = 0;
  int contact = 0;
  int close = 0;
  const int cases = 6000;
  for (int i = 0; i < cases; ++i) {
    const swept::Shape a = randomShape(random, i);
    const swept::Shape b = randomShape(random, i / 5);
    const double pace = std::pow(10.0, random.uniform(-2.5, 0.0));
    const Screwing moveA{random.pose(0.3), pace * random.vector(0.2), pace * random.vector(0.5)};
    const Screwing moveB{random.pose(0.3), pace * random.vector(0.1), pace * random.vector(0.2)};
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    swept::SeparationQuery query;
    query.approach = approachOf(a, moveA, b, moveB);
    query.contact = 0.0;
    const swept::SeparationResult result = swept::separate(a, b, a_from_b, query);
    if (result.status == Separation::Contact) {
      ++contact;
      EXPECT_LE((result.pointA - result.pointB).norm(), 1e-9);
      EXPECT_EQ(swept::distance(a, b, a_from_b).upper, 0.0);
      continue;
    }
    if (result.status != Separation::Separated) continue;
    ++separated;
    double least = 1e9;
    for (int k = -50; k <= 50; ++k) {
      const double s = k / 50.0;
      const double distance = swept::distance(a, b, moveA.at(s).inverse() * moveB.at(s)).upper;
      ASSERT_GT(distance, 0.0) << "case " << i << " at s = " << s;
      least = std::min(least, distance);
    }
    close += least < 0.05;
  }
  EXPECT_GT(separated, cases / 10);
  EXPECT_GT(contact, cases / 10);
  EXPECT_GT(close, 100) << "too few proofs near contact to be a test";
}

/// Motion along a face does not bring the bodies closer: only the directed bound sees that.
TEST(Separation, SlidingAlongAWallIsProven) {
  const swept::Box wall{Vector3d(1.0, 1.0, 0.01)};
  const swept::Sphere ball{0.1};
  Isometry3d wall_from_ball = Isometry3d::Identity();
  wall_from_ball.translation() = Vector3d(0.0, 0.0, 0.12);
  swept::SeparationQuery query;
  query.approach.linear = Vector3d(0.5, 0.3, 0.0);
  query.approach.travel = 0.6;
  EXPECT_EQ(swept::separate(wall, ball, wall_from_ball, query).status, Separation::Separated);
  query.approach.linear.z() = 0.02;
  EXPECT_EQ(swept::separate(wall, ball, wall_from_ball, query).status, Separation::Unproven);
}

TEST(Separation, NaNIsNeverProven) {
  swept::SeparationQuery query;
  query.approach.linear = Vector3d::Constant(std::nan(""));
  query.approach.travel = std::nan("");
  Isometry3d far = Isometry3d::Identity();
  far.translation().x() = 10.0;
  EXPECT_EQ(swept::separate(swept::Sphere{1.0}, swept::Sphere{1.0}, far, query).status,
            Separation::Unproven);
  far.translation().x() = std::nan("");
  EXPECT_EQ(swept::separate(swept::Sphere{1.0}, swept::Sphere{1.0}, far, {}).status,
            Separation::Unproven);
}

}  // namespace
