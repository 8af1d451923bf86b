// SPDX-License-Identifier: BSD-3-Clause
// What OMPL's own tests ask of its planners, and what this one promises besides.
#include "swept/ompl_bridge/certified_connect.hpp"

#include <gtest/gtest.h>
#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/util/Console.h>

#include <atomic>
#include <queue>
#include <set>
#include <thread>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Path = std::vector<std::vector<double>>;

constexpr double kSeconds = 60.0;  // that a search may take; all take far less

class CertifiedConnectTest : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  og::SimpleSetupPtr throughTheWindow() const {
    auto setup = makeSimpleSetup(checker_);
    setStartAndGoal(*setup, *checker_, kStart, kGoal);
    return setup;
  }
  ob::ScopedState<> at(const og::SimpleSetup& setup, const std::vector<double>& q) const {
    ob::ScopedState<> state(setup.getStateSpace());
    StateConversion(checker_->robot(), checker_->group()).toState(q, state.get());
    return state;
  }
  static std::shared_ptr<CertifiedConnect> plannerOf(og::SimpleSetup& setup) {
    auto planner = std::make_shared<CertifiedConnect>(setup.getSpaceInformation());
    setup.setPlanner(planner);
    return planner;
  }
  static bool solves(og::SimpleSetup& setup) {
    return setup.solve(kSeconds) == ob::PlannerStatus::EXACT_SOLUTION;
  }
  void expectProven(const og::SimpleSetup& setup, const Checker& checker) const {
    for (const MotionCertificate& certificate : certifyPath(setup.getSolutionPath(), checker))
      EXPECT_EQ(certificate.verdict, Verdict::Free);
  }
  Path pathOf(const og::SimpleSetup& setup) const {
    return configurationsOf(setup.getSolutionPath(), *checker_);
  }

  const std::vector<double> kStart{-0.8, -0.5, -0.5}, kGoal{0.8, -0.5, -0.5};
  const std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(wallWithWindow()));
};

TEST_F(CertifiedConnectTest, FindsProvenPaths) {
  std::set<Path> paths;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto setup = throughTheWindow();
    plannerOf(*setup)->setSeed(seed);
    ASSERT_TRUE(solves(*setup));
    expectProven(*setup, *checker_);
    EXPECT_EQ(pathOf(*setup).front(), kStart);
    EXPECT_EQ(pathOf(*setup).back(), kGoal);
    const Path path = pathOf(*setup);
    paths.insert(path);
    // The same seed gives the same path: in a new planner, and in one that is cleared.
    setup->clear();
    ASSERT_TRUE(solves(*setup));
    EXPECT_EQ(pathOf(*setup), path);
    const auto again = throughTheWindow();
    plannerOf(*again)->params().setParam("seed", std::to_string(seed));
    ASSERT_TRUE(solves(*again));
    EXPECT_EQ(pathOf(*again), path);
  }
  EXPECT_EQ(paths.size(), 20U);
}

TEST_F(CertifiedConnectTest, TriesTheStraightMotionFirst) {
  const auto setup = makeSimpleSetup(checker_);
  setStartAndGoal(*setup, *checker_, kStart, {-0.8, 0.9, 0.9});
  plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  EXPECT_EQ(pathOf(*setup).size(), 2U);
  EXPECT_EQ(setup->getSpaceInformation()->getMotionValidator()->getCheckedMotionCount(), 1U);
}

TEST_F(CertifiedConnectTest, StaysWhereTheStartIsTheGoal) {
  const auto setup = makeSimpleSetup(checker_);
  setStartAndGoal(*setup, *checker_, kStart, kStart);
  plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  for (const std::vector<double>& q : pathOf(*setup)) EXPECT_EQ(q, kStart);
}

