// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "certify/motion_check.hpp"
#include "certify/state_check.hpp"
#include "model_robots.hpp"
#include "models_dir.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"
#include "swept/core/distance.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::WorkspaceData;

struct Case {
  const char* robot;
  const char* group;
  const char* scene;    ///< null: the sparse world
  double margin = 0.0;  ///< m
};

constexpr std::array<Case, 11> kCases{{
    {"rook7", "arm_with_gripper", "shelf.yaml"},
    {"rook7", "arm", "tunnel_trap.yaml"},
    {"rook7", "arm", "table_objects.yaml", 0.01},
    {"rook7", "arm_with_gripper", "empty.yaml"},
    {"rook6", "arm_with_tool", "bin.yaml"},
    {"rook6_cart", "whole_body", "table_objects.yaml"},
    {"rook6_cart", "whole_body", "cage.yaml"},
    {"drifter", "body", "cage.yaml"},
    {"drifter", "body", "narrow_slot.yaml", 0.005},
    {"rook7", "arm", nullptr},
    {"rook6_cart", "whole_body", nullptr},
}};

/// Thin things that fill little of the sets that stand for them in the lanes.
World sparseWorld() {
  Random random(50);
  World world;
  const auto somewhere = [&] {
    Eigen::Isometry3d pose = random.pose(0.0);
    pose.translation() = 0.7 * random.direction() + Eigen::Vector3d(0.0, 0.0, 0.6);
    return pose;
  };
  for (int i = 0; i < 3; ++i) {
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < 8; ++k) points.push_back(random.vector(0.25));
    world.add("cloud" + std::to_string(i), PointCloud::build(points, 0.003), somewhere());
    world.add("cone" + std::to_string(i), Cone{0.1, 0.1}, somewhere());
    world.add("sheet" + std::to_string(i),
              Triangle{{random.vector(0.3), random.vector(0.3), random.vector(0.3)}}, somewhere());
  }
  return world;
}

/// The checker, and the same without the SIMD tier.
struct Tiers {
  std::shared_ptr<const CheckerModel> lanes;
  CheckerModel exact;
};

Tiers compile(const Case& which) {
  const std::string folder = modelsDir() + "/";
  const auto loaded = test::modelRobot(which.robot);
  const auto world = std::make_shared<World>(
      which.scene == nullptr ? sparseWorld() : World::load(folder + "scenes/" + which.scene));
  CheckerOptions options;
  options.margin = which.margin;
  Tiers tiers;
  tiers.lanes = detail::compileChecker(loaded, *loaded->findGroup(which.group), world, options);
  tiers.exact = *tiers.lanes;
  tiers.exact.simd.usable = false;
  return tiers;
}

struct Motion {
  std::vector<double> from, to;
};

/// From anywhere to somewhere near or far. Some turn past their limits, some drive far away.
Motion motionOf(Random& random, const CheckerModel& model) {
  const detail::KinematicModel& kinematics = model.kinematics;
  Motion motion;
  const double step = random.scale(0.02, 1.0);
  const double far = random.chance(0.1) ? 200.0 : 1.2;
  for (int i = 0; i < kinematics.dimension; ++i) {
    const bool bounded = std::isfinite(kinematics.upper[i] - kinematics.lower[i]);
    const double low = bounded ? kinematics.lower[i] : -far;
    const double high = bounded ? kinematics.upper[i] : far;
    motion.from.push_back(random.uniform(low, high));
    motion.to.push_back((1.0 - step) * motion.from[i] + step * random.uniform(low, high));
  }
  for (const detail::MovingBody& body : kinematics.bodies) {
    if (!turns(body.type) || !random.chance(0.03)) continue;
    for (auto* values : {&motion.from, &motion.to})
      (*values)[body.variable] += random.uniform(-9.0, 9.0);
  }
  return motion;
}

/// Distances of shapes alone, in doubles, at one moment after the other. Where the bodies are is
/// not looked at here: kinematics have tests of their own.
class Geometry {
 public:
  Geometry(const CheckerModel& model, const Motion& motion)
      : model_(model), states_(model.kinematics.bodies.size()) {
    joints_.resize(states_.size());
    EXPECT_TRUE(detail::compileMotion(model.kinematics, motion.from, motion.to, joints_));
  }

  void moveTo(double t) {
    for (std::size_t body = 1; body < states_.size(); ++body)
      detail::evaluateBody(model_.kinematics, joints_, t, static_cast<int>(body), states_);
  }

  /// Whether two bodies touch, or are for sure nearer than the margin.
  bool anyWithin(double margin) const {
    for (std::size_t i = 0; i < model_.pairCount(); ++i)
      if (within(model_.pair(i), margin)) return true;
    return false;
  }

