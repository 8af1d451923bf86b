// SPDX-License-Identifier: BSD-3-Clause
// Paths whose rates change go through both tiers, and no state on the way refutes what these say.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "certify/motion_check.hpp"
#include "certify/signed_clearance.hpp"
#include "certify/state_check.hpp"
#include "kinematics/nested_motion_bounds.hpp"
#include "model_robots.hpp"
#include "models_dir.hpp"
#include "quadratic_path.hpp"
#include "simd_robots.hpp"
#include "swept/robot_model/world.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::WorkspaceData;
using test::QuadraticPath;

struct Case {
  const char* robot;
  const char* group;
  const char* scene;
  double margin = 0.0;   ///< m
  bool passing = false;  ///< beside a box that passes by
};

constexpr std::array<Case, 7> kCases{{
    {"rook7", "arm_with_gripper", "shelf.yaml"},
    {"rook7", "arm", "table_objects.yaml", 0.01},
    {"rook7", "arm", "tunnel_trap.yaml"},
    {"rook6", "arm_with_tool", "bin.yaml"},
    {"rook6_cart", "whole_body", "table_objects.yaml"},
    {"rook6_cart", "whole_body", "cage.yaml"},
    {"rook7", "arm", "empty.yaml", 0.0, true},
}};

/// Of all cases together; SWEPT_CURVED_MOTIONS asks for another number.
int wantedMotions() {
  const char* const text = std::getenv("SWEPT_CURVED_MOTIONS");
  return text == nullptr ? 100'002 : std::atoi(text);
}

MovingObstacle passingBox() {
  MovingObstacle box{.name = "passing",
                     .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}}};
  for (const double time : {0.0, 0.3, 0.7, 1.0}) {
    const Eigen::Vector3d place(0.7, 2.0 * (time - 0.5), 0.4 + 0.3 * time);
    box.waypoints.push_back({time, Eigen::Isometry3d(Eigen::Translation3d(place))});
  }
  return box;
}

std::shared_ptr<const CheckerModel> compile(const Case& which) {
  const auto robot = test::modelRobot(which.robot);
  auto world = std::make_shared<World>(World::load(modelsDir() + "/scenes/" + which.scene));
  if (which.passing) world->add(passingBox());
  CheckerOptions options;
  options.margin = which.margin;
  return detail::compileChecker(robot, *robot->findGroup(which.group), world, options);
}

/// From a random state, there and back again several times.
QuadraticPath pathOf(Random& random, const CheckerModel& model) {
  const detail::KinematicModel& kinematics = model.kinematics;
  const bool timed = !model.world->obstacles().empty();
  const auto size = static_cast<std::size_t>(kinematics.dimension);
  std::vector<double> from(size);
  const std::size_t pieces = 1 + static_cast<std::size_t>(random.below(4));
  std::vector<std::vector<double>> rates(pieces + 1, std::vector<double>(size));
  const double swing = random.scale(0.02, 4.0);
  for (std::size_t i = 0; i < size; ++i) {
    const double middle = 0.5 * (kinematics.lower[i] + kinematics.upper[i]);
    const bool bounded = std::isfinite(middle);
    const double reach = bounded ? 0.5 * (kinematics.upper[i] - kinematics.lower[i]) : 1.2;
    from[i] = (bounded ? middle : 0.0) + random.uniform(-0.8, 0.8) * reach;
    for (auto& knot : rates) knot[i] = random.uniform(-swing, swing) * std::min(1.0, reach);
  }
  // What slides has to stay within its limits.
  for (const detail::MovingBody& body : kinematics.bodies) {
    if (body.type != JointType::Prismatic) continue;
    const auto i = static_cast<std::size_t>(body.variable);
    const double reach = 0.5 * (kinematics.upper[i] - kinematics.lower[i]);
    from[i] = 0.5 * (kinematics.lower[i] + kinematics.upper[i]) + random.uniform(-0.5, 0.5) * reach;
    for (auto& knot : rates) knot[i] = random.uniform(-0.1, 0.1) * reach;
  }
  if (timed) {
    from.back() = 0.0;
    for (auto& knot : rates) knot.back() = 1.0;
  }
  return {kinematics, from, rates};
}

struct Tally {
  int motions = 0, free = 0, collision = 0, undecided = 0, inSimd = 0, prefixes = 0;
};

class Judge {
 public:
  Judge(const std::shared_ptr<const CheckerModel>& model, Random& random)
      : model_(*model), exact_(*model), random_(random), workspace_(*model), exactWork_(exact_) {
    exact_.simd.usable = false;
  }

