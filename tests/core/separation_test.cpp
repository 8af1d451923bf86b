// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference_distance.hpp"
#include "swept/core/distance.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using reference::Random;
using swept::Separation;

/// A rigid body that turns about a fixed axis through its frame's origin while the origin moves
/// along a line: the pose at s in [-1, 1] is [exp(s spin) R | p + s velocity].
struct Screwing {
  Isometry3d middle;
  Vector3d velocity;
  Vector3d spin;

  Isometry3d at(double s) const {
    Isometry3d pose = middle;
    pose.translation() += s * velocity;
    const double angle = s * spin.norm();
    pose.linear() = Eigen::AngleAxisd(angle, spin.normalized()) * middle.linear();
    return pose;
  }
};

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

/// The bound of ApproachBound for two screwing bodies over s in [-1, 1], in a's frame at s = 0.
swept::ApproachBound approachOf(const swept::Shape& a, const Screwing& moveA, const swept::Shape& b,
                                const Screwing& moveB) {
  const swept::BoundingSphere ballA = swept::boundingSphere(a);
  const swept::BoundingSphere ballB = swept::boundingSphere(b);
  const auto velocity = [](const Screwing& move, const Vector3d& center) -> Vector3d {
    return move.velocity + move.spin.cross(Vector3d(move.middle.linear() * center));
  };
  const Eigen::Matrix3d a_from_world = moveA.middle.linear().transpose();
  swept::ApproachBound bound;
  bound.linear = a_from_world * (velocity(moveB, ballB.center) - velocity(moveA, ballA.center));
  bound.spinA = a_from_world * moveA.spin;
  bound.spinB = a_from_world * moveB.spin;
  bound.ballA = ballA;
  bound.ballB = {moveA.middle.inverse() * (moveB.middle * ballB.center), ballB.radius};
  const double armA = ballA.center.norm() + ballA.radius;
  const double armB = ballB.center.norm() + ballB.radius;
  bound.curvature = 0.5 * (armA * moveA.spin.squaredNorm() + armB * moveB.spin.squaredNorm());
  bound.travel = moveA.velocity.norm() + moveB.velocity.norm() + armA * moveA.spin.norm() +
                 armB * moveB.spin.norm();
  bound.required = 1e-12;
  return bound;
}

/// What is called separated never comes within the margin at any sampled time; what is called
/// contact touches at the middle. Half of the motions are scaled to be nearly too fast to prove.
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
