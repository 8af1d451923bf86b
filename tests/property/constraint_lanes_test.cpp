// SPDX-License-Identifier: BSD-3-Clause
// Sub-intervals in which lanes of single precision prove a constraint, on each instruction set,
// against an own reading of it in extended precision.
#include "simd/kernels/constraint_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "certify/checker_model.hpp"
#include "constraints/campaign.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd_targets.hpp"
#include "swept/core/tolerances.hpp"

namespace {

using namespace constraints;
using swept::detail::kLanes;

constexpr int kSamples = 24;  // of a sub-interval

struct LaneTally {
  int motions = 0, kept = 0, left = 0, broken = 0, near = 0, kinds[kKinds] = {};
  std::string text() const {
    return std::to_string(motions) + " motions, lanes " + std::to_string(kept) + " kept (" +
           std::to_string(near) + " near), " + std::to_string(left) + " left, " +
           std::to_string(broken) + " broken";
  }
};

/// For each value of the group, its index among those of the case.
std::vector<double> ordered(const Case& of, const swept::detail::CheckerModel& model,
                            const std::vector<double>& q) {
  std::vector<double> own;
  const swept::Robot& robot = *model.robot;
  for (const int variable : model.group.variables) {
    const swept::Joint& joint = robot.joints()[static_cast<std::size_t>(
        robot.variables()[static_cast<std::size_t>(variable)].joint)];
    const auto index = static_cast<std::size_t>(std::stoi(joint.name.substr(1)));
    own.push_back(
        q[static_cast<std::size_t>(of.robot.joints[index].first + variable - joint.firstVariable)]);
  }
  return own;
}

/// The case's constraints one by one, in the model's order.
Real excessOfOne(const Case& of, const swept::detail::CompiledConstraint& own,
                 const std::vector<Real>& q) {
  using Kind = swept::ConstraintViolation::Kind;
  switch (own.kind) {
    case Kind::Joint:
      return excessOfJoint(of.robot, of.constraint.joints[own.index], q);
    case Kind::Position:
      return excessOf(of.robot, of.constraint.positions[own.index], q);
    case Kind::Orientation:
      return excessOf(of.robot, of.constraint.orientations[own.index], q);
    case Kind::Axis:
      break;
  }
  return excessOf(of.robot, of.constraint.axes[own.index], q);
}

/// The largest excess of a constraint in an eighth.
Real most(const Case& of, const swept::detail::CompiledConstraint& own, int lane) {
  Real found = -std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= kSamples; ++i)
    found = std::max(
        found, excessOfOne(of, own, of.at((lane + static_cast<Real>(i) / kSamples) / kLanes)));
  return found;
}

void judge(std::uint64_t index, LaneTally& tally) {
  const Case of = makeCase(77, index);
  if (of.curve || of.inTube) return;
  const auto robot = swept::Robot::parse(of.robot.urdf(), "random.urdf");
  swept::CheckerOptions options;
  options.constraints = of.constraint;
  const auto model = swept::detail::compileChecker(robot, robot->groups().front(),
                                                   std::make_shared<const swept::World>(), options);
  const std::size_t count = model->laneConstraints.constraints.size();
  if (count == 0) return;
  const std::vector<double> from = ordered(of, *model, of.from), to = ordered(of, *model, of.to);
  swept::detail::SimdScratch scratch(model->simd);
  std::vector<swept::detail::JointMotion> joints(model->kinematics.bodies.size());
  const swept::detail::StraightPath path(model->kinematics, from, to);
  swept::detail::SimdMotion motion(model->simd, model->kinematics, path, joints, scratch);
  if (!motion.compile()) return;
  motion.placeEighths();
  motion.setMoving();
  std::vector<std::uint8_t> kept(count);
  findKeptLanes(model->laneConstraints, model->simd, motion.extent(), scratch, kept);
  ++tally.motions;
  for (std::size_t i = 0; i < count; ++i)
    for (int lane = 0; lane < kLanes; ++lane) {
      const Real excess = most(of, model->constraints.constraints[i], lane);
      const bool holds = (kept[i] >> lane & 1) != 0;
      tally.broken += excess > 0 ? 1 : 0;
      if (!holds) {
        tally.left += excess <= 0 ? 1 : 0;
        continue;
      }
      ++tally.kept;
      ++tally.kinds[static_cast<int>(of.kind)];
      tally.near += excess > -0.05L * of.length() ? 1 : 0;
      EXPECT_LE(excess, 0) << "case " << index << ", constraint " << i << ", lane " << lane;
    }
}

TEST(ConstraintLanes, KeepWhatTheySay) {
  swept::simd_test::tallyOnAllTargets<LaneTally>([](LaneTally& tally) {
    for (std::uint64_t i = 0; i < 1500; ++i) judge(i, tally);
    EXPECT_GT(tally.motions, 500) << tally.text();
    EXPECT_GT(tally.kept, 3 * tally.left) << tally.text();
    EXPECT_GT(8 * tally.broken, tally.kept) << tally.text();
    EXPECT_GT(20 * tally.near, tally.kept) << tally.text();
    for (int kind = static_cast<int>(Kind::Box); kind < kKinds; ++kind)
      EXPECT_GT(tally.kinds[kind], 200) << kind;
  });
}

/// A link of 1 m along x that turns about y: the bound on its acceleration is no larger than that.
/// The ends of a motion are off by far less than what its sub-intervals' curvature is.
TEST(ConstraintLanes, CountAllOfACurvature) {
  const auto robot = swept::Robot::parse(
      "<robot name='one'><link name='base'/><link name='arm'/>"
      "<joint name='turn' type='revolute'><parent link='base'/><child link='arm'/>"
      "<axis xyz='0 1 0'/><limit lower='-3' upper='3' velocity='1' effort='1'/></joint></robot>",
      "one.urdf");
  const auto verdict = [&robot](const swept::TaskConstraint& constraint, double angle) {
    swept::CheckerOptions options;
    options.constraints = constraint;
    const swept::Checker checker(robot, "all", std::make_shared<const swept::World>(), options);
    swept::Workspace workspace(checker);
    return checker.certifyMotion(std::vector{-angle}, std::vector{angle}, workspace).verdict;
  };
  const auto boxFrom = [](double lowest) {
    Eigen::Isometry3d center = Eigen::Isometry3d::Identity();
    center.translation().x() = lowest + 1.0;
    return swept::TaskConstraint::inside("arm", {2, 4, 4}, center, {1, 0, 0});
  };
  for (const std::int64_t target : swept::simd_test::simdTargets()) {
    const swept::simd_test::OnTarget on(target);
    for (const double angle : {0.2, 0.4, 0.8}) {
      const double off = 0.05 * (angle / 8) * (angle / 8);
      EXPECT_EQ(verdict(boxFrom(std::cos(angle) + off), angle), swept::Verdict::Violation);
      EXPECT_EQ(verdict(boxFrom(std::cos(angle) - off), angle), swept::Verdict::Free);
      EXPECT_EQ(verdict(swept::TaskConstraint::upright("arm", angle - off), angle),
                swept::Verdict::Violation);
      EXPECT_EQ(verdict(swept::TaskConstraint::upright("arm", angle + off), angle),
                swept::Verdict::Free);
    }
  }
}

}  // namespace