  void look(const QuadraticPath& path, Tally& tally) {
    ++tally.motions;
    const MotionCertificate found =
        detail::certifyMotion(model_, path, MotionQuery::VerdictOnly, workspace_);
    refute(path, found, found.verdict == Verdict::Free ? 1.0 : 0.0);
    tally.free += found.verdict == Verdict::Free ? 1 : 0;
    tally.collision += found.verdict == Verdict::Collision ? 1 : 0;
    tally.undecided += found.verdict == Verdict::Undecided ? 1 : 0;
    tally.inSimd += found.effort.lanes > 0 ? 1 : 0;
    if (tally.motions % 8 != 0) return;
    const MotionCertificate first =
        detail::certifyMotion(model_, path, MotionQuery::FirstContact, workspace_);
    refute(path, first, first.freeUntil);
    tally.prefixes += first.verdict != Verdict::Free && first.freeUntil > 0.0 ? 1 : 0;
    const MotionCertificate exact =
        detail::certifyMotion(exact_, path, MotionQuery::VerdictOnly, exactWork_);
    refute(path, exact, exact.verdict == Verdict::Free ? 1.0 : 0.0);
    EXPECT_FALSE((exact.verdict == Verdict::Free && found.verdict == Verdict::Collision) ||
                 (exact.verdict == Verdict::Collision && found.verdict == Verdict::Free));
  }

 private:
  Verdict at(const QuadraticPath& path, double t) {
    q_.resize(static_cast<std::size_t>(model_.kinematics.dimension));
    path.interpolate(t, q_);
    return detail::checkState(exact_, q_, exactWork_);
  }

  /// No state is in contact before `until`; one is where the witness has it.
  void refute(const QuadraticPath& path, const MotionCertificate& found, double until) {
    constexpr int kSamples = 12;
    for (int i = 0; i < kSamples && until > 0.0; ++i) {
      const double t = until * (i + random_.uniform(0.0, 1.0)) / kSamples;
      ASSERT_NE(at(path, t), Verdict::Collision) << "at " << t << " of " << until;
    }
    if (found.verdict != Verdict::Collision) return;
    ASSERT_TRUE(found.witness);
    EXPECT_NE(at(path, found.witness->t), Verdict::Free);
  }

  const CheckerModel& model_;
  CheckerModel exact_;
  Random& random_;
  WorkspaceData workspace_, exactWork_;
  std::vector<double> q_;
};

TEST(CurvedMotions, AreProvenByBothTiersAndRefutedByNothing) {
  Random random(46);
  Tally tally;
  for (const Case& which : kCases) {
    SCOPED_TRACE(std::string(which.robot) + " " + which.scene);
    const auto model = compile(which);
    ASSERT_TRUE(model->simd.usable);
    Judge judge(model, random);
    for (int i = 0; i < wantedMotions() / static_cast<int>(kCases.size()) && !HasFailure(); ++i)
      judge.look(pathOf(random, *model), tally);
  }
  RecordProperty("motions", tally.motions);
  RecordProperty("free", tally.free);
  RecordProperty("collision", tally.collision);
  RecordProperty("undecided", tally.undecided);
  EXPECT_GT(10 * tally.free, tally.motions);
  EXPECT_GT(10 * tally.collision, tally.motions);
  EXPECT_LT(50 * tally.undecided, tally.motions);
  EXPECT_EQ(tally.inSimd, tally.motions);
  EXPECT_GT(200 * tally.prefixes, tally.motions);
  std::printf("%d motions: %d free, %d collisions, %d undecided; %d prefixes\n", tally.motions,
              tally.free, tally.collision, tally.undecided, tally.prefixes);
}

/// Says no where it said yes of the whole.
class TakesBack final : public detail::JointPath {
 public:
  explicit TakesBack(const QuadraticPath& path) : path_(path) {}
  bool linearize(double t, double half, std::span<detail::JointMotion> joints) const override {
    return half == 0.5 && path_.linearize(t, half, joints);
  }
  void interpolate(double t, std::span<double> q) const override { path_.interpolate(t, q); }

 private:
  const QuadraticPath& path_;
};

TEST(CurvedMotions, APathThatTakesItsBoundsBackIsRefused) {
  Random random(50);
  const auto model = compile(kCases[0]);
  CheckerModel exact = *model;
  exact.simd.usable = false;
  for (const CheckerModel* tier : {model.get(), static_cast<const CheckerModel*>(&exact)}) {
    WorkspaceData workspace(*tier);
    const QuadraticPath path = pathOf(random, *tier);
    EXPECT_THROW(detail::certifyMotion(*tier, TakesBack(path), MotionQuery::VerdictOnly, workspace),
                 std::logic_error);
  }
}

