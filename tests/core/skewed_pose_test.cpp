// SPDX-License-Identifier: BSD-3-Clause
// Poses whose linear part is not quite a rotation, as sums in float and text of few digits leave
// them. Queries took the transpose for the inverse in one formula and not in the other: with a skew
// of 1e-4 what lies 100 m from the origin was off by a centimetre, and `lower` a hundred times the
// distance.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/nearest_rotation.hpp"
#include "pair_samples_all.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d polar(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

double offRotation(const Matrix3d& r) {
  return (r.transpose() * r - Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

Isometry3d skewed(Isometry3d pose, double by, reference::Random& random) {
  Matrix3d skew = Matrix3d::Identity();
  for (int i = 0; i < 9; ++i) skew(i / 3, i % 3) += by * random.uniform(-1.0, 1.0);
  pose.linear() = (pose.linear() * skew).eval();
  return pose;
}

Isometry3d straightened(Isometry3d pose) {
  pose.linear() = polar(pose.linear());
  return pose;
}

/// m. What the pose's own rounding and that of the oracle may make of distances.
double allowance(const samples::Pair& pair) {
  return 1e-13 * (1.0 + pair.a_from_b.translation().norm());
}

/// Every pair of kinds, far from the origin of a, nearly touching there.
template <typename Judge>
void forSkewedPairs(const Judge& judge) {
  samples::Sampler sampler(20261125);
  const std::size_t kinds = samples::kNames.size();
  for (std::size_t kind = 0; kind < kinds * kinds; ++kind) {
    for (int i = 0; i < 24; ++i) {
      samples::Pair pair = sampler.pair(kind / kinds, kind % kinds, i);
      const double by = std::pow(10.0, sampler.random.uniform(-12.0, -3.7));
      pair.a_from_b = skewed(pair.a_from_b, by, sampler.random);
      SCOPED_TRACE(testing::Message()
                   << samples::kNames[kind / kinds] << ' ' << samples::kNames[kind % kinds] << ' '
                   << i << " skew " << offRotation(pair.a_from_b.linear()));
      judge(pair, straightened(pair.a_from_b));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(SkewedPose, RotationIsTheNearest) {
  reference::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double by = std::pow(10.0, random.uniform(-17.0, -3.6));
    const Isometry3d pose = skewed(random.pose(10.0), by, random);
    const Isometry3d rigid = detail::rigidPose(pose);
    EXPECT_TRUE(detail::isRigidPose(rigid)) << by;
    EXPECT_LE((rigid.linear() - polar(pose.linear())).norm(), 8e-15) << by;
    EXPECT_EQ(rigid.translation(), pose.translation());
  }
}

TEST(SkewedPose, ProductsOfTenRotationsStayAsTheyAre) {
  reference::Random random(4);
  int changed = 0;
  for (int i = 0; i < 1000; ++i) {
    Isometry3d pose = random.pose(1.0);
    for (int k = 1; k < 10; ++k) pose = pose * random.pose(1.0);
    changed += detail::isRigidPose(pose) ? 0 : 1;
  }
  EXPECT_LE(changed, 10);
}

TEST(SkewedPose, BoundsOfDistanceAreThoseOfTheNearestRotation) {
  forSkewedPairs([](const samples::Pair& pair, const Isometry3d& straight) {
    const DistanceResult found = distance(pair.a, pair.b, pair.a_from_b);
    const DistanceResult truth = distance(pair.a, pair.b, straight);
    const double allowed = allowance(pair);
    EXPECT_LE(found.lower, truth.upper + allowed);
    EXPECT_GE(found.upper, truth.lower - allowed);
    const Contact contact = collide(pair.a, pair.b, pair.a_from_b);
    if (truth.lower > allowed) {
      EXPECT_NE(contact, Contact::Touching);
    }
    if (contact == Contact::Separate) {
      EXPECT_NE(collide(pair.a, pair.b, straight), Contact::Touching);
    }
    const SignedDistanceResult depth = signedDistance(pair.a, pair.b, pair.a_from_b);
    const SignedDistanceResult depthOfTruth = signedDistance(pair.a, pair.b, straight);
    EXPECT_LE(depth.lower, depthOfTruth.upper + allowed);
    EXPECT_GE(depth.upper, depthOfTruth.lower - allowed);
  });
}

/// What is said to be apart by some length is so by the distance of the nearest rotation.
TEST(SkewedPose, SeparationIsThatOfTheNearestRotation) {
  forSkewedPairs([](const samples::Pair& pair, const Isometry3d& straight) {
    const DistanceResult truth = distance(pair.a, pair.b, straight);
    for (const double share : {0.999, 1.001}) {
      SeparationQuery query;
      query.approach.required = share * truth.upper + (share > 1.0 ? allowance(pair) : 0.0);
      const SeparationResult found = separate(pair.a, pair.b, pair.a_from_b, query);
      if (share > 1.0) {
        EXPECT_NE(found.status, Separation::Separated);
      }
      if (found.status == Separation::Contact) {
        EXPECT_LE(truth.lower, allowance(pair));
      }
    }
    std::vector<ContactPoint> contacts;
    const Contact touching = findContacts(pair.a, pair.b, pair.a_from_b, 100, contacts).status;
    if (truth.lower > allowance(pair)) {
      EXPECT_NE(touching, Contact::Touching);
    }
  });
}

/// A long box that ends in front of a ball: by the transpose for the inverse it ends elsewhere.
TEST(SkewedPose, FarAwayPointsAreNotMovedByTheSkew) {
  const Shape box = makeBox({2.0, 2.0, 200.0});
  const Shape ball = makeSphere(0.5);
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  Matrix3d scale = Matrix3d::Identity();
  scale(2, 2) = 1.0 + 1e-4;
  pose.linear() = (pose.linear() * scale).eval();
  const Vector3d axis = polar(pose.linear()).col(2);
  for (const double gap : {1e-4, 1e-3, 1e-2}) {
    pose.translation() = -(100.5 + gap) * axis;
    for (const auto& [a, b, a_from_b] :
         {std::tuple(ball, box, pose), std::tuple(box, ball, straightened(pose).inverse())}) {
      const DistanceResult found = distance(a, b, a_from_b);
      EXPECT_NEAR(found.lower, gap, 1e-9);
      EXPECT_NEAR(found.upper, gap, 1e-9);
    }
  }
}

/// Neither an answer nor an exception.
TEST(SkewedPose, WhatIsNoRotationAtAllIsUndecided) {
  const Shape box = makeBox({1.0, 1.0, 1.0});
  const Shape ball = makeSphere(0.5);
  for (const double scale : {0.0, 0.9, 1.01, 1e160, 1e-200}) {
    Isometry3d pose(Eigen::Translation3d(5.0, 0.0, 0.0));
    pose.linear() *= scale;
    const DistanceResult found = distance(box, ball, pose);
    EXPECT_EQ(found.lower, 0.0);
    EXPECT_EQ(found.upper, std::numeric_limits<double>::infinity());
    EXPECT_EQ(collide(box, ball, pose), Contact::Unknown);
    EXPECT_EQ(separate(box, ball, pose, {}).status, Separation::Unproven);
    EXPECT_EQ(signedDistance(box, ball, pose).lower, -std::numeric_limits<double>::infinity());
    std::vector<ContactPoint> contacts;
    EXPECT_EQ(findContacts(box, ball, pose, 10, contacts).status, Contact::Unknown);
  }
}

/// A motion of one's own whose poses are scaled.
class ScaledMotion final : public Motion {
 public:
  ScaledMotion(const Vector3d& start, const Vector3d& along, double scale)
      : Motion(Vector3d::Zero()), start_(start), along_(along), scale_(scale) {}
  Isometry3d at(double t) const override {
    Isometry3d pose(Eigen::Translation3d(start_ + t * along_));
    pose.linear() *= scale_;
    return pose;
  }
  Twist velocity(double /*t*/) const override { return {along_, Vector3d::Zero()}; }
  MotionRates rates(double /*from*/, double /*to*/) const override {
    return {along_.norm(), 0.0, 0.0, 0.0};
  }
  double rounding(double reach) const override { return 1e-14 * (reach + start_.norm()); }

 private:
  Vector3d start_;
  Vector3d along_;
  double scale_;
};

TEST(SkewedPose, MotionsAreThoseOfTheNearestRotation) {
  const Shape box = makeBox({200.0, 2.0, 2.0});
  const Shape ball = makeSphere(0.5);
  for (const double scale : {1.0 - 2e-4, 1.0 + 2e-4}) {
    const ScaledMotion carrier(Vector3d::Zero(), Vector3d::Zero(), scale);
    for (const double gap : {-1e-3, 1e-3}) {
      const ScaledMotion passing({100.5 + gap, -3.0, 0.0}, {0.0, 6.0, 0.0}, scale);
      ContinuousOptions options;
      options.tolerance = 1e-4;
      const ContinuousResult found = continuousCollide(box, carrier, ball, passing, options);
      EXPECT_EQ(found.verdict, gap > 0.0 ? Verdict::Free : Verdict::Collision) << scale << gap;
    }
  }
  const ScaledMotion grown({100.0, 0.0, 0.0}, Vector3d::Zero(), 1.1);
  const ScaledMotion still(Vector3d::Zero(), Vector3d::Zero(), 1.0);
  EXPECT_EQ(continuousCollide(ball, still, ball, grown).verdict, Verdict::Undecided);
}

}  // namespace
