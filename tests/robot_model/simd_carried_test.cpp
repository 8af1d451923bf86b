// SPDX-License-Identifier: BSD-3-Clause
// Bounds on accelerations as robots of many bodies have them, from arms that all references share:
// against what centres of balls do, and against the bounds of robots with few bodies.
#include <gtest/gtest.h>

#include <utility>

#include "simd/compile/simd_references.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::kLanes;
using enum JointType;

std::vector<JointType> typesOf(Random& random) {
  std::vector<JointType> types{std::array{Revolute, Floating, Planar}[random.below(3)]};
  const int joints = 1 + random.below(20);
  for (int i = 0; i < joints; ++i)
    types.push_back(std::array{Revolute, Continuous, Revolute, Prismatic}[random.below(4)]);
  return types;
}

/// A tree whose bodies are all references, compiled as for few bodies and as for many.
struct Both {
  explicit Both(Random& random) {
    ChainOptions options;
    options.types = typesOf(random);
    options.link = random.scale(1e-3, 1e2);
    options.branches = random.chance(0.5) ? 0.4 : 0.0;
    model = robotOf(random, options);
    few = simdModelOf(model);
    std::vector<int> references;
    for (std::size_t body = 0; body < model.kinematics.bodies.size(); ++body)
      references.push_back(static_cast<int>(body));
    many = few;
    detail::compileReferences(model, references, few);
    detail::compileReferences(model, references, many, 0);
    const double turn = random.scale(0.01, 20.0);
    from = configuration(random, model.kinematics, turn, 3.0 * options.link);
    to = configuration(random, model.kinematics, turn, 3.0 * options.link);
    withFew.emplace(few);
    withMany.emplace(many);
    moves = StraightSimdMotion(few, model.kinematics, from, to, *withFew).compile() &&
            StraightSimdMotion(many, model.kinematics, from, to, *withMany).compile();
  }

  static std::pair<std::size_t, std::size_t> placeOf(int slot) {
    return {static_cast<std::size_t>(slot / kLanes), static_cast<std::size_t>(slot % kLanes)};
  }
  static float boundOf(const detail::SimdScratch& scratch, std::size_t reference, int slot) {
    const auto [row, lane] = placeOf(slot);
    return scratch.bounds[reference].acceleration[row].lane[lane];
  }

  detail::CheckerModel model;
  detail::SimdModel few, many;
  std::optional<detail::SimdScratch> withFew, withMany;
  std::vector<double> from, to;
  bool moves = false;
};

Real accelerationAt(const Both& robot, Real t, int body, int reference, const Vector& point,
                    Real step) {
  const auto at = [&](Real time) {
    return exactPoint(robot.model.kinematics, robot.from, robot.to, time, body, reference, point);
  };
  return (at(t + step) - 2 * at(t) + at(t - step)).norm() / (step * step);
}

TEST(SimdCarried, BoundsHoldAndAreHardlyMoreThanThoseOfFewBodies) {
  Random random(72);
  int compared = 0;
  double sum = 0.0;
  Real tightest = 0;
  for (int round = 0; round < 500; ++round) {
    const Both robot(random);
    if (!robot.moves) continue;
    ASSERT_EQ(robot.many.carried.size(), robot.model.kinematics.bodies.size());
    ASSERT_TRUE(robot.few.carried.empty());
    Real spins = 1, speeds = 0;
    for (const auto& motion : robot.withMany->motion) {
      spins += static_cast<Real>(motion.spin);
      speeds += static_cast<Real>(motion.speed);
    }
    const Real noise = 1e-7L * spins * (spins * static_cast<Real>(robot.few.reach) + speeds);
    for (std::size_t k = 0; k < robot.many.references.size(); ++k) {
      const detail::SimdReference& reference = robot.many.references[k];
      ASSERT_EQ(reference.slot, robot.few.references[k].slot);
      for (const int body : robot.many.allBodies) {
        const int slot = reference.slot[body];
        if (slot < 0) continue;
        const float bound = Both::boundOf(*robot.withMany, k, slot);
        const float other = Both::boundOf(*robot.withFew, k, slot);
        const Vector center =
            centerOf(robot.many, body, robot.many.nodes[robot.many.rootOfBody[body]]);
        const Real t = random.uniform(0.0, 1.0);
        const Real seen = accelerationAt(robot, t, body, reference.body, center, 1e-4L / spins);
        ASSERT_LE(seen, static_cast<Real>(bound) * (1 + 1e-7L) + noise)
            << "round " << round << ", body " << body << " from " << reference.body;
        // Both round outward.
        ASSERT_GE(bound, other * (1.0F - 1e-4F));
        if (!(static_cast<Real>(other) > 1e3L * noise)) continue;
        ASSERT_LE(bound, 2.0F * other);
        ++compared;
        sum += static_cast<double>(bound / other);
        tightest = std::max(tightest, seen / static_cast<Real>(bound));
      }
    }
  }
  RecordProperty("mean ratio", std::to_string(sum / compared));
  EXPECT_GT(compared, 10000);
  EXPECT_LT(sum / compared, 1.1);
  EXPECT_GT(tightest, 0.9L) << "the bound is idle";
}

}  // namespace
}  // namespace swept::simd_test
