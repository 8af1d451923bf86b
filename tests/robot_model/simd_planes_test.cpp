// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "simd/kernels/hull_planes.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/distance.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::RobotGeometry;
using detail::SimdModel;
using detail::SimdScratch;
using enum JointType;

Shape randomObstacle(Random& random, double size) {
  const auto length = [&] { return random.scale(0.05, 1.0) * size; };
  switch (random.below(4)) {
    case 0:
      return Sphere{length()};
    case 1:
      return Capsule{length(), length()};
    case 2:
      return Cylinder{length(), length()};
    default:
      return Box{{length(), length(), length()}};
  }
}

/// Links have all that obstacles have.
Shape randomShape(Random& random, double size) {
  std::vector<Eigen::Vector3d> points(4 + random.below(40));
  for (Eigen::Vector3d& point : points) point = random.vector(size);
  switch (random.below(6)) {
    case 0:
      return Cone{random.scale(0.05, 1.0) * size, random.scale(0.05, 1.0) * size};
    case 1:
      return ConvexHull::of(points);
    default:
      return randomObstacle(random, size);
  }
}

/// Two bodies of a random robot, or one and an obstacle, on a random motion.
class Pass {
 public:
  Pass(Random& random, int round, bool self) : self_(self) {
    ChainOptions options;
    options.types.resize(1 + random.below(9));
    for (JointType& type : options.types)
      type = std::array{Revolute, Revolute, Prismatic}[random.below(3)];
    if (round % 5 == 0) options.types.insert(options.types.begin(), Floating);
    if (round % 5 == 1) options.types.insert(options.types.begin(), Planar);
    options.link = size_ = random.scale(1e-2, 1e1);
    options.branches = random.chance(0.5) ? 0.5 : 0.0;
    model_ = robotOf(random, options);
    changeGeometry(model_, [&](std::vector<RobotGeometry>& all) {
      for (RobotGeometry& geometry : all) setShape(randomShape(random, size_), geometry);
    });
    const double turn = random.scale(0.01, 4.0);
    from_ = configuration(random, model_.kinematics, turn, size_);
    to_ = configuration(random, model_.kinematics, turn, size_);
    addPair(random);
  }

  bool paired() const { return !model_.pairs.empty(); }

  struct Found {
    std::uint32_t lanes = 0;
    bool usable = false;
  };
  /// Lanes in which more than the margin is proven. The direction is that of the nearest points at
  /// the middle of a lane, turned by up to `off`.
  Found divide(double margin, int lane, const Eigen::Vector3d& direction) {
    detail::SimdDirection towards;
    towards.lane = lane;
    for (int i = 0; i < 3; ++i) towards.towards[i] = static_cast<float>(direction[i]);
    return find(margin, [&](const SimdModel& lanes, SimdScratch& scratch) {
      return detail::lanesDivided(lanes, 0, towards, detail::kAllLanes, scratch);
    });
  }
  /// Lanes in which planes that are sought from the obstacle prove that.
  Found divideOutward(double margin) {
    return find(margin, [](const SimdModel& lanes, SimdScratch& scratch) {
      return detail::lanesOutward(lanes, 0, detail::kAllLanes, scratch);
    });
  }

  template <typename Ask>
  Found find(double margin, const Ask& ask) {
    model_.pairs.front().margin = margin;
    const SimdModel lanes = simdModelOf(model_);
    SimdScratch scratch(lanes);
    Found found;
    found.usable = StraightSimdMotion(lanes, model_.kinematics, from_, to_, scratch).compile();
    if (!found.usable) return found;
    detail::SimdBlock& block = scratch.block;
    for (int i = 0; i < detail::kLanes; ++i) {
      block.time.lane[i] = static_cast<float>(middle(i));
      block.half.lane[i] = static_cast<float>(kHalf);
    }
    detail::placeBodies(lanes, scratch.motion, lanes.allBodies, block);
    found.lanes = ask(lanes, scratch);
    return found;
  }

