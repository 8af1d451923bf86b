// SPDX-License-Identifier: BSD-3-Clause
// Pairs with the world and pairs of the robot's own bodies are told apart. A hand turns about its
// own middle, always as far from the carriage: what it says must not hide the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "slide_robot.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using testing::HasSubstr;

constexpr double kRadius = test::kSlideRadius;  // m, of all balls
constexpr double kSelf = test::kSlideGap;       // m
constexpr double kAway = 0.2;                   // m, of the post beside the way
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::string kUrdf = test::slideUrdf("1 0 0");

class WorldAndSelf : public testing::Test {
 protected:
  static Checker checker(CheckerOptions options = {}) {
    World world;
    world.add("post", makeSphere(kRadius), Isometry3d(Translation3d(0, kAway, 0)));
    return {Robot::parse(kUrdf, "slide.urdf"), "all",
            std::make_shared<const World>(std::move(world)), options};
  }
  /// m, from the carriage or the hand to the post.
  static double toPost(double x) {
    const double carriage = std::hypot(x, kAway), hand = std::hypot(x + 2 * kRadius + kSelf, kAway);
    return std::min(carriage, hand) - 2 * kRadius;
  }
  static StateReport report(const Checker& checker, double x) {
    Workspace workspace(checker);
    return checker.reportState(std::array{x, 0.3}, workspace);
  }
};

TEST_F(WorldAndSelf, ReportsHaveBothClearances) {
  const Checker all = checker();
  for (const double x : {-1.5, -0.6, -0.1136, -0.05, 0.0, 0.4, 1.2}) {
    const StateReport found = report(all, x);
    EXPECT_NEAR(found.world.clearance, toPost(x), 1e-8) << x;
    EXPECT_EQ(found.world.bodyA, std::abs(x) < std::abs(x + 0.1136) ? "carriage" : "hand") << x;
    EXPECT_EQ(found.world.bodyB, "post");
    EXPECT_NEAR(found.self.clearance, kSelf, 1e-8) << x;
    EXPECT_EQ(found.self.bodyA, "carriage");
    EXPECT_EQ(found.self.bodyB, "hand");
    EXPECT_EQ(found.clearance, std::min(found.world.clearance, found.self.clearance));
    EXPECT_TRUE(found.nearestSelfPair);
  }
}

TEST_F(WorldAndSelf, KindsWithoutPairsAreInfinitelyFar) {
  const StateReport alone = report(checker().withoutBody("post"), 0.0);
  EXPECT_EQ(alone.world.clearance, kInfinity);
  EXPECT_EQ(alone.world.bodyA, "");
  EXPECT_NEAR(alone.clearance, kSelf, 1e-8);
  const StateReport apart =
      report(checker().withRules(CollisionRules().allow("carriage", "hand")), 0.0);
  EXPECT_EQ(apart.self.clearance, kInfinity);
  EXPECT_EQ(apart.nearestA, "carriage");
  EXPECT_EQ(apart.nearestB, "post");
  EXPECT_FALSE(apart.nearestSelfPair);
}

TEST_F(WorldAndSelf, MotionsHaveBothClearances) {
  const Checker all = checker();
  Workspace workspace(all);
  constexpr double kAccuracy = 1e-4;
  for (const auto& [from, to, least] : {std::array{-1.5, 1.5, kAway - 2 * kRadius},
                                        {-1.5, -0.5, toPost(-0.5)},
                                        {0.3, 1.2, toPost(0.3)}}) {
    const std::array begin{from, -2.0}, end{to, 2.0};
    const MotionClearance found = all.motionClearance(begin, end, kAccuracy, workspace);
    EXPECT_LE(found.world.lower, least + 1e-9);
    EXPECT_GE(found.world.lower, least - kAccuracy - 1e-9);
    EXPECT_GE(found.world.upper, least - 1e-9);
    EXPECT_LE(found.world.upper - found.world.lower, kAccuracy + 1e-9);
    EXPECT_NEAR(toPost(from + found.world.t * (to - from)), found.world.upper, 1e-8);
    EXPECT_EQ(found.world.bodyB, "post");
    EXPECT_LE(found.self.lower, kSelf + 1e-9);
    EXPECT_GE(found.self.lower, kSelf - kAccuracy - 1e-9);
    EXPECT_EQ(found.self.bodyA, "carriage");
    EXPECT_EQ(found.self.bodyB, "hand");
    // The whole is the nearer of the two.
    EXPECT_EQ(found.lower, found.self.lower);
    EXPECT_EQ(found.bodyB, "hand");
    EXPECT_TRUE(found.selfPair);
    const MotionClearance whole =
        all.motionClearance(begin, end, kAccuracy, workspace, ClearanceQuery::Least);
    EXPECT_NEAR(whole.lower, kSelf, kAccuracy + 1e-9);
    EXPECT_EQ(whole.bodyB, "hand");
    EXPECT_TRUE(whole.selfPair);
  }
}

