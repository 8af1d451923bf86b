// SPDX-License-Identifier: BSD-3-Clause
// A value up to 1e-5 beyond a limit: start and goal are taken to the limit, with a warning, and a
// state that somebody has made is within the space's bounds as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <array>
#include <limits>
#include <numbers>

#include "fixtures.hpp"
#include "message_of.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
using testing::ElementsAre;
using testing::IsEmpty;
using Vector = ob::ScopedState<ob::RealVectorStateSpace>;

constexpr std::array kHairs{2e-9, 1e-6, 9e-6, 1e-5};
constexpr std::array kOutside{1.1e-5, 1e-3};

/// Keeps OMPL's warnings while it is there.
class Console : public ompl::msg::OutputHandler {
 public:
  Console() : before_(ompl::msg::getOutputHandler()) { ompl::msg::useOutputHandler(this); }
  ~Console() override { ompl::msg::useOutputHandler(before_); }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  void log(const std::string& text, ompl::msg::LogLevel level, const char*, int) override {
    if (level == ompl::msg::LOG_WARN) warnings.push_back(text);
  }
  std::vector<std::string> warnings;

 private:
  ompl::msg::OutputHandler* before_;
};

/// A gantry among its boxes: the ball's x, y and z are in [-1, 1].
class Hair : public testing::Test {
 protected:
  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(boxes()));
  ompl::geometric::SimpleSetupPtr setup_ = makeSimpleSetup(checker_);
  ob::StateSpacePtr space_ = setup_->getStateSpace();
};

TEST_F(Hair, StartAndGoalAreTakenToTheLimit) {
  for (const double hair : kHairs) {
    Console console;
    const auto setup = makeSimpleSetup(checker_);
    setStartAndGoal(*setup, *checker_, std::vector<double>{-1.0 - hair, -1.0, 0.95},
                    std::vector<double>{1.0, 1.0 + hair, 0.95});
    ASSERT_EQ(console.warnings.size(), 2u) << hair;
    EXPECT_THAT(console.warnings[0],
                testing::MatchesRegex("start: x is -1\\.0[0-9]* m, [0-9e.-]+ beyond its limit "
                                      "-1: taken to the limit"));
    EXPECT_THAT(console.warnings[1],
                testing::MatchesRegex("goal: y is 1\\.0[0-9]* m, [0-9e.-]+ beyond its limit 1: "
                                      "taken to the limit"));
    setup->setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation()));
    ASSERT_EQ(setup->solve(10.0), ob::PlannerStatus::EXACT_SOLUTION);
    const auto path = configurationsOf(setup->getSolutionPath(), *checker_);
    EXPECT_EQ(path.front(), (std::vector<double>{-1.0, -1.0, 0.95}));
    EXPECT_EQ(path.back(), (std::vector<double>{1.0, 1.0, 0.95}));
  }
  for (const double beyond : kOutside) {
    Console console;
    setStartAndGoal(*setup_, *checker_, std::vector<double>{-1.0 - beyond, -1.0, 0.95},
                    std::vector<double>{1.0, 1.0, 0.95});
    EXPECT_THAT(console.warnings, IsEmpty());
    EXPECT_FALSE(
        setup_->getSpaceInformation()->isValid(setup_->getProblemDefinition()->getStartState(0)));
  }
}

TEST_F(Hair, TheBoundsOfTheSpaceAreThoseOfTheChecker) {
  Vector state(space_), bounded(space_), other(space_);
  other[0] = other[1] = other[2] = -0.95;
  const ob::SpaceInformationPtr si = setup_->getSpaceInformation();
  si->setup();
  const auto set = [&](double value) {
    state[0] = state[1] = -0.95;
    state[2] = value;
    space_->copyState(bounded.get(), state.get());
    space_->enforceBounds(bounded.get());
  };
  for (const double hair : kHairs) {
    for (const double sign : {-1.0, 1.0}) {
      set(sign * (1.0 + hair));
      EXPECT_TRUE(space_->satisfiesBounds(state.get())) << hair;
      EXPECT_TRUE(checker_->withinLimits(std::vector<double>{-0.95, -0.95, state[2]}));
      EXPECT_TRUE(si->isValid(state.get()));
      EXPECT_TRUE(si->checkMotion(state.get(), other.get()));
      EXPECT_TRUE(si->checkMotion(other.get(), state.get()));
      EXPECT_EQ(bounded[2], sign);
      EXPECT_TRUE(space_->satisfiesBounds(bounded.get()));
    }
  }
  for (const double beyond : kOutside) {
    for (const double sign : {-1.0, 1.0}) {
      set(sign * (1.0 + beyond));
      EXPECT_FALSE(space_->satisfiesBounds(state.get())) << beyond;
      EXPECT_FALSE(checker_->withinLimits(std::vector<double>{-0.95, -0.95, state[2]}));
      EXPECT_FALSE(si->isValid(state.get()));
      EXPECT_FALSE(si->checkMotion(state.get(), other.get()));
      EXPECT_EQ(bounded[2], sign);
    }
  }
  for (int i = 0; i < 1000; ++i) {
    state.random();
    for (int k = 0; k < 3; ++k) EXPECT_LE(std::abs(state[k]), 1.0);
  }
}

