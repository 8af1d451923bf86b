// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "simd/kernels/simd_bounds.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"

namespace swept::simd_test {
namespace {

using detail::kLanes;
using detail::SimdReference;
using enum JointType;

/// A random robot whose pairs of bodies ask for bounds relative to all kinds of ancestors, and a
/// motion of it.
class MovingRobot {
 public:
  MovingRobot(Random& random, int round) {
    ChainOptions options;
    options.types = typesOf(random, round);
    options.link = random.scale(1e-3, 1e2);
    options.branches = random.chance(0.5) ? 0.4 : 0.0;
    make(random, options);
    const double turn = random.scale(0.01, 20.0);
    from = configuration(random, model.kinematics, turn, 3.0 * options.link);
    to = configuration(random, model.kinematics, turn, 3.0 * options.link);
    move();
  }

  /// A chain of more than kLongPath joints. Its first one turns alone, and the others are slid far
  /// longer than the links are.
  static MovingRobot longChain(Random& random) {
    MovingRobot robot;
    ChainOptions options;
    options.types = {Revolute};
    options.slides = 100.0;
    options.mimics = 0.0;
    while (options.types.size() < detail::kLongPath + 20)
      options.types.push_back(random.chance(0.3) ? Prismatic : Revolute);
    robot.make(random, options);
    robot.from = configuration(random, robot.model.kinematics, 3.0, 0.0);
    robot.to = robot.from;
    robot.to[robot.model.kinematics.bodies[1].variable] += random.uniform(-2.0, 2.0);
    robot.move();
    return robot;
  }

  Vector at(Real t, int body, int reference, const Vector& point) const {
    return exactPoint(model.kinematics, from, to, t, body, reference, point);
  }
  Vector velocity(Real t, int body, int reference, const Vector& point) const {
    const Real step = 1e-5L / spins;
    return (at(t + step, body, reference, point) - at(t - step, body, reference, point)) /
           (2 * step);
  }
  Vector acceleration(Real t, int body, int reference, const Vector& point) const {
    const Real step = 1e-4L / spins;
    return (at(t + step, body, reference, point) - 2 * at(t, body, reference, point) +
            at(t - step, body, reference, point)) /
           (step * step);
  }
  /// m per unit t squared; what the differences may be off by.
  Real noise() const { return 1e-7L * spins * (spins * static_cast<Real>(lanes.reach) + speeds); }
  Real bound(std::size_t reference, int body) const {
    const int slot = lanes.references[reference].slot[body];
    if (slot < 0) return 0;
    const auto& row = scratch->bounds[reference].acceleration[slot / kLanes];
    return static_cast<Real>(row.lane[slot % kLanes]);
  }
  /// Ball centres of a body, in its frame.
  std::vector<Vector> centers(int body) const {
    const detail::SimdNode& root = lanes.nodes[lanes.rootOfBody[body]];
    std::vector<Vector> found{centerOf(lanes, body, root)};
    for (int i = 0; i < root.childCount; ++i)
      found.push_back(centerOf(lanes, body, lanes.nodes[root.firstChild + i]));
    return found;
  }
  /// A centre of a body in the lanes: where it is, and half the way that it moves.
  static Vector valueOf(const detail::Row (&rows)[3], int lane) {
    return {static_cast<Real>(rows[0].lane[lane]), static_cast<Real>(rows[1].lane[lane]),
            static_cast<Real>(rows[2].lane[lane])};
  }

  detail::CheckerModel model;
  detail::SimdModel lanes;
  std::optional<detail::SimdScratch> scratch;
  std::vector<double> from, to;
  bool moves = false;
  Real spins = 1;   ///< rad per unit t
  Real speeds = 0;  ///< m per unit t

 private:
  MovingRobot() = default;

  void make(Random& random, const ChainOptions& options) {
    model = robotOf(random, options);
    addPairs();
    lanes = simdModelOf(model);
    EXPECT_TRUE(lanes.usable);
  }

