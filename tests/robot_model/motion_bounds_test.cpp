// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/tolerances.hpp"

namespace {

/// Frames and velocities of all bodies at t.
void evaluateAll(const swept::detail::KinematicModel& model,
                 std::span<const swept::detail::JointMotion> motion, double t,
                 std::span<swept::detail::BodyState> states) {
  states[0] = {};
  for (std::size_t i = 1; i < model.bodies.size(); ++i)
    swept::detail::evaluateBody(model, motion, t, static_cast<int>(i), states);
}

using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::JointType;
using swept::detail::BodyState;
using swept::detail::JointMotion;
using swept::detail::KinematicModel;
using swept::detail::LeverArms;
using swept::detail::MovingBody;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Isometry3d pose(double size) {
    Isometry3d result = Isometry3d::Identity();
    result.linear() = Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 0.3)
                          .normalized()
                          .toRotationMatrix();
    result.translation() = vector(size);
    return result;
  }

 private:
  std::mt19937 engine_;
};

/// A serial chain of the given joint types with random geometry.
KinematicModel chain(Random& random, const std::vector<JointType>& types) {
  KinematicModel model;
  model.bodies.emplace_back();
  for (const JointType type : types) {
    MovingBody body;
    body.parent = static_cast<int>(model.bodies.size()) - 1;
    body.type = type;
    body.parent_from_joint = random.pose(0.4);
    body.axis = random.vector(1.0).normalized();
    body.planarBasis = swept::axisFrame(body.axis);
    body.variable = model.dimension;
    body.lower = -0.3;
    body.upper = 0.5;
    const int count = type == JointType::Planar ? 3 : type == JointType::Floating ? 7 : 1;
    for (int i = 0; i < count; ++i) {
      const bool angle = type == JointType::Continuous || (type == JointType::Planar && i == 2);
      model.cyclic.push_back(angle);
    }
    model.dimension += count;
    model.bodies.push_back(body);
  }
  return model;
}

std::vector<double> configuration(Random& random, const KinematicModel& model) {
  std::vector<double> q;
  for (const MovingBody& body : model.bodies) {
    switch (body.type) {
      case JointType::Prismatic:
        q.push_back(random.uniform(body.lower, body.upper));
        break;
      case JointType::Revolute:
      case JointType::Continuous:
        q.push_back(random.uniform(-3.1, 3.1));
        break;
      case JointType::Planar:
        for (int i = 0; i < 3; ++i) q.push_back(random.uniform(-1.0, 1.0));
        break;
      case JointType::Floating: {
        for (int i = 0; i < 3; ++i) q.push_back(random.uniform(-1.0, 1.0));
        const Eigen::Quaterniond turn(random.pose(0.0).linear());
        for (int i = 0; i < 4; ++i) q.push_back(turn.coeffs()[i]);
        break;
      }
      case JointType::Fixed:
        break;
    }
  }
  return q;
}

const std::vector<std::vector<JointType>>& chains() {
  using enum JointType;
  static const std::vector<std::vector<JointType>> kChains{
      {Revolute, Revolute, Revolute, Revolute, Revolute, Revolute, Revolute},
      {Prismatic, Revolute, Prismatic, Revolute},
      {Continuous, Prismatic, Continuous, Revolute},
      {Planar, Revolute, Revolute},
      {Floating, Revolute, Prismatic},
      {Revolute, Planar, Revolute},
      {Revolute, Floating, Revolute},
      {Floating},
      {Planar},
      {Prismatic},
  };
  return kChains;
}