  /// m, and the direction from the first to the second.
  double distanceAt(double t, Eigen::Vector3d* direction = nullptr) const {
    const detail::GeometryPair& pair = model_.pairs.front();
    const Eigen::Isometry3d world_from_a = placed(pair.a, t);
    const Eigen::Isometry3d world_from_b = self_ ? placed(pair.b, t) : obstacleAt_;
    const Shape& other = self_ ? model_.robotGeometry[pair.b].shape : obstacle_;
    const DistanceResult result =
        distance(model_.robotGeometry[pair.a].shape, other, world_from_a.inverse() * world_from_b);
    if (direction != nullptr)
      *direction = (world_from_a.linear() * (result.pointB - result.pointA)).normalized();
    return result.upper;
  }

  /// Puts the motion in a tube in which each joint that turns errs by up to this (rad). Only what
  /// is known along a direction proves anything then.
  void err(double turn, double slide = 0.0) {
    model_.tube.assign(model_.kinematics.bodies.size(), {});
    for (std::size_t i = 0; i < model_.tube.size(); ++i)
      if (detail::turns(model_.kinematics.bodies[i].type) &&
          model_.kinematics.bodies[i].type != Floating)
        model_.tube[i] = {.rotation = std::abs(model_.kinematics.bodies[i].multiplier) * turn,
                          .translation = slide};
    model_.pairs.front().tube = 1e9;
  }

