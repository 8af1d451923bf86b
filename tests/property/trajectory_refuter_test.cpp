// SPDX-License-Identifier: BSD-3-Clause
// Some hundred of the curves that trajectory_refute makes by the million, and tests of the judge.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "trajectories/campaign.hpp"
#include "trajectories/errors.hpp"
#include "trajectories/judge.hpp"

namespace {

using namespace trajectories;

TEST(TrajectoryRefuter, FindsNothingToRefute) {
  CampaignOptions options;
  options.count = scenes().size() * kTubes * kCurvesOfStage;
  options.samples = 1500;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  const auto share = [](std::uint64_t n, const Tally& of) {
    return static_cast<double>(n) / static_cast<double>(of.curves);
  };
  EXPECT_GT(share(report.all.free, report.all), 0.2);
  EXPECT_LT(share(report.all.free, report.all), 0.8);
  EXPECT_GT(20 * report.near, report.all.free);
  EXPECT_LE(share(report.narrow.undecided, report.narrow), 0.01);
  for (const Tally& tally : report.kinds) EXPECT_GT(tally.free * tally.collision, 0U);
  for (const Tally& tally : report.scenes) EXPECT_GT(tally.free * tally.collision, 0U);
  EXPECT_GT(share(report.beside, report.all), 0.02);
  EXPECT_GT(share(report.prefixes, report.all), 0.02);
  EXPECT_GT(share(report.tooFast, report.all), 0.05);
  EXPECT_GT(share(report.outside, report.all), 0.02);
}

}  // namespace
