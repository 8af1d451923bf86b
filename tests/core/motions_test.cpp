// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "motion_oracle.hpp"
#include "reference_distance.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using motion_oracle::Curve;
using motion_oracle::Placement;
using motion_oracle::Real;
using motion_oracle::Rotation;
using motion_oracle::Vector;
using reference::Random;

/// A motion, and where formulas that share nothing with it say the body is.
struct Sample {
  std::string kind;
  std::unique_ptr<Motion> motion;
  Curve truth;
};

template <typename M>
Sample sample(std::string kind, M motion, Curve truth) {
  return {std::move(kind), std::make_unique<M>(std::move(motion)), std::move(truth)};
}

std::vector<ControlPose> controls(Random& random, int count, double turn) {
  std::vector<ControlPose> control;
  for (int i = 0; i < count; ++i) control.push_back({random.vector(1.0), random.vector(turn)});
  return control;
}

constexpr int kKinds = 8;

Sample makeSample(Random& random, int kind) {
  const Isometry3d start = random.pose(1.0);
  const double angle = random.uniform(0.01, 3.0);
  const Vector3d turn = angle * random.direction();
  const Vector3d move = random.vector(2.0);
  const Vector3d reference = random.vector(0.5);
  switch (kind) {
    case 0:
      return sample("still", UniformMotion::still(start),
                    motion_oracle::turning(start, Vector3d::Zero(), Vector3d::Zero(), reference));
    case 1:
      return sample("translation", UniformMotion::translation(start, move),
                    motion_oracle::turning(start, Vector3d::Zero(), move, reference));
    case 2: {
      const Isometry3d end = random.pose(1.0);
      return sample("interpolation", UniformMotion::interpolation(start, end, reference),
                    motion_oracle::slerp(start, end, reference));
    }
    case 3: {
      const Isometry3d end = random.pose(1.0);
      return sample("screw", UniformMotion::screw(start, end), motion_oracle::screw(start, end));
    }
    case 4:
      return sample("turning", UniformMotion::turning(start, turn, move, reference),
                    motion_oracle::turning(start, turn, move, reference));
    case 5: {
      const double turns = random.uniform(7.0, 60.0);
      const Vector3d far = turns * random.direction();
      return sample("turns", UniformMotion::turning(start, far, move, reference),
                    motion_oracle::turning(start, far, move, reference));
    }
    case 6: {
      const auto control = controls(random, static_cast<int>(random.uniform(2.0, 9.0)), 1.5);
      return sample("bezier", SplineMotion::bezier(start.linear(), control),
                    motion_oracle::bezier(start.linear(), control));
    }
    default: {
      const auto control = controls(random, static_cast<int>(random.uniform(4.0, 9.0)), 1.5);
      return sample("cubic", SplineMotion::uniformCubic(start.linear(), control),
                    motion_oracle::uniformCubic(start.linear(), control));
    }
  }
}

double off(const Isometry3d& pose, const Placement& truth, const Vector3d& local) {
  const Vector world = truth.rotation * local.cast<Real>() + truth.position;
  return static_cast<double>(((pose * local).cast<Real>() - world).norm());
}

TEST(Motions, AreWhereTheFormulasSay) {
  Random random(1);
  for (int i = 0; i < 400 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    const double allowed = s.motion->rounding(1.0);
    ASSERT_LT(allowed, 1e-10) << s.kind;
    ASSERT_GT(allowed, 0.0) << s.kind;
    for (const double t : {0.0, 1.0, random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)}) {
      const Isometry3d pose = s.motion->at(t);
      // Both take the start for the nearest rotation, each rounded in its own way.
      ASSERT_LE(off(pose, s.truth(t), random.direction()), allowed + 4e-15) << s.kind << ' ' << t;
      ASSERT_LT((pose.linear() * pose.linear().transpose() - Matrix3d::Identity()).norm(), 1e-14);
    }
  }
}