  /// m, over a lane and the tube, at samples and where these lead: never below the least there is.
  double nearestInTube(int lane) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double at : {-1.0, 0.0, 1.0}) {
      errors_.assign(from_.size(), 0.0);
      const double t = middle(lane) + kHalf * at;
      double own = distanceAt(t);
      for (std::size_t i = 1; i < model_.tube.size(); ++i) {
        const detail::MovingBody& body = model_.kinematics.bodies[i];
        if (model_.tube[i].rotation == 0.0) continue;
        double& error =
            errors_[static_cast<std::size_t>(body.variable) + (body.type == Planar ? 2U : 0U)];
        const double kept = error;
        double best = kept;
        for (const double way : {-1.0, 1.0}) {
          error = way * model_.tube[i].rotation / std::abs(body.multiplier);
          const double there = distanceAt(t);
          if (there < own) {
            own = there;
            best = error;
          }
        }
        error = best;
      }
      nearest = std::min(nearest, own);
    }
    errors_.assign(from_.size(), 0.0);
    return nearest;
  }

  /// Makes the second geometry a ball and the first a plate beside the ball's way in its frame, on
  /// the side to which that way bends during the lane. False: it hardly bends.
  bool bendTowardsPlate(Random& random, int lane) {
    const detail::GeometryPair& pair = model_.pairs.front();
    const double radius = 0.1 * size_;
    changeGeometry(model_,
                   [&](std::vector<RobotGeometry>& all) { setShape(Sphere{radius}, all[pair.b]); });
    const auto wayAt = [&](double t) -> Eigen::Vector3d {
      const RobotGeometry& a = model_.robotGeometry[pair.a];
      const Eigen::Isometry3d world_from_body = placed(pair.a, t) * a.body_from_shape.inverse();
      return world_from_body.inverse() * placed(pair.b, t).translation();
    };
    const double t = middle(lane);
    const Eigen::Vector3d at = wayAt(t);
    const Eigen::Vector3d ahead = wayAt(t + kHalf) - at;
    const Eigen::Vector3d behind = wayAt(t - kHalf) - at;
    const double bend = 0.5 * (ahead + behind).norm();
    if (!(bend > 1e-3 * size_)) return false;
    const Eigen::Vector3d n = (ahead + behind).normalized();
    const double thin = 0.5 * radius;
    const double wide = ahead.norm() + behind.norm() + radius;
    changeGeometry(model_, [&](std::vector<RobotGeometry>& all) {
      RobotGeometry& plate = all[pair.a];
      plate.body_from_shape = Eigen::Isometry3d(
          Eigen::Translation3d(at + (radius + bend * random.uniform(1.2, 4.0) + thin) * n));
      plate.body_from_shape.linear() = axisFrame(n);
      setShape(Box{{wide, wide, thin}}, plate);
    });
    return true;
  }

  static constexpr double kHalf = 1.0 / 16.0;
  static double middle(int lane) { return (2 * lane + 1) * kHalf; }
  /// m, over a lane, at samples.
  double nearestIn(int lane) const {
    double nearest = std::numeric_limits<double>::infinity();
    constexpr int kSamples = 24;
    for (int i = 0; i <= kSamples; ++i)
      nearest = std::min(nearest, distanceAt(middle(lane) + kHalf * (2.0 * i / kSamples - 1.0)));
    return nearest;
  }

 private:
  void setShape(Shape shape, RobotGeometry& geometry) const {
    geometry.shape = std::move(shape);
    const BoundingSphere ball = boundingSphere(geometry.shape);
    auto cover = std::make_shared<SphereCover>(*geometry.cover);
    cover->nodes.front().ball = {ball.center.cast<float>(),
                                 static_cast<float>(ball.radius * 1.0001)};
    geometry.cover = cover;
    geometry.center = geometry.body_from_shape * ball.center;
    geometry.radius = ball.radius * 1.0001;
    geometry.levers =
        detail::leverArms(model_.kinematics, geometry.body, geometry.center, geometry.radius);
  }

  void addPair(Random& random) {
    const int count = static_cast<int>(model_.robotGeometry.size());
    detail::GeometryPair pair;
    pair.self = self_;
    pair.a = random.below(count);
    if (self_) {
      pair.b = random.below(count);
      if (pair.a > pair.b) std::swap(pair.a, pair.b);
      const int bodyA = model_.robotGeometry[pair.a].body;
      const int bodyB = model_.robotGeometry[pair.b].body;
      if (bodyA == bodyB) return;
      pair.reference = commonAncestor(model_.kinematics, bodyA, bodyB);
    } else {
      obstacle_ = randomObstacle(random, size_);
      obstacleAt_ = random.pose(4.0 * size_);
      model_.worldGeometry = {worldGeometry(obstacle_, obstacleAt_)};
    }
    model_.pairs.push_back(pair);
  }

  Eigen::Isometry3d placed(int geometry, double t) const {
    const RobotGeometry& piece = model_.robotGeometry[geometry];
    std::vector<double> from = from_, to = to_;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      from[i] += errors_[i];
      to[i] += errors_[i];
    }
    Pose pose = Pose::Identity();
    for (int b = piece.body; b != 0; b = model_.kinematics.bodies[b].parent)
      pose = jointPose(model_.kinematics, model_.kinematics.bodies[b], from, to,
                       static_cast<Real>(t)) *
             pose;
    return pose.cast<double>() * piece.body_from_shape;
  }

  bool self_;
  double size_ = 1.0;
  CheckerModel model_;
  Shape obstacle_ = Sphere{1.0};
  Eigen::Isometry3d obstacleAt_ = Eigen::Isometry3d::Identity();
  std::vector<double> from_, to_;
  std::vector<double> errors_;  ///< rad, of the values; empty: none
};

struct Tally {
  int asked = 0;
  int halfProven = 0;  ///< of lanes that keep twice the margin
  int roomy = 0;       ///< such lanes

  std::string text() const {
    return std::to_string(asked) + " asked, " + std::to_string(halfProven) + " of " +
           std::to_string(roomy) + " proven";
  }
};