  void move() {
    scratch.emplace(lanes);
    moves = StraightSimdMotion(lanes, model.kinematics, from, to, *scratch).compile();
    for (const auto& motion : scratch->motion) {
      spins += static_cast<Real>(motion.spin);
      speeds += static_cast<Real>(motion.speed);
    }
  }

  static std::vector<JointType> typesOf(Random& random, int round) {
    if (round % 6 == 0) return {Floating, Revolute, Prismatic, Revolute};
    if (round % 6 == 1) return {Planar, Prismatic, Revolute, Continuous};
    if (round % 6 == 2) return std::vector(7, Revolute);
    std::vector<JointType> types(1 + random.below(12));
    for (JointType& type : types) type = std::array{Revolute, Revolute, Prismatic}[random.below(3)];
    return types;
  }

  void addPairs() {
    const int count = static_cast<int>(model.robotGeometry.size());
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        const int bodyA = model.robotGeometry[a].body;
        const int bodyB = model.robotGeometry[b].body;
        if (bodyA == bodyB) continue;
        detail::GeometryPair pair;
        pair.a = a;
        pair.b = b;
        pair.self = true;
        pair.reference = commonAncestor(model.kinematics, bodyA, bodyB);
        model.pairs.push_back(pair);
      }
    }
  }
};

/// How accelerations that were seen compare with bounds on them.
struct Tightness {
  Real tightest = 0;
  int compared = 0;
  int attained = 0;  ///< by half or more

  /// A difference of points, off by `noise` at the most (m per unit t squared).
  void add(Real seen, Real bound, Real noise, int body, int reference) {
    ASSERT_LE(seen, bound * (1 + 1e-7L) + noise) << "body " << body << " from " << reference;
    ++compared;
    if (!(bound > 1e3L * noise)) return;
    tightest = std::max(tightest, seen / bound);
    attained += seen > 0.5L * bound ? 1 : 0;
  }
};

