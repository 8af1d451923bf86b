// SPDX-License-Identifier: BSD-3-Clause
// Goals for the pose of a link: what OMPL samples from them and plans to, judged by LinkMotion and
// by the checker.
#include "swept/ompl_bridge/pose_goal.hpp"
#include "../robot_model/model_robots.hpp"
#include "models_dir.hpp"

#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using Configuration = std::vector<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const World> scene(const std::string& name) {
  return std::make_shared<const World>(World::load(modelsDir() + "/scenes/" + name));
}

/// A link of a checker's robot.
struct Arm {
  std::shared_ptr<const Checker> checker;
  std::string link;

  Isometry3d place(const Configuration& q) const {
    return LinkMotion(checker->robot(), checker->group().name, link, q, q,
                      checker->options().reference)
        .at(0.0);
  }
  Configuration configuration(const ob::State* state) const {
    const StateConversion conversion(checker->robot(), checker->group());
    Configuration q(conversion.dimension());
    conversion.toConfiguration(state, q);
    return q;
  }
};

Arm shelfArm() {
  return {std::make_shared<const Checker>(modelRobot("rook7"), "arm", scene("shelf.yaml")), "hand"};
}

const Configuration kReady{0, -0.3, 0, 1.9, 0, 1.54, 0};
/// Free, between the boards of the shelf.
const Configuration kInShelf{-1.7602, 0.9661, 1.8646, 2.1343, 0.4387, -0.4426, 2.2866};