  /// Least distance of the geometry of two bodies, m.
  double distanceOf(const std::string& bodyA, const std::string& bodyB) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model_.pairCount(); ++i) {
      const detail::GeometryPair pair = model_.pair(i);
      if (model_.nameOfA(pair) != bodyA || model_.nameOfB(pair) != bodyB) continue;
      const auto& a = model_.robotGeometry[pair.a];
      least = std::min(least, distance(a.shape, shapeOfB(pair), between(pair)).upper);
    }
    return least;
  }

 private:
  Eigen::Isometry3d poseOf(int geometry) const {
    const auto& piece = model_.robotGeometry[geometry];
    return states_[piece.body].world_from_body * piece.body_from_shape;
  }
  const Shape& shapeOfB(const detail::GeometryPair& pair) const {
    return pair.self ? model_.robotGeometry[pair.b].shape : model_.worldGeometry[pair.b].shape;
  }
  Eigen::Isometry3d between(const detail::GeometryPair& pair) const {
    const Eigen::Isometry3d b =
        pair.self ? poseOf(pair.b) : model_.worldGeometry[pair.b].world_from_shape;
    return poseOf(pair.a).inverse() * b;
  }
  bool within(const detail::GeometryPair& pair, double margin) const {
    const auto& a = model_.robotGeometry[pair.a];
    const Eigen::Vector3d center = states_[a.body].world_from_body * a.center;
    if (!pair.self) {
      const auto& b = model_.worldGeometry[pair.b];
      const Eigen::Vector3d out = (b.box_from_world * center).cwiseAbs() - b.halfExtents;
      if (out.cwiseMax(0.0).norm() > a.radius + margin + 1e-6) return false;
    }
    if (margin > 0.0) {
      const double surely = margin - 1e-9;
      const DistanceOptions options{.enough = margin, .contact = 0.999 * surely};
      return distance(a.shape, shapeOfB(pair), between(pair), options).upper < surely;
    }
    return collide(a.shape, shapeOfB(pair), between(pair)) == Contact::Touching;
  }

  const CheckerModel& model_;
  std::vector<detail::JointMotion> joints_;
  std::vector<detail::BodyState> states_;
};

bool same(const MotionCertificate& a, const MotionCertificate& b) {
  const bool alike = a.verdict == b.verdict && a.freeUntil == b.freeUntil &&
                     a.undecidedAt == b.undecidedAt && a.effort.intervals == b.effort.intervals &&
                     a.effort.distances == b.effort.distances &&
                     a.effort.culled == b.effort.culled && a.effort.lanes == b.effort.lanes &&
                     a.witness.has_value() == b.witness.has_value();
  if (!alike || !a.witness) return alike;
  return a.witness->t == b.witness->t && a.witness->bodyA == b.witness->bodyA &&
         a.witness->bodyB == b.witness->bodyB && a.witness->pointA == b.witness->pointA &&
         a.witness->pointB == b.witness->pointB && a.witness->distance == b.witness->distance;
}

struct Tally {
  int asked = 0;
  int free = 0;
  int collision = 0;
  int undecided = 0;
  int inLanes = 0;  ///< settled without the exact tier
};

/// All motions of a case on the instruction set that is chosen.
class Conformance {
 public:
  Conformance(const Tiers& tiers, double margin)
      : tiers_(tiers), margin_(margin), used_(*tiers.lanes), exactWork_(tiers.exact) {}

