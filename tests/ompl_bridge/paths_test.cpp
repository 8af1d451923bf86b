// SPDX-License-Identifier: BSD-3-Clause
// What is done with planners' results: simplified paths, roadmaps and clearances with certificates.
#include "swept/ompl_bridge/paths.hpp"

#include <gtest/gtest.h>
#include <ompl/base/PlannerDataStorage.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "../robot_model/model_robots.hpp"
#include "fixtures.hpp"
#include "message_of.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class Paths : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_ERROR); }

  og::SimpleSetupPtr throughTheWindow(MotionCheck motions = MotionCheck::Certified) {
    SetupOptions options;
    options.motions = motions;
    auto setup = makeSimpleSetup(checker_, options);
    setStartAndGoal(*setup, *checker_, std::vector<double>{-0.8, -0.5, -0.5},
                    std::vector<double>{0.8, -0.5, -0.5});
    return setup;
  }
  static bool allFree(const std::vector<MotionCertificate>& certificates) {
    return std::ranges::all_of(certificates, [](const MotionCertificate& certificate) {
      return certificate.verdict == Verdict::Free;
    });
  }

  std::vector<Obstacle> wall_ = wallWithWindow();
  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(wall_));
};

TEST_F(Paths, BeginAndEndWhereTheSetupIsTold) {
  const auto setup = throughTheWindow();
  const std::vector<double> start{0.1, 0.2, 0.3}, goal{0.4, 0.5, 0.6}, two{0.1, 0.2};
  setStartAndGoal(*setup, *checker_, start, goal);
  const auto expectEnds = [&] {
    ASSERT_EQ(setup->getProblemDefinition()->getStartStateCount(), 1u);
    og::PathGeometric ends(setup->getSpaceInformation());
    EXPECT_TRUE(configurationsOf(ends, *checker_).empty());
    ends.append(setup->getProblemDefinition()->getStartState(0));
    ends.append(setup->getGoal()->as<ob::GoalState>()->getState());
    EXPECT_EQ(configurationsOf(ends, *checker_), (std::vector{start, goal}));
  };
  expectEnds();
  EXPECT_THROW(setStartAndGoal(*setup, *checker_, two, goal), std::invalid_argument);
  EXPECT_THROW(setStartAndGoal(*setup, *checker_, goal, two), std::invalid_argument);
  // As many values, in another kind of state.
  const Checker cart(
      Robot::parse("<robot name='cart'><link name='floor'/><link name='deck'/>"
                   "<joint name='roll' type='planar'><parent link='floor'/><child link='deck'/>"
                   "<axis xyz='0 0 1'/></joint></robot>",
                   "cart.urdf"),
      "all", std::make_shared<World>());
  ASSERT_EQ(cart.dimension(), checker_->dimension());
  EXPECT_THROW(setStartAndGoal(*setup, cart, goal, start), std::invalid_argument);
  expectEnds();
}

