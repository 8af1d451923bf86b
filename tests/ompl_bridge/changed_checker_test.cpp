// SPDX-License-Identifier: BSD-3-Clause
// A space information whose world changes.
#include <gtest/gtest.h>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/util/Console.h>

#include <random>
#include <stdexcept>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Vector = ob::ScopedState<ob::RealVectorStateSpace>;

std::shared_ptr<const Checker> checkerOf(const std::vector<Obstacle>& obstacles) {
  return std::make_shared<const Checker>(gantry(), "all", worldOf(obstacles));
}

/// A wall across the whole room, but for its window.
std::vector<Obstacle> closedWall() {
  std::vector<Obstacle> wall = wallWithWindow();
  wall.push_back({{0.0, 0.5, 0.5}, {0.001, 0.4, 0.4}});
  return wall;
}

std::vector<bool> answersOf(const ob::SpaceInformation& si) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  Vector from(si.getStateSpace()), to(si.getStateSpace());
  std::vector<bool> answers;
  for (int i = 0; i < 500; ++i) {
    for (unsigned d = 0; d < 3; ++d) {
      from[d] = anywhere(random);
      to[d] = 0.7 * from[d] + 0.3 * anywhere(random);
    }
    answers.push_back(si.isValid(from.get()));
    answers.push_back(si.checkMotion(from.get(), to.get()));
  }
  return answers;
}

TEST(ChangedChecker, AnswersAsANewSetupDoes) {
  const auto before = checkerOf(boxes()), after = checkerOf(closedWall());
  const auto setup = makeSimpleSetup(before), fresh = makeSimpleSetup(after);
  const auto& si = setup->getSpaceInformation();
  const std::vector<bool> old = answersOf(*si), wanted = answersOf(*fresh->getSpaceInformation());
  ASSERT_NE(old, wanted);
  setChecker(*si, after);
  EXPECT_EQ(answersOf(*si), wanted);
  setChecker(*si, before);
  EXPECT_EQ(answersOf(*si), old);
}

/// One that asks again, and one whose edges are certified anew.
TEST(ChangedChecker, LeavesARoadmapToBeAskedAgain) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const auto open = checkerOf(wallWithWindow());
  const auto setup = makeSimpleSetup(open);
  const std::vector<double> from{-0.8, -0.5, -0.5}, to{0.8, -0.5, -0.5};
  setStartAndGoal(*setup, *open, from, to);
  const auto& si = setup->getSpaceInformation();
  const auto planner = std::make_shared<og::LazyPRM>(si);
  setup->setPlanner(planner);
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const og::PathGeometric path = setup->getSolutionPath();
  EXPECT_TRUE(path.check());

  const auto closed = std::make_shared<const Checker>(
      open->withBody({.name = "shutter",
                      .parts = {{makeBox({0.001, 0.4, 0.4}),
                                 Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.5, 0.5))}}}));
  setChecker(*si, closed);
  EXPECT_FALSE(path.check());
  planner->clearValidity();
  planner->clearQuery();
  setup->getProblemDefinition()->clearSolutionPaths();
  EXPECT_FALSE(setup->solve(0.3) == ob::PlannerStatus::EXACT_SOLUTION);

  setChecker(*si, open);
  planner->clearValidity();
  planner->clearQuery();
  setup->getProblemDefinition()->clearSolutionPaths();
  EXPECT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
}

TEST(ChangedChecker, ThatIsRefusedChangesNothing) {
  const auto before = checkerOf(boxes());
  const auto setup = makeSimpleSetup(before);
  const auto& si = setup->getSpaceInformation();
  const std::vector<bool> old = answersOf(*si);
  EXPECT_THROW(setChecker(*si, nullptr), std::invalid_argument);
  EXPECT_THROW(
      setChecker(*si, std::make_shared<const Checker>(everyJoint(), "all", worldOf(boxes()))),
      std::invalid_argument);
  MovingObstacle ball{.name = "drone", .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}}};
  ball.waypoints.push_back({0.0, Eigen::Isometry3d::Identity()});
  EXPECT_THROW(setChecker(*si, std::make_shared<const Checker>(before->withObstacle(ball))),
               std::invalid_argument);
  EXPECT_EQ(answersOf(*si), old);
  EXPECT_EQ(dynamic_cast<ValidityChecker&>(*si->getStateValidityChecker()).checker(), before);
}

TEST(ChangedChecker, IsOfOurClassesAlone) {
  const auto checker = checkerOf(boxes());
  const auto si =
      std::make_shared<ob::SpaceInformation>(makeStateSpace(checker->robot(), checker->group()));
  si->setStateValidityChecker(std::make_shared<ob::AllValidStateValidityChecker>(si));
  si->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(si));
  EXPECT_THROW(setChecker(*si, checker), std::invalid_argument);
  // With OMPL's own validator over our states, these alone change.
  const auto setup = makeSimpleSetup(checkerOf({}), {.motions = MotionCheck::Discrete});
  setChecker(*setup->getSpaceInformation(), checker);
  EXPECT_EQ(dynamic_cast<ValidityChecker&>(*setup->getSpaceInformation()->getStateValidityChecker())
                .checker(),
            checker);
}

}  // namespace
}  // namespace swept::test