/// Calls `check(robot, index of a reference)` for those of many robots; ends at a failure.
template <typename Check>
void forEachReference(Random& random, const Check& check) {
  for (int round = 0; round < 2000; ++round) {
    MovingRobot robot(random, round);
    if (!robot.moves) continue;
    for (std::size_t k = 0; k < robot.lanes.references.size(); ++k) {
      SCOPED_TRACE("round " + std::to_string(round));
      check(robot, k);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(SimdBounds, NoBallCentreAcceleratesMore) {
  Random random(21);
  Tightness tightness;
  int relative = 0;
  forEachReference(random, [&](const MovingRobot& robot, std::size_t k) {
    const SimdReference& reference = robot.lanes.references[k];
    for (const SimdReference::Step& step : reference.steps) {
      const auto centers = robot.centers(step.body);
      const Vector& center = centers[random.below(static_cast<int>(centers.size()))];
      const Real t = random.uniform(0.0, 1.0);
      const Real seen = robot.acceleration(t, step.body, reference.body, center).norm();
      tightness.add(seen, robot.bound(k, step.body), robot.noise(), step.body, reference.body);
      relative += reference.body != 0 ? 1 : 0;
    }
  });
  RecordProperty("tightest", std::to_string(static_cast<double>(tightness.tightest)));
  EXPECT_GT(tightness.tightest, 0.98L) << "the bound is idle";
  EXPECT_GT(tightness.attained, tightness.compared / 50);
  EXPECT_GT(tightness.compared, 30000);
  EXPECT_GT(relative, tightness.compared / 4);
}

/// Of all points of a link's geometry, as far from its centre as they are.
TEST(SimdBounds, NoPointOfAGeometryAcceleratesMore) {
  Random random(22);
  Tightness tightness;
  forEachReference(random, [&](MovingRobot& robot, std::size_t k) {
    const SimdReference& reference = robot.lanes.references[k];
    const int geometry = random.below(static_cast<int>(robot.model.robotGeometry.size()));
    const detail::RobotGeometry& piece = robot.model.robotGeometry[geometry];
    if (reference.slot[piece.body] < 0) return;
    const auto bound = static_cast<Real>(
        detail::accelerationOfPoints(robot.lanes, static_cast<int>(k), geometry, *robot.scratch));
    const Vector point =
        (piece.center + piece.radius * random.direction() * (1.0 - 1e-9)).cast<Real>();
    const Real t = random.uniform(0.0, 1.0);
    const Real seen = robot.acceleration(t, piece.body, reference.body, point).norm();
    const Real noise = robot.noise() *
                       (1 + static_cast<Real>(piece.radius) / static_cast<Real>(robot.lanes.reach));
    tightness.add(seen, bound, noise, piece.body, reference.body);
  });
  RecordProperty("tightest", std::to_string(static_cast<double>(tightness.tightest)));
  EXPECT_GT(tightness.tightest, 0.9L) << "the bound is idle";
  EXPECT_GT(tightness.attained, tightness.compared / 100);
  EXPECT_GT(tightness.compared, 5000);
}

/// What slides in a chain takes points farther from the axes of joints before it.
TEST(SimdBounds, NoPointOfALongChainAcceleratesMore) {
  Random random(23);
  Tightness ofCentres, ofPoints;
  for (int round = 0; round < 5; ++round) {
    MovingRobot robot = MovingRobot::longChain(random);
    ASSERT_TRUE(robot.moves);
    ASSERT_FALSE(robot.lanes.carried.empty()) << "not bounded as long chains are";
    for (std::size_t i = 0; i < robot.model.robotGeometry.size(); ++i) {
      const detail::RobotGeometry& piece = robot.model.robotGeometry[i];
      const Vector centre = robot.centers(piece.body).front();
      const Real t = random.uniform(0.0, 1.0);
      ofCentres.add(robot.acceleration(t, piece.body, 0, centre).norm(), robot.bound(0, piece.body),
                    robot.noise(), piece.body, 0);
      const auto bound = static_cast<Real>(
          detail::accelerationOfPoints(robot.lanes, 0, static_cast<int>(i), *robot.scratch));
      ofPoints.add(robot.acceleration(t, piece.body, 0, piece.center.cast<Real>()).norm(), bound,
                   robot.noise(), piece.body, 0);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(ofCentres.compared, 500);
  EXPECT_GT(ofCentres.attained, ofCentres.compared / 50);
  EXPECT_GT(ofPoints.attained, ofPoints.compared / 50);
}

/// Least distance of the origin from the points y + s h, |s| <= 1.
Real nearest(const Vector& y, const Vector& h) {
  const Real length = h.squaredNorm();
  const Real s = length > 0 ? std::clamp<Real>(-y.dot(h) / length, -1, 1) : 0;
  return (y + s * h).norm();
}

struct Interval {
  int lane;
  Real middle, half;
};

void fillIntervals(Random& random, MovingRobot& robot) {
  auto& block = robot.scratch->block;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double half = random.scale(1e-3, 0.5);
    block.half.lane[lane] = static_cast<float>(half);
    block.time.lane[lane] = static_cast<float>(random.uniform(half, 1.0 - half));
  }
  block.mode = detail::SimdMode::Motion;
  detail::placeBodies(robot.lanes, robot.scratch->motion, robot.lanes.allBodies, block);
}

Interval intervalOf(const MovingRobot& robot, int lane) {
  return {lane, static_cast<Real>(robot.scratch->block.time.lane[lane]),
          static_cast<Real>(robot.scratch->block.half.lane[lane])};
}

/// All of a sub-interval, the ends more often than not: there the segment is farthest off.
Real sampleOf(Random& random, const Interval& interval) {
  const Real share = random.chance(0.3) ? (random.chance(0.5) ? 1 : -1)
                                        : static_cast<Real>(random.uniform(-1.0, 1.0));
  return interval.middle + share * interval.half;
}

/// Taylor's capsule, with the segment as the lanes have it: where it is and where it ends.
TEST(SimdBounds, CentresStayWithinTheInflationOfTheirSegments) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Random random(22);
    Real tightest = 0;
    int compared = 0;
    for (int round = 0; round < 500; ++round) {
      MovingRobot robot(random, round);
      if (!robot.moves) continue;
      fillIntervals(random, robot);
      for (const int body : robot.lanes.allBodies) {
        const Vector center = robot.centers(body).front();
        for (int lane = 0; lane < kLanes; ++lane) {
          const Interval interval = intervalOf(robot, lane);
          const auto& root = robot.scratch->block.roots[body];
          const Vector x = MovingRobot::valueOf(root.at, lane);
          const Vector g = MovingRobot::valueOf(root.by, lane);
          const Real inflation = interval.half * interval.half * robot.bound(0, body) / 2;
          const Real rounding = static_cast<Real>(robot.scratch->rounding);
          for (int sample = 0; sample < 4; ++sample) {
            const Vector p = robot.at(sampleOf(random, interval), body, 0, center);
            const Real off = nearest(x - p, g);
            ASSERT_LE(off, inflation * (1 + 1e-6L) + rounding)
                << "round " << round << ", body " << body << ", lane " << lane;
            ++compared;
            if (inflation > 1e3L * rounding) tightest = std::max(tightest, off / inflation);
          }
        }
      }
    }
    EXPECT_GT(tightest, 0.5L) << "the inflation is idle";
    EXPECT_GT(compared, 50000);
  }
}

/// The lemma of self_walk.hpp, with what the lanes compute: two centres are never nearer to each
/// other than the relative segment comes to the origin, less inflation and rounding.
TEST(SimdBounds, RelativeSegmentsBoundTheDistanceOfTwoCentres) {
  Random random(23);
  Real tightest = 0;
  int compared = 0;
  int turning = 0;
  for (int round = 0; round < 1500; ++round) {
    MovingRobot robot(random, round);
    if (!robot.moves) continue;
    fillIntervals(random, robot);
    const auto& block = robot.scratch->block;
    for (const detail::SimdBodyPair& pair : robot.lanes.bodyPairs) {
      const int lane = random.below(kLanes);
      const Interval interval = intervalOf(robot, lane);
      const int base = robot.lanes.references[pair.reference].body;
      const auto& a = block.roots[pair.bodyA];
      const auto& b = block.roots[pair.bodyB];
      const Vector between = MovingRobot::valueOf(b.at, lane) - MovingRobot::valueOf(a.at, lane);
      const Vector angular = MovingRobot::valueOf(block.states[base].angular, lane);
      const Vector by = MovingRobot::valueOf(b.by, lane) - MovingRobot::valueOf(a.by, lane) -
                        interval.half * angular.cross(between);
      const Real bound =
          robot.bound(pair.reference, pair.bodyA) + robot.bound(pair.reference, pair.bodyB);
      const Real inflation = interval.half * interval.half * bound / 2;
      const Real rounding = 2 * static_cast<Real>(robot.scratch->rounding);
      const Real least = nearest(between, by);
      for (int sample = 0; sample < 6; ++sample) {
        const Real t = sampleOf(random, interval);
        const Vector pA = robot.at(t, pair.bodyA, base, robot.centers(pair.bodyA).front());
        const Vector pB = robot.at(t, pair.bodyB, base, robot.centers(pair.bodyB).front());
        const Real apart = (pB - pA).norm();
        ASSERT_GE(apart, least - inflation * (1 + 1e-6L) - rounding)
            << "round " << round << ", bodies " << pair.bodyA << ", " << pair.bodyB;
        ++compared;
        turning += base != 0 && angular.norm() > 1e-3L ? 1 : 0;
        if (inflation > 1e3L * rounding) tightest = std::max(tightest, (least - apart) / inflation);
      }
    }
  }
  EXPECT_GT(tightest, 0.1L) << "the inflation is idle";
  EXPECT_GT(compared, 50000);
  EXPECT_GT(turning, compared / 10);
}

}  // namespace
}  // namespace swept::simd_test
