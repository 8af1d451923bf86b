// SPDX-License-Identifier: BSD-3-Clause
// Trajectories that are proven as a controller executes them, and repairs of those that are not.
#include "swept/robot_model/proven_trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "model_robots.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

using Path = std::vector<std::vector<double>>;

std::shared_ptr<const World> scene(const std::string& name) {
  return std::make_shared<const World>(World::load(modelsDir() + "/scenes/" + name + ".yaml"));
}

RateLimits limitsOf(const Checker& checker) {
  RateLimits limits = RateLimits::of(checker.robot(), checker.group());
  for (double& limit : limits.velocity) limit = std::min(limit, 2.0);
  for (double& limit : limits.acceleration) limit = 4.0;
  for (double& limit : limits.jerk) limit = 40.0;
  return limits;
}

/// Random walks whose straight motions are free.
class FreeWalks {
 public:
  explicit FreeWalks(const Checker& checker) : checker_(checker), workspace_(checker) {}

  Path draw(std::mt19937& random, std::size_t states) {
    Path path{freeState(random)};
    std::normal_distribution<double> step(0.0, 0.4);
    for (int tries = 0; path.size() < states && tries < 2000; ++tries) {
      std::vector<double> next = path.back();
      for (std::size_t i = 0; i < next.size(); ++i) next[i] = bounded(i, next[i] + step(random));
      if (checker_.certifyMotion(path.back(), next, workspace_, MotionQuery::VerdictOnly).verdict ==
          Verdict::Free)
        path.push_back(next);
    }
    return path;
  }

  std::vector<double> stateOf(Verdict verdict, std::mt19937& random) {
    for (;;) {
      std::vector<double> q;
      for (std::size_t i = 0; i < checker_.group().variables.size(); ++i) {
        const bool isBounded = std::isfinite(variable(i).lower);
        q.push_back(std::uniform_real_distribution<double>(
            isBounded ? variable(i).lower : -1.0, isBounded ? variable(i).upper : 1.0)(random));
      }
      if (checker_.checkState(q, workspace_) == verdict) return q;
    }
  }

 private:
  const Variable& variable(std::size_t i) const {
    return checker_.robot().variables()[static_cast<std::size_t>(checker_.group().variables[i])];
  }
  double bounded(std::size_t i, double value) const {
    return std::isfinite(variable(i).lower)
               ? std::clamp(value, variable(i).lower, variable(i).upper)
               : value;
  }
  std::vector<double> freeState(std::mt19937& random) { return stateOf(Verdict::Free, random); }

  const Checker& checker_;
  Workspace workspace_;
};

/// No state of the curve, or of the tube at its corners, is in contact.
void refute(const PiecewisePolynomial& curve, const Checker& plain, double tube,
            std::mt19937& random) {
  Workspace workspace(plain);
  const int steps = static_cast<int>(curve.duration() / 0.002) + 1;
  std::bernoulli_distribution coin;
  for (int i = 0; i <= steps; ++i) {
    Eigen::VectorXd q = curve.position(curve.begin() + curve.duration() * i / steps);
    ASSERT_NE(plain.checkState(q, workspace), Verdict::Collision);
    for (double& value : q) value += coin(random) ? tube : -tube;
    ASSERT_NE(plain.checkState(q, workspace), Verdict::Collision);
  }
}

TEST(ProvenTrajectory, EveryProvenPathHasOne) {
  std::mt19937 random(47);
  int blends = 0, stops = 0, smaller = 0;
  for (const auto& [robot, group, world] : {std::tuple{"rook7", "arm", "shelf"},
                                            {"rook7", "arm", "narrow_slot"},
                                            {"rook7", "arm_with_gripper", "table_objects"},
                                            {"rook6", "arm_with_tool", "bin"}}) {
    SCOPED_TRACE(robot);
    const Checker plain(test::modelRobot(robot), group, scene(world));
    constexpr double kTube = 0.005;
    const Checker checker = plain.withTracking({{.rotation = kTube, .translation = 0.0}, {}});
    FreeWalks walks(checker);
    for (int i = 0; i < 20; ++i) {
      const Path path = walks.draw(random, 6);
      TimingOptions options;
      options.jerkLimited = i % 3 == 0;
      const ProvenTrajectory proven = provenTrajectory(checker, path, limitsOf(checker), options);
      ASSERT_EQ(proven.certificate.verdict, Verdict::Free);
      EXPECT_TRUE(proven.certificate.violations.empty());
      for (const TimedCorner& corner : proven.timed.corners) {
        ++(corner.stops() ? stops : blends);
        smaller += !corner.stops() && corner.deviation < 0.09 ? 1 : 0;
        EXPECT_LE(corner.deviation, options.blendDeviation * (1.0 + 1e-9));
      }
      const PiecewisePolynomial& curve = proven.timed.curve;
      EXPECT_EQ(curve.position(curve.begin()),
                Eigen::Map<const Eigen::VectorXd>(path.front().data(),
                                                  static_cast<Eigen::Index>(path.front().size())));
      std::mt19937 errors(random());
      // Sliding joints have no tube here.
      refute(curve, plain, std::string(group) == "arm" ? kTube : 0.0, errors);
    }
  }
  EXPECT_GT(blends, 50);
  EXPECT_GT(smaller, 5);
  RecordProperty("stops", stops);
}

