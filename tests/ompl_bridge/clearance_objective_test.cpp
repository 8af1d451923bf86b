// SPDX-License-Identifier: BSD-3-Clause
// Which pairs an objective's clearance is of. A hand is always as far from its carriage: that says
// nothing about a path, and must not hide what the path keeps from a post beside it.
#include "swept/ompl_bridge/clearance_objective.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "slide_robot.hpp"
#include "swept/ompl_bridge/setup.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
using Eigen::Isometry3d;
using Eigen::Translation3d;

constexpr double kSelf = test::kSlideGap;       // m
constexpr double kRadius = test::kSlideRadius;  // m, of all balls
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::string kUrdf = test::slideUrdf("0 1 0");

class ClearanceObjective : public testing::Test {
 protected:
  ClearanceObjective() { si_->setup(); }
  static std::shared_ptr<const Checker> checker() {
    World world;
    world.add("post", makeSphere(kRadius), Isometry3d::Identity());
    return std::make_shared<const Checker>(Robot::parse(kUrdf, "slide.urdf"), "all",
                                           std::make_shared<const World>(std::move(world)));
  }
  /// m, from the carriage to the post; the hand is farther away on the motions here.
  static double toPost(double y) { return std::abs(y) - 2 * kRadius; }
  ob::ScopedState<> state(double y) const {
    ob::ScopedState<> state(si_);
    StateConversion(checker_->robot(), checker_->group()).toState({y, 0.3}, state.get());
    return state;
  }
  double motionCost(const CertifiedClearanceObjective& objective, double from, double to) const {
    return objective.motionCost(state(from).get(), state(to).get()).value();
  }

  std::shared_ptr<const Checker> checker_ = checker();
  ompl::geometric::SimpleSetupPtr setup_ = makeSimpleSetup(checker_);
  ob::SpaceInformationPtr si_ = setup_->getSpaceInformation();
};

TEST_F(ClearanceObjective, IsOfTheWorldUnlessToldOtherwise) {
  const CertifiedClearanceObjective objective(si_, checker_, 1e-4);
  const CertifiedClearanceObjective world(si_, checker_, 1e-4, ClearanceOf::World);
  for (const double y : {0.5, 0.9, 1.6}) {
    EXPECT_NEAR(objective.stateCost(state(y).get()).value(), toPost(y), 1e-8);
    EXPECT_NEAR(motionCost(objective, y, y + 0.3), toPost(y), 1e-4);
    EXPECT_EQ(motionCost(objective, y, y + 0.3), motionCost(world, y, y + 0.3));
  }
  // The motion that keeps more is the better one.
  EXPECT_TRUE(objective.isCostBetterThan(ob::Cost(motionCost(objective, 0.9, 1.2)),
                                         ob::Cost(motionCost(objective, 0.5, 1.2))));
}

TEST_F(ClearanceObjective, OfAllPairsDoesNotTellThemApart) {
  const CertifiedClearanceObjective objective(si_, checker_, 1e-4, ClearanceOf::All);
  EXPECT_NEAR(objective.stateCost(state(0.5).get()).value(), kSelf, 1e-8);
  EXPECT_NEAR(motionCost(objective, 0.5, 1.2), kSelf, 1e-4);
  EXPECT_NEAR(motionCost(objective, 0.9, 1.2), kSelf, 1e-4);
  // Near to the post, or in it, it is the post that counts.
  EXPECT_NEAR(motionCost(objective, 0.105, 1.2), 0.005, 1e-4);
  EXPECT_EQ(motionCost(objective, 0.05, 1.2), 0.0);
}

TEST_F(ClearanceObjective, OfTheRobotAloneDoesNotSeeTheWorld) {
  const CertifiedClearanceObjective objective(si_, checker_, 1e-4, ClearanceOf::Self);
  EXPECT_NEAR(objective.stateCost(state(0.0).get()).value(), kSelf, 1e-8);
  EXPECT_NEAR(motionCost(objective, -1.0, 1.0), kSelf, 1e-4);
}

TEST_F(ClearanceObjective, IsInfiniteWithoutPairs) {
  const auto empty = std::make_shared<const Checker>(checker_->withoutBody("post"));
  const CertifiedClearanceObjective objective(si_, empty, 1e-4);
  EXPECT_EQ(objective.stateCost(state(0.5).get()).value(), kInfinity);
  EXPECT_EQ(motionCost(objective, 0.5, 1.0), kInfinity);
}

TEST_F(ClearanceObjective, SaysWhatItIsOf) {
  const auto description = [&](ClearanceOf pairs) {
    return CertifiedClearanceObjective(si_, checker_, 1e-4, pairs).getDescription();
  };
  EXPECT_EQ(description(ClearanceOf::World), "Proven least clearance of the motions to the world");
  EXPECT_EQ(description(ClearanceOf::Self),
            "Proven least clearance of the robot's bodies to each other");
  EXPECT_EQ(description(ClearanceOf::All), "Proven least clearance of the motions");
}

}  // namespace
}  // namespace swept