/// For random chains, motions and points of a ball: the velocity field matches finite differences,
/// and the lever-arm bounds hold relative to the model frame and to every ancestor. The largest
/// ratio found shows that the bounds are not idle.
TEST(MotionBounds, HoldAgainstFiniteDifferences) {
  Random random(3);
  double tightest = 0.0;
  for (int round = 0; round < 400; ++round) {
    const KinematicModel model = chain(random, chains()[round % chains().size()]);
    const int last = static_cast<int>(model.bodies.size()) - 1;
    const Vector3d center = random.vector(0.3);
    const double radius = random.uniform(0.0, 0.2);
    const LeverArms levers = swept::detail::leverArms(model, last, center, radius);
    const auto from = configuration(random, model);
    const auto to = configuration(random, model);
    std::vector<JointMotion> motion(model.bodies.size());
    ASSERT_TRUE(swept::detail::compileMotion(model, from, to, motion));
    std::vector<std::vector<BodyState>> states(3, std::vector<BodyState>(model.bodies.size()));
    const double step = 1e-4;
    const double t = random.uniform(0.01, 0.99);
    for (int k = 0; k < 3; ++k) {
      evaluateAll(model, motion, t + (k - 1) * step, states[k]);
    }
    const Vector3d point = center + random.uniform(0.0, radius) * random.vector(1.0).normalized();

    std::vector<double> arms(levers.path.size());
    swept::detail::motionArms(model, last, center, radius, motion, arms);
    for (std::size_t first = 0; first < levers.path.size(); ++first) {
      const int reference = first == 0 ? 0 : levers.path[first - 1];
      std::array<Vector3d, 3> seen;  // the point in the reference body's frame
      for (int k = 0; k < 3; ++k) {
        seen[k] = states[k][reference].world_from_body.inverse() *
                  (states[k][last].world_from_body * point);
      }
      const Vector3d velocity = (seen[2] - seen[0]) / (2 * step);
      const Vector3d acceleration = (seen[2] - 2 * seen[1] + seen[0]) / (step * step);
      const auto bound = swept::detail::pointMotionBound(model, levers.path, arms, first, motion);
      EXPECT_LE(velocity.norm(), bound.speed + 1e-5);
      EXPECT_LE(acceleration.norm(), bound.acceleration + 1e-4);
      if (bound.acceleration > 0.1) {
        tightest = std::max(tightest, acceleration.norm() / bound.acceleration);
      }
      const BodyState& base = states[1][reference];
      const BodyState& tip = states[1][last];
      const Vector3d world = tip.world_from_body * point;
      const Vector3d field = base.world_from_body.linear().transpose() *
                             (tip.linear - base.linear + (tip.angular - base.angular).cross(world));
      EXPECT_LT((field - velocity).norm(), 1e-5 * (1.0 + velocity.norm()));
    }
  }
  EXPECT_GT(tightest, 0.8);
  EXPECT_LE(tightest, 1.0 + 1e-6);
}

/// Stretched out, with joints that turn the same way about parallel axes, an arm accelerates as
/// much as any with such joints does.
TEST(MotionBounds, AreReachedByAPlanarArm) {
  const double length = 0.5;
  const std::vector<double> rates{0.7, 0.2, 1.3, 0.4};
  KinematicModel model;
  model.bodies.emplace_back();
  std::vector<double> to;
  double turning = 0.0, truth = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    MovingBody body;
    body.parent = static_cast<int>(i);
    body.type = JointType::Revolute;
    body.axis = sign * Vector3d::UnitZ();
    body.parent_from_joint = Eigen::Translation3d(i == 0 ? 0.0 : length, 0.0, 0.0);
    body.variable = model.dimension++;
    body.lower = -2.0;
    body.upper = 2.0;
    model.cyclic.push_back(false);
    model.bodies.push_back(body);
    to.push_back(sign * rates[i]);
    turning += rates[i];
    truth += length * turning * turning;
  }
  const std::vector<double> from(rates.size(), 0.0);
  std::vector<JointMotion> motion(model.bodies.size());
  ASSERT_TRUE(swept::detail::compileMotion(model, from, to, motion));
  const int last = static_cast<int>(rates.size());
  const LeverArms levers = swept::detail::leverArms(model, last, Vector3d(length, 0.0, 0.0), 0.0);
  const auto bound = swept::detail::pointMotionBound(model, levers.path, levers.arms, 0, motion);
  EXPECT_GE(bound.acceleration, truth);
  EXPECT_LE(bound.acceleration, 1.001 * truth);
}