/// Beside the hand a ball so large that the straight motion is only just proven.
TEST(ProvenTrajectory, NeedsNoMoreRoomThanItsStraightMotions) {
  const auto robot = test::modelRobot("rook7");
  const Checker empty = Checker(robot, "arm", std::make_shared<const World>())
                            .withTracking({{.rotation = 0.005, .translation = 0.0}, {}});
  FreeWalks walks(empty);
  std::mt19937 random(49);
  int tight = 0, onLine = 0;
  for (int i = 0; i < 60; ++i) {
    Path path = walks.draw(random, 3);
    std::vector<double> middle;
    for (std::size_t k = 0; k < path[0].size(); ++k)
      middle.push_back(0.5 * (path[0][k] + path[1][k]));
    // A way point on the line between its neighbours is no corner.
    const bool hasMiddle = i % 4 != 0;
    if (hasMiddle) path.insert(path.begin() + 1, middle);
    const Eigen::Isometry3d hand = linkPose(
        *robot, "arm", "hand",
        Eigen::Map<Eigen::VectorXd>(middle.data(), static_cast<Eigen::Index>(middle.size())));
    std::normal_distribution<double> side(0.0, 0.2);
    const double x = side(random);
    const Eigen::Vector3d beside(x, side(random), 0.3);
    const auto withBall = [&](double radius) {
      return empty.withBody("ball", makeSphere(radius), hand * Eigen::Translation3d(beside));
    };
    const auto isFree = [&](double radius) {
      const Checker checker = withBall(radius);
      Workspace workspace(checker);
      for (std::size_t k = 0; k + 1 < path.size(); ++k)
        if (checker.certifyMotion(path[k], path[k + 1], workspace).verdict != Verdict::Free)
          return false;
      return true;
    };
    double free = 1e-3, open = 0.5;
    if (!isFree(free) || isFree(open)) continue;
    while (open - free > 1e-5) {
      const double radius = 0.5 * (free + open);
      (isFree(radius) ? free : open) = radius;
    }
    ++tight;
    const Checker checker = withBall(free);
    for (const bool jerkLimited : {false, true}) {
      TimingOptions options;
      options.jerkLimited = jerkLimited;
      const ProvenTrajectory proven = provenTrajectory(checker, path, limitsOf(checker), options);
      EXPECT_EQ(proven.certificate.verdict, Verdict::Free) << i;
      // A stop there, as the motion through it was left undecided.
      for (const TimedCorner& corner : proven.timed.corners)
        onLine += hasMiddle && corner.wayPoint == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(tight, 20);
  EXPECT_GT(onLine, 0);
}

/// A ball where the hand would be in the middle of the largest blend.
TEST(ProvenTrajectory, BlendsLessBesideAnObstacle) {
  const auto robot = test::modelRobot("rook7");
  const Checker empty(robot, "arm", std::make_shared<const World>());
  Workspace workspace(empty);
  const std::vector<double> corner{0.0, 0.5, 0.0, 1.2, 0.0, 0.8, 0.0};
  std::vector<double> before = corner, after = corner;
  before[0] -= 0.8;
  after[1] -= 0.6;
  for (const double radius : {0.02, 0.01, 0.005, 0.002}) {
    SCOPED_TRACE(radius);
    const RateLimits limits = limitsOf(empty);
    const ProvenTrajectory free = provenTrajectory(empty, Path{before, corner, after}, limits);
    ASSERT_EQ(free.timed.corners.size(), 1U);
    ASSERT_FALSE(free.timed.corners[0].stops());
    ASSERT_EQ(free.certificate.verdict, Verdict::Free);
    // What is in the middle of the blend, and how far the hand is there from where it goes else.
    const double middle = 0.5 * (free.timed.corners[0].begin + free.timed.corners[0].end);
    const Eigen::VectorXd cut = free.timed.curve.position(middle);
    const Eigen::Isometry3d at = linkPose(*robot, "arm", "hand", cut);
    const Checker checker =
        empty.withBody("ball", makeSphere(radius), at * Eigen::Translation3d(0.0, 0.0, 0.05));
    const ProvenTrajectory proven = provenTrajectory(checker, Path{before, corner, after}, limits);
    if (proven.certificate.verdict == Verdict::Free) {
      EXPECT_LT(proven.timed.corners[0].deviation, free.timed.corners[0].deviation);
      continue;
    }
    // One of the straight motions meets the ball, too.
    Workspace inWorld(checker);
    EXPECT_TRUE(checker.certifyMotion(before, corner, inWorld).verdict != Verdict::Free ||
                checker.certifyMotion(corner, after, inWorld).verdict != Verdict::Free);
  }
}

TEST(ProvenTrajectory, RefusesMovingObstacles) {
  const auto robot = test::modelRobot("rook7");
  MovingObstacle box{.name = "box",
                     .parts = {{makeBox({0.1, 0.1, 0.1}), Eigen::Isometry3d::Identity()}}};
  box.waypoints.push_back({0.0, Eigen::Isometry3d(Eigen::Translation3d(3.0, 0.0, 0.0))});
  World world;
  world.add(box);
  const Checker checker(robot, "arm", std::make_shared<const World>(world));
  const std::vector<double> q(7, 0.0);
  EXPECT_EQ(test::messageOf([&] {
              provenTrajectory(checker, Path{q, q}, limitsOf(checker));
            }),
            "provenTrajectory: the world has moving obstacles, whose places depend on the times "
            "that are to be found");
}

/// A cubic that swings out between two points whose straight motion is free.
TEST(RepairTrajectory, FollowsACurveThatSwingsOut) {
  const auto robot = test::modelRobot("rook7");
  const Checker checker(robot, "arm", scene("shelf"));
  Workspace workspace(checker);
  FreeWalks walks(checker);
  std::mt19937 random(48);
  int repaired = 0, refused = 0;
  for (int i = 0; i < 60; ++i) {
    Path path = walks.draw(random, 3);
    if (i % 4 == 0) path[1] = walks.stateOf(Verdict::Collision, random);
    JointTrajectory trajectory;
    for (const int variable : checker.group().variables)
      trajectory.variables.push_back(robot->variables()[static_cast<std::size_t>(variable)].name);
    std::normal_distribution<double> swing(0.0, 1.5);
    for (std::size_t k = 0; k < path.size(); ++k) {
      std::vector<double> velocity(7, 0.0);
      if (k == 1)
        for (double& value : velocity) value = swing(random);
      trajectory.points.push_back({1.0 * static_cast<double>(k), path[k], velocity, {}});
    }
    const PiecewisePolynomial curve = controllerCurve(trajectory);
    const TrajectoryCertificate found = checker.certifyTrajectory(curve, workspace);
    const RepairedTrajectory fixed = repairTrajectory(checker, curve, limitsOf(checker));
    if (fixed.proven) {
      ++repaired;
      EXPECT_FALSE(fixed.place);
      EXPECT_EQ(fixed.proven->certificate.verdict, Verdict::Free);
      EXPECT_GE(fixed.wayPoints.size(), 3U + fixed.inserted);
      std::mt19937 errors(7);
      refute(fixed.proven->timed.curve, checker, 0.0, errors);
      continue;
    }
    ++refused;
    ASSERT_TRUE(fixed.place);
    // The place is one of the curve that is not free by itself.
    EXPECT_NE(found.verdict, Verdict::Free);
    EXPECT_NE(checker.checkState(curve.position(fixed.place->time), workspace), Verdict::Free);
  }
  EXPECT_GT(repaired, 15);
  EXPECT_GE(refused, 15);
}

}  // namespace
}  // namespace swept