/// The bound on a clearance is no more than what any state on the way has.
TEST(CurvedMotions, KeepTheClearanceThatIsSaid) {
  Random random(49);
  int close = 0;
  for (const Case& which : kCases) {
    SCOPED_TRACE(std::string(which.robot) + " " + which.scene);
    const auto model = compile(which);
    WorkspaceData workspace(*model);
    std::vector<double> q(static_cast<std::size_t>(model->kinematics.dimension));
    for (int i = 0; i < 150; ++i) {
      const QuadraticPath path = pathOf(random, *model);
      constexpr double kAccuracy = 1e-3;
      const MotionClearance found =
          detail::motionClearance(*model, path, kAccuracy, ClearanceQuery::Least, workspace);
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 20; ++k) {
        path.interpolate(random.uniform(0.0, 1.0), q);
        const SignedClearance at = detail::signedClearance(*model, q, {}, workspace);
        least = std::min(least, std::max(0.0, at.upper));
      }
      ASSERT_LE(found.lower, least);
      path.interpolate(found.t, q);
      ASSERT_LE(std::max(0.0, detail::signedClearance(*model, q, {}, workspace).lower),
                found.upper + 1e-9);
      close += found.lower > 0.0 && least - found.lower < 2.0 * kAccuracy ? 1 : 0;
    }
  }
  EXPECT_GT(close, 50);
}

/// What begins and ends free, and meets in between: no bound may rest on values at the ends.
TEST(CurvedMotions, ThereAndBackIsNotFree) {
  Random random(48);
  int motions = 0;
  for (const Named& robot : buildRobotsWithTables()) {
    SCOPED_TRACE(robot.name);
    const CheckerModel& model = *robot.model;
    const detail::KinematicModel& kinematics = model.kinematics;
    const auto size = static_cast<std::size_t>(kinematics.dimension);
    WorkspaceData workspace(model);
    std::vector<double> q(size);
    const auto moveTo = [&](Verdict verdict) {
      for (int tries = 0; tries < 1000; ++tries) {
        for (std::size_t i = 0; i < size; ++i)
          q[i] = random.uniform(std::max(kinematics.lower[i], -3.0),
                                std::min(kinematics.upper[i], 3.0));
        if (detail::checkState(model, q, workspace) == verdict) return true;
      }
      return false;
    };
    for (int round = 0; round < 200 && moveTo(Verdict::Free); ++round) {
      const std::vector<double> from = q;
      if (!moveTo(Verdict::Collision)) break;
      std::vector<std::vector<double>> rates(5, std::vector<double>(size));
      for (std::size_t i = 0; i < size; ++i) {
        rates[1][i] = 4.0 * (q[i] - from[i]);
        rates[3][i] = -rates[1][i];
      }
      ++motions;
      const QuadraticPath path(kinematics, from, rates);
      for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
        const MotionCertificate found = detail::certifyMotion(model, path, query, workspace);
        ASSERT_NE(found.verdict, Verdict::Free);
        ASSERT_LE(found.freeUntil, 0.5);
      }
    }
  }
  EXPECT_GT(motions, 500);
}

/// A tree of bodies on a curved path, at one interval of it.
class CurvedTree {
 public:
  explicit CurvedTree(Random& random) : model_(treeOf(random)), path_(pathOf(random)) {
    model_.simd = simdModelOf(model_);
    scratch_.emplace(model_.simd);
    t_ = random.uniform(0.05, 0.95);
    half_ = std::min({random.scale(1e-3, 0.2), t_, 1.0 - t_});
    joints_.resize(model_.kinematics.bodies.size());
    states_.resize(joints_.size());
  }

  /// Looks at bounds over the interval; false where the path slides too far.
  bool bound(Random& random) {
    detail::SimdMotion motion(model_.simd, model_.kinematics, path_, joints_, *scratch_);
    if (!motion.compile()) return false;
    // One lane is the interval, the others are anywhere.
    for (std::size_t lane = 0; lane < detail::kLanes; ++lane) {
      scratch_->block.time.lane[lane] = static_cast<float>(random.uniform(0.1, 0.9));
      scratch_->block.half.lane[lane] = static_cast<float>(random.uniform(0.0, 0.1));
    }
    const auto own = static_cast<std::size_t>(random.below(detail::kLanes));
    scratch_->block.time.lane[own] = static_cast<float>(t_);
    scratch_->block.half.lane[own] = static_cast<float>(half_);
    scratch_->block.mode = detail::SimdMode::Motion;
    motion.place(model_.simd.allBodies);
    return path_.linearize(t_, half_, joints_);
  }

  struct Bounds {
    double one, nested, simd;  ///< m per unit t squared
  };
  /// Of the ball of a piece of geometry.
  Bounds boundsOf(const detail::RobotGeometry& geometry) {
    const auto levers = detail::leverArms(model_.kinematics, geometry.body, geometry.center, 0.0);
    std::vector<double> arms(levers.path.size());
    detail::motionArms(model_.kinematics, geometry.body, geometry.center, 0.0, joints_, arms);
    std::vector<detail::PointMotionBound> nested(arms.size() + 1);
    detail::nestedMotionBounds(model_.kinematics, levers.path, arms, joints_, nested);
    const auto slot = static_cast<std::size_t>(
        model_.simd.references[0].slot[static_cast<std::size_t>(geometry.body)]);
    const Row& row = scratch_->bounds[0].acceleration[slot / detail::kLanes];
    return {detail::pointMotionBound(model_.kinematics, levers.path, arms, 0, joints_).acceleration,
            nested[0].acceleration, static_cast<double>(row.lane[slot % detail::kLanes])};
  }