TEST(Motions, BeginAndEndWhereTheyWereTold) {
  Random random(2);
  for (int i = 0; i < 400; ++i) {
    const Isometry3d start = random.pose(1.0);
    // Half turns too, where the shorter way is either.
    Isometry3d end = random.pose(1.0);
    const double angle = std::numbers::pi * (i % 4 == 0 ? 1.0 : random.uniform(0.0, 1.0));
    if (i % 2 == 0) {
      end.linear() = Eigen::AngleAxisd(angle, random.direction()) * start.linear();
    }
    if (i % 8 == 1) end.linear() = start.linear();
    const Vector3d reference = random.vector(0.5);
    const UniformMotion interpolation = UniformMotion::interpolation(start, end, reference);
    const UniformMotion screw = UniformMotion::screw(start, end);
    EXPECT_LT((interpolation.at(0.0).matrix() - start.matrix()).norm(), 1e-14);
    EXPECT_LT((interpolation.at(1.0).matrix() - end.matrix()).norm(), 1e-13);
    EXPECT_LT((screw.at(0.0).matrix() - start.matrix()).norm(), 1e-14 + screw.rounding(0.0));
    EXPECT_LT((screw.at(1.0).matrix() - end.matrix()).norm(), 1e-13 + 2.0 * screw.rounding(1.0));
    EXPECT_LE(interpolation.rates(0.0, 1.0).angularSpeed, std::numbers::pi + 1e-12);
    EXPECT_LE(screw.rates(0.0, 1.0).angularSpeed, std::numbers::pi + 1e-12);
    EXPECT_LT(screw.rounding(1.0), 1e-6);
    const Vector3d straight =
        0.5 * (start * reference + end * reference) - interpolation.at(0.5) * reference;
    EXPECT_LT(straight.norm(), 1e-14);
  }
}

/// Of every turn from a rounding error to a half.
TEST(Motions, OfSmallTurnsAreAsGood) {
  Random random(3);
  for (int i = 0; i < 400; ++i) {
    const Isometry3d start = random.pose(1.0);
    const double angle = std::pow(10.0, random.uniform(-18.0, 0.0));
    Isometry3d end = start;
    end.linear() = Eigen::AngleAxisd(angle, random.direction()) * start.linear();
    end.translation() += random.vector(0.3);
    for (const UniformMotion& m :
         {UniformMotion::screw(start, end), UniformMotion::interpolation(start, end)}) {
      const double t = random.uniform(0.0, 1.0);
      const Vector3d p = random.direction();
      EXPECT_LT((m.at(0.0) * p - start * p).norm(), 1e-14 + m.rounding(1.0)) << angle;
      EXPECT_LT((m.at(1.0) * p - end * p).norm(), 1e-13 + 2.0 * m.rounding(1.0)) << angle;
      // Both are straight lines but for the turn.
      const Vector3d line = start * p + t * (end * p - start * p);
      EXPECT_LT((m.at(t) * p - line).norm(), 3.0 * angle + 1e-14 + 2.0 * m.rounding(1.0)) << angle;
      EXPECT_LT(m.rounding(1.0), 1e-6) << angle;
    }
  }
}

TEST(Motions, VelocitiesAreTheDifferences) {
  Random random(4);
  for (int i = 0; i < 300 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    // A spline's third derivative jumps between spans: there the differences say less.
    const Real h = 1e-4L;
    const Real t = random.uniform(2.0 * static_cast<double>(h), 1.0 - 2.0 * static_cast<double>(h));
    const Vector reference = s.motion->reference().cast<Real>();
    const motion_oracle::Derivative d = motion_oracle::differences(s.truth, t, h, reference);
    const Twist twist = s.motion->velocity(static_cast<double>(t));
    const double scale = 1.0 + static_cast<double>(d.velocity.norm());
    const double allowed = (s.kind == "cubic" ? 1e-5 : 1e-9) * scale + s.motion->rounding(1.0);
    EXPECT_LT((twist.linear.cast<Real>() - d.velocity).norm(), allowed) << s.kind;
    EXPECT_LT((twist.angular.cast<Real>() - d.spin).norm(),
              (s.kind == "cubic" || s.kind == "turns" ? 1e-5 : 1e-9) + s.motion->rounding(1.0))
        << s.kind;
  }
}

