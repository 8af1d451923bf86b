// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class Planning : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_WARN); }

  static og::SimpleSetupPtr problem(const std::shared_ptr<const Checker>& checker,
                                    const std::vector<double>& from,
                                    const std::vector<double>& to) {
    auto setup = makeSimpleSetup(checker);
    setStartAndGoal(*setup, *checker, from, to);
    return setup;
  }
};

// From one side of a wall to the other through its window, by planners that use the validator
// differently; the path is sampled against the closed form.
TEST_F(Planning, PathsThroughAWindowAreProven) {
  const std::vector<Obstacle> wall = wallWithWindow();
  const auto checker = std::make_shared<const Checker>(gantry(), "all", worldOf(wall));
  for (const bool roadmap : {false, true}) {
    const auto setup = problem(checker, {-0.8, -0.5, -0.5}, {0.8, -0.5, -0.5});
    const auto& si = setup->getSpaceInformation();
    if (roadmap) {
      setup->setPlanner(std::make_shared<og::PRM>(si));
    } else {
      setup->setPlanner(std::make_shared<og::RRTConnect>(si));
    }
    ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
    setup->simplifySolution();
    const og::PathGeometric& path = setup->getSolutionPath();
    EXPECT_TRUE(path.check());
    const auto certificates = certifyPath(path, *checker);
    ASSERT_EQ(certificates.size() + 1, path.getStateCount());
    ASSERT_GE(certificates.size(), 2u);
    for (const MotionCertificate& certificate : certificates) {
      EXPECT_EQ(certificate.verdict, Verdict::Free);
      EXPECT_EQ(certificate.freeUntil, 1.0);
    }
    og::PathGeometric fine(path);
    fine.interpolate(20000);
    for (const ob::State* state : fine.getStates()) {
      const double* q = state->as<ob::RealVectorStateSpace::StateType>()->values;
      for (const Obstacle& box : wall) {
        ASSERT_GT(box.distance({q[0], q[1], q[2]}), kBallRadius);
      }
    }
  }
}

TEST_F(Planning, AClosedWallHasNoPath) {
  std::vector<Obstacle> wall = wallWithWindow();
  wall.push_back({{0.0, 0.5, 0.5}, {0.001, 0.4, 0.4}});
  const auto checker = std::make_shared<const Checker>(gantry(), "all", worldOf(wall));
  const auto setup = problem(checker, {-0.8, -0.5, -0.5}, {0.8, -0.5, -0.5});
  setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
  EXPECT_FALSE(setup->solve(0.3) == ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_GT(setup->getSpaceInformation()->getMotionValidator()->getCheckedMotionCount(), 100u);
}

TEST_F(Planning, CompoundSpacesPlanWithProjections) {
  auto world = std::make_shared<World>();
  world->add("ball", Sphere{0.2}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0)));
  const auto checker = std::make_shared<const Checker>(everyJoint(), "all", world);
  const std::vector<double> from{0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  std::vector<double> to = from;
  to[4] = 1.0;
  to[1] = 3.0;
  const auto setup = problem(checker, from, to);
  setup->setPlanner(std::make_shared<og::KPIECE1>(setup->getSpaceInformation()));
  ASSERT_TRUE(
      setup->getStateSpace()->satisfiesBounds(setup->getProblemDefinition()->getStartState(0)));
  setup->getProblemDefinition()->getGoal()->as<ob::GoalRegion>()->setThreshold(1.0);
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  for (const MotionCertificate& certificate : certifyPath(setup->getSolutionPath(), *checker)) {
    EXPECT_EQ(certificate.verdict, Verdict::Free);
  }
}

/// OMPL's informed samples do not exist in spaces with continuous joints. CForest would find out in
/// a thread of its own, and end the process.
TEST_F(Planning, InformedPlannersRefuseCompoundSpaces) {
  const auto world = std::make_shared<const World>();
  const auto limited = makeSimpleSetup(std::make_shared<const Checker>(gantry(), "all", world));
  const auto mixed = makeSimpleSetup(std::make_shared<const Checker>(everyJoint(), "all", world));
  const std::vector<std::string> informed{"ABITstar", "AITstar",         "BITstar",
                                          "CForest",  "InformedRRTstar", "SORRTstar"};
  for (const std::string& name : plannerNames()) {
    EXPECT_NE(makePlanner(name, limited->getSpaceInformation()), nullptr) << name;
    std::string message;
    try {
      EXPECT_NE(makePlanner(name, mixed->getSpaceInformation()), nullptr) << name;
    } catch (const UsageError& error) {
      message = error.what();
    }
    const bool isInformed = std::ranges::find(informed, name) != informed.end();
    EXPECT_EQ(message, !isInformed
                           ? ""
                           : "planner " + name +
                                 " cannot plan in space 'all': OMPL's informed samples are of "
                                 "joints with limits alone, or of one planar or floating joint; "
                                 "allowed there: planners that draw none, such as RRTstar");
  }
}

}  // namespace
}  // namespace swept::test