/// Joints of every kind, in a space that consists of several.
TEST_F(CertifiedConnectTest, PlansInCompoundSpaces) {
  auto world = std::make_shared<World>();
  world->add("ball", Sphere{0.4}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0)));
  const auto checker = std::make_shared<const Checker>(everyJoint(), "all", world);
  std::vector<double> from{0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  std::vector<double> to = from;
  to[4] = 1.0;
  Workspace workspace(*checker);
  ASSERT_NE(checker->certifyMotion(from, to, workspace).verdict, Verdict::Free);
  const auto setup = makeSimpleSetup(checker);
  setStartAndGoal(*setup, *checker, from, to);
  const auto planner = plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  expectProven(*setup, *checker);
  // 0.4 m of the slide and 4 m of the two bodies without limits; 0.4 rad of all that turns.
  EXPECT_GT(planner->getRange(), 8.0);
  EXPECT_LT(planner->getRange(), 20.0);
}

TEST_F(CertifiedConnectTest, ChoosesARangeUnlessItIsTold) {
  const auto setup = throughTheWindow();
  const auto planner = plannerOf(*setup);
  EXPECT_EQ(planner->getRange(), 0.0);
  setup->setup();
  EXPECT_NEAR(planner->getRange(), 0.4 * std::sqrt(3.0), 1e-12);  // a fifth of 2 m, three times
  const auto told = throughTheWindow();
  const auto other = plannerOf(*told);
  EXPECT_TRUE(other->params().setParam("range", "0.1"));
  ASSERT_TRUE(solves(*told));
  EXPECT_EQ(other->getRange(), 0.1);
  const Path path = pathOf(*told);
  for (std::size_t i = 1; i < path.size(); ++i) {
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      squared += (path[i][k] - path[i - 1][k]) * (path[i][k] - path[i - 1][k]);
    EXPECT_LE(std::sqrt(squared), 0.1 + 1e-12);
  }
}

/// The trees: roots are starts and goals, every edge is proven, and the path leads along edges.
TEST_F(CertifiedConnectTest, TellsItsTrees) {
  const auto setup = throughTheWindow();
  const auto planner = plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  ob::PlannerData data(setup->getSpaceInformation());
  planner->getPlannerData(data);
  EXPECT_EQ(data.numStartVertices(), 1U);
  EXPECT_EQ(data.numGoalVertices(), 1U);
  EXPECT_GT(data.numVertices(), 4U);
  // Two trees and the motion that joins them.
  EXPECT_EQ(data.numEdges(), data.numVertices() - 1);
  EXPECT_EQ(certifyEdges(data, *checker_), data.numEdges());
  std::set<unsigned> reached{data.getStartIndex(0)};
  std::queue<unsigned> next({data.getStartIndex(0)});
  while (!next.empty()) {
    std::vector<unsigned> edges;
    data.getEdges(next.front(), edges);
    next.pop();
    for (const unsigned vertex : edges)
      if (reached.insert(vertex).second) next.push(vertex);
  }
  EXPECT_TRUE(reached.contains(data.getGoalIndex(0)));
  planner->clear();
  ob::PlannerData none(setup->getSpaceInformation());
  planner->getPlannerData(none);
  EXPECT_EQ(none.numVertices(), 0U);
}