/// Over parts of the way, most of them short; how tight is said over the short ones.
TEST(Motions, RatesBoundWhatIsSampled) {
  Random random(5);
  std::vector<double> shares;
  for (int i = 0; i < 150 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    const double length = std::pow(10.0, random.uniform(-3.0, 0.0));
    const double from = random.uniform(0.0, 1.0 - length);
    const double to = from + length;
    const MotionRates rates = s.motion->rates(from, to);
    const Real h = 1e-4L;
    const Vector reference = s.motion->reference().cast<Real>();
    MotionRates seen;
    for (int k = 0; k <= 16; ++k) {
      const Twist twist = s.motion->velocity(std::min(to, from + k * length / 16.0));
      seen.speed = std::max(seen.speed, twist.linear.norm());
      seen.angularSpeed = std::max(seen.angularSpeed, twist.angular.norm());
      const Real t = std::clamp<Real>(from + k * length / 16.0, 3 * h, 1 - 3 * h);
      if (t - 3 * h < from || t + 3 * h > to) continue;
      const auto d = motion_oracle::differences(s.truth, t, h, reference);
      seen.acceleration = std::max(seen.acceleration, static_cast<double>(d.acceleration.norm()));
      seen.angularAcceleration =
          std::max(seen.angularAcceleration, static_cast<double>(d.spinChange.norm()));
    }
    const double slack = 1e-13 + s.motion->rounding(1.0);
    ASSERT_LE(seen.speed, rates.speed + slack) << s.kind;
    ASSERT_LE(seen.angularSpeed, rates.angularSpeed + slack) << s.kind;
    const double rough = 1e-7 + 1e-5 * rates.angularSpeed * rates.angularSpeed;
    ASSERT_LE(seen.acceleration, rates.acceleration + rough) << s.kind;
    ASSERT_LE(seen.angularAcceleration, rates.angularAcceleration + rough) << s.kind;
    if (s.kind != "bezier" && s.kind != "cubic") {
      EXPECT_LE(rates.speed, seen.speed + 1e-9) << s.kind;
      EXPECT_LE(rates.angularSpeed, seen.angularSpeed + 1e-9) << s.kind;
      EXPECT_LE(rates.acceleration, seen.acceleration + 1e-9) << s.kind;
      EXPECT_LE(rates.angularAcceleration, 1e-9) << s.kind;
    } else if (length < 0.05) {
      shares.push_back(seen.speed / rates.speed);
      shares.push_back(seen.angularSpeed / rates.angularSpeed);
    }
  }
  ASSERT_GT(shares.size(), 200u);
  std::sort(shares.begin(), shares.end());
  EXPECT_GT(shares[shares.size() / 2], 0.6) << "half of the bounds are as tight";
  EXPECT_GT(shares[shares.size() / 20], 0.1);
}

/// How far points of a ball get, sampled, in units of what along() says; checks most() too.
struct Reach {
  double share = 0.0;

  void look(const Motion& motion, const Curve& truth, Random& random, double from, double to) {
    const BoundingSphere ball{random.vector(0.5), random.uniform(0.0, 0.7)};
    const MotionBound bound = motion.bound(ball, from, to);
    const Placement middle = truth((Real(from) + Real(to)) / 2);
    for (int k = 0; k < 12; ++k) {
      const Vector3d n = random.direction();
      const double along = bound.along(n);
      ASSERT_GE(bound.most(), along * (1.0 - 1e-15));
      ASSERT_NEAR(bound.along(-n), along, 1e-12 * (1.0 + along));
      for (int j = 0; j < 8; ++j) {
        const double t = j == 0 ? from : (j == 1 ? to : random.uniform(from, to));
        const Vector3d p = ball.center + ball.radius * random.direction();
        const Placement then = truth(t);
        const Vector local = p.cast<Real>();
        const Vector moved =
            then.rotation * local + then.position - middle.rotation * local - middle.position;
        const double got = std::abs(static_cast<double>(n.cast<Real>().dot(moved)));
        ASSERT_LE(got, along + 1e-13 + 2.0 * motion.rounding(1.5)) << from << ' ' << to;
        if (along > 1e-9) share = std::max(share, got / along);
      }
    }
  }
};

TEST(Motions, NoPointGetsFartherThanTheBound) {
  Random random(6);
  std::vector<double> shares;
  for (int i = 0; i < 150 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    const double length = std::pow(10.0, random.uniform(-4.0, 0.0));
    const double from = random.uniform(0.0, 1.0 - length);
    Reach reach;
    reach.look(*s.motion, s.truth, random, from, std::min(1.0, from + length));
    if (HasFatalFailure()) FAIL() << s.kind;
    if (s.kind == "still") {
      EXPECT_LT(s.motion->bound({Vector3d::Ones(), 1.0}, 0.0, 1.0).most(), 1e-12);
    } else if (length < 0.01) {
      shares.push_back(reach.share);
    }
  }
  ASSERT_GT(shares.size(), 300u);
  std::sort(shares.begin(), shares.end());
  EXPECT_GT(shares[shares.size() / 2], 0.5) << "half of the bounds are as tight";
  EXPECT_LE(shares.back(), 1.0 + 1e-9);
}

TEST(Motions, OfAnEndlessBallAreKnownOnlyIfItDoesNotTurn) {
  const BoundingSphere endless{Vector3d::Zero(), std::numeric_limits<double>::infinity()};
  Random random(7);
  for (int i = 0; i < 20 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    const MotionBound bound = s.motion->bound(endless, 0.2, 0.7);
    if (s.kind == "still" || s.kind == "translation") {
      EXPECT_LT(bound.most(), 2.0);
      EXPECT_GE(bound.most(), bound.along(random.direction()));
    } else {
      EXPECT_EQ(bound.most(), std::numeric_limits<double>::infinity()) << s.kind;
    }
    EXPECT_FALSE(std::isnan(bound.along(random.direction()))) << s.kind;
  }
}