/// A turntable, and on it a base that drives outwards.
TEST(MotionBounds, CountWhatABaseMovesAbout) {
  KinematicModel model;
  model.bodies.emplace_back();
  for (const JointType type : {JointType::Revolute, JointType::Planar}) {
    MovingBody body;
    body.parent = static_cast<int>(model.bodies.size()) - 1;
    body.type = type;
    body.axis = Vector3d::UnitZ();
    body.planarBasis = Eigen::Matrix3d::Identity();
    body.variable = model.dimension;
    body.lower = -2.0;
    body.upper = 2.0;
    model.dimension += type == JointType::Planar ? 3 : 1;
    model.bodies.push_back(body);
  }
  model.cyclic = {false, false, false, true};
  std::vector<JointMotion> motion(model.bodies.size());
  const std::vector<double> from{0.0, 3.0, 0.0, 0.0}, to{1.0, 5.0, 0.0, 0.0};
  ASSERT_TRUE(swept::detail::compileMotion(model, from, to, motion));
  const LeverArms levers = swept::detail::leverArms(model, 2, Vector3d::Zero(), 0.0);
  const auto bound = swept::detail::pointMotionBound(model, levers.path, levers.arms, 0, motion);
  EXPECT_GE(bound.speed, std::hypot(2.0, 5.0 * 1.0));               // at the end
  EXPECT_GE(bound.acceleration, std::hypot(5.0 * 1.0, 2.0 * 2.0));  // and Coriolis'
}

/// A base so far out that a sum of both slides loses the second one's, which carries the point away
/// from the axis that the first one turns about.
TEST(MotionBounds, KeepASmallSlideBesideALargeOne) {
  for (const JointType type : {JointType::Planar, JointType::Floating}) {
    KinematicModel model;
    model.bodies.emplace_back();
    for (const JointType joint : {JointType::Planar, type}) {
      MovingBody body;
      body.parent = static_cast<int>(model.bodies.size()) - 1;
      body.type = joint;
      body.axis = Vector3d::UnitZ();
      body.planarBasis = Eigen::Matrix3d::Identity();
      body.variable = model.dimension;
      model.dimension += joint == JointType::Planar ? 3 : 7;
      model.bodies.push_back(body);
    }
    model.cyclic.assign(static_cast<std::size_t>(model.dimension), false);
    std::vector<double> from{1e18, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    from.resize(static_cast<std::size_t>(model.dimension));
    std::vector<double> to = from;
    to[2] = 1.0;
    std::vector<JointMotion> motion(model.bodies.size());
    ASSERT_TRUE(swept::detail::compileMotion(model, from, to, motion));
    const LeverArms levers = swept::detail::leverArms(model, 2, Vector3d::Zero(), 0.0);
    const auto bound = swept::detail::pointMotionBound(model, levers.path, levers.arms, 0, motion);
    EXPECT_GE(bound.speed, 5.0);
    EXPECT_LE(bound.speed, 5.01);
    EXPECT_GE(bound.acceleration, 5.0);
    EXPECT_LE(bound.acceleration, 5.01);
  }
}

TEST(MotionBounds, ReachHoldsOverAllConfigurations) {
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    using enum JointType;
    const KinematicModel model =
        chain(random, round % 2 ? std::vector{Revolute, Prismatic, Revolute, Continuous}
                                : std::vector{Revolute, Revolute, Revolute});
    const int last = static_cast<int>(model.bodies.size()) - 1;
    const Vector3d center = random.vector(0.3);
    const LeverArms levers = swept::detail::leverArms(model, last, center, 0.1);
    const Vector3d base = model.bodies[1].parent_from_joint.translation();
    for (int i = 0; i < 50; ++i) {
      const auto q = configuration(random, model);
      std::vector<JointMotion> motion(model.bodies.size());
      ASSERT_TRUE(swept::detail::compileMotion(model, q, q, motion));
      std::vector<BodyState> states(model.bodies.size());
      evaluateAll(model, motion, 0.0, states);
      const Vector3d tip = states[last].world_from_body * center;
      EXPECT_LE(tip.norm() + 0.1, levers.span);
      EXPECT_LE((tip - base).norm() + 0.1, levers.reachFromBase);
      // Distance from each axis, the quantity the arms bound.
      for (std::size_t k = 0; k < levers.path.size(); ++k) {
        const MovingBody& body = model.bodies[levers.path[k]];
        if (body.type == Prismatic) continue;
        const Isometry3d& frame = states[levers.path[k]].world_from_body;
        const Vector3d axis = frame.linear() * body.axis;
        EXPECT_LE(axis.cross(tip - frame.translation()).norm() + 0.1, levers.arms[k] + 1e-12);
      }
    }
  }
}