class PoseGoals : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  static std::shared_ptr<PoseGoal> goalOf(const og::SimpleSetupPtr& setup, const Arm& arm,
                                          const Isometry3d& target,
                                          const PoseGoalOptions& options = {}) {
    return std::make_shared<PoseGoal>(setup->getSpaceInformation(), arm.checker, arm.link, target,
                                      options);
  }

  static void start(const og::SimpleSetupPtr& setup, const Arm& arm, const Configuration& q) {
    ob::ScopedState<> state(setup->getStateSpace());
    StateConversion(arm.checker->robot(), arm.checker->group()).toState(q, state.get());
    setup->setStartState(state);
  }

  /// Sampling ends by itself.
  static void awaitSamples(const PoseGoal& goal) {
    goal.getSpaceInformation()->setup();
    while (goal.isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static std::vector<Configuration> samples(const PoseGoal& goal, const Arm& arm) {
    std::vector<Configuration> all;
    for (unsigned int i = 0; i < goal.getStateCount(); ++i) {
      all.push_back(arm.configuration(goal.getState(i)));
    }
    return all;
  }

  static void expectNear(const Isometry3d& actual, const Isometry3d& wanted,
                         const PoseGoalOptions& options) {
    EXPECT_LT((actual.translation() - wanted.translation()).norm(), options.positionTolerance);
    EXPECT_LT(AngleAxisd(actual.linear().transpose() * wanted.linear()).angle(),
              options.orientationTolerance);
  }

  /// Each is free, in bounds, within the tolerances, and away from the others.
  static void expectGoals(const PoseGoal& goal, const Arm& arm, const PoseGoalOptions& options) {
    const auto& si = goal.getSpaceInformation();
    Workspace workspace(*arm.checker);
    for (unsigned int i = 0; i < goal.getStateCount(); ++i) {
      const ob::State* state = goal.getState(i);
      const Configuration q = arm.configuration(state);
      EXPECT_EQ(arm.checker->checkState(q, workspace), Verdict::Free);
      EXPECT_TRUE(si->satisfiesBounds(state));
      expectNear(arm.place(q), goal.target(), options);
      EXPECT_TRUE(goal.isSatisfied(state));
      for (unsigned int j = 0; j < i; ++j) {
        EXPECT_GT(si->distance(state, goal.getState(j)), PoseGoal::kSampleDistance);
      }
    }
  }
};

TEST_F(PoseGoals, ArePlannedTo) {
  const Arm arm = shelfArm();
  const Isometry3d target = arm.place(kInShelf);
  const PoseGoalOptions options;
  const auto setup = makeSimpleSetup(arm.checker);
  start(setup, arm, kReady);
  const auto goal = goalOf(setup, arm, target, options);
  setup->setGoal(goal);
  setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const og::PathGeometric& path = setup->getSolutionPath();
  ASSERT_GE(path.getStateCount(), 2u);
  EXPECT_EQ(arm.configuration(path.getState(0)), kReady);
  for (const MotionCertificate& certificate : certifyPath(path, *arm.checker)) {
    EXPECT_EQ(certificate.verdict, Verdict::Free);
  }
  const auto last = static_cast<unsigned int>(path.getStateCount() - 1);
  expectNear(arm.place(arm.configuration(path.getState(last))), target, options);
  awaitSamples(*goal);
  EXPECT_GE(goal->getStateCount(), 1u);
  expectGoals(*goal, arm, options);
}

/// A planner that grows one tree, and asks whether its states satisfy the goal.
TEST_F(PoseGoals, AreReachedByTheirDistance) {
  const Arm arm{std::make_shared<const Checker>(gantry(), "all", worldOf(wallWithWindow())),
                "ball"};
  PoseGoalOptions options;
  options.positionTolerance = 0.1;
  const Isometry3d target(Translation3d(0.7, -0.4, 0.2));
  const auto setup = makeSimpleSetup(arm.checker);
  start(setup, arm, {-0.8, -0.5, -0.5});
  const auto goal = goalOf(setup, arm, target, options);
  setup->setGoal(goal);
  setup->setPlanner(std::make_shared<og::RRT>(setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const og::PathGeometric& path = setup->getSolutionPath();
  const auto last = static_cast<unsigned int>(path.getStateCount() - 1);
  expectNear(arm.place(arm.configuration(path.getState(last))), target, options);
}

TEST_F(PoseGoals, GiveTheSameSamplesForTheSameSeed) {
  const Arm arm = shelfArm();
  const auto setup = makeSimpleSetup(arm.checker);
  const auto sampled = [&](std::uint32_t seed) {
    PoseGoalOptions options;
    options.seed = seed;
    options.maxSamples = 8;
    const auto goal = goalOf(setup, arm, arm.place(kInShelf), options);
    awaitSamples(*goal);
    expectGoals(*goal, arm, options);
    return samples(*goal, arm);
  };
  const auto first = sampled(7);
  EXPECT_EQ(first.size(), 8u);
  EXPECT_EQ(sampled(7), first);
  EXPECT_NE(sampled(8), first);
}

/// The bounds of a space may be narrower than the limits of the robot: the cart stays in its
/// corner, and the arm reaches out of it.
TEST_F(PoseGoals, KeepTheBoundsOfTheSpace) {
  const Arm arm{
      std::make_shared<const Checker>(modelRobot("rook6_cart"), "whole_body", scene("empty.yaml")),
      "tool"};
  const auto setup = makeSimpleSetup(arm.checker);
  ob::RealVectorBounds corner(2);
  corner.setLow(0, 0.5), corner.setHigh(0, 0.8);
  corner.setLow(1, -0.2), corner.setHigh(1, 0.1);
  setup->getStateSpace()->as<ob::CompoundStateSpace>()->as<ob::SE2StateSpace>(0)->setBounds(corner);
  const Isometry3d target = arm.place({0.0, 0.0, 0.0, 0.0, -0.6, 1.2, -0.6, 1.0, 0.3});
  PoseGoalOptions options;
  options.maxSamples = 20;
  const auto goal = goalOf(setup, arm, target, options);
  awaitSamples(*goal);
  EXPECT_EQ(goal->getStateCount(), 20u);
  expectGoals(*goal, arm, options);
  int atTheEdge = 0;
  for (const Configuration& q : samples(*goal, arm)) {
    EXPECT_GE(q[0], 0.5);
    EXPECT_LE(q[0], 0.8);
    EXPECT_GE(q[1], -0.2);
    EXPECT_LE(q[1], 0.1);
    atTheEdge += q[0] == 0.5 || q[1] == -0.2 || q[1] == 0.1;
  }
  EXPECT_GT(atTheEdge, 0);
}

/// All kinds of subspaces at once; the quaternions of the states are what OMPL wants.
TEST_F(PoseGoals, SampleEveryKindOfJoint) {
  const Arm arm{std::make_shared<const Checker>(everyJoint(), "all", worldOf(boxes())), "l6"};
  const auto setup = makeSimpleSetup(arm.checker);
  Isometry3d target(Translation3d(-0.3, 0.1, 0.9));
  target.rotate(AngleAxisd(2.0, Vector3d(1, 1, 0).normalized()));
  PoseGoalOptions options;
  options.maxSamples = 20;
  const auto goal = goalOf(setup, arm, target, options);
  awaitSamples(*goal);
  EXPECT_EQ(goal->getStateCount(), 20u);
  expectGoals(*goal, arm, options);
}

/// The rest of the robot stands where the checker has it.
TEST_F(PoseGoals, UseTheCheckersReference) {
  const auto robot = modelRobot("rook6_cart");
  CheckerOptions moved;
  moved.reference = robot->defaultState();
  (*moved.reference)[*robot->findVariable("floor/x")] = 2.0;
  (*moved.reference)[*robot->findVariable("floor/theta")] = 1.0;
  const Arm arm{std::make_shared<const Checker>(robot, "arm", scene("empty.yaml"), moved),
                "wrist_3"};
  const auto setup = makeSimpleSetup(arm.checker);
  const Isometry3d target = arm.place({0.0, -0.5, 1.75, 0.32, -1.5708, 0.0});
  EXPECT_GT(target.translation().head<2>().norm(), 1.0);
  const auto goal = goalOf(setup, arm, target);
  awaitSamples(*goal);
  EXPECT_GE(goal->getStateCount(), 1u);
  expectGoals(*goal, arm, {});
}

TEST_F(PoseGoals, PlaceTheTool) {
  const Arm arm = shelfArm();
  const auto setup = makeSimpleSetup(arm.checker);
  PoseGoalOptions options;
  options.link_from_tool = Translation3d(0.1, 0, 0.2) * AngleAxisd(0.5, Vector3d::UnitY());
  options.maxSamples = 4;
  const Isometry3d target = arm.place(kReady) * options.link_from_tool;
  const auto goal = goalOf(setup, arm, target, options);
  awaitSamples(*goal);
  ASSERT_EQ(goal->getStateCount(), 4u);
  for (const Configuration& q : samples(*goal, arm)) {
    expectNear(arm.place(q) * options.link_from_tool, target, options);
  }
}

/// A pose out of reach, one in collision, and one in reach that is not: sampling ends, and so does
/// a planner that has all the time there is.
TEST_F(PoseGoals, WithoutASampleEndThePlanning) {
  const Arm arm{std::make_shared<const Checker>(gantry(), "all", worldOf(boxes())), "ball"};
  const Vector3d outOfReach(0, 0, 3), inABox(0, 0, 0), beside(0.45, 0.0, 0.0);
  for (const Vector3d& wanted : {outOfReach, inABox, beside}) {
    const auto setup = makeSimpleSetup(arm.checker);
    start(setup, arm, {-0.8, -0.8, 0.8});
    const auto goal = goalOf(setup, arm, Isometry3d(Translation3d(wanted)));
    setup->setGoal(goal);
    setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
    const ob::PlannerStatus status = setup->solve(ob::plannerNonTerminatingCondition());
    if (wanted == beside) {
      EXPECT_TRUE(status == ob::PlannerStatus::EXACT_SOLUTION);
      continue;
    }
    EXPECT_FALSE(setup->haveSolutionPath());
    EXPECT_FALSE(goal->isSampling());
    EXPECT_EQ(goal->getStateCount(), 0u);
  }
}

/// Metres over metres, or radians over radians, whichever is more.
TEST_F(PoseGoals, MeasureInTolerances) {
  const Arm arm{std::make_shared<const Checker>(gantry(), "all", std::make_shared<World>()),
                "ball"};
  const auto setup = makeSimpleSetup(arm.checker);
  PoseGoalOptions options;
  options.positionTolerance = 0.02;
  options.orientationTolerance = 0.1;
  Isometry3d target(Translation3d(0.1, 0.2, 0.3));
  target.rotate(AngleAxisd(0.05, Vector3d::UnitZ()));
  const auto goal = goalOf(setup, arm, target, options);
  ob::ScopedState<ob::RealVectorStateSpace> state(setup->getStateSpace());
  const auto distance = [&](double x, double y, double z) {
    state->values[0] = x, state->values[1] = y, state->values[2] = z;
    return goal->distanceGoal(state.get());
  };
  EXPECT_NEAR(distance(0.1, 0.2, 0.3), 0.5, 1e-12);
  EXPECT_NEAR(distance(0.1, 0.2, 0.305), 0.5, 1e-12);
  EXPECT_NEAR(distance(0.1, 0.24, 0.33), 2.5, 1e-12);
  EXPECT_FALSE(goal->isSatisfied(state.get()));
  EXPECT_NEAR(distance(0.1, 0.2, 0.3199), 0.995, 1e-12);
  double told = 0.0;
  EXPECT_TRUE(goal->isSatisfied(state.get(), &told));
  EXPECT_NEAR(told, 0.995, 1e-12);
  EXPECT_NEAR(distance(0.1, 0.2, 0.3201), 1.005, 1e-12);
  EXPECT_FALSE(goal->isSatisfied(state.get()));
  EXPECT_EQ(distance(0.1, 0.2, 1.5), kInfinity);
  EXPECT_EQ(distance(0.1, std::nan(""), 0.3), kInfinity);
  EXPECT_FALSE(goal->isSatisfied(state.get()));
}

/// The thread reads members of the goal until it is joined.
TEST_F(PoseGoals, EndTheirThreadWithThem) {
  const Arm arm = shelfArm();
  const auto setup = makeSimpleSetup(arm.checker);
  const Isometry3d target = arm.place(kInShelf);
  PoseGoalOptions endless;
  endless.maxSeeds = std::numeric_limits<int>::max();
  endless.maxSamples = std::numeric_limits<int>::max();
  // Before the setup the thread waits, later it samples.
  goalOf(setup, arm, target, endless);
  setup->getSpaceInformation()->setup();
  for (int i = 0; i < 10; ++i) {
    const auto goal = goalOf(setup, arm, target, endless);
    while (goal->getStateCount() < 1) std::this_thread::yield();
    EXPECT_TRUE(goal->isSampling());
  }
}

/// Stopped and started again, it goes on where it was.
TEST_F(PoseGoals, GoOnAfterAStop) {
  const Arm arm = shelfArm();
  const auto setup = makeSimpleSetup(arm.checker);
  PoseGoalOptions options;
  options.maxSamples = 8;
  const auto whole = goalOf(setup, arm, arm.place(kInShelf), options);
  awaitSamples(*whole);
  const auto parts = goalOf(setup, arm, arm.place(kInShelf), options);
  for (std::size_t wanted = 1; wanted < 8; wanted += 2) {
    while (parts->getStateCount() < wanted) std::this_thread::yield();
    parts->stopSampling();
    EXPECT_FALSE(parts->isSampling());
    parts->startSampling();
  }
  awaitSamples(*parts);
  EXPECT_EQ(samples(*parts, arm), samples(*whole, arm));
}

template <typename Make>
std::string message(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST_F(PoseGoals, SayWhatIsWrong) {
  const Arm arm{std::make_shared<const Checker>(gantry(), "all", std::make_shared<World>()),
                "ball"};
  const auto setup = makeSimpleSetup(arm.checker);
  PoseGoalOptions options;
  Isometry3d target = Isometry3d::Identity();
  const auto build = [&](const std::shared_ptr<const Checker>& checker, const std::string& link) {
    return message([&] { goalOf(setup, {checker, link}, target, options); });
  };
  EXPECT_EQ(build(arm.checker, "ball"), "nothing thrown");
  EXPECT_EQ(build(nullptr, "ball"), "no checker given");
  EXPECT_EQ(build(arm.checker, "nose"), "InverseKinematics: robot 'gantry' has no link 'nose'");
  EXPECT_EQ(build(arm.checker, "frame"),
            "InverseKinematics: group 'all' does not move link 'frame'");
  const auto other =
      std::make_shared<const Checker>(everyJoint(), "all", std::make_shared<World>());
  EXPECT_EQ(build(other, "l6"),
            "state space `all` is not built as makeStateSpace does for group `all`");
  options.positionTolerance = std::nan("");
  EXPECT_EQ(build(arm.checker, "ball"),
            "PoseGoal: the position tolerance is nan m; it must be above 0");
  // Half of it is what is searched with, in a thread where nothing may be thrown.
  options.positionTolerance = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(build(arm.checker, "ball"),
            "InverseKinematics: the position tolerance is 0 m; it must be above 0");
  options = {};
  options.orientationTolerance = 0.0;
  EXPECT_EQ(build(arm.checker, "ball"),
            "PoseGoal: the orientation tolerance is 0 rad; it must be above 0");
  options = {};
  options.maxSeeds = -1;
  EXPECT_EQ(build(arm.checker, "ball"),
            "PoseGoal: the number of seeds is -1; it must be at least 0");
  options = {};
  options.maxSamples = -1;
  EXPECT_EQ(build(arm.checker, "ball"),
            "PoseGoal: the number of samples is -1; it must be at least 0");
  options = {};
  target.linear() *= 2.0;
  EXPECT_EQ(build(arm.checker, "ball"), "InverseKinematics: the target is not a rigid transform");
  target = Isometry3d::Identity();
  ob::RealVectorBounds outside(3);
  outside.setLow(2.0);
  outside.setHigh(3.0);
  setup->getStateSpace()->as<ob::RealVectorStateSpace>()->setBounds(outside);
  EXPECT_EQ(build(arm.checker, "ball"),
            "InverseKinematics: the limits leave no value to variable 'x'");
}

}  // namespace
}  // namespace swept::test
