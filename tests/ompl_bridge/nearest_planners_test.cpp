// SPDX-License-Identifier: BSD-3-Clause
// Which of OMPL's planners take NearestStates.
#include <gtest/gtest.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyLBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/util/Console.h>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// Shows the tree that a planner keeps to itself.
template <typename Planner>
class Open : public Planner {
 public:
  using Planner::Planner;
  bool hasNearestStates() const {
    if constexpr (requires { this->nn_; })
      return isOne(*this->nn_);
    else
      return isOne(*this->tStart_) && isOne(*this->tGoal_);
  }

 private:
  template <typename T>
  static bool isOne(const ompl::NearestNeighbors<T>& nearest) {
    return dynamic_cast<const NearestStates<T>*>(&nearest) != nullptr;
  }
};

class NearestOfPlanners : public testing::Test {
 protected:
  void SetUp() override {
    ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
    setup_ = newSetup();
  }
  /// One for each planner: LazyLBTRRT of OMPL 1.5.2 frees its tree twice where a setup is cleared.
  og::SimpleSetupPtr newSetup() const {
    og::SimpleSetupPtr setup = makeSimpleSetup(checker_);
    const std::vector<double> from{-0.8, -0.5, -0.5}, to{0.8, -0.5, -0.5};
    setStartAndGoal(*setup, *checker_, from, to);
    // The first way ends the time of those that optimise.
    const auto length =
        std::make_shared<ob::PathLengthOptimizationObjective>(setup->getSpaceInformation());
    length->setCostThreshold(ob::Cost(100.0));
    setup->setOptimizationObjective(length);
    return setup;
  }
  template <typename Planner>
  void expectTaken() {
    setup_ = newSetup();
    const auto planner = std::make_shared<Open<Planner>>(setup_->getSpaceInformation());
    ASSERT_TRUE(useNearestStates(*planner)) << planner->getName();
    EXPECT_TRUE(planner->hasNearestStates()) << planner->getName();
    setup_->setPlanner(planner);
    EXPECT_TRUE(setup_->solve(1.0)) << planner->getName();
    EXPECT_TRUE(planner->hasNearestStates()) << planner->getName();
  }
  template <typename Planner>
  void expectLeft() {
    const auto planner = std::make_shared<Planner>(setup_->getSpaceInformation());
    EXPECT_FALSE(useNearestStates(*planner)) << planner->getName();
  }

  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf({}));
  og::SimpleSetupPtr setup_;
};

TEST_F(NearestOfPlanners, AreTakenByTheseAndTheyPlan) {
  expectTaken<og::RRT>();
  expectTaken<og::RRTConnect>();
  expectTaken<og::RRTstar>();
  expectTaken<og::InformedRRTstar>();
  expectTaken<og::SORRTstar>();
  expectTaken<og::LazyRRT>();
  expectTaken<og::LBTRRT>();
  expectTaken<og::LazyLBTRRT>();
  expectTaken<og::BiTRRT>();
  expectTaken<og::pRRT>();
}

TEST_F(NearestOfPlanners, AreTakenOnceAProblemIsKnown) {
  const auto planner = std::make_shared<Open<og::RRTsharp>>(setup_->getSpaceInformation());
  EXPECT_FALSE(useNearestStates(*planner));
  planner->setProblemDefinition(setup_->getProblemDefinition());
  ASSERT_TRUE(useNearestStates(*planner));
  EXPECT_TRUE(planner->hasNearestStates());
}

TEST_F(NearestOfPlanners, AreLeftWhereTheyDoNotHelp) {
  expectLeft<og::PRM>();
  expectLeft<og::SPARStwo>();
  expectLeft<og::BITstar>();
  expectLeft<og::TRRT>();
  expectLeft<og::SST>();
  expectLeft<og::KPIECE1>();
}

}  // namespace
}  // namespace swept::test