  void check(const Motion& motion, Tally& tally) {
    const auto expected = ask(tiers_.exact, motion, MotionQuery::VerdictOnly, exactWork_);
    for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
      const auto found = ask(*tiers_.lanes, motion, query, used_);
      WorkspaceData fresh(*tiers_.lanes);
      EXPECT_TRUE(same(found, ask(*tiers_.lanes, motion, query, fresh)))
          << "a used workspace answers differently";
      compare(expected, found, motion);
      if (query == MotionQuery::VerdictOnly) count(found, tally);
    }
    checkState(motion);
  }

 private:
  static MotionCertificate ask(const CheckerModel& model, const Motion& motion, MotionQuery query,
                               WorkspaceData& workspace) {
    return detail::certifyMotion(model, motion.from, motion.to, query, workspace);
  }

  static void count(const MotionCertificate& found, Tally& tally) {
    ++tally.asked;
    tally.free += found.verdict == Verdict::Free ? 1 : 0;
    tally.collision += found.verdict == Verdict::Collision ? 1 : 0;
    tally.undecided += found.verdict == Verdict::Undecided ? 1 : 0;
    tally.inLanes += found.effort.intervals == 0 ? 1 : 0;
  }

  void compare(const MotionCertificate& expected, const MotionCertificate& found,
               const Motion& motion) {
    if (found.verdict != expected.verdict) {
      const bool open =
          found.verdict == Verdict::Undecided || expected.verdict == Verdict::Undecided;
      ASSERT_TRUE(open) << "one tier has a proof, the other a witness";
      // Only what comes within the tolerance may be left open.
      const double tolerance = tiers_.exact.options.tolerance;
      const detail::StraightPath path(tiers_.exact.kinematics, motion.from, motion.to);
      const MotionClearance clearance = detail::motionClearance(tiers_.exact, path, 0.1 * tolerance,
                                                                ClearanceQuery::Least, exactWork_);
      EXPECT_LE(clearance.lower, margin_ + tolerance);
    }
    Geometry geometry(tiers_.exact, motion);
    refute(found.verdict == Verdict::Free ? 1.0 : found.freeUntil, geometry);
    if (found.verdict != Verdict::Collision) return;
    ASSERT_TRUE(found.witness);
    geometry.moveTo(found.witness->t);
    EXPECT_LE(geometry.distanceOf(found.witness->bodyA, found.witness->bodyB), margin_ + 1e-9);
  }

  /// A proof of [0, until] holds at every t in it.
  void refute(double until, Geometry& geometry) const {
    if (!(until > 0.0)) return;
    constexpr int kSamples = 8;
    for (int i = 0; i <= kSamples; ++i) {
      // Before until: there the contact may be.
      geometry.moveTo(until * (1.0 - 1e-9) * i / kSamples);
      EXPECT_FALSE(geometry.anyWithin(margin_)) << "not free where it is proven";
    }
  }

  void checkState(const Motion& motion) {
    const Verdict expected = detail::checkState(tiers_.exact, motion.from, exactWork_);
    WorkspaceData fresh(*tiers_.lanes);
    const Verdict found = detail::checkState(*tiers_.lanes, motion.from, used_);
    EXPECT_EQ(found, detail::checkState(*tiers_.lanes, motion.from, fresh));
    if (found == expected) return;
    EXPECT_TRUE(found == Verdict::Undecided || expected == Verdict::Undecided);
    EXPECT_LE(detail::stateClearance(tiers_.exact, motion.from, exactWork_), margin_ + 1e-6);
  }

  const Tiers& tiers_;
  double margin_;
  WorkspaceData used_;
  WorkspaceData exactWork_;
};

class SimdConformance : public testing::TestWithParam<Case> {};

TEST_P(SimdConformance, EveryTargetAgreesWithExactGeometry) {
  const Tiers tiers = compile(GetParam());
  ASSERT_TRUE(tiers.lanes->simd.usable);
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Random random(51);
    Conformance conformance(tiers, GetParam().margin);
    Tally tally;
    constexpr int kMotions = 100;
    for (int i = 0; i < kMotions; ++i) {
      SCOPED_TRACE(i);
      conformance.check(motionOf(random, *tiers.lanes), tally);
    }
    RecordProperty(std::string("tally_") + hwy::TargetName(target),
                   std::to_string(tally.free) + " free, " + std::to_string(tally.collision) +
                       " collision, " + std::to_string(tally.undecided) + " undecided, " +
                       std::to_string(tally.inLanes) + " in lanes");
    EXPECT_GT(tally.free, kMotions / 20);
    EXPECT_GT(tally.collision, kMotions / 50);
    // In the sparse world most is open to the exact tier.
    const double share = GetParam().scene == nullptr ? 0.2 : 0.7;
    EXPECT_GT(tally.inLanes, share * kMotions) << "the lanes settle next to nothing";
    EXPECT_LT(tally.undecided, kMotions / 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, SimdConformance, testing::ValuesIn(kCases), [](const auto& which) {
  std::string name = which.param.robot;
  return name + "_" + std::to_string(which.index);
});

/// What cannot be checked is not free on any target.
TEST(SimdConformanceInput, WhatIsNoNumberIsNeverProven) {
  const Tiers tiers = compile(kCases[3]);
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    WorkspaceData workspace(*tiers.lanes);
    const std::vector<double> rest(tiers.lanes->kinematics.dimension, 0.01);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        std::vector<double> bad = rest;
        bad[i] = value;
        for (const auto& [from, to] : {std::pair{rest, bad}, {bad, rest}, {bad, bad}}) {
          const auto found =
              detail::certifyMotion(*tiers.lanes, from, to, MotionQuery::FirstContact, workspace);
          EXPECT_EQ(found.verdict, Verdict::Undecided);
          EXPECT_EQ(found.freeUntil, 0.0);
        }
        EXPECT_EQ(detail::checkState(*tiers.lanes, bad, workspace), Verdict::Undecided);
      }
    }
  }
}

}  // namespace
}  // namespace swept::simd_test