/// A gap of a little more than what the lane keeps is never proven; of half of it often. Also
/// across directions that are `off` that of the nearest points.
void tryBoth(Random& random, Pass& pass, int lane, double off, Tally& tally) {
  const double nearest = pass.nearestIn(lane);
  Eigen::Vector3d direction;
  if (!(nearest > 0.0) || !(pass.distanceAt(Pass::middle(lane), &direction) > 0.0)) return;
  if (off > 0.0) direction = (direction + off * random.direction()).normalized();
  const Pass::Found more = pass.divide(nearest * (1.0 + random.scale(1e-6, 1e-2)), lane, direction);
  if (!more.usable) return;
  ASSERT_EQ(more.lanes >> lane & 1U, 0U) << "of " << nearest << " m";
  ++tally.asked;
  const Pass::Found less = pass.divide(0.5 * nearest, lane, direction);
  for (int i = 0; i < detail::kLanes; ++i) {
    const double kept = i == lane ? nearest : pass.nearestIn(i);
    const bool proven = (less.lanes >> i & 1U) != 0;
    if (proven) {
      ASSERT_GE(kept, 0.5 * nearest) << "lane " << i;
    }
    if (kept < nearest) continue;
    ++tally.roomy;
    tally.halfProven += proven ? 1 : 0;
  }
}

void tryManyPasses(bool self, Tally& tally) {
  Random random(self ? 81 : 82);
  constexpr int kRounds = 400;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    Pass pass(random, round, self);
    if (!pass.paired()) continue;
    tryBoth(random, pass, random.below(detail::kLanes), round % 4 == 0 ? 0.3 : 0.0, tally);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(tally.asked, kRounds / 3);
  EXPECT_GT(tally.roomy, tally.asked);
  EXPECT_GT(tally.halfProven, tally.roomy / 5);
}

TEST(SimdPlanes, NoPlaneIsFoundWhereTwoLinksAreTooNear) {
  tallyOnAllTargets<Tally>([](Tally& tally) { tryManyPasses(true, tally); });
}

TEST(SimdPlanes, NoPlaneIsFoundWhereAnObstacleIsTooNear) {
  tallyOnAllTargets<Tally>([](Tally& tally) { tryManyPasses(false, tally); });
}

/// The planes that are sought in closed form prove no more than there is, and most of what keeps
/// twice the margin.
TEST(SimdPlanes, NoPlaneIsSoughtWhereAnObstacleIsTooNear) {
  tallyOnAllTargets<Tally>([](Tally& tally) {
    Random random(85);
    for (int round = 0; round < 400; ++round) {
      SCOPED_TRACE(round);
      Pass pass(random, round, false);
      if (!pass.paired()) continue;
      double least = std::numeric_limits<double>::infinity();
      std::array<double, detail::kLanes> nearest;
      for (int lane = 0; lane < detail::kLanes; ++lane) {
        nearest[static_cast<std::size_t>(lane)] = pass.nearestIn(lane);
        least = std::min(least, nearest[static_cast<std::size_t>(lane)]);
      }
      for (const double share : {0.0, 0.5, 1.001, 1.5}) {
        const double margin = share * std::max(least, 1e-3);
        const Pass::Found found = pass.divideOutward(margin);
        if (!found.usable) break;
        ++tally.asked;
        for (int lane = 0; lane < detail::kLanes; ++lane) {
          const double kept = nearest[static_cast<std::size_t>(lane)];
          const bool proven = (found.lanes >> lane & 1U) != 0;
          if (proven) {
            ASSERT_GT(kept, margin) << "lane " << lane;
          }
          if (kept < 2.0 * margin || kept <= 0.0) continue;
          ++tally.roomy;
          tally.halfProven += proven ? 1 : 0;
        }
      }
    }
    EXPECT_GT(tally.asked, 200);
    EXPECT_GT(tally.roomy, tally.asked);
    EXPECT_GT(tally.halfProven, tally.roomy / 3);
  });
}

