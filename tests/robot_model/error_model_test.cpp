// SPDX-License-Identifier: BSD-3-Clause
// The largest errors that arithmetic makes, in 50 digits and on every instruction set, as shares of
// what rounding/error_model.hpp allows for. ERROR_MODEL.md has the table that this prints.
#include <gtest/gtest.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "error_model_test.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/obstacle_kernels.hpp"
#include "simd/kernels/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

void measureSquared(const SimdObstacles& world, const Row (&x)[3], const Row (&g)[3],
                    Row& squared) {
  store(squaredDistance(world, world.obstacles.front(), Segment{load3(x), load3(g)}), squared);
}

void placeInGrid(const SimdField& field, const Row (&x)[3], Row (&q)[3]) {
  store3(inFrame(field, load3(x), true), q);
}

void readCells(const SimdField& field, const Row (&q)[3], Row& value) {
  store(cellClearance(field, load3(q)), value);
}

void readField(const SimdField& field, const Row (&q)[3], Row& value) {
  store(clearance(field, load3(q), set(1e30F), kAllLanes), value);
}

void inflate(const Row& half, float acceleration, Row& by) {
  store(inflation(load(half), acceleration), by);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "exact_motion.hpp"
#include "kinematics/lever_arms.hpp"
#include "rounding/error_model.hpp"
#include "simd/kernels/hull_planes.hpp"
#include "simd/kernels/simd_bounds.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "simd/kernels/table_lanes.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/simd_dispatch.hpp"
#include "worst_share.hpp"

namespace swept::detail {
SWEPT_DISPATCH_TABLE(measureSquared);
SWEPT_DISPATCH_TABLE(placeInGrid);
SWEPT_DISPATCH_TABLE(readCells);
SWEPT_DISPATCH_TABLE(readField);
SWEPT_DISPATCH_TABLE(inflate);

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using exact_test::Digits;
using exact_test::Exact3;
using exact_test::ExactPose;
using simd_test::ChainOptions;
using simd_test::kAnyTarget;
using simd_test::OnTarget;
using simd_test::Random;
using simd_test::simdTargets;
using simd_test::Worst;
using enum JointType;

using exact_test::exact;

Exact3 inLane(const Row (&rows)[3], int lane) {
  return {{Digits(rows[0].lane[lane]), Digits(rows[1].lane[lane]), Digits(rows[2].lane[lane])}};
}

/// Chains of 3 to 60 joints of all types, long links and short ones, some in a row about parallel
/// axes, where errors add up.
ChainOptions chainOf(Random& random, int round) {
  ChainOptions options;
  options.link = random.scale(1e-3, 1e2);
  options.straight = round % 3 == 0;
  options.branches = random.chance(0.3) ? 0.3 : 0.0;
  options.slides = random.scale(0.1, 10.0);
  if (round % 8 == 1) options.types = {Planar};
  if (round % 8 == 2) options.types = {Floating};
  const int most = round % 4 == 3 ? 60 : 12;
  const int count = 3 + random.below(most - 2);
  while (static_cast<int>(options.types.size()) < count)
    options.types.push_back(random.chance(0.2)   ? Prismatic
                            : random.chance(0.2) ? Continuous
                                                 : Revolute);
  return options;
}

/// In a row about parallel axes, each joint back by what the one before it turns.
ChainOptions zigzagOf(Random& random) {
  ChainOptions options;
  options.types = std::vector(static_cast<std::size_t>(3 + random.below(58)), Revolute);
  options.link = random.scale(1e-3, 1e2);
  options.straight = true;
  options.mimics = 0.0;
  return options;
}

/// A robot, a motion, and three of its sub-intervals in 50 digits.
class ExactRobot {
 public:
  static constexpr std::array<int, 3> kSeen{0, 3, 7};

  ExactRobot(Random& random, int round) {
    const bool zigzag = round % 6 == 5;
    model = simd_test::robotOf(random, zigzag ? zigzagOf(random) : chainOf(random, round));
    addHulls(random);
    // Long turns and slides are where single precision is worst, short ones where it is used.
    const double turn = random.scale(0.01, 40.0);
    from = simd_test::configuration(random, model.kinematics, turn, random.scale(1e-3, 1e2));
    to = simd_test::configuration(random, model.kinematics, turn, random.scale(1e-3, 1e2));
    if (zigzag) {
      // Every joint has the same sine and cosine, and these the same error.
      const double angle = random.uniform(0.1, 1.5);
      for (std::size_t i = 0; i < from.size(); ++i) from[i] = i % 2 == 0 ? angle : -angle;
      to = from;
      to[random.below(static_cast<int>(to.size()))] += random.uniform(-1.0, 1.0);
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      const double at = lane == 0 ? 0.0 : lane == kLanes - 1 ? 1.0 : random.uniform(0.0, 1.0);
      time.lane[lane] = static_cast<float>(at);
      half.lane[lane] = static_cast<float>(random.scale(1e-4, 0.5));
    }
    for (std::size_t k = 0; k < kSeen.size(); ++k) {
      const Digits t(time.lane[kSeen[k]]);
      for (int i = 0; i < 3; ++i)
        around[k][static_cast<std::size_t>(i)] = poses(t + (i - 1) * kStep);
      within[k] = poses(t + Digits(half.lane[kSeen[k]]) * Digits(random.uniform(-1.0, 1.0)));
    }
    addObstacle(random);
    addPairs();
    lanes = simd_test::simdModelOf(model);
  }

  /// False: the motion is left to double precision.
  bool compile() {
    scratch.emplace(lanes);
    scratch->block.time = time;
    scratch->block.half = half;
    scratch->block.mode = SimdMode::Motion;
    if (!simd_test::StraightSimdMotion(lanes, model.kinematics, from, to, *scratch).compile())
      return false;
    placeBodies(lanes, scratch->motion, lanes.allBodies, scratch->block);
    return true;
  }

  std::vector<ExactPose> poses(const Digits& t) const {
    return exact_test::posesAt(model.kinematics, from, to, t);
  }
  /// The middle of the ball around a body, in the body's frame.
  Exact3 center(int body) const {
    const SimdNode& node = lanes.nodes[lanes.rootOfBody[body]];
    const Exact3 inLanes{{Digits(node.center[0]), Digits(node.center[1]), Digits(node.center[2])}};
    Isometry3d turned = Isometry3d::Identity();
    turned.linear() = lanes.bodyFromLane[body];
    return exact(turned) * inLanes;
  }
  /// Of a point of a body at a seen middle, seen from another body: by differences, whose own error
  /// is below 1e-20 of the motion.
  Exact3 at(std::size_t seen, int which, int body, int reference, const Exact3& point) const {
    const std::vector<ExactPose>& all = around[seen][static_cast<std::size_t>(which)];
    const Exact3 p = all[static_cast<std::size_t>(body)] * point;
    const ExactPose& frame = all[static_cast<std::size_t>(reference)];
    return frame.turnedBack(p - frame.origin);
  }
  Exact3 velocity(std::size_t seen, int body, int reference, const Exact3& point) const {
    return (1 / (2 * kStep)) *
           (at(seen, 2, body, reference, point) - at(seen, 0, body, reference, point));
  }
  Exact3 acceleration(std::size_t seen, int body, int reference, const Exact3& point) const {
    return (1 / (kStep * kStep)) *
           (at(seen, 2, body, reference, point) + at(seen, 0, body, reference, point) -
            Digits(2) * at(seen, 1, body, reference, point));
  }

  /// Most that the points of the last hull reach along a direction, with `s` half ways.
  Digits reachOfHull(std::size_t seen, const Exact3& n, const Digits& s) const {
    const int geometry = static_cast<int>(model.robotGeometry.size()) - 1;
    const SimdHull& hull = lanes.hulls->of[static_cast<std::size_t>(geometry)];
    const int body = model.robotGeometry[geometry].body;
    Digits most = -Digits(1e30);
    for (int i = 0; i < hull.count; ++i) {
      const int index = kLanes * hull.first + i;
      const Exact3 point = exact(lanes.hulls->inBody[static_cast<std::size_t>(index)]);
      const Exact3 there = at(seen, 1, body, 0, point) + s * velocity(seen, body, 0, point);
      most = std::max<Digits>(most, dot(n, there));
    }
    return most + Digits(hull.radius) * norm(n);
  }
  /// Of the box in the world, as it is grown, and with what its support is allowed.
  Digits reachOfObstacle(const Exact3& n) const {
    const ExactPose pose = exact(model.worldGeometry.front().world_from_shape);
    const SimdBox& box = lanes.obstacles.boxes.front();
    const Exact3 inBox = pose.turnedBack(n);
    Digits most = dot(n, pose.origin);
    for (std::size_t i = 0; i < 3; ++i)
      most += abs(inBox[i]) * Digits(box.half[i]) +
              Digits(kSupportShare) * (Digits(std::abs(box.offset[i])) + Digits(box.half[i]));
    return most;
  }

  CheckerModel model;
  SimdModel lanes;
  std::optional<SimdScratch> scratch;
  std::vector<double> from, to;
  Vector3d towards;  ///< from the last hull to the obstacle, at the middle of the first seen lane
  Row time, half;
  inline static const Digits kStep{"1e-13"};
  /// Of each seen sub-interval: just before its middle, at it, just behind; and anywhere in it.
  std::array<std::array<std::vector<ExactPose>, 3>, kSeen.size()> around;
  std::array<std::vector<ExactPose>, kSeen.size()> within;

 private:
  /// In the balls that they have so far.
  void addHulls(Random& random) {
    simd_test::changeGeometry(model, [&](std::vector<RobotGeometry>& all) {
      for (RobotGeometry& geometry : all) {
        const CoverBall& ball = geometry.cover->nodes.front().ball;
        std::vector<Vector3d> points;
        for (int i = 0; i < 12; ++i)
          points.push_back(ball.center.cast<double>() + 0.9 * geometry.radius * random.direction());
        geometry.shape = ConvexHull::of(points);
      }
    });
  }

  /// A box beside the last body.
  void addObstacle(Random& random) {
    const RobotGeometry& last = model.robotGeometry[model.robotGeometry.size() - 1];
    towards = random.direction();
    Isometry3d pose = random.pose(0.0);
    const Vector3d sides = last.radius * Vector3d(random.uniform(0.1, 1.0), 0.5, 0.3);
    const double gap = last.radius * random.uniform(1.0, 1.5);
    const Vector3d turned = pose.linear().transpose() * towards;
    pose.translation() =
        rounded(around[0][1][static_cast<std::size_t>(last.body)] * exact(last.center)) +
        (gap + turned.cwiseAbs().dot(sides)) * towards;
    model.worldGeometry.push_back(simd_test::worldGeometry(Box{sides}, pose));
    GeometryPair pair;
    pair.a = static_cast<int>(model.robotGeometry.size()) - 1;
    model.pairs.push_back(pair);
  }

  /// Of each body with the next but one, so that bounds are asked relative to several.
  void addPairs() {
    const int count = static_cast<int>(model.robotGeometry.size());
    for (int a = 0; a + 2 < count; ++a) {
      GeometryPair pair;
      pair.a = a;
      pair.b = a + 2;
      const int bodyA = model.robotGeometry[pair.a].body, bodyB = model.robotGeometry[pair.b].body;
      if (bodyA == bodyB) continue;
      pair.self = true;
      pair.reference = simd_test::commonAncestor(model.kinematics, bodyA, bodyB);
      model.pairs.push_back(pair);
    }
  }
};

const std::vector<std::unique_ptr<ExactRobot>>& robots() {
  static const auto all = [] {
    Random random(61);
    std::vector<std::unique_ptr<ExactRobot>> made;
    for (int round = 0; round < 150; ++round)
      made.push_back(std::make_unique<ExactRobot>(random, round));
    return made;
  }();
  return all;
}

/// The counts of ERROR_MODEL.md, from what they are made of.
TEST(ErrorModel, ConstantsAreAboveTheirCounts) {
  const double columns = std::sqrt(2.0), matrix = std::sqrt(3.0), entries = 5.0 / 3.0;
  const double origin = entries + 1.0 + 2.0 + 3.0;
  const double sine = columns * kSineError / kSingle;
  const double rotation = matrix + (entries * entries + columns + entries) + sine + (2.0 + columns);
  EXPECT_GE(kFrameRoundings, rotation + origin) << "places";
  const double notTurns = matrix + (entries * matrix + columns + matrix) + (2.0 + columns);
  EXPECT_GE(kFrameRoundings, std::sqrt(2.5) * notTurns + 2.0 * sine) << "velocities";
  EXPECT_GE(kFrameRoundings, rotation + origin + 3.0) << "velocities, joints far out";
  EXPECT_GE(kFrameRoundings / kAngleOfFrame, 3.0) << "angles";
  constexpr double kWalks = 44.0;  // L9 and L11, of one ball or hull
  EXPECT_GE(kFrameSpare * kFrameRoundings, 10.0 + 8.0 + 22.0 + kWalks);
  EXPECT_GE(kSlideRoundings, 7.0 + kObstacleRoundings);
  EXPECT_GE(kObstacleRoundings, 28.0) << "the side of a cone";
  EXPECT_GE(kOffsetRoundings, 2.0);
  EXPECT_GE(kFieldRoundings, 14.0);
  const auto roundings = [](float outward) {
    return (static_cast<double>(outward) - 1.0) / kSingle;
  };
  EXPECT_GE(roundings(kBallOutward), 5.0 + 2.0);
  EXPECT_GE(roundings(kPairOutward), 12.0);
  EXPECT_GE(roundings(kMarginOutward), 5.0);
  EXPECT_GE(roundings(kLengthOutward), 6.0);
  EXPECT_GE(roundings(kRootOutward), 1.0);
  EXPECT_GE(roundings(kReachOutward), 2.0);
  EXPECT_GE(roundings(kBoundOutward), 5.0);
  EXPECT_GE(roundings(2.0F * kHalfOutward), 3.0);
  EXPECT_GE(static_cast<double>(kBoundPerTerm) / kSingle, 2.0);
  EXPECT_GE(static_cast<double>(kSupportShare) / kSingle, 10.5);
  EXPECT_GE(kArmOutward * (1.0 - kSingle), 1.0);
  EXPECT_GE(kSingleOutward * (1.0 - kSingle), 1.0);
  EXPECT_GE(kCosineError, kSingle);
  EXPECT_GE(kTableShare / kSingle, 4.0);
  EXPECT_GE(kInnerBallShare / kSingle, 2.0);
  EXPECT_GE(kTableValueError, (192.0 + 2.0 * 64.0 + 32.0 + 3.0 * 64.0 + 2.0 * 32.0) * kSingle);
  EXPECT_GE(kValueRounding / kDouble, 4.0);
  EXPECT_GE(kNestedRoundings / kDouble, 5.0);
  EXPECT_GE(kTimeRounding / kDouble, 3.0);
  EXPECT_GE(tolerance::kRoundingPerJoint / kDouble,
            10.0 + 2.0 * (entries * entries + columns + entries) + 2.0 * origin + 4.0 * kOrdinary);
  EXPECT_GE(tolerance::kSupportRounding / kDouble, 2.0 * 40.0);
}

/// L1 to L7: where balls are, how far they go, and that they stay in their capsules.
TEST(ErrorModel, FramesAndMotions) {
  Worst places("places and half ways of balls (L6, L7: kFrameRoundings)", 1e-3);
  Worst capsules("ways beside half^2 A / 2 (L5: kHalfOutward)", 0.2);
  Worst accelerations("accelerations (L5: kBoundOutward)", 0.9);
  int taken = 0;
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    const auto grow = SWEPT_DISPATCH(inflate);
    for (const auto& robot : robots()) {
      if (!robot->compile()) continue;
      ++taken;
      const SimdBlock& block = robot->scratch->block;
      const Digits rounding(robot->scratch->rounding);
      for (std::size_t k = 0; k < ExactRobot::kSeen.size(); ++k) {
        const int lane = ExactRobot::kSeen[k];
        const Digits half(block.half.lane[lane]);
        for (int body = 1; body < static_cast<int>(robot->lanes.bodies.size()); ++body) {
          const Exact3 center = robot->center(body);
          const Exact3 x = robot->at(k, 1, body, 0, center);
          const Exact3 g = half * robot->velocity(k, body, 0, center);
          const Exact3 laneX = inLane(block.roots[body].at, lane);
          const Exact3 laneG = inLane(block.roots[body].by, lane);
          places.note(target, norm(laneX - x) + norm(laneG - g), rounding);

          const SimdBounds& bounds = robot->scratch->bounds[0];
          const int at = robot->lanes.references[0].slot[body];
          const float most = bounds.acceleration[at / kLanes].lane[at % kLanes];
          Row by;
          grow(block.half, most, by);
          const Exact3 later = robot->within[k][static_cast<std::size_t>(body)] * center;
          capsules.note(target, distanceFromSegment(later, laneX, laneG),
                        Digits(by.lane[lane]) + rounding);

          for (std::size_t r = 0; r < robot->lanes.references.size(); ++r) {
            const SimdReference& reference = robot->lanes.references[r];
            const int slot = reference.slot[body];
            if (slot < 0) continue;
            const Digits bound(
                robot->scratch->bounds[r].acceleration[slot / kLanes].lane[slot % kLanes]);
            if (!(bound > 0)) continue;
            accelerations.note(target, norm(robot->acceleration(k, body, reference.body, center)),
                               bound);
          }
        }
      }
    }
  }
  EXPECT_GT(taken, static_cast<int>(simdTargets().size() * robots().size()) / 2);
}

/// L13: the same places and velocities in double precision, and the bounds there.
TEST(ErrorModel, FramesAndMotionsInDoublePrecision) {
  Worst places("places in double precision (L13: tolerance::kRoundingPerJoint)", 1e-3);
  Worst velocities("velocities in double precision (L13: velocityRounding)", 1e-4);
  Worst accelerations("accelerations in double precision (L5: kArithmeticOutward)", 0.9);
  for (const auto& robot : robots()) {
    const KinematicModel& kinematics = robot->model.kinematics;
    std::vector<JointMotion> joints(kinematics.bodies.size());
    ASSERT_TRUE(compileMotion(kinematics, robot->from, robot->to, joints));
    std::vector<CarriedRounding> carried(kinematics.bodies.size());
    for (std::size_t i = 1; i < carried.size(); ++i)
      carried[i] = carriedRounding(carried[static_cast<std::size_t>(kinematics.bodies[i].parent)],
                                   joints[i]);
    for (std::size_t k = 0; k < ExactRobot::kSeen.size(); ++k) {
      std::vector<BodyState> states(kinematics.bodies.size());
      for (int body = 1; body < static_cast<int>(states.size()); ++body)
        evaluateBody(kinematics, joints,
                     static_cast<double>(robot->time.lane[ExactRobot::kSeen[k]]), body, states);
      for (const RobotGeometry& geometry : robot->model.robotGeometry) {
        const int body = geometry.body;
        const BodyState& state = states[static_cast<std::size_t>(body)];
        const CarriedRounding& own = carried[static_cast<std::size_t>(body)];
        const LeverArms levers = leverArms(kinematics, body, geometry.center, 0.0);
        const double span = levers.spanAtRest + own.slid;
        const double rounding =
            (tolerance::kRoundingPerJoint * (levers.transforms + 2.0) + own.angleError) * span +
            own.slideError;
        const Exact3 center = exact(geometry.center);
        const Vector3d at = state.world_from_body * geometry.center;
        places.note(kAnyTarget, norm(exact(at) - robot->at(k, 1, body, 0, center)), rounding);

        std::vector<double> arms = levers.arms;
        motionArms(kinematics, body, geometry.center, 0.0, joints, arms);
        const PointMotionBound bound = pointMotionBound(kinematics, levers.path, arms, 0, joints);
        if (!(bound.speed > 0.0)) continue;
        const Vector3d velocity = state.linear + state.angular.cross(at);
        velocities.note(kAnyTarget, norm(exact(velocity) - robot->velocity(k, body, 0, center)),
                        Digits(velocityRounding(levers.transforms)) * bound.speed);
        if (!(bound.acceleration > 0.0)) continue;
        accelerations.note(kAnyTarget, norm(robot->acceleration(k, body, 0, center)),
                           bound.acceleration);
      }
    }
  }
}

/// L11: the largest margin for which a plane is found says what gap was computed.
TEST(ErrorModel, Planes) {
  Worst gaps("planes beside hulls (L11: 4 roundings)", 1e-4);
  const int lane = ExactRobot::kSeen[0];
  int seen = 0;
  for (const auto& robot : robots()) {
    SimdDirection direction;
    direction.lane = lane;
    for (int i = 0; i < 3; ++i) direction.towards[i] = static_cast<float>(robot->towards[i]);
    const Exact3 n{
        {Digits(direction.towards[0]), Digits(direction.towards[1]), Digits(direction.towards[2])}};
    const Exact3 unit = (1 / norm(n)) * n;
    const Digits half(robot->half.lane[lane]);
    const Digits before = robot->reachOfHull(0, unit, -half);
    const Digits after = robot->reachOfHull(0, unit, half);
    const Digits gap = -std::max<Digits>(before, after) - robot->reachOfObstacle(Digits(-1) * unit);
    for (const std::int64_t target : simdTargets()) {
      const OnTarget on(target);
      if (!robot->compile()) continue;
      const auto divides = [&](float margin) {
        robot->lanes.margin = margin;
        return (lanesDivided(robot->lanes, 0, direction, 1U << lane, *robot->scratch) &
                1U << lane) != 0;
      };
      float low = 0.0F;
      float high = 4.0F * static_cast<float>(norm(robot->around[0][1].back().origin)) + 1e3F;
      if (!divides(low)) continue;
      ++seen;
      while (true) {
        const float middle = 0.5F * (low + high);
        if (!(middle > low && middle < high)) break;
        (divides(middle) ? low : high) = middle;
      }
      robot->lanes.margin = 0.0F;
      Row by;
      SWEPT_DISPATCH(inflate)
      (robot->half,
       accelerationOfPoints(robot->lanes, 0,
                            static_cast<int>(robot->model.robotGeometry.size()) - 1,
                            *robot->scratch),
       by);
      const Digits rounding = 4 * Digits(robot->scratch->rounding);
      const Digits found =
          (rounding + Digits(low) * Digits(kMarginOutward) + Digits(by.lane[lane])) *
          Digits(kPairOutward);
      gaps.note(target, found - gap, rounding);
    }
  }
  EXPECT_GT(seen, 50);
}

/// L6: sines and cosines, as the place of a ball at (1, 0, 0) on a joint about z has them.
TEST(ErrorModel, SinesAndCosines) {
  Worst sines("sines and cosines (L6: kSineError)", 0.1);
  CheckerModel model;
  model.kinematics.bodies.resize(2);
  MovingBody& body = model.kinematics.bodies[1];
  body.parent = 0;
  body.type = Revolute;
  body.variable = 0;
  body.lower = -1e3;
  body.upper = 1e3;
  model.kinematics.dimension = 1;
  model.kinematics.cyclic.push_back(0);
  auto cover = std::make_shared<SphereCover>();
  SphereCover::Node node{};
  node.ball = {Eigen::Vector3f::UnitX(), 0.1F};
  cover->nodes.push_back(node);
  RobotGeometry geometry;
  geometry.body = 1;
  geometry.shape = Sphere{0.1};
  geometry.body_from_shape.setIdentity();
  geometry.cover = cover;
  geometry.levers = leverArms(model.kinematics, 1, Vector3d::UnitX(), 0.1);
  model.robotGeometry = SharedArray(std::vector<RobotGeometry>{geometry});
  const SimdModel lanes = simd_test::simdModelOf(model);
  SimdScratch scratch(lanes);
  SimdBlock& block = scratch.block;
  block.mode = SimdMode::States;
  block.given = true;
  Random random(62);
  for (int round = 0; round < 4000; ++round) {
    std::array<Digits, kLanes> s, c;
    Row angles;
    for (int lane = 0; lane < kLanes; ++lane) {
      // Anywhere; where the quarter changes, which is where it is worst; and tiny ones.
      const double quarter = std::numbers::pi / 4 * (random.below(327) - 163);
      const double near = quarter + random.uniform(-1.0, 1.0) * random.scale(1e-7, 1e-2);
      const double tiny = random.uniform(-1.0, 1.0) * random.scale(1e-30, 1.0);
      const double angle = std::array{random.uniform(-128.0, 128.0),
                                      std::clamp(near, -128.0, 128.0), tiny}[random.below(3)];
      angles.lane[lane] = static_cast<float>(angle);
      s[static_cast<std::size_t>(lane)] = sin(Digits(angles.lane[lane]));
      c[static_cast<std::size_t>(lane)] = cos(Digits(angles.lane[lane]));
    }
    for (const std::int64_t target : simdTargets()) {
      const OnTarget on(target);
      block.angle[1] = angles;
      placeBodies(lanes, scratch.motion, lanes.allBodies, block);
      for (int lane = 0; lane < kLanes; ++lane) {
        const Exact3 at = inLane(block.roots[1].at, lane);
        sines.note(target, abs(at[0] - c[static_cast<std::size_t>(lane)]), kSineError);
        sines.note(target, abs(at[1] - s[static_cast<std::size_t>(lane)]), kSineError);
      }
    }
  }
}

/// L12: the part of a table that a value is found in, for values that a motion computes.
TEST(ErrorModel, TableValues) {
  Worst values("values of joint tables (L12: kTableValueError)", 0.05);
  Random random(63);
  for (int round = 0; round < 2000; ++round) {
    ChainOptions options;
    options.types = {Revolute};
    options.mimics = 0.0;
    const CheckerModel model = simd_test::robotOf(random, options);
    const SimdModel lanes = simd_test::simdModelOf(model);
    const double width = random.chance(0.5) ? random.uniform(kTableWidest, 2.0 * kTableWidest)
                                            : random.scale(1.0, kTableWidest);
    const double lower = random.uniform(-kTableWidest, kTableWidest - width);
    PairSeparationTable table;
    table.joints = 1;
    PairSeparationTable::Axis& axis = table.axes[0];
    axis.body = 1;
    axis.lower = static_cast<float>(lower);
    axis.upper = static_cast<float>(lower + width);
    axis.cells = 1024;
    const double part = width / axis.cells / PairSeparationTable::kParts;
    axis.partsPerUnit = static_cast<float>(1.0 / part);
    table.cells.resize(static_cast<std::size_t>(axis.cells));
    // Whole turns are taken off what is farther.
    const std::vector<double> from{
        random.uniform(std::max(lower, -4.0), std::min(lower + width, 4.0))};
    if (!(std::abs(from[0]) < 4.0)) continue;
    // Sub-intervals end beside a border between two cells: only there a value is in the wrong one.
    const std::vector<double> to{lower + 8.0 * part * (1 + random.below(axis.cells - 2)) +
                                 random.uniform(-1.0, 1.0) * kTableValueError};
    SimdScratch scratch(lanes);
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto half = static_cast<float>(random.scale(1e-3, 0.5));
      scratch.block.half.lane[lane] = half;
      scratch.block.time.lane[lane] = 1.0F - half;
    }
    for (const std::int64_t target : simdTargets()) {
      const OnTarget on(target);
      ASSERT_TRUE(
          simd_test::StraightSimdMotion(lanes, model.kinematics, from, to, scratch).compile());
      placeBodies(lanes, scratch.motion, lanes.allBodies, scratch.block);
      for (int lane = 0; lane < kLanes; ++lane) {
        const Digits rate = Digits(to[0]) - Digits(from[0]);
        const Digits middle = Digits(from[0]) + Digits(scratch.block.time.lane[lane]) * rate;
        const Digits reach = Digits(scratch.block.half.lane[lane]) * abs(rate);
        PairSeparationTable::Values low{}, high{};
        TableLanes(lanes, scratch).boxOf(table, lane, lane + 1, low, high);
        const auto beyond = [&](const PairSeparationTable::Values& value, const Digits& truth) {
          const PairSeparationTable::Cell* cell = table.cellAt(value);
          if (cell == nullptr) return;
          const auto index = static_cast<double>(cell - table.cells.data());
          const Digits begin = Digits(lower) + Digits(8.0 * part) * index;
          const Digits end = begin + Digits(8.0 * part);
          values.note(target, std::max<Digits>(begin - truth, truth - end), kTableValueError);
        };
        beyond(low, middle - reach);
        beyond(high, middle + reach);
      }
    }
  }
}