TEST(LimitsOfASpace, ConversionTakesToTheRobotsAndLeavesTheRest) {
  const auto robot = everyJoint();
  const Group& group = *robot->findGroup("all");
  const StateConversion conversion(*robot, group);
  ob::ScopedState<> state(makeStateSpace(*robot, group));
  // slide, turn, elbow, wrist, cart (3), body (7)
  const std::vector<double> inside{1.5, 3.0, -2.0, 0.3, 1e3, 0.0, 1.0,
                                   0.0, 0.0, 0.0,  0.0, 0.0, 0.0, 1.0};
  const auto converted = [&](const std::vector<double>& q) {
    std::vector<double> back(q.size());
    conversion.toState(q, state.get());
    conversion.toConfiguration(state.get(), back);
    return back;
  };
  EXPECT_EQ(converted(inside), inside);
  for (const double hair : kHairs) {
    std::vector<double> q = inside;
    q[0] += hair;
    q[2] -= hair;
    EXPECT_EQ(converted(q), inside) << hair;
  }
  for (const double beyond : kOutside) {
    std::vector<double> q = inside;
    q[0] += beyond;
    EXPECT_EQ(converted(q), q) << beyond;
    EXPECT_FALSE(state.getSpace()->satisfiesBounds(state.get()));
  }
}

TEST(LimitsOfASpace, MayPassTheRobotsByAHair) {
  const auto robot = gantry();
  const Group& group = robot->groups().front();
  Console console;
  const auto boundsOf = [&](double low, double high) {
    const auto space = makeStateSpace(*robot, group, {.limits = {{"y", {low, high}}}});
    const auto& bounds = space->as<ob::RealVectorStateSpace>()->getBounds();
    return std::pair(bounds.low[1], bounds.high[1]);
  };
  EXPECT_EQ(boundsOf(-1.0 - 9e-6, 1.000000002), std::pair(-1.0, 1.0));
  EXPECT_THAT(console.warnings,
              ElementsAre("limits: y is -1.000009 m, 9e-06 beyond its limit -1: taken to the limit",
                          "limits: y is 1.000000002 m, 2e-09 beyond its limit 1: taken to the "
                          "limit"));
  console.warnings.clear();
  EXPECT_EQ(boundsOf(-0.5, 1.0), std::pair(-0.5, 1.0));
  EXPECT_THAT(console.warnings, IsEmpty());
  EXPECT_EQ(messageOf([&] { boundsOf(-0.5, 1.000011); }),
            "state space: limits [-0.5, 1.000011] of `y` are not within the robot's [-1, 1]");
  EXPECT_EQ(messageOf([&] { boundsOf(-1.0001, 0.5); }),
            "state space: limits [-1.0001, 0.5] of `y` are not within the robot's [-1, 1]");
}

/// Bounds that are narrower than the robot's, of a joint and of a base that has none.
TEST(LimitsOfASpace, StartAndGoalAreTakenToNarrowerOnes) {
  const auto checker =
      std::make_shared<const Checker>(everyJoint(), "all", std::make_shared<World>());
  SetupOptions options;
  options.space.limits = {{"elbow", {-0.1, 0.1}}, {"cart/x", {-0.1, 0.1}}};
  const auto setup = makeSimpleSetup(checker, options);
  const double single = 0.1F;
  std::vector<double> start{0.0, 0.0, single, 0.0, -single, 0.0, std::numbers::pi,
                            0.0, 0.0, 0.0,    0.0, 0.0,     0.0, 1.0};
  Console console;
  setStartAndGoal(*setup, *checker, start, start);
  EXPECT_THAT(console.warnings,
              ElementsAre("start: elbow is 0.1000000015 rad, 1.49e-09 beyond its limit 0.1: taken "
                          "to the limit",
                          "start: cart/x is -0.1000000015 m, 1.49e-09 beyond its limit -0.1: taken "
                          "to the limit",
                          testing::StartsWith("goal: elbow"), testing::StartsWith("goal: cart/x")));
  const ob::State* state = setup->getProblemDefinition()->getStartState(0);
  EXPECT_TRUE(setup->getStateSpace()->satisfiesBounds(state));
  std::vector<double> q(start.size());
  StateConversion(checker->robot(), checker->group()).toConfiguration(state, q);
  EXPECT_EQ(q[2], 0.1);
  EXPECT_EQ(q[4], -0.1);
}

}  // namespace
}  // namespace swept::test