void expectSame(const MotionState& state, const Isometry3d& pose, const Twist& twist) {
  EXPECT_EQ(state.pose.matrix(), pose.matrix());
  EXPECT_EQ(state.twist.linear, twist.linear);
  EXPECT_EQ(state.twist.angular, twist.angular);
}

TEST(Motions, HaveStatesOfTheirPosesAndVelocities) {
  Random random(11);
  for (int i = 0; i < 20 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    SCOPED_TRACE(s.kind);
    const double t = random.uniform(0.0, 1.0);
    expectSame(s.motion->state(t), s.motion->at(t), s.motion->velocity(t));
    const MotionPart part(*s.motion, 0.2, 0.7);
    expectSame(part.state(t), part.at(t), part.velocity(t));
    const AttachedFrame attached(*s.motion, random.pose(1.0));
    expectSame(attached.state(t), attached.at(t), attached.velocity(t));
  }
}

/// Differences of control poses this far apart are infinite, and their differences not a number.
TEST(Motions, WhoseRatesOverflowClaimNoBounds) {
  const double huge = std::numeric_limits<double>::max();
  std::vector<ControlPose> control;
  for (int i = 0; i < 6; ++i) {
    control.push_back({(i % 2 == 0 ? huge : -huge) * Vector3d::UnitX(), Vector3d::Zero()});
  }
  for (const SplineMotion& motion : {SplineMotion::bezier(Matrix3d::Identity(), control),
                                     SplineMotion::uniformCubic(Matrix3d::Identity(), control)}) {
    const MotionRates rates = motion.rates(0.0, 1.0);
    EXPECT_FALSE(std::isfinite(rates.speed));
    EXPECT_FALSE(std::isfinite(rates.acceleration));
    EXPECT_FALSE(std::isfinite(motion.bound({Vector3d::Zero(), 0.1}, 0.0, 1.0).most()));
  }
}

TEST(MotionPart, IsThePartOfTheWhole) {
  Random random(8);
  for (int i = 0; i < 60 * kKinds; ++i) {
    const Sample s = makeSample(random, i % kKinds);
    const double from = i % 3 == 0 ? 0.0 : random.uniform(0.0, 1.0);
    const double to = i % 5 == 0 ? from : (i % 5 == 1 ? 1.0 : random.uniform(from, 1.0));
    const MotionPart part(*s.motion, from, to);
    const Curve truth = [&](Real t) { return s.truth(from + t * (Real(to) - Real(from))); };
    EXPECT_EQ(part.reference(), s.motion->reference());
    const double t = random.uniform(0.0, 1.0);
    const Vector3d p = random.direction();
    const double slack = 1e-13 + 2.0 * part.rounding(1.0);
    EXPECT_LE(off(part.at(t), truth(t), p), slack) << s.kind;
    EXPECT_LE(off(part.at(0.0), s.truth(from), p), slack) << s.kind;
    EXPECT_LE(off(part.at(1.0), s.truth(to), p), slack) << s.kind;
    const Twist whole = s.motion->velocity(from + t * (to - from));
    const Twist own = part.velocity(t);
    EXPECT_LT((own.linear - (to - from) * whole.linear).norm(), 1e-10) << s.kind;
    EXPECT_LT((own.angular - (to - from) * whole.angular).norm(), 1e-10) << s.kind;
    const double length = random.uniform(0.0, 1.0);
    const double begin = random.uniform(0.0, 1.0 - length);
    const MotionRates rates = part.rates(begin, begin + length);
    EXPECT_LE(part.velocity(begin + 0.3 * length).linear.norm(), rates.speed + slack);
    EXPECT_LE(part.velocity(begin + 0.7 * length).angular.norm(), rates.angularSpeed + slack);
    Reach reach;
    reach.look(part, truth, random, begin, begin + length);
    if (HasFatalFailure()) FAIL() << s.kind;
  }
}

TEST(Motions, AlmostRotationsBecomeRotations) {
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    Isometry3d pose = random.pose(1.0);
    for (int k = 0; k < 3; ++k) pose.linear().col(k) += 1e-7 * random.vector(1.0);
    for (const Isometry3d& at :
         {UniformMotion::still(pose).at(0.3), UniformMotion::interpolation(pose, pose).at(0.3),
          UniformMotion::screw(pose, pose).at(0.3)}) {
      EXPECT_LT((at.linear() * at.linear().transpose() - Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_LT((at.matrix() - pose.matrix()).norm(), 1e-6);
    }
  }
}

TEST(Motions, WithoutATimeHaveNoPose) {
  Random random(10);
  for (int kind = 0; kind < kKinds; ++kind) {
    const Sample s = makeSample(random, kind);
    for (const double t : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      EXPECT_FALSE(s.motion->at(t).matrix().allFinite()) << s.kind;
    }
  }
}

}  // namespace