/// An obstacle, the frames of its compiled form in 50 digits, and what it is grown to.
struct ExactObstacle {
  Shape shape;
  Isometry3d world_from_shape;
  double size = 1.0;   ///< m
  double reach = 1.0;  ///< m
  double magnitude = 0.0;
  SimdObstacles world;
};

ExactObstacle obstacleOf(Random& random, const Shape& shape, double size) {
  ExactObstacle obstacle;
  obstacle.shape = shape;
  obstacle.size = size;
  obstacle.world_from_shape = random.pose(size * std::array{0.0, 1.0, 1e2}[random.below(3)]);
  const WorldGeometry geometry = simd_test::worldGeometry(shape, obstacle.world_from_shape);
  obstacle.magnitude = geometry.magnitude;
  obstacle.reach = obstacle.world_from_shape.translation().norm() + 3.0 * size;
  obstacle.world = compileObstacles({geometry}, obstacle.reach, true);
  return obstacle;
}

Digits positive(const Digits& value) {
  return value > 0 ? value : Digits(0);
}

/// The least |y + s h| across an axis, the least along it, and where on it the middle is.
struct ExactParts {
  Digits axial, beyond, radial;
};
ExactParts partsOf(const Exact3& y, const Exact3& g) {
  const Exact3 across{{y[0], y[1], 0}}, way{{g[0], g[1], 0}};
  return {y[2], abs(g[2]), distanceFromSegment(Exact3{}, across, way)};
}