  /// m per unit t squared, by finite differences somewhere in the interval. Negative: a knot is too
  /// near.
  double seen(const detail::RobotGeometry& geometry, Random& random) {
    constexpr double kStep = 1e-4;
    const double t = t_ + random.uniform(-1.0, 1.0) * (half_ - kStep);
    std::array<Eigen::Vector3d, 3> at;
    std::array<double, 3> rates{};
    for (int k = 0; k < 3; ++k) {
      const double time = t + (k - 1) * kStep;
      path_.linearize(time, 0.0, moved_);
      rates[static_cast<std::size_t>(k)] =
          moved_.back().spinAcceleration + moved_.back().acceleration;
      for (std::size_t body = 1; body < states_.size(); ++body)
        detail::evaluateBody(model_.kinematics, moved_, time, static_cast<int>(body), states_);
      at[static_cast<std::size_t>(k)] =
          states_[static_cast<std::size_t>(geometry.body)].world_from_body * geometry.center;
    }
    if (rates[0] != rates[2]) return -1.0;
    return (at[2] - 2.0 * at[1] + at[0]).norm() / (kStep * kStep);
  }

  const CheckerModel& model() const { return model_; }

 private:
  using Row = detail::Row;

  static CheckerModel treeOf(Random& random) {
    ChainOptions options;
    const int joints = 1 + random.below(7);
    if (random.chance(0.2)) options.types.push_back(JointType::Planar);
    for (int i = 0; i < joints; ++i)
      options.types.push_back(std::array{JointType::Revolute, JointType::Continuous,
                                         JointType::Prismatic}[random.below(3)]);
    return robotOf(random, options);
  }

  QuadraticPath pathOf(Random& random) {
    const auto size = static_cast<std::size_t>(model_.kinematics.dimension);
    std::vector<double> from(size);
    std::vector<std::vector<double>> rates(2 + static_cast<std::size_t>(random.below(4)),
                                           std::vector<double>(size));
    // Joints that hardly move yet accelerate, too.
    const double swing = random.scale(0.01, 3.0);
    for (std::size_t i = 0; i < size; ++i) {
      from[i] = random.uniform(-0.1, 0.1);
      for (auto& knot : rates) knot[i] = random.uniform(-0.05, 0.05) * swing;
    }
    for (const detail::MovingBody& body : model_.kinematics.bodies)
      if (turns(body.type))
        for (auto& knot : rates)
          knot[static_cast<std::size_t>(body.variable)] = random.uniform(-swing, swing);
    return {model_.kinematics, from, rates};
  }

  CheckerModel model_;
  QuadraticPath path_;
  std::optional<detail::SimdScratch> scratch_;
  double t_ = 0.0, half_ = 0.0;
  std::vector<detail::JointMotion> joints_;
  std::vector<detail::BodyState> states_;
  std::vector<detail::JointMotion> moved_ =
      std::vector<detail::JointMotion>(model_.kinematics.bodies.size());
};

TEST(CurvedMotions, NoPointAcceleratesMoreThanItsBounds) {
  Random random(47);
  int looks = 0;
  CurvedTree::Bounds tightest{0.0, 0.0, 0.0};
  for (int round = 0; round < 4000; ++round) {
    CurvedTree tree(random);
    if (!tree.bound(random)) continue;
    const auto& all = tree.model().robotGeometry;
    const detail::RobotGeometry& geometry =
        all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))];
    const CurvedTree::Bounds bounds = tree.boundsOf(geometry);
    const double seen = tree.seen(geometry, random);
    if (seen < 0.0) continue;
    ++looks;
    const double noise = 1e-6 * (1.0 + seen);
    ASSERT_LE(seen, bounds.one + noise);
    ASSERT_LE(seen, bounds.nested + noise);
    ASSERT_LE(seen, bounds.simd + noise);
    if (seen < 1e-3) continue;
    tightest.one = std::max(tightest.one, seen / bounds.one);
    tightest.nested = std::max(tightest.nested, seen / bounds.nested);
    tightest.simd = std::max(tightest.simd, seen / bounds.simd);
  }
  EXPECT_GT(looks, 3000);
  EXPECT_GT(tightest.one, 0.9);
  EXPECT_GT(tightest.nested, 0.9);
  EXPECT_GT(tightest.simd, 0.5);
}

}  // namespace
}  // namespace swept::simd_test
