// SPDX-License-Identifier: BSD-3-Clause
// Planning, timing and proving in one call.
#include <gtest/gtest.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/setup.hpp"
#include "swept/ompl_bridge/trajectory.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

std::shared_ptr<const Checker> armIn(const std::string& scene) {
  const std::string arm = modelsDir() + "/robots/rook7/rook7";
  return std::make_shared<const Checker>(
      Robot::load(arm + ".urdf", arm + ".srdf"), "arm",
      std::make_shared<const World>(World::load(modelsDir() + "/scenes/" + scene + ".yaml")));
}

RateLimits limitsOf(const Checker& checker) {
  RateLimits limits = RateLimits::of(checker.robot(), checker.group());
  for (double& limit : limits.acceleration) limit = 3.0;
  return limits;
}

ompl::geometric::SimpleSetupPtr homeToReady(const std::shared_ptr<const Checker>& checker,
                                            MotionCheck motions = MotionCheck::Certified) {
  auto setup = makeSimpleSetup(checker, {.space = {}, .motions = motions});
  setStartAndGoal(*setup, *checker, namedConfiguration(checker->robot(), checker->group(), "home"),
                  namedConfiguration(checker->robot(), checker->group(), "ready"));
  setup->setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation()));
  return setup;
}

TEST(PlanTrajectory, IsProvenWithEverythingThatTheRobotMayBeOff) {
  const auto checker = armIn("narrow_slot");
  Workspace workspace(*checker);
  std::mt19937 random(5);
  std::bernoulli_distribution coin;
  constexpr double kTube = 0.005;
  for (int run = 0; run < 3; ++run) {
    const auto setup = homeToReady(checker);
    const RateLimits limits = limitsOf(*checker);
    const PlannedTrajectory planned =
        planTrajectory(*setup, limits, {{.rotation = kTube, .translation = 0.0}, {}});
    ASSERT_TRUE(planned.isProven());
    EXPECT_TRUE(planned.trajectory->certificate.violations.empty());
    const auto* motions = dynamic_cast<const CertifiedMotionValidator*>(
        setup->getSpaceInformation()->getMotionValidator().get());
    EXPECT_EQ(motions->checker(), planned.checker);
    EXPECT_EQ(planned.checker->options().tracking.rotation, kTube);
    const PiecewisePolynomial& curve = planned.trajectory->timed.curve;
    for (double t = 0.0; t <= curve.duration(); t += 0.001) {
      Eigen::VectorXd q = curve.position(curve.begin() + t);
      for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += coin(random) ? kTube : -kTube;
      ASSERT_NE(checker->checkState(q, workspace), Verdict::Collision) << t;
      ASSERT_LE((curve.velocity(curve.begin() + t).cwiseAbs() -
                 Eigen::Map<const Eigen::VectorXd>(limits.velocity.data(), q.size()))
                    .maxCoeff(),
                1e-9);
    }
  }
}

TEST(PlanTrajectory, HasNoneWithoutASolution) {
  const auto checker = armIn("narrow_slot");
  const auto setup = homeToReady(checker);
  const PlannedTrajectory planned =
      planTrajectory(*setup, limitsOf(*checker), {}, {.seconds = 0.0, .timing = {}});
  EXPECT_NE(planned.status, ompl::base::PlannerStatus::EXACT_SOLUTION);
  EXPECT_FALSE(planned.trajectory);
  EXPECT_FALSE(planned.isProven());
  EXPECT_NE(planned.checker, nullptr);
}

TEST(PlanTrajectory, NamesWhatItCannotUse) {
  const auto checker = armIn("narrow_slot");
  const auto setup = homeToReady(checker);
  const RateLimits limits = limitsOf(*checker);
  const auto messageOf = [&](const RateLimits& of, const TrajectoryPlanOptions& options) {
    return test::messageOf([&] { planTrajectory(*setup, of, {}, options); });
  };
  EXPECT_EQ(messageOf(limits, {.seconds = -1.0, .timing = {}}),
            "planTrajectory: seconds -1 s must be a finite number that is not negative");
  EXPECT_EQ(messageOf(limits, {.simplifySeconds = INFINITY, .timing = {}}),
            "planTrajectory: simplifySeconds inf s must be a finite number that is not negative");
  RateLimits few = limits;
  few.velocity.pop_back();
  EXPECT_NE(messageOf(few, {}), "");
  const auto discrete = homeToReady(checker, MotionCheck::Discrete);
  EXPECT_EQ(test::messageOf([&] { planTrajectory(*discrete, limits); }),
            "planTrajectory: the setup's motion validator is no swept::CertifiedMotionValidator");
}

}  // namespace
}  // namespace swept