/// What the kernel of an obstacle stands for, without rounding: of the grown set, in the shape's
/// frame. Of a point it is the distance, of a segment no more.
Digits kernelDistance(const ExactObstacle& obstacle, const Exact3& x, const Exact3& g) {
  const ExactPose pose = exact(obstacle.world_from_shape);
  const Exact3 y = pose.turnedBack(x - pose.origin), h = pose.turnedBack(g);
  const SimdObstacle& kind = obstacle.world.obstacles.front();
  const auto round = [&]() -> const SimdRound& { return obstacle.world.rounds[kind.first]; };
  switch (kind.kind) {
    case ObstacleKind::Box: {
      const SimdBox& box = obstacle.world.boxes[kind.first];
      Digits squared = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Digits gap = positive(abs(y[i]) - abs(h[i]) - Digits(box.half[i]));
        squared += gap * gap;
      }
      return sqrt(squared);
    }
    case ObstacleKind::Ball:
      return distanceFromSegment(Exact3{}, y, h) - Digits(round().radius);
    case ObstacleKind::Capsule: {
      const ExactParts parts = partsOf(y, h);
      const Digits beyond = positive(abs(parts.axial) - parts.beyond - Digits(round().halfLength));
      return sqrt(beyond * beyond + parts.radial * parts.radial) - Digits(round().radius);
    }
    case ObstacleKind::Cylinder:
    case ObstacleKind::Cone: {
      const ExactParts parts = partsOf(y, h);
      const Digits beyond = positive(abs(parts.axial) - parts.beyond - Digits(round().halfLength));
      const Digits outside = positive(parts.radial - Digits(round().radius));
      Digits around = sqrt(beyond * beyond + outside * outside);
      if (kind.kind == ObstacleKind::Cylinder) return around;
      const auto& cone = std::get<Cone>(obstacle.shape);
      const Digits height = 2 * Digits(cone.halfLength);
      const Digits slant = sqrt(Digits(cone.radius) * cone.radius + height * height);
      const Digits side = height / slant * parts.radial +
                          Digits(cone.radius) / slant * (parts.axial - parts.beyond) -
                          Digits(round().offset);
      return std::max<Digits>(around, side);
    }
    case ObstacleKind::Planes:
    case ObstacleKind::Slab: {
      const LanePlane& plane = obstacle.world.planes[kind.first];
      const auto* half = std::get_if<HalfSpace>(&obstacle.shape);
      const Exact3 normal =
          exact(half != nullptr ? half->normal : std::get<Plane>(obstacle.shape).normal);
      const Digits offset(half != nullptr ? half->offset : std::get<Plane>(obstacle.shape).offset);
      const Digits at = dot(normal, y) - offset;
      // The slack is in the plane's own place.
      return (kind.kind == ObstacleKind::Slab ? Digits(abs(at)) : at) - abs(dot(normal, h)) -
             Digits(plane.slack);
    }
    case ObstacleKind::Ellipsoid: {
      const SimdEllipsoid& own = obstacle.world.ellipsoids[kind.first];
      // The nearest point of the surface is S^2 y / (S^2 + k), for the k > 0 where it is on it.
      const auto& axes = std::get<Ellipsoid>(obstacle.shape).semiAxes;
      Digits k = 0;
      for (int step = 0; step < 200; ++step) {
        Digits f = -1, slope = 0;
        for (int i = 0; i < 3; ++i) {
          const Digits a(axes[i]), in = a * a + k;
          const Digits share = a * y[static_cast<std::size_t>(i)] / in;
          f += share * share;
          slope -= 2 * share * share / in;
        }
        if (step == 0 && f <= 0) return -Digits(own.slack);
        const Digits next = k - f / slope;
        if (!(next > k * (1 + Digits("1e-45")))) break;
        k = next;
      }
      Digits squared = 0;
      for (int i = 0; i < 3; ++i) {
        const Digits a(axes[i]);
        const Digits off = y[static_cast<std::size_t>(i)] * k / (a * a + k);
        squared += off * off;
      }
      return sqrt(squared) - Digits(own.slack);
    }
    case ObstacleKind::Field:
      break;
  }
  return 0;
}