// Asked for one kind, the search takes less time and finds the same.
TEST_F(WorldAndSelf, OneKindAloneIsAsInBoth) {
  const Checker all = checker();
  Workspace workspace(all);
  constexpr double kAccuracy = 1e-4;
  for (const auto& [from, to] : {std::array{-1.5, 1.5}, {-1.5, -0.5}, {-0.2, 0.0}}) {
    const auto of = [&, from = from, to = to](ClearanceQuery query) {
      return all.motionClearance({from, -2.0}, {to, 2.0}, kAccuracy, workspace, query);
    };
    const MotionClearance both = of(ClearanceQuery::ByKind);
    const MotionClearance world = of(ClearanceQuery::World);
    EXPECT_EQ(world.world.lower, both.world.lower);
    EXPECT_EQ(world.world.upper, both.world.upper);
    EXPECT_EQ(world.upper, world.world.upper);
    EXPECT_EQ(world.lower, world.world.lower);
    EXPECT_EQ(world.t, both.world.t);
    EXPECT_EQ(world.bodyB, "post");
    EXPECT_FALSE(world.selfPair);
    EXPECT_EQ(world.self.lower, 0.0);
    EXPECT_EQ(world.self.upper, kInfinity);
    EXPECT_LE(world.intervals, both.intervals);
    const MotionClearance self = of(ClearanceQuery::Self);
    EXPECT_EQ(self.self.lower, both.self.lower);
    EXPECT_EQ(self.self.upper, both.self.upper);
    EXPECT_EQ(self.lower, self.self.lower);
    EXPECT_EQ(self.bodyB, "hand");
    EXPECT_TRUE(self.selfPair);
    EXPECT_EQ(self.world.lower, 0.0);
    EXPECT_EQ(self.world.upper, kInfinity);
    EXPECT_LE(self.intervals, both.intervals);
  }
  // Of a kind without pairs everything is far away, and nothing is said of the other.
  const Checker alone = all.withoutBody("post");
  Workspace scratch(alone);
  const MotionClearance none =
      alone.motionClearance({0, 0}, {1, 0}, kAccuracy, scratch, ClearanceQuery::World);
  EXPECT_EQ(none.lower, kInfinity);
  EXPECT_EQ(none.upper, kInfinity);
  EXPECT_FALSE(none.selfPair);
}

TEST_F(WorldAndSelf, AContactWithOneDoesNotHideTheOther) {
  const Checker all = checker().withBody(
      {.name = "in the way", .parts = {{makeSphere(kRadius), Isometry3d::Identity()}}});
  Workspace workspace(all);
  const std::array begin{-1.5, -2.0}, end{1.5, 2.0};
  const MotionClearance found = all.motionClearance(begin, end, 1e-4, workspace);
  EXPECT_EQ(found.upper, 0.0);
  EXPECT_EQ(found.world.upper, 0.0);
  EXPECT_EQ(found.world.bodyB, "in the way");
  EXPECT_NEAR(found.self.lower, kSelf, 1e-4 + 1e-9);
  EXPECT_GE(found.self.upper, kSelf - 1e-9);
}

TEST_F(WorldAndSelf, MarginsAreOfTheirKind) {
  const auto verdict = [](const CheckerOptions& options, double x) {
    const Checker all = checker(options);
    Workspace workspace(all);
    const Verdict found = all.checkState(std::array{x, 0.3}, workspace);
    EXPECT_EQ(report(all, x).verdict, found);
    EXPECT_EQ(all.certifyMotion(std::array{x, 0.3}, std::array{x, 0.4}, workspace).verdict, found);
    return found;
  };
  EXPECT_EQ(verdict({.margin = 0.02}, 1.0), Verdict::Collision);
  EXPECT_EQ(verdict({.margin = 0.02, .selfMargin = 0.01}, 1.0), Verdict::Free);
  EXPECT_EQ(verdict({.worldMargin = 0.5}, 1.0), Verdict::Free);
  EXPECT_EQ(verdict({.worldMargin = 0.5}, 0.3), Verdict::Collision);
  EXPECT_EQ(verdict({.margin = 0.5, .selfMargin = 0.01, .worldMargin = 0.05}, 0.3), Verdict::Free);
  EXPECT_EQ(verdict({.selfMargin = 0.02}, 1.0), Verdict::Collision);
}

