// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "../robot_model/model_robots.hpp"
#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "urdf_text.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

TEST(StateSpace, LimitedJointsAreOneRealVector) {
  const auto robot = everyJoint();
  const auto space = makeStateSpace(*robot, *robot->findGroup("limited"));
  ASSERT_FALSE(space->isCompound());
  EXPECT_EQ(space->getName(), "limited");
  const auto* vector = space->as<ob::RealVectorStateSpace>();
  ASSERT_EQ(vector->getDimension(), 3u);
  EXPECT_EQ(vector->getDimensionName(0), "slide");
  EXPECT_EQ(vector->getDimensionName(2), "wrist");
  EXPECT_EQ(vector->getBounds().low, (std::vector<double>{-0.5, -2.0, -1.0}));
  EXPECT_EQ(vector->getBounds().high, (std::vector<double>{1.5, 2.0, 1.0}));
}

TEST(StateSpace, EveryJointTypeHasItsSubspace) {
  const auto robot = everyJoint();
  const auto space = makeStateSpace(*robot, *robot->findGroup("all"));
  ASSERT_TRUE(space->isCompound());
  const auto* compound = space->as<ob::CompoundStateSpace>();
  ASSERT_EQ(compound->getSubspaceCount(), 5u);
  const std::vector<std::string> names{"slide", "turn", "elbow..wrist", "cart", "body"};
  const std::vector<int> types{ob::STATE_SPACE_REAL_VECTOR, ob::STATE_SPACE_SO2,
                               ob::STATE_SPACE_REAL_VECTOR, ob::STATE_SPACE_SE2,
                               ob::STATE_SPACE_SE3};
  for (unsigned int i = 0; i < 5; ++i) {
    EXPECT_EQ(compound->getSubspace(i)->getName(), names[i]);
    EXPECT_EQ(compound->getSubspace(i)->getType(), types[i]);
    EXPECT_EQ(compound->getSubspaceWeight(i), 1.0);
  }
  EXPECT_EQ(compound->as<ob::SE2StateSpace>(3)->getBounds().high, (std::vector<double>{10, 10}));
  EXPECT_EQ(compound->as<ob::SE3StateSpace>(4)->getBounds().low,
            (std::vector<double>{-10, -10, -10}));
  EXPECT_TRUE(compound->isLocked());
}

/// What mimics `drive` times 0.5 is half a turn away after a turn of it: the two ends of its range
/// are not one state.
TEST(StateSpace, AContinuousJointWithAGearIsARealVector) {
  const std::string follows = "<mimic joint='drive' multiplier='0.5'/>";
  const auto robot =
      Robot::parse("<robot name='g'><link name='a'/><link name='b'/><link name='c'/>" +
                       joint("drive", "continuous", "a", "b", "") +
                       joint("d", "continuous", "a", "c", follows) + "</robot>",
                   "g.urdf");
  const auto space = makeStateSpace(*robot, *robot->findGroup("all"));
  ASSERT_EQ(space->getType(), ob::STATE_SPACE_REAL_VECTOR);
  const auto* vector = space->as<ob::RealVectorStateSpace>();
  EXPECT_EQ(vector->getBounds().low, std::vector{-std::numbers::pi});
  EXPECT_EQ(vector->getBounds().high, std::vector{std::numbers::pi});
  ob::ScopedState<ob::RealVectorStateSpace> from(space), to(space), middle(space);
  from[0] = 3.0;
  to[0] = -3.0;
  EXPECT_EQ(space->distance(from.get(), to.get()), 6.0);
  space->interpolate(from.get(), to.get(), 0.25, middle.get());
  EXPECT_EQ(middle[0], 1.5);
  const auto sampler = space->allocStateSampler();
  for (int i = 0; i < 1000; ++i) {
    sampler->sampleUniformNear(middle.get(), from.get(), 1.0);
    EXPECT_GE(middle[0], 2.0);
    EXPECT_LE(middle[0], std::numbers::pi);
  }
}

TEST(StateSpace, HasADefaultProjectionAfterSetup) {
  const auto robot = everyJoint();
  for (const Group& group : robot->groups()) {
    const auto space = makeStateSpace(*robot, group);
    space->setup();
    ASSERT_TRUE(space->hasDefaultProjection()) << group.name;
    EXPECT_GE(space->getDefaultProjection()->getDimension(), 1u);
    ob::ScopedState<> state(space);
    state.random();
    Eigen::VectorXd projected(space->getDefaultProjection()->getDimension());
    space->getDefaultProjection()->project(state.get(), projected);
    EXPECT_TRUE(projected.allFinite());
    space->sanityChecks();
  }
}