TEST_F(Paths, BecomeShorterAndStayProven) {
  const auto setup = throughTheWindow();
  setup->setPlanner(std::make_shared<og::RRT>(setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  og::PathGeometric path = setup->getSolutionPath();
  const double before = path.length();
  const auto certificates = simplifyPath(path, *checker_, 1.0, setup->getGoal());
  EXPECT_EQ(certificates.size() + 1, path.getStateCount());
  EXPECT_TRUE(allFree(certificates));
  EXPECT_LT(path.length(), before);
  // Around the wall's edge and back: no path through the window is shorter than its two legs.
  EXPECT_GT(path.length(), 2.0 * std::hypot(0.8, 0.9, 0.9));
  const auto refusal = [&](double time) {
    return messageOf([&] { simplifyPath(path, *checker_, time); });
  };
  EXPECT_EQ(refusal(0.0), "simplifyPath: time 0 s must be a finite number greater than zero");
  EXPECT_EQ(refusal(-1e-9),
            "simplifyPath: time -1e-09 s must be a finite number greater than zero");
  EXPECT_EQ(refusal(std::nan("")),
            "simplifyPath: time nan s must be a finite number greater than zero");
}

/// A simplifier that samples may leave the proven path: then it stays.
TEST_F(Paths, ThatWouldCollideAreLeftAsTheyAre) {
  const auto setup = throughTheWindow();
  setup->setPlanner(std::make_shared<og::RRT>(setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const auto careless = throughTheWindow(MotionCheck::Discrete);
  // Coarse enough to step over the wall, of 0.02 m, with a ball of 0.2 m.
  careless->getStateSpace()->setLongestValidSegmentFraction(0.99);
  careless->setup();
  og::PathGeometric path(careless->getSpaceInformation());
  for (const ob::State* state : setup->getSolutionPath().getStates()) path.append(state);
  const og::PathGeometric original(path);
  const auto certificates = simplifyPath(path, *checker_, 1.0);
  EXPECT_TRUE(allFree(certificates));
  ASSERT_EQ(path.getStateCount(), original.getStateCount());
  EXPECT_EQ(path.length(), original.length());
}

TEST_F(Paths, CheckedDiscretelyMayCollide) {
  const auto setup = throughTheWindow(MotionCheck::Discrete);
  setup->getStateSpace()->setLongestValidSegmentFraction(0.2);
  setup->setPlanner(std::make_shared<og::RRT>(setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_FALSE(allFree(certifyPath(setup->getSolutionPath(), *checker_)));
}

TEST_F(Paths, OfOtherGroupsAreRefused) {
  const auto setup = throughTheWindow();
  og::PathGeometric path(setup->getSpaceInformation());
  const Checker turn(everyJoint(), "turn_only", std::make_shared<World>());
  EXPECT_THROW(configurationsOf(path, turn), std::invalid_argument);
  EXPECT_THROW(simplifyPath(path, turn, 1.0), std::invalid_argument);
  ob::PlannerData data(setup->getSpaceInformation());
  EXPECT_THROW(certifyEdges(data, turn), std::invalid_argument);
  EXPECT_TRUE(simplifyPath(path, *checker_, 1.0).empty());
}

TEST_F(Paths, EdgesOfRoadmapsCarryCertificates) {
  for (const bool lazy : {false, true}) {
    const auto setup = throughTheWindow();
    const auto& si = setup->getSpaceInformation();
    if (lazy) {
      setup->setPlanner(std::make_shared<og::LazyPRM>(si));
    } else {
      setup->setPlanner(std::make_shared<og::PRM>(si));
    }
    ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
    ob::PlannerData data(si);
    setup->getPlannerData(data);
    ASSERT_GT(data.numEdges(), 20u);
    const unsigned edges = data.numEdges();
    const unsigned proven = certifyEdges(data, *checker_);
    EXPECT_EQ(data.numEdges(), edges);
    unsigned free = 0, seen = 0;
    for (unsigned v = 0; v < data.numVertices(); ++v) {
      std::vector<unsigned> neighbours;
      data.getEdges(v, neighbours);
      for (const unsigned other : neighbours) {
        const auto* edge = dynamic_cast<const CertifiedEdge*>(&data.getEdge(v, other));
        ASSERT_NE(edge, nullptr);
        ++seen;
        const bool valid =
            si->checkMotion(data.getVertex(v).getState(), data.getVertex(other).getState());
        EXPECT_EQ(edge->certificate().verdict == Verdict::Free, valid);
        free += valid;
      }
    }
    EXPECT_EQ(seen, edges);
    EXPECT_EQ(free, proven);
    if (lazy) {
      EXPECT_LT(proven, edges);
    } else {
      EXPECT_EQ(proven, edges);
    }
    setup->clear();  // OMPL 1.5.2's LazyPRM ends without giving its states back
  }
}

/// In the order that the documentation has: stored, loaded, and then certified.
TEST_F(Paths, RoadmapsAreStoredBeforeTheyAreCertified) {
  const auto setup = throughTheWindow();
  const auto& si = setup->getSpaceInformation();
  setup->setPlanner(std::make_shared<og::PRM>(si));
  ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  ob::PlannerData data(si), loaded(si);
  setup->getPlannerData(data);
  std::stringstream stream;
  ob::PlannerDataStorage storage;
  storage.store(data, stream);
  storage.load(stream, loaded);
  ASSERT_GT(data.numEdges(), 20u);
  EXPECT_EQ(loaded.numEdges(), data.numEdges());
  EXPECT_EQ(certifyEdges(loaded, *checker_), certifyEdges(data, *checker_));
}

/// At a coarse tolerance proofs depend on the order in which a motion is examined. What the planner
/// took for valid is proven when its path is certified, too: both queries give one verdict.
TEST(PathsOfAnArm, OfMotionsThatTheValidatorTakesAreProven) {
  const auto world = std::make_shared<const World>(World::load(modelsDir() + "/scenes/shelf.yaml"));
  const auto checker = std::make_shared<const Checker>(modelRobot("rook7"), "arm", world,
                                                       CheckerOptions{.tolerance = 0.2});
  const auto setup = makeSimpleSetup(checker);
  const auto& si = setup->getSpaceInformation();
  si->setup();
  const StateConversion conversion(checker->robot(), checker->group());
  ob::ScopedState<> from(si), to(si);
  Workspace workspace(*checker);
  std::mt19937 random(1);
  std::vector<double> q0(conversion.dimension()), q1(q0);
  int taken = 0;
  for (int i = 0; i < 60'000; ++i) {
    for (std::size_t k = 0; k < q0.size(); ++k) {
      const Variable& variable = checker->robot().variables()[checker->group().variables[k]];
      q0[k] = std::uniform_real_distribution<>(variable.lower, variable.upper)(random);
      const double near = q0[k] + std::uniform_real_distribution<>(-1.0, 1.0)(random);
      q1[k] = std::clamp(near, variable.lower, variable.upper);
    }
    conversion.toState(q0, from.get());
    conversion.toState(q1, to.get());
    if (!si->checkMotion(from.get(), to.get())) continue;
    ++taken;
    const og::PathGeometric path(si, from.get(), to.get());
    EXPECT_EQ(certifyPath(path, *checker).front().verdict, Verdict::Free);
    EXPECT_EQ(checker->certifyMotion(q0, q1, workspace).verdict, Verdict::Free);
  }
  EXPECT_GT(taken, 30'000);
}

TEST_F(Paths, ClearancesOfMotionsAreProven) {
  const auto setup = throughTheWindow();
  const auto& si = setup->getSpaceInformation();
  setup->setup();
  const CertifiedClearanceObjective objective(si, checker_, 1e-3);
  const ob::MaximizeMinClearanceObjective atEnds(si);
  ob::ScopedState<> a(si->getStateSpace()), b(si->getStateSpace()), c(si->getStateSpace());
  int lower = 0, compared = 0;
  for (int i = 0; i < 3000; ++i) {
    a.random();
    b.random();
    if (!si->isValid(a.get()) || !si->isValid(b.get())) continue;
    ++compared;
    const double proven = objective.motionCost(a.get(), b.get()).value();
    EXPECT_EQ(objective.stateCost(a.get()).value(),
              si->getStateValidityChecker()->clearance(a.get()));
    double sampled = 1e9;
    for (int k = 0; k <= 50; ++k) {
      si->getStateSpace()->interpolate(a.get(), b.get(), k / 50.0, c.get());
      sampled = std::min(sampled, std::max(0.0, si->getStateValidityChecker()->clearance(c.get())));
    }
    EXPECT_LE(proven, sampled + 1e-9);
    EXPECT_GE(proven, sampled - 0.06);
    lower += proven < atEnds.motionCost(a.get(), b.get()).value() - 0.01;
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(lower, compared / 10);
  EXPECT_EQ(messageOf([&] { CertifiedClearanceObjective(si, checker_, -1e-9); }),
            "CertifiedClearanceObjective: accuracy -1e-09 m must be a finite number greater than "
            "zero");
  EXPECT_THROW(CertifiedClearanceObjective(si, nullptr), std::invalid_argument);
}

/// Through the middle of the window: it leaves 0.1 m around the ball.
TEST_F(Paths, OptimisedForClearanceKeepMore) {
  const auto setup = throughTheWindow();
  const auto& si = setup->getSpaceInformation();
  const auto objective = std::make_shared<CertifiedClearanceObjective>(si, checker_, 1e-3);
  objective->setCostThreshold(ob::Cost(0.03));
  setup->setOptimizationObjective(objective);
  setup->setPlanner(std::make_shared<og::RRTstar>(si));
  ASSERT_TRUE(setup->solve(30.0) == ob::PlannerStatus::EXACT_SOLUTION);
  double least = 1e9;
  Workspace workspace(*checker_);
  const auto& path = setup->getSolutionPath();
  EXPECT_TRUE(allFree(certifyPath(path, *checker_)));
  for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
    const auto q = [&](std::size_t k) {
      const double* values = path.getState(static_cast<unsigned>(k))
                                 ->as<ob::RealVectorStateSpace::StateType>()
                                 ->values;
      return std::vector<double>(values, values + 3);
    };
    least = std::min(least, checker_->motionClearance(q(i), q(i + 1), 1e-4, workspace).lower);
  }
  EXPECT_GT(least, 0.029);
  EXPECT_LT(least, 0.1);
}

}  // namespace
}  // namespace swept::test