struct ObstacleKindCase {
  const char* name;
  Shape (*shape)(Random&, double);
  bool moves = true;  ///< what a kernel stands for is known of segments too
};

Vector3d lengths(Random& random, double size) {
  return {size * random.scale(1e-2, 1.0), size * random.scale(1e-2, 1.0),
          size * random.scale(1e-2, 1.0)};
}

const std::array<ObstacleKindCase, 8> kObstacleKinds{
    {{"balls", [](Random& r, double size) -> Shape { return Sphere{lengths(r, size)[0]}; }},
     {"boxes", [](Random& r, double size) -> Shape { return Box{lengths(r, size)}; }},
     {"capsules",
      [](Random& r, double size) -> Shape {
        return Capsule{lengths(r, size)[0], lengths(r, size)[0]};
      }},
     {"cylinders",
      [](Random& r, double size) -> Shape {
        return Cylinder{lengths(r, size)[0], lengths(r, size)[0]};
      }},
     {"cones",
      [](Random& r, double size) -> Shape {
        return Cone{lengths(r, size)[0], lengths(r, size)[0]};
      }},
     {"half-spaces",
      [](Random& r, double size) -> Shape {
        return HalfSpace{r.direction(), r.uniform(-size, size)};
      }},
     {"planes",
      [](Random& r, double size) -> Shape {
        return Plane{r.direction(), r.uniform(-size, size)};
      }},
     {"ellipsoids",
      [](Random& r, double size) -> Shape {
        const Vector3d axes = lengths(r, size);
        return Ellipsoid{r.chance(0.5) ? axes : Vector3d(Vector3d::Constant(axes[0]))};
      },
      false}}};