/// OMPL's planners of the KPIECE family want some 20 cells along each axis of what states reach.
TEST(StateSpace, HasCellsOfASmallPartOfWhatStatesReach) {
  const auto robot = everyJoint();
  int axes = 0;
  for (const Group& group : robot->groups()) {
    const auto space = makeStateSpace(*robot, group);
    space->setup();
    space->setup();  // planners set the projection up once more
    const auto projection = space->getDefaultProjection();
    const unsigned int size = projection->getDimension();
    ASSERT_EQ(projection->getCellSizes().size(), size);
    EXPECT_FALSE(projection->userConfigured());
    Eigen::VectorXd low = Eigen::VectorXd::Constant(size, 1e9), high = -low, projected = low;
    ob::ScopedState<> state(space);
    for (int i = 0; i < 1000; ++i) {
      state.random();
      projection->project(state.get(), projected);
      low = low.cwiseMin(projected);
      high = high.cwiseMax(projected);
    }
    for (unsigned int i = 0; i < size; ++i) {
      const double extent = high[i] - low[i];
      if (extent == 0.0) {
        EXPECT_EQ(projection->getCellSizes(i), 1.0) << group.name;
        continue;
      }
      ++axes;
      EXPECT_GT(extent / projection->getCellSizes(i), 10.0) << group.name;
      EXPECT_LT(extent / projection->getCellSizes(i), 80.0) << group.name;
    }
  }
  EXPECT_GT(axes, 5);
}

/// The position of the group's tip by the library's other way to place a link.
TEST(StateSpace, ProjectsOntoThePlaceOfTheTip) {
  const auto robot = everyJoint();
  int tips = 0;
  for (const Group& group : robot->groups()) {
    const auto space = makeStateSpace(*robot, group);
    space->setup();
    const auto projection = space->getDefaultProjection();
    const StateConversion conversion(*robot, group);
    ob::ScopedState<> state(space);
    std::vector<double> q(conversion.dimension());
    for (int i = 0; i < 50; ++i) {
      state.random();
      conversion.toConfiguration(state.get(), q);
      Eigen::VectorXd projected(projection->getDimension());
      projection->project(state.get(), projected);
      if (group.tipLink < 0) {
        ASSERT_EQ(projected.size(), std::min<Eigen::Index>(2, conversion.dimension()));
        EXPECT_EQ(projected[0], q[0]);
        continue;
      }
      ++tips;
      const LinkMotion stands(*robot, group.name, robot->links()[group.tipLink].name, q, q);
      ASSERT_EQ(projected.size(), 3);
      EXPECT_LT((projected - stands.at(0.0).translation()).norm(), 1e-12) << group.name;
    }
  }
  EXPECT_GT(tips, 100);
}

TEST(StateSpace, TakesNarrowerLimits) {
  const auto robot = everyJoint();
  StateSpaceOptions options;
  options.limits = {
      {"elbow", {-0.5, 0.25}}, {"cart/x", {2.0, 40.0}}, {"body/trans_z", {-1.0, 0.0}}};
  const auto space = makeStateSpace(*robot, *robot->findGroup("all"), options);
  space->setup();
  ob::ScopedState<> state(space);
  const StateConversion conversion(*robot, *robot->findGroup("all"));
  std::vector<double> q(conversion.dimension());
  for (int i = 0; i < 200; ++i) {
    state.random();
    conversion.toConfiguration(state.get(), q);
    EXPECT_TRUE(q[2] >= -0.5 && q[2] <= 0.25);
    EXPECT_TRUE(q[4] >= 2.0 && q[4] <= 40.0);
    EXPECT_TRUE(q[9] >= -1.0 && q[9] <= 0.0);
    EXPECT_TRUE(q[0] >= -0.5 && q[0] <= 1.5);
  }
}