TEST_F(WorldAndSelf, PairsSayWhatTheyKeep) {
  const Checker all = checker({.margin = 0.5, .selfMargin = 0.01, .worldMargin = 0.03});
  for (const Checker::Pair& pair : all.checkedPairs())
    EXPECT_EQ(pair.margin, pair.selfPair ? 0.01 : 0.03);
  EXPECT_EQ(all.explain("hand", "post"), "hand - post: checked, keeps more than 0.03 m");
  EXPECT_EQ(all.withRules(CollisionRules().pad("hand", 0.001)).explain("hand", "carriage"),
            "hand - carriage: checked, keeps more than 0.011 m (margin 0.01 m, padding of hand "
            "0.001 m)");
}

TEST_F(WorldAndSelf, MovingObstaclesAreOfTheWorld) {
  const MovingObstacle obstacle{
      .name = "cart",
      .parts = {{makeSphere(kRadius), Isometry3d::Identity()}},
      .waypoints = {{.time = 0.0, .world_from_body = Isometry3d(Translation3d(0, -0.15, 0))},
                    {.time = 1.0, .world_from_body = Isometry3d(Translation3d(0, -0.25, 0))}}};
  const Checker all = checker({.worldMargin = 0.02}).withObstacle(obstacle);
  Workspace workspace(all);
  const StateReport found = all.reportState(std::array{0.0, 0.3, 0.0}, workspace);
  EXPECT_EQ(found.world.bodyB, "cart");
  EXPECT_NEAR(found.world.clearance, 0.05, 1e-8);
  EXPECT_EQ(found.self.bodyB, "hand");
  EXPECT_EQ(found.verdict, Verdict::Free);
  const MotionClearance motion =
      all.motionClearance(std::array{0.0, 0.3, 0.0}, std::array{0.0, 0.3, 1.0}, 1e-4, workspace);
  EXPECT_EQ(motion.world.bodyB, "cart");
  EXPECT_NEAR(motion.world.lower, 0.05, 1e-4 + 1e-9);
  EXPECT_NEAR(motion.self.lower, kSelf, 1e-4 + 1e-9);
}

TEST_F(WorldAndSelf, WitnessesHaveTheNearestPointsAndTheMargin) {
  const Checker all = checker({.worldMargin = 0.2});
  const StateReport near = report(all, 0.0);
  ASSERT_EQ(near.contacts.size(), 2U);
  EXPECT_EQ(near.contacts[0].bodyA, "carriage");
  EXPECT_NEAR(near.contacts[0].distance, kAway - 2 * kRadius, 1e-8);
  EXPECT_EQ(near.contacts[0].margin, 0.2);
  // In each other: any two points are within the margin, the nearest are the same.
  const Checker deep = all.withBody(
      {.name = "block", .parts = {{makeBox({0.4, 0.4, 0.4}), Isometry3d::Identity()}}});
  const StateReport touching = report(deep, 0.0);
  EXPECT_EQ(std::ranges::count(touching.contacts, "block", &Witness::bodyB), 2);
  for (const Witness& contact : touching.contacts)
    EXPECT_EQ(contact.distance == 0.0, contact.bodyB == "block");
  Workspace workspace(deep);
  const MotionCertificate met =
      deep.certifyMotion(std::array{0.0, 0.0}, std::array{1.0, 0.0}, workspace);
  ASSERT_TRUE(met.witness);
  EXPECT_EQ(met.witness->t, 0.0);
  // Of a motion that comes near from afar, the distance at the first contact is the margin.
  const MotionCertificate coming =
      all.certifyMotion(std::array{-1.5, 0.0}, std::array{1.5, 0.0}, workspace);
  ASSERT_TRUE(coming.witness);
  EXPECT_NEAR(coming.witness->distance, 0.2, 2e-4);
  EXPECT_LE(coming.witness->distance, 0.2);
}

TEST_F(WorldAndSelf, BadMarginsAreRefused) {
  const auto refusal = [](const CheckerOptions& options) -> std::string {
    try {
      checker(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.selfMargin = -0.01}),
            "Checker: selfMargin -0.01 m must be a finite number that is not negative");
  EXPECT_THAT(refusal({.worldMargin = kInfinity}), HasSubstr("Checker: worldMargin "));
  EXPECT_THAT(refusal({.worldMargin = std::nan("")}), HasSubstr("Checker: worldMargin "));
}

}  // namespace
}  // namespace swept
