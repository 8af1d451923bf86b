// SPDX-License-Identifier: BSD-3-Clause
// How far joints move the robot, by hand and by an integral; and the metric that follows from it.
#include "reach_metric.hpp"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fixtures.hpp"
#include "joint_reach.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "urdf_text.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

std::string link(const std::string& name, double x) {
  return "<link name='" + name + "'><collision><origin xyz='" + std::to_string(x) +
         " 0 0'/><geometry><sphere radius='0.1'/></geometry></collision></link>\n";
}

/// Shoulder and elbow turn about z, 1 m apart; the forearm's ball is 0.5 m beyond the elbow. A
/// finger 0.3 m from its own axis, which mimics the elbow three times as fast; a lift under all.
std::shared_ptr<const Robot> arm() {
  const std::string urdf =
      "<?xml version='1.0'?>\n<robot name='arm'>\n<link name='ground'/><link name='base'/>" +
      link("upper", 0.0) + link("fore", 0.5) + link("finger", 0.2) +
      joint("lift", "prismatic", "ground", "base", limited("0 0 1", 0, 1)) +
      joint("shoulder", "revolute", "base", "upper", limited("0 0 1", -3, 3)) +
      joint("elbow", "revolute", "upper", "fore",
            "<origin xyz='1 0 0'/>" + limited("0 0 1", 0, 3)) +
      joint("tip", "revolute", "fore", "finger",
            limited("0 0 1", -9, 9) + "<mimic joint='elbow' multiplier='-3'/>") +
      "</robot>\n";
  const std::string srdf =
      "<?xml version='1.0'?>\n<robot name='arm'>\n"
      "<group name='arm'><joint name='shoulder'/><joint name='elbow'/></group>\n"
      "<group name='lifted'><joint name='lift'/><joint name='shoulder'/></group>\n</robot>\n";
  return Robot::parse(urdf, "arm.urdf", srdf, "arm.srdf");
}

std::shared_ptr<const Checker> checkerOf(const std::shared_ptr<const Robot>& robot,
                                         const std::string& group, CheckerOptions options = {}) {
  return std::make_shared<const Checker>(robot, group, std::make_shared<const World>(),
                                         std::move(options));
}

double reachOf(const Checker& checker, const std::string& joint) {
  return detail::jointReach(checker)[static_cast<std::size_t>(*checker.robot().findJoint(joint))];
}

/// m. The root mean square over the elbow of the farthest point of the forearm's and the finger's
/// balls.
double shoulderReach() {
  constexpr int kParts = 10000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double elbow = 3.0 * (i + 0.5) / kParts, finger = elbow - 3.0 * elbow;
    const auto far = [](double length, double angle) {
      return std::hypot(1.0 + length * std::cos(angle), length * std::sin(angle)) + 0.1;
    };
    const double farthest = std::max(far(0.5, elbow), far(0.2, finger));
    sum += farthest * farthest / kParts;
  }
  return std::sqrt(sum);
}

TEST(ReachMetric, OfJointsIsTheMeanOfTheFarthestPoints) {
  const auto robot = arm();
  const auto checker = checkerOf(robot, "arm");
  EXPECT_NEAR(reachOf(*checker, "shoulder"), shoulderReach(), 0.02);
  // The finger's ball is 0.2 + 0.1 m from its own axis, and three times as fast.
  EXPECT_NEAR(reachOf(*checker, "elbow"), 0.9, 1e-9);
  EXPECT_EQ(reachOf(*checker, "lift"), 0.0);
  EXPECT_EQ(reachOf(*checker, "tip"), 0.0);
}

TEST(ReachMetric, OfJointsThatSlideIsOne) {
  const auto checker = checkerOf(arm(), "lifted");
  EXPECT_EQ(reachOf(*checker, "lift"), 1.0);
  EXPECT_GT(reachOf(*checker, "shoulder"), 0.6);
}

TEST(ReachMetric, CountsWhatTheRobotCarries) {
  CheckerOptions options;
  AttachedBody pole;
  pole.name = "pole";
  pole.link = "fore";
  pole.parts.push_back({makeSphere(0.2), Eigen::Isometry3d(Eigen::Translation3d(2.0, 0.0, 0.0))});
  options.attached.push_back(pole);
  const auto checker = checkerOf(arm(), "arm", options);
  // One ball around the forearm's own, from 0.4 m on, and the pole, up to 2.2 m: the mean of both
  // centres is 1.25 m away.
  EXPECT_NEAR(reachOf(*checker, "elbow"), 1.25 + 0.95, 1e-6);
}

/// Distances of single joints are in proportion to their reach and their weights.
TEST(ReachMetric, WeighsJointsByTheirReach) {
  const auto checker = checkerOf(arm(), "arm");
  SetupOptions options;
  options.space.weights["elbow"] = 2.0;
  const auto setup = makeSimpleSetup(checker, options);
  setup->getSpaceInformation()->setup();
  const detail::ReachMetric metric(*setup->getSpaceInformation());
  ob::ScopedState<ob::RealVectorStateSpace> zero(setup->getStateSpace()), one(zero), both(zero);
  zero[0] = zero[1] = 0.0;
  const auto alone = [&](int joint) {
    one = zero;
    one[static_cast<unsigned>(joint)] = 0.3;
    return metric.distance(zero.get(), one.get()) / 0.3;
  };
  const double shoulder = alone(0), elbow = alone(1);
  EXPECT_NEAR(shoulder / elbow, reachOf(*checker, "shoulder") / (2.0 * reachOf(*checker, "elbow")),
              1e-9);
  EXPECT_NEAR(shoulder * shoulder + 0.25 * elbow * elbow, 2.0, 1e-9);
  both[0] = 0.3;
  both[1] = -0.4;
  EXPECT_NEAR(metric.distance(zero.get(), both.get()), std::hypot(0.3 * shoulder, 0.4 * elbow),
              1e-9);
  EXPECT_EQ(metric.jointFactors().size(), 2U);
}

TEST(ReachMetric, TakesGroupsOfEveryJoint) {
  const auto robot = everyJoint();
  const auto setup = makeSimpleSetup(checkerOf(robot, "all"));
  setup->getSpaceInformation()->setup();
  const detail::ReachMetric metric(*setup->getSpaceInformation());
  EXPECT_TRUE(metric.jointFactors().empty());
  ob::ScopedState<> a(setup->getStateSpace()), b(a), c(a);
  double differs = 0.0;
  for (int i = 0; i < 100; ++i) {
    a.random();
    b.random();
    c.random();
    const double ab = metric.distance(a.get(), b.get());
    EXPECT_GT(ab, 0.0);
    EXPECT_EQ(metric.distance(b.get(), a.get()), ab);
    EXPECT_LE(ab, (metric.distance(a.get(), c.get()) + metric.distance(c.get(), b.get())) *
                      (1.0 + 1e-12));
    differs = std::max(differs, std::abs(ab - setup->getStateSpace()->distance(a.get(), b.get())));
  }
  EXPECT_GT(differs, 0.1);
}

/// The space's own for validators of others.
TEST(ReachMetric, IsTheSpacesOwnWithoutAChecker) {
  const auto robot = arm();
  const auto space = makeStateSpace(*robot, *robot->findGroup("arm"));
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([](const ob::State*) { return true; });
  si->setup();
  const detail::ReachMetric metric(*si);
  EXPECT_TRUE(metric.jointFactors().empty());
  ob::ScopedState<> a(space), b(space);
  a.random();
  b.random();
  EXPECT_EQ(metric.distance(a.get(), b.get()), space->distance(a.get(), b.get()));
}

}  // namespace
}  // namespace swept::test