/// L8: distances of points and segments from obstacles. What squares and roots take is
/// taken off, for the walks multiply by it.
TEST(ErrorModel, Obstacles) {
  Random random(64);
  for (const ObstacleKindCase& kind : kObstacleKinds) {
    Worst distances("distances from " + std::string(kind.name) + " (L8: kObstacleRoundings)", 1e-3);
    for (int round = 0; round < 1200; ++round) {
      const double size = random.scale(1e-2, 1e2);
      const ExactObstacle obstacle = obstacleOf(random, kind.shape(random, size), size);
      Row x[3], g[3];
      std::array<Digits, kLanes> truth;
      std::array<double, kLanes> way;
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vector3d at =
            obstacle.world_from_shape * random.vector(size * random.scale(0.1, 1.7));
        const Vector3d by = kind.moves && lane % 2 == 1
                                ? Vector3d(random.direction() * size * random.scale(1e-4, 1.0))
                                : Vector3d(Vector3d::Zero());
        for (int i = 0; i < 3; ++i) {
          x[i].lane[lane] = static_cast<float>(at[i]);
          g[i].lane[lane] = static_cast<float>(by[i]);
        }
        truth[static_cast<std::size_t>(lane)] =
            kernelDistance(obstacle, inLane(x, lane), inLane(g, lane));
        way[static_cast<std::size_t>(lane)] = by.norm();
      }
      for (const std::int64_t target : simdTargets()) {
        const OnTarget on(target);
        Row squared;
        SWEPT_DISPATCH(measureSquared)(obstacle.world, x, g, squared);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if (!(squared.lane[lane] > 0.0F)) continue;
          const Digits found = sqrt(Digits(squared.lane[lane]));
          const Digits error = found - positive(truth[lane]) * Digits(kBallOutward);
          distances.note(target, error,
                         obstacleRounding(obstacle.reach + way[lane], obstacle.magnitude));
        }
      }
    }
  }
}

