// SPDX-License-Identifier: BSD-3-Clause
// GoalSampleableRegion, by its contract (contract.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/util/Exception.h>

#include <chrono>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
using State = ob::ScopedState<>;
namespace og = ompl::geometric;

class PoseGoalContract : protected Seeded, public testing::Test {
 protected:
  /// Of the ball, which is where its three values say.
  PoseGoal goalAt(double x, double y, double z) const {
    return {si_, checker_, "ball", Eigen::Isometry3d(Eigen::Translation3d(x, y, z)), options_};
  }
  static PoseGoalOptions coarse() {
    PoseGoalOptions options;
    options.positionTolerance = 1.2;
    options.maxSamples = 6;
    return options;
  }
  void awaitSamples(const PoseGoal& goal) const {
    si_->setup();
    while (goal.isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(boxes()));
  og::SimpleSetupPtr setup_ = makeSimpleSetup(checker_);
  ob::SpaceInformationPtr si_ = setup_->getSpaceInformation();
  PoseGoalOptions options_ = coarse();
};

TEST_F(PoseGoalContract, TellsWhetherItCanSample) {
  PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  for (const auto type :
       {ob::GOAL_REGION, ob::GOAL_SAMPLEABLE_REGION, ob::GOAL_STATES, ob::GOAL_LAZY_SAMPLES}) {
    EXPECT_TRUE(goal.hasType(type)) << type;
  }
  State state(si_->getStateSpace());
  // Nothing is sampled before the setup, but something may be later.
  EXPECT_FALSE(goal.canSample());
  EXPECT_TRUE(goal.couldSample());
  EXPECT_EQ(goal.maxSampleCount(), 0u);
  EXPECT_THROW(goal.sampleGoal(state.get()), ompl::Exception);
  awaitSamples(goal);
  EXPECT_TRUE(goal.canSample());
  EXPECT_TRUE(goal.couldSample());
  EXPECT_EQ(goal.maxSampleCount(), 6u);
  EXPECT_EQ(goal.getStateCount(), 6u);
  EXPECT_THROW(goal.getState(6), ompl::Exception);
  goal.clear();
  EXPECT_FALSE(goal.canSample());
  EXPECT_THROW(goal.sampleGoal(state.get()), ompl::Exception);
  std::ostringstream text;
  EXPECT_NO_THROW(goal.print(text));

  PoseGoal beyond = goalAt(5.0, 0.0, 0.0);
  awaitSamples(beyond);
  EXPECT_FALSE(beyond.canSample());
  EXPECT_FALSE(beyond.couldSample());
}

/// "The maximum number of samples that can be asked for before repeating."
TEST_F(PoseGoalContract, RepeatsItsSamplesInTurn) {
  const PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  awaitSamples(goal);
  std::vector<State> seen;
  for (unsigned int i = 0; i < 2 * goal.maxSampleCount(); ++i) {
    State state(si_->getStateSpace());
    goal.sampleGoal(state.get());
    EXPECT_TRUE(goal.isSatisfied(state.get()));
    EXPECT_TRUE(si_->isValid(state.get()));
    for (std::size_t k = 0; k < seen.size(); ++k)
      EXPECT_EQ(si_->equalStates(seen[k].get(), state.get()), k + goal.maxSampleCount() == i);
    seen.push_back(state);
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST_F(PoseGoalContract, IsSatisfiedWithinItsThreshold) {
  PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  int satisfied = 0;
  State state(si_->getStateSpace());
  for (const double threshold : {1.0, 0.5}) {
    goal.setThreshold(threshold);
    EXPECT_EQ(goal.getThreshold(), threshold);
    for (int i = 0; i < 500; ++i) {
      state.random();
      const std::vector<double> at = state.reals();
      const double away = Eigen::Vector3d(at[0] - 0.5, at[1], at[2] + 0.2).norm() / 1.2;
      double told = -1.0;
      EXPECT_NEAR(goal.distanceGoal(state.get()), away, 1e-12);
      EXPECT_EQ(goal.isSatisfied(state.get(), &told), away < threshold);
      EXPECT_EQ(goal.isSatisfied(state.get()), away < threshold);
      EXPECT_NEAR(told, away, 1e-12);
      satisfied += away < threshold;
    }
  }
  EXPECT_GT(satisfied, 50);
  EXPECT_LT(satisfied, 950);
}

}  // namespace
}  // namespace swept::test