TEST(StateSpace, WeighsJoints) {
  const auto robot = everyJoint();
  StateSpaceOptions options;
  options.weights = {{"elbow", 3.0}, {"turn", 0.5}, {"slide", 1.0}};
  for (const char* name : {"all", "limited", "turn_only"}) {
    const Group& group = *robot->findGroup(name);
    StateSpaceOptions mine = options;
    for (const std::string joint : {"elbow", "turn", "slide"}) {
      const bool has =
          std::ranges::find(group.joints, *robot->findJoint(joint)) != group.joints.end();
      if (!has) mine.weights.erase(joint);
    }
    const auto space = makeStateSpace(*robot, group, mine);
    const auto plain = makeStateSpace(*robot, group);
    space->setup();
    plain->setup();
    EXPECT_NO_THROW(space->sanityChecks());
    const StateConversion conversion(*robot, group);
    ob::ScopedState<> a(space), b(space);
    std::vector<double> from(conversion.dimension()), to(conversion.dimension());
    double sum = 0.0;
    for (int i = 0; i < 100; ++i) {
      a.random();
      conversion.toConfiguration(a.get(), from);
      for (std::size_t k = 0; k < group.variables.size(); ++k) {
        const std::string& joint =
            robot->joints()[robot->variables()[group.variables[k]].joint].name;
        to = from;
        to[k] += 0.01 - 0.02 * (from[k] > 0.0);
        conversion.toState(to, b.get());
        const double weight = mine.weights.contains(joint) ? mine.weights.at(joint) : 1.0;
        EXPECT_NEAR(space->distance(a.get(), b.get()), weight * plain->distance(a.get(), b.get()),
                    1e-9);
      }
      b.random();
      EXPECT_LE(space->distance(a.get(), b.get()), space->getMaximumExtent());
      sum += space->distance(a.get(), b.get());
    }
    EXPECT_GT(sum, 0.0);
  }
}

/// Planners take radii from the measure, and distances of samples from the space.
TEST(StateSpace, MeasureAndSamplesAreWeighedToo) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("limited");
  StateSpaceOptions options;
  options.weights = {{"elbow", 4.0}};
  const auto space = makeStateSpace(*robot, group, options);
  const auto plain = makeStateSpace(*robot, group);
  space->setup();
  plain->setup();
  EXPECT_NEAR(space->getMeasure(), 4.0 * plain->getMeasure(), 1e-12 * space->getMeasure());
  const auto place = std::ranges::find(group.joints, *robot->findJoint("elbow"));
  const auto elbow = static_cast<std::size_t>(place - group.joints.begin());
  ASSERT_LT(elbow, group.joints.size());
  const ob::StateSamplerPtr sampler = space->allocStateSampler();
  const StateConversion conversion(*robot, group);
  ob::ScopedState<> middle(space), sample(space);
  std::vector<double> q(conversion.dimension(), 0.1), near(q);
  conversion.toState(q, middle.get());
  double farthest = 0.0, farthestElbow = 0.0, squares = 0.0, squaresElbow = 0.0;
  constexpr int kSamples = 2000;
  for (int i = 0; i < kSamples; ++i) {
    sampler->sampleUniformNear(sample.get(), middle.get(), 0.08);
    conversion.toConfiguration(sample.get(), near);
    EXPECT_TRUE(space->satisfiesBounds(sample.get()));
    farthestElbow = std::max(farthestElbow, std::abs(near[elbow] - q[elbow]));
    farthest = std::max(farthest, std::abs(near[1 - elbow] - q[1 - elbow]));
    sampler->sampleGaussian(sample.get(), middle.get(), 0.04);
    conversion.toConfiguration(sample.get(), near);
    EXPECT_TRUE(space->satisfiesBounds(sample.get()));
    squaresElbow += std::pow(near[elbow] - q[elbow], 2);
    squares += std::pow(near[1 - elbow] - q[1 - elbow], 2);
  }
  EXPECT_LE(farthest, 0.08);
  EXPECT_GT(farthest, 0.079);
  EXPECT_LE(farthestElbow, 0.02);
  EXPECT_GT(farthestElbow, 0.0197);
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.04, 0.003);
  EXPECT_NEAR(std::sqrt(squaresElbow / kSamples), 0.01, 0.001);
}

/// A base that drives may begin and end anywhere.
TEST(StateSpace, IsMadeWideEnoughForConfigurations) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  std::vector<std::vector<double>> ends(2, std::vector<double>(group.variables.size(), 0.0));
  EXPECT_TRUE(limitsAround(*robot, group, ends).empty());
  const auto at = [&](const std::string& name) -> std::size_t {
    const auto found = std::ranges::find(group.variables, *robot->findVariable(name));
    return static_cast<std::size_t>(found - group.variables.begin());
  };
  ends[0][at("cart/x")] = 15.0;
  ends[1][at("cart/x")] = -3.0;
  ends[1][at("body/trans_z")] = -1e3;
  ends[1][at("elbow")] = 100.0;  // beyond the robot's own limits, which stay
  ends[0][at("cart/y")] = std::numeric_limits<double>::quiet_NaN();
  using Limits = std::map<std::string, std::pair<double, double>>;
  const Limits limits = limitsAround(*robot, group, ends);
  EXPECT_EQ(limits, (Limits{{"cart/x", {-10.0, 25.0}}, {"body/trans_z", {-1010.0, 10.0}}}));
  const auto space = makeStateSpace(*robot, group, {.limits = limits});
  const auto* cart = space->as<ob::CompoundStateSpace>()->as<ob::SE2StateSpace>(3);
  EXPECT_EQ(cart->getBounds().high, (std::vector<double>{25.0, 10.0}));
  ends[0].pop_back();
  EXPECT_THROW(limitsAround(*robot, group, ends), std::invalid_argument);
}