/// L8 and L10: coordinates in the frame of a grid, and what its cells say; and that the whole
/// answer is no more than the distance.
TEST(ErrorModel, Fields) {
  Worst coordinates("coordinates in a grid (L8: kObstacleRoundings, twice)", 0.01);
  Worst cells("values of cells (L10: kFieldRoundings)", 1e-3);
  Random random(65);
  int proven = 0;
  for (int round = 0; round < 12; ++round) {
    const double size = random.scale(0.1, 10.0);
    std::vector<Vector3d> points;
    for (int i = 0; i < 12; ++i) points.push_back(random.vector(size));
    const double radius = 0.05 * size;
    const ExactObstacle obstacle =
        obstacleOf(random, Shape(PointCloud::build(points, radius)), size);
    if (obstacle.world.fields.empty()) continue;
    const SimdField& field = obstacle.world.fields.front();
    const double numbers =
        obstacle.reach + obstacle.magnitude + 255.0 * static_cast<double>(field.step);
    const double own = obstacleRounding(obstacle.reach, obstacle.magnitude);
    Isometry3d grid_from_world = obstacle.world_from_shape.inverse();
    grid_from_world.translation() -= field.field->origin;
    for (int i = 0; i < 40; ++i) {
      Row x[3];
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vector3d at = obstacle.world_from_shape * random.vector(1.5 * size);
        for (int k = 0; k < 3; ++k) x[k].lane[lane] = static_cast<float>(at[k]);
      }
      for (const std::int64_t target : simdTargets()) {
        const OnTarget on(target);
        Row q[3], inside[3], value, whole;
        SWEPT_DISPATCH(placeInGrid)(field, x, q);
        for (int k = 0; k < 3; ++k)
          for (int lane = 0; lane < kLanes; ++lane)
            inside[k].lane[lane] = std::clamp(q[k].lane[lane], field.lower[k], field.upper[k]);
        SWEPT_DISPATCH(readCells)(field, inside, value);
        SWEPT_DISPATCH(readField)(field, q, whole);
        for (int lane = 0; lane < kLanes; ++lane) {
          const Exact3 at = inLane(x, lane);
          coordinates.note(target, norm(inLane(q, lane) - exact(grid_from_world) * at), 2.0 * own);
          // Lemma 1 of ClearanceField, of the cell and those around it: rounding may choose
          // these.
          const Exact3 middle = inLane(inside, lane);
          Digits best = -Digits(1e30);
          int base[3], count[3];
          for (int k = 0; k < 3; ++k) {
            count[k] = 2 * field.blocks[k];
            base[k] = static_cast<int>(inside[k].lane[lane] / field.cell);
          }
          for (int n = 0; n < 27; ++n) {
            const int cell[3] = {base[0] + n % 3 - 1, base[1] + n / 3 % 3 - 1, base[2] + n / 9 - 1};
            bool within = true;
            Exact3 off;
            for (int k = 0; k < 3; ++k) {
              within = within && cell[k] >= 0 && cell[k] < count[k];
              off[static_cast<std::size_t>(k)] =
                  middle[static_cast<std::size_t>(k)] -
                  (Digits(cell[k]) + Digits(0.5)) * Digits(field.cell);
            }
            if (!within) continue;
            const int index = (cell[2] * count[1] + cell[1]) * count[0] + cell[0];
            const std::uint32_t byte = field.cells[index / 4] >> (8 * (index % 4)) & 0xFFU;
            best = std::max<Digits>(best, Digits(byte) * Digits(field.step) - norm(off));
          }
          cells.note(target, Digits(value.lane[lane]) - best, fieldRounding(0.0, numbers));
          Digits nearest = 1e30;
          for (const Vector3d& point : points)
            nearest = std::min<Digits>(
                nearest, norm(exact(obstacle.world_from_shape) * exact(point) - at) - radius);
          EXPECT_LE(Digits(whole.lane[lane]), nearest);
          proven += whole.lane[lane] > 0.0F ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(proven, 1000);
}

/// L14: the plane that separates two bodies, along its own normal.
TEST(ErrorModel, Supports) {
  Worst gaps("gaps along a normal (L14: tolerance::kSupportRounding)", 1e-3);
  Random random(66);
  const auto corners = [](const Shape& shape) {
    if (const auto* hull = std::get_if<ConvexHull>(&shape)) return hull->vertices();
    std::vector<Vector3d> points;
    const Vector3d& half = std::get<Box>(shape).halfExtents;
    for (int i = 0; i < 8; ++i)
      points.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                          (i & 4) != 0 ? half.z() : -half.z());
    return points;
  };
  const auto body = [&](double size) -> Shape {
    if (random.chance(0.5)) return Box{lengths(random, size)};
    std::vector<Vector3d> points;
    for (int i = 0; i < 4 + random.below(30); ++i) points.push_back(random.vector(size));
    return ConvexHull::of(points);
  };
  const auto extentOf = [&](const Shape& shape) {
    double extent = 0.0;
    for (const Vector3d& corner : corners(shape)) extent = std::max(extent, corner.norm());
    return extent;
  };
  const auto errorOf = [](const Shape& shape) {
    const auto* hull = std::get_if<ConvexHull>(&shape);
    return hull != nullptr ? hull->error() : 0.0;
  };
  int seen = 0;
  for (int round = 0; round < 12000; ++round) {
    const double size = random.scale(1e-3, 1e3);
    const Shape a = body(size), b = body(size * random.scale(0.1, 1.0));
    const Isometry3d a_from_b = random.pose(3.0 * size);
    const DistanceResult found = distance(a, b, a_from_b);
    if (!(found.lower > 0.0) || found.normal.isZero(0.0)) continue;
    ++seen;
    const Exact3 normal = exact(found.normal);
    const ExactPose pose = exact(a_from_b);
    Digits most = -Digits(1e30), least = 1e30;
    for (const Vector3d& corner : corners(a))
      most = std::max<Digits>(most, dot(normal, exact(corner)));
    for (const Vector3d& corner : corners(b))
      least = std::min<Digits>(least, dot(normal, pose * exact(corner)));
    const Digits gap = (least - most) / norm(normal);
    const double allowed = tolerance::kSupportRounding * (extentOf(a) + extentOf(b) +
                                                          a_from_b.translation().cwiseAbs().sum()) +
                           errorOf(a) + errorOf(b);
    gaps.note(kAnyTarget, Digits(found.lower) + allowed - gap, allowed);
  }
  EXPECT_GT(seen, 1500);
}

}  // namespace
}  // namespace swept::detail
#endif