/// Ways that bend towards what they pass, so that all that keeps a plane from being found is what
/// bounds the bends.
TEST(SimdPlanes, NoPlaneIsFoundWhereAWayBendsTooNear) {
  tallyOnAllTargets<Tally>([](Tally& tally) {
    Random random(84);
    for (int round = 0; round < 5000; ++round) {
      SCOPED_TRACE(round);
      Pass pass(random, round, true);
      const int lane = random.below(detail::kLanes);
      if (!pass.paired() || !pass.bendTowardsPlate(random, lane)) continue;
      tryBoth(random, pass, lane, 0.0, tally);
      if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(tally.asked, 200);
    EXPECT_GT(tally.halfProven, 100);
  });
}

/// What errors of joints add along a direction is enough for all of the tube, at every time.
TEST(SimdPlanes, NoPlaneIsFoundWhereATubeComesTooNear) {
  tallyOnAllTargets<Tally>([](Tally& tally) {
    Random random(85);
    constexpr int kRounds = 600;
    int matters = 0;  // without its tube, the motion keeps more
    for (int round = 0; round < kRounds; ++round) {
      SCOPED_TRACE(round);
      Pass pass(random, round, round % 2 == 0);
      if (!pass.paired()) continue;
      pass.err(random.scale(1e-4, 0.1));
      const int lane = random.below(detail::kLanes);
      const double nearest = pass.nearestInTube(lane);
      Eigen::Vector3d direction;
      if (!(nearest > 0.0) || !(pass.distanceAt(Pass::middle(lane), &direction) > 0.0)) continue;
      const double more = nearest * (1.0 + random.scale(1e-6, 1e-2));
      const Pass::Found found = pass.divide(more, lane, direction);
      if (!found.usable) continue;
      ASSERT_EQ(found.lanes >> lane & 1U, 0U) << "of " << nearest << " m";
      ++tally.asked;
      matters += pass.nearestIn(lane) > more ? 1 : 0;
      ++tally.roomy;
      tally.halfProven += pass.divide(0.5 * nearest, lane, direction).lanes >> lane & 1U;
    }
    EXPECT_GT(tally.asked, kRounds / 3);
    EXPECT_GT(matters, tally.asked / 3);
    EXPECT_GT(tally.halfProven, tally.roomy / 5);
  });
}

/// Errors that are no turns have no direction here.
TEST(SimdPlanes, NoPlaneIsFoundInATubeOfSlides) {
  Random random(86);
  int proven = 0;
  for (int round = 0; round < 100; ++round) {
    Pass pass(random, 2 + 5 * round, round % 2 == 0);
    if (!pass.paired()) continue;
    const double nearest = pass.nearestIn(3);
    Eigen::Vector3d direction;
    if (!(nearest > 0.0) || !(pass.distanceAt(Pass::middle(3), &direction) > 0.0)) continue;
    pass.err(1e-6);
    const bool turning = pass.divide(0.5 * nearest, 3, direction).lanes != 0;
    pass.err(1e-6, 1e-9);
    const bool sliding = pass.divide(0.5 * nearest, 3, direction).lanes != 0;
    proven += turning && !sliding ? 1 : 0;
    EXPECT_TRUE(turning || !sliding);
  }
  EXPECT_GT(proven, 20);
}

TEST(SimdPlanes, NothingIsProvenAcrossNoDirection) {
  Random random(83);
  int asked = 0;
  for (int round = 0; round < 40; ++round) {
    Pass pass(random, round, round % 2 == 0);
    if (!pass.paired()) continue;
    const Pass::Found none = pass.divide(1e-3, 3, Eigen::Vector3d::Zero());
    asked += none.usable ? 1 : 0;
    EXPECT_EQ(none.lanes, 0U);
    EXPECT_EQ(pass.divide(1e-3, 3, Eigen::Vector3d::Constant(std::nan(""))).lanes, 0U);
  }
  EXPECT_GT(asked, 20);
}

}  // namespace
}  // namespace swept::simd_test