TEST(StateSpace, SaysWhichOptionIsWrong) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  const auto messageOf = [&](const StateSpaceOptions& options, const Group& of) -> std::string {
    try {
      makeStateSpace(*robot, of, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "taken";
  };
  const auto limits = [](const std::string& name, double low, double high) {
    StateSpaceOptions options;
    options.limits[name] = {low, high};
    return options;
  };
  const auto weight = [](const std::string& name, double value) {
    StateSpaceOptions options;
    options.weights[name] = value;
    return options;
  };
  EXPECT_EQ(messageOf(limits("elbow", -2, 2), group), "taken");
  EXPECT_EQ(messageOf(limits("elbow", -2.5, 1), group),
            "state space: limits [-2.5, 1] of `elbow` are not within the robot's [-2, 2]");
  EXPECT_EQ(
      messageOf(limits("elbow", 1, 1), group),
      "state space: limits [1, 1] of `elbow` are not two finite numbers, the lower one first");
  EXPECT_EQ(
      messageOf(limits("elbow", std::nan(""), 1), group),
      "state space: limits [nan, 1] of `elbow` are not two finite numbers, the lower one first");
  EXPECT_EQ(
      messageOf(limits("elbow", 1, 0.5), group),
      "state space: limits [1, 0.5] of `elbow` are not two finite numbers, the lower one first");
  EXPECT_EQ(messageOf(limits("nose", 0, 1), group),
            "state space: group `all` has no variable `nose` to limit");
  EXPECT_EQ(messageOf(limits("turn", 0, 1), *robot->findGroup("limited")),
            "state space: group `limited` has no variable `turn` to limit");
  for (const char* angle : {"turn", "cart/theta", "body/rot_x"}) {
    EXPECT_EQ(messageOf(limits(angle, 0, 1), group),
              std::string("state space: `") + angle +
                  "` is an angle without limits, or part of an orientation");
  }
  EXPECT_EQ(messageOf(weight("nose", 1), group),
            "state space: group `all` has no joint `nose` to weigh");
  EXPECT_EQ(messageOf(weight("elbow", 0), group),
            "state space: weight 0 of `elbow` is not a finite number greater than zero");
}

TEST(StateSpace, RefusesAGroupWithoutVariables) {
  const auto robot = everyJoint();
  EXPECT_THROW(makeStateSpace(*robot, Group{"none", {}, {}, -1}), std::invalid_argument);
}

TEST(NamedStates, AreConfigurationsOfTheirGroup) {
  const auto robot = modelRobot("rook6_cart");
  ASSERT_GE(robot->namedStates().size(), 2u);
  for (const NamedState& named : robot->namedStates()) {
    const Group& group = *robot->findGroup(named.group);
    const std::vector<double> q = namedConfiguration(*robot, group, named.name);
    const NamedState again = makeNamedState(group, named.name, q);
    EXPECT_EQ(again.name, named.name);
    EXPECT_EQ(again.group, named.group);
    auto values = named.values;
    EXPECT_TRUE(std::ranges::is_permutation(again.values, values));
    const auto space = makeStateSpace(*robot, group);
    ompl::base::ScopedState<> state(space);
    StateConversion(*robot, group).toState(q, state.get());
    EXPECT_TRUE(space->satisfiesBounds(state.get()));
  }
}

TEST(StateConversion, RoundTripsStatesOfEveryGroup) {
  const auto robot = everyJoint();
  for (const Group& group : robot->groups()) {
    const auto space = makeStateSpace(*robot, group);
    const StateConversion conversion(*robot, group);
    ASSERT_EQ(conversion.dimension(), static_cast<int>(group.variables.size()));
    ob::ScopedState<> state(space), copy(space);
    std::vector<double> q(conversion.dimension());
    for (int i = 0; i < 200; ++i) {
      state.random();
      conversion.toConfiguration(state.get(), q);
      conversion.toState(q, copy.get());
      ASSERT_LT(space->distance(state.get(), copy.get()), 1e-7) << group.name;
      // OMPL's distance takes close rotations for equal, so compare the numbers too.
      std::vector<double> left = state.reals(), right = copy.reals();
      for (std::size_t k = 0; k < left.size(); ++k) ASSERT_NEAR(left[k], right[k], 1e-15);
    }
  }
}

TEST(StateConversion, FollowsTheOrderOfTheGroup) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  const auto space = makeStateSpace(*robot, group);
  const StateConversion conversion(*robot, group);
  const std::vector<std::string> names{"slide",        "turn",         "elbow",      "wrist",
                                       "cart/x",       "cart/y",       "cart/theta", "body/trans_x",
                                       "body/trans_y", "body/trans_z", "body/rot_x", "body/rot_y",
                                       "body/rot_z",   "body/rot_w"};
  ASSERT_EQ(group.variables.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(robot->variables()[group.variables[i]].name, names[i]);
  }
  const std::vector<double> q{0.1, 0.2, 0.3, 0.4, 5, 6, 0.7, 8, 9, 1.5, 0.5, -0.5, 0.1, 0.7};
  ob::ScopedState<ob::CompoundStateSpace> state(space);
  conversion.toState(q, state.get());
  EXPECT_EQ((*state)[0]->as<ob::RealVectorStateSpace::StateType>()->values[0], 0.1);
  EXPECT_EQ((*state)[1]->as<ob::SO2StateSpace::StateType>()->value, 0.2);
  EXPECT_EQ((*state)[2]->as<ob::RealVectorStateSpace::StateType>()->values[1], 0.4);
  EXPECT_EQ((*state)[3]->as<ob::SE2StateSpace::StateType>()->getY(), 6.0);
  EXPECT_EQ((*state)[3]->as<ob::SE2StateSpace::StateType>()->getYaw(), 0.7);
  const auto* body = (*state)[4]->as<ob::SE3StateSpace::StateType>();
  EXPECT_EQ(body->getZ(), 1.5);
  EXPECT_DOUBLE_EQ(body->rotation().x, 0.5);
  EXPECT_DOUBLE_EQ(body->rotation().w, 0.7);
}

