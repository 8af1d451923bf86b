// SPDX-License-Identifier: BSD-3-Clause
// What the checker of proofs shows of random motions under constraints: nothing that is false, and
// what the library has proven. Some of what constraint_refute makes by the million.
#include <gtest/gtest.h>

#include <iostream>

#include "constraints/campaign.hpp"
#include "constraints/shown.hpp"

namespace {

using namespace constraints;

TEST(ConstraintProofs, ShowWhatIsProvenAndNothingFalse) {
  CampaignOptions options;
  options.seed = 2;
  options.count = 8000;
  options.samples = 300;
  options.shows = isShown;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_GT(report.shown, 3000U);
  // Some frames are 1e6 m away, of which the checker of proofs takes centimetres for rounding.
  EXPECT_LT(report.notShown, report.shown / 100);
}

}  // namespace