TEST_F(CertifiedConnectTest, EndsWhenItIsToldAndGoesOn) {
  const auto setup = throughTheWindow();
  const auto planner = plannerOf(*setup);
  setup->setup();
  // Before anything.
  EXPECT_FALSE(planner->solve(ob::plannerAlwaysTerminatingCondition()) ==
               ob::PlannerStatus::EXACT_SOLUTION);
  int calls = 0;
  bool exact = false;
  while (!exact && calls < 1000) {
    ob::IterationTerminationCondition some(5);
    const ob::PlannerStatus status = planner->solve(some);
    exact = status == ob::PlannerStatus::EXACT_SOLUTION;
    EXPECT_TRUE(exact || status == ob::PlannerStatus::APPROXIMATE_SOLUTION);
    ++calls;
  }
  EXPECT_TRUE(exact);
  EXPECT_GT(calls, 1);
  EXPECT_TRUE(setup->getProblemDefinition()->hasExactSolution());
  // The best solution is the exact one.
  EXPECT_EQ(pathOf(*setup).back(), kGoal);
  expectProven(*setup, *checker_);
  // Asked once more, it finds another one.
  const std::size_t before = setup->getProblemDefinition()->getSolutionCount();
  EXPECT_TRUE(planner->solve(kSeconds) == ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(setup->getProblemDefinition()->getSolutionCount(), before + 1);
}

TEST_F(CertifiedConnectTest, TellsTheWayToTheNearestStateWithoutASolution) {
  std::vector<Obstacle> wall = wallWithWindow();
  wall.push_back({{0.0, 0.5, 0.5}, {0.001, 0.4, 0.4}});
  const auto checker = std::make_shared<const Checker>(gantry(), "all", worldOf(wall));
  const auto setup = makeSimpleSetup(checker);
  setStartAndGoal(*setup, *checker, kStart, kGoal);
  plannerOf(*setup);
  ob::IterationTerminationCondition some(2000);
  EXPECT_TRUE(setup->solve(some) == ob::PlannerStatus::APPROXIMATE_SOLUTION);
  EXPECT_FALSE(setup->haveExactSolutionPath());
  const double left = setup->getProblemDefinition()->getSolutionDifference();
  EXPECT_GT(left, 0.8);  // the wall is in between
  EXPECT_LT(left, 1.3);
  expectProven(*setup, *checker);
  EXPECT_NEAR(setup->getStateSpace()->distance(setup->getSolutionPath().getStates().back(),
                                               at(*setup, kGoal).get()),
              left, 1e-12);
}

TEST_F(CertifiedConnectTest, TakesSeveralStartsAndGoals) {
  // Of the starts one is in the wall; of the goals two are, and one is beyond the bounds.
  const auto setup = makeSimpleSetup(checker_);
  setup->addStartState(at(*setup, {0.0, -0.5, -0.5}));
  setup->addStartState(at(*setup, kStart));
  setup->addStartState(at(*setup, {-0.5, 0.9, 0.9}));
  auto goals = std::make_shared<ob::GoalStates>(setup->getSpaceInformation());
  for (const std::vector<double>& q :
       Path{{0.0, 0.0, 0.0}, {0.0, -0.5, 0.1}, {1.5, 0.0, 0.0}, kGoal, {0.9, 0.9, 0.9}})
    goals->addState(at(*setup, q));
  setup->setGoal(goals);
  const auto planner = plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  expectProven(*setup, *checker_);
  const Path path = pathOf(*setup);
  EXPECT_TRUE(path.front() == kStart || path.front() == (std::vector<double>{-0.5, 0.9, 0.9}));
  EXPECT_TRUE(path.back() == kGoal || path.back() == (std::vector<double>{0.9, 0.9, 0.9}));
  ob::PlannerData data(setup->getSpaceInformation());
  planner->getPlannerData(data);
  EXPECT_EQ(data.numStartVertices(), 2U);
  EXPECT_GE(data.numGoalVertices(), 1U);
}

TEST_F(CertifiedConnectTest, AsksTheGoalWhichPairsItTakes) {
  class OnlyLow final : public ob::GoalStates {
   public:
    using GoalStates::GoalStates;
    bool isStartGoalPairValid(const ob::State* start, const ob::State*) const override {
      return start->as<ob::RealVectorStateSpace::StateType>()->values[1] < 0.0;
    }
  };
  const auto setup = makeSimpleSetup(checker_);
  setup->addStartState(at(*setup, {-0.5, 0.9, 0.9}));  // nearer to the window
  setup->addStartState(at(*setup, kStart));
  auto goals = std::make_shared<OnlyLow>(setup->getSpaceInformation());
  goals->addState(at(*setup, kGoal));
  setup->setGoal(goals);
  plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  EXPECT_EQ(pathOf(*setup).front(), kStart);
}

TEST_F(CertifiedConnectTest, WaitsForGoalsThatComeLater) {
  const auto setup = makeSimpleSetup(checker_);
  setup->setStartState(at(*setup, kStart));
  std::atomic<int> asked = 0;
  const auto goal = std::make_shared<ob::GoalLazySamples>(
      setup->getSpaceInformation(), [&](const ob::GoalLazySamples*, ob::State* state) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        setup->getStateSpace()->copyState(state, at(*setup, kGoal).get());
        return ++asked < 3;
      });
  setup->setGoal(goal);
  plannerOf(*setup);
  ASSERT_TRUE(solves(*setup));
  goal->stopSampling();
  EXPECT_EQ(pathOf(*setup).back(), kGoal);
  expectProven(*setup, *checker_);
}