TEST(StateConversion, PutsAnglesAndQuaternionsWhereOmplWantsThem) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  const auto space = makeStateSpace(*robot, group);
  const StateConversion conversion(*robot, group);
  ob::ScopedState<> state(space);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-30.0, 30.0), number(-2.0, 2.0);
  std::vector<double> q(14, 0.0), back(14);
  for (int i = 0; i < 500; ++i) {
    q[1] = i == 0 ? std::numbers::pi : angle(random);
    q[6] = i == 0 ? -std::numbers::pi : angle(random);
    for (int k = 10; k < 14; ++k) q[k] = number(random);
    conversion.toState(q, state.get());
    ASSERT_TRUE(space->satisfiesBounds(state.get()));
    conversion.toConfiguration(state.get(), back);
    ASSERT_NEAR(std::sin(back[1] - q[1]), 0.0, 1e-14);
    ASSERT_NEAR(std::cos(back[6] - q[6]), 1.0, 1e-14);
    const double norm = Eigen::Map<const Eigen::Vector4d>(&q[10]).norm();
    for (int k = 10; k < 14; ++k) ASSERT_NEAR(back[k] * norm, q[k], 1e-14);
  }
}

// OMPL's bounds let NaN through; the validity checker must not.
TEST(StateConversion, ABrokenQuaternionIsNeverValid) {
  const auto checker =
      std::make_shared<const Checker>(everyJoint(), "all", std::make_shared<const World>());
  const auto setup = makeSimpleSetup(checker);
  const StateConversion conversion(checker->robot(), checker->group());
  ob::ScopedState<> state(setup->getStateSpace());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> q(14, 0.0);
  for (const double bad : {0.0, nan, infinity}) {
    q[13] = bad;
    conversion.toState(q, state.get());
    EXPECT_FALSE(setup->getStateValidityChecker()->isValid(state.get())) << bad;
  }
  for (const double good : {1.0, -1.0, 1e-300, 1e300}) {
    q[13] = good;
    conversion.toState(q, state.get());
    EXPECT_TRUE(setup->getStateValidityChecker()->isValid(state.get())) << good;
  }
}

TEST(StateConversion, RefusesTheWrongSize) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  const StateConversion conversion(*robot, group);
  ob::ScopedState<> state(makeStateSpace(*robot, group));
  std::vector<double> q(13);
  EXPECT_THROW(conversion.toState(q, state.get()), std::invalid_argument);
  EXPECT_THROW(conversion.toConfiguration(state.get(), q), std::invalid_argument);
}

}  // namespace
}  // namespace swept::test
