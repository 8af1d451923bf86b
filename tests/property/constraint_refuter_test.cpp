// SPDX-License-Identifier: BSD-3-Clause
// Some of the motions that constraint_refute makes by the million.
#include <gtest/gtest.h>

#include <iostream>

#include "constraints/campaign.hpp"

namespace {

using namespace constraints;

TEST(ConstraintRefuter, FindsNothingToRefute) {
  CampaignOptions options;
  options.count = 2000;
  options.samples = 300;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  const auto share = [](std::uint64_t n, std::uint64_t of) {
    return static_cast<double>(n) / static_cast<double>(of);
  };
  EXPECT_GT(share(report.all.free, report.all.cases), 0.2);
  EXPECT_GT(share(report.all.violated, report.all.cases), 0.2);
  EXPECT_LT(share(report.all.undecided, report.all.cases), 0.15);
  for (const Tally& tally : report.kinds) {
    EXPECT_GT(share(tally.free, tally.cases), 0.1);
    EXPECT_GT(share(tally.violated, tally.cases), 0.1);
  }
  for (const Tally* tally : {&report.tubes, &report.curves, &report.relative})
    EXPECT_GT(tally->free * tally->violated, 0U);
  EXPECT_GT(share(report.near, report.all.free), 0.1);
  EXPECT_GT(share(report.prefixes, report.all.cases), 0.1);
}

/// The reading itself, where the truth is plain: a robot's tool at zero is where its frames say.
TEST(ConstraintReading, KnowsATurnedTool) {
  RandomRobot robot;
  robot.joints.push_back(
      {.axis = Eigen::Vector3d::UnitX(), .lower = -3.0, .upper = 3.0, .first = 0});
  robot.values = 1;
  swept::AxisConstraint up{.frame = {.body = "l1"}, .angle = 0.25};
  EXPECT_NEAR(static_cast<double>(excessOf(robot, up, {0.75L})), 0.5, 1e-15);
  swept::OrientationConstraint turned{.frame = {.body = "l1"}, .tolerance = {0.25, 0.1, 0.1}};
  EXPECT_NEAR(static_cast<double>(excessOf(robot, turned, {-0.75L})), 0.5, 1e-15);
  turned.parameterization = swept::OrientationConstraint::Parameterization::RotationVector;
  EXPECT_NEAR(static_cast<double>(excessOf(robot, turned, {3.0L})), 2.75, 1e-15);
}

}  // namespace