/// Poses in doubles against the same product in 80-bit floats: the error stays below what the
/// checker adds to every required separation, for short and for long chains, near the origin and
/// far from it.
TEST(MotionModel, PosesAreWithinTheRoundingBound) {
  using Pose = Eigen::Transform<long double, 3, Eigen::Isometry>;
  using Vector = Eigen::Matrix<long double, 3, 1>;
  Random random(6);
  double worst = 0.0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t joints = round % 3 == 0 ? 50 : 7;
    KinematicModel model = chain(random, std::vector(joints, JointType::Revolute));
    model.bodies[1].parent_from_joint.translation() *= round % 2 == 0 ? 1.0 : 1e3;
    const auto from = configuration(random, model);
    const auto to = configuration(random, model);
    std::vector<JointMotion> motion(model.bodies.size());
    ASSERT_TRUE(swept::detail::compileMotion(model, from, to, motion));
    std::vector<BodyState> states(model.bodies.size());
    const double t = random.uniform(0.0, 1.0);
    evaluateAll(model, motion, t, states);
    Pose exact = Pose::Identity();
    for (std::size_t i = 1; i <= joints; ++i) {
      const MovingBody& body = model.bodies[i];
      const long double angle =
          static_cast<long double>(from[i - 1]) +
          static_cast<long double>(t) *
              (static_cast<long double>(to[i - 1]) - static_cast<long double>(from[i - 1]));
      const Vector axis = body.axis.cast<long double>().normalized();
      exact = exact * Pose(body.parent_from_joint.cast<long double>()) *
              Eigen::AngleAxis<long double>(angle, axis);
    }
    const int last = static_cast<int>(joints);
    const Vector3d point = random.vector(0.3);
    const Vector error = exact * point.cast<long double>() -
                         (states[last].world_from_body * point).cast<long double>();
    const LeverArms levers = swept::detail::leverArms(model, last, point, 0.0);
    const double bound =
        swept::tolerance::kRoundingPerJoint * levers.span * static_cast<double>(joints + 2);
    worst = std::max(worst, static_cast<double>(error.norm()) / bound);
  }
  EXPECT_LT(worst, 0.25) << "less than a factor of four is left";
  EXPECT_GT(worst, 1e-4) << "the bound is idle";
}

TEST(MotionModel, RefusesWhatItCannotBound) {
  Random random(5);
  const KinematicModel model = chain(random, {JointType::Prismatic, JointType::Floating});
  std::vector<JointMotion> motion(model.bodies.size());
  const std::vector<double> good{0.1, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_TRUE(swept::detail::compileMotion(model, good, good, motion));
  std::vector<double> bad = good;
  bad[0] = 0.6;  // outside the limits its lever arms were computed for
  EXPECT_FALSE(swept::detail::compileMotion(model, good, bad, motion));
  bad = good;
  bad[7] = 0.0;  // a quaternion without direction
  EXPECT_FALSE(swept::detail::compileMotion(model, bad, good, motion));
  bad = good;
  bad[2] = std::nan("");
  EXPECT_FALSE(swept::detail::compileMotion(model, good, bad, motion));
}

}  // namespace
