// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <iostream>

#include "gantry.hpp"
#include "property/forgeries/campaign.hpp"

/// Path files that `swept plan` wrote, changed by someone who wants doubles to cancel.
namespace swept::test {
namespace {

TEST(VerifyForge, NoFalseProofMadeOfATrueOneIsVerified) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"left", "right", "--embed", "-o", file}).exitCode, 0);
  forgeries::CampaignOptions options;
  options.count = 2000;
  options.seed = 3;
  options.originals = {forgeries::Json::parse(gantry.folder().read("path.json"))};
  const forgeries::CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_GT(report.originals, options.count / 10);
}

}  // namespace
}  // namespace swept::test
