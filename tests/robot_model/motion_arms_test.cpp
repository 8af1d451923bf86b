// SPDX-License-Identifier: BSD-3-Clause
// Arms over one motion, and arms that are linear in what slides: no point gets farther from an
// axis, and the limits have no part in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "simd_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::JointMotion;
using detail::KinematicModel;
using detail::RestArms;
using enum JointType;

/// A chain that ends in a ball, and a motion of it.
class MovingChain {
 public:
  explicit MovingChain(Random& random) {
    ChainOptions options;
    options.types.resize(2 + random.below(6));
    for (JointType& type : options.types) type = random.chance(0.5) ? Prismatic : Continuous;
    if (random.chance(0.2)) options.types.front() = Floating;
    options.straight = random.chance(0.2);
    options.mimics = 0.0;
    model.bodies.emplace_back();
    for (const JointType type : options.types) addBody(random, options, type, model);
    last = static_cast<int>(model.bodies.size()) - 1;
    center = random.vector(0.3);
    radius = random.uniform(0.0, 0.2);
    from = configuration(random, model, 3.0, 1.0);
    to = configuration(random, model, 3.0, 1.0);
    motion.resize(model.bodies.size());
    moves = detail::compileMotion(model, from, to, motion);
  }

  void setLimits(double limit) {
    for (detail::MovingBody& body : model.bodies) {
      body.lower = -limit;
      body.upper = limit;
    }
  }

  std::vector<double> arms() const {
    std::vector<double> found(static_cast<std::size_t>(last));
    detail::motionArms(model, last, center, radius, motion, found);
    return found;
  }
  std::vector<double> linearArms() const {
    const RestArms rest = detail::restArms(model, last, center, radius);
    std::vector<double> found = rest.arms;
    for (const RestArms::Growth& growth : rest.growths)
      found[growth.joint] += growth.share * motion[growth.slide].slid();
    return found;
  }
  /// m, of the ball at t from the axis of a joint that turns, or from its middle.
  double distance(Real t, int body) const {
    const Vector at = exactPoint(model, from, to, t, last, body, center.cast<Real>());
    const detail::MovingBody& joint = model.bodies[body];
    const Vector across = joint.type == Floating ? at : Vector(joint.axis.cast<Real>().cross(at));
    return static_cast<double>(across.norm()) + radius;
  }

  KinematicModel model;
  int last = 0;
  Eigen::Vector3d center;
  double radius = 0.0;
  std::vector<double> from, to;
  std::vector<JointMotion> motion;
  bool moves = false;
};

TEST(MotionArms, HoldOverTheMotion) {
  Random random(31);
  int compared = 0, reached = 0, reachedLinearly = 0;
  for (int round = 0; round < 3000; ++round) {
    MovingChain chain(random);
    ASSERT_TRUE(chain.moves);
    chain.setLimits(random.scale(1.0, 1e16));
    const std::vector<double> arms = chain.arms(), linear = chain.linearArms();
    for (int body = 1; body <= chain.last; ++body) {
      if (chain.model.bodies[body].type == Prismatic) continue;
      const auto joint = static_cast<std::size_t>(body) - 1;
      double farthest = 0.0;
      for (const double t : {0.0, random.uniform(0.0, 1.0), 1.0})
        farthest = std::max(farthest, chain.distance(t, body));
      ASSERT_LE(farthest, arms[joint] * (1.0 + 1e-15)) << "round " << round << ", joint " << body;
      ASSERT_LE(farthest, linear[joint]) << "round " << round << ", joint " << body;
      ++compared;
      reached += farthest > 0.9 * arms[joint] ? 1 : 0;
      reachedLinearly += farthest > 0.9 * linear[joint] ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 4000);
  EXPECT_GT(reached, compared / 5);
  EXPECT_GT(reachedLinearly, compared / 10);
}

/// What slides along an axis does not get farther from it.
TEST(MotionArms, DoNotGrowAlongAnAxis) {
  Random random(32);
  ChainOptions options;
  options.types = {Continuous, Continuous, Prismatic};
  options.straight = true;
  KinematicModel model;
  model.bodies.emplace_back();
  for (const JointType type : options.types) addBody(random, options, type, model);
  for (const RestArms::Growth& growth : detail::restArms(model, 3, {0.1, 0.0, 0.0}, 0.05).growths)
    EXPECT_LT(growth.share, 1e-13);
}

TEST(MotionArms, AreTheSameWithinAnyLimits) {
  Random random(33);
  int varied = 0;
  for (int round = 0; round < 300; ++round) {
    MovingChain chain(random);
    chain.setLimits(1.0);
    const auto narrow = detail::leverArms(chain.model, chain.last, chain.center, chain.radius);
    const std::vector<double> arms = chain.arms(), linear = chain.linearArms();
    chain.setLimits(1e16);
    const auto wide = detail::leverArms(chain.model, chain.last, chain.center, chain.radius);
    EXPECT_EQ(chain.arms(), arms);
    EXPECT_EQ(chain.linearArms(), linear);
    EXPECT_EQ(wide.spanAtRest, narrow.spanAtRest);
    EXPECT_EQ(wide.vary, narrow.vary);
    varied += narrow.vary ? 1 : 0;
  }
  EXPECT_GT(varied, 100);
}

}  // namespace
}  // namespace swept::simd_test