TEST_F(CertifiedConnectTest, SaysWhatItCannotStartWith) {
  const auto inWall = makeSimpleSetup(checker_);
  setStartAndGoal(*inWall, *checker_, {0.0, -0.5, -0.5}, kGoal);
  plannerOf(*inWall);
  EXPECT_TRUE(inWall->solve(1.0) == ob::PlannerStatus::INVALID_START);

  const auto noGoal = makeSimpleSetup(checker_);
  setStartAndGoal(*noGoal, *checker_, kStart, {0.0, -0.5, -0.5});
  plannerOf(*noGoal);
  const ob::PlannerStatus status = noGoal->solve(0.2);
  EXPECT_TRUE(status == ob::PlannerStatus::INVALID_GOAL || status == ob::PlannerStatus::TIMEOUT);

  class Nowhere final : public ob::Goal {
   public:
    using Goal::Goal;
    bool isSatisfied(const ob::State*) const override { return false; }
  };
  const auto unknown = makeSimpleSetup(checker_);
  unknown->setStartState(at(*unknown, kStart));
  unknown->setGoal(std::make_shared<Nowhere>(unknown->getSpaceInformation()));
  plannerOf(*unknown);
  EXPECT_TRUE(unknown->solve(1.0) == ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE);
}

/// A space and a validator of OMPL's alone. Its validator takes the first state for valid.
TEST_F(CertifiedConnectTest, PlansWithAnyValidator) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(-1.0, 1.0);
  og::SimpleSetup setup(space);
  const auto isValid = [](const ob::State* state) {
    const double* q = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return std::abs(q[0]) > 0.1 || q[1] > 0.8;
  };
  setup.setStateValidityChecker(isValid);
  ob::ScopedState<ob::RealVectorStateSpace> start(space), goal(space);
  start[0] = -0.5, start[1] = -0.5, goal[0] = 0.5, goal[1] = -0.5;
  setup.setStartAndGoalStates(start, goal);
  const auto planner = plannerOf(setup);
  ASSERT_TRUE(solves(setup));
  EXPECT_NEAR(planner->getRange(), 0.2 * std::sqrt(8.0), 1e-12);
  EXPECT_TRUE(setup.getSolutionPath().check());
  ob::PlannerData data(setup.getSpaceInformation());
  planner->getPlannerData(data);
  for (unsigned i = 0; i < data.numVertices(); ++i)
    EXPECT_TRUE(isValid(data.getVertex(i).getState()));
}

/// Planners on threads share the space information.
TEST_F(CertifiedConnectTest, WorksBesideOthers) {
  const auto setup = throughTheWindow();
  setup->setup();
  std::vector<Path> paths(4);
  std::vector<std::thread> threads;
  for (Path& path : paths)
    threads.emplace_back([&] {
      const auto problem = setup->getProblemDefinition()->clone();
      CertifiedConnect planner(setup->getSpaceInformation());
      planner.setProblemDefinition(problem);
      planner.setup();
      if (planner.solve(kSeconds) == ob::PlannerStatus::EXACT_SOLUTION)
        path = configurationsOf(*problem->getSolutionPath()->as<og::PathGeometric>(), *checker_);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GE(paths[0].size(), 3U);
  for (const Path& path : paths) EXPECT_EQ(path, paths[0]);
}

}  // namespace
}  // namespace swept::test
