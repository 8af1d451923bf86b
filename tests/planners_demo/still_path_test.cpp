// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gantry.hpp"

/// Paths from a state to itself, of which some planners (FMT) have one state only.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kClearance = 0.8;  // m, between the faces of cube and post

class StillPath : public testing::TestWithParam<std::string> {
 protected:
  Gantry gantry_;
};

/// Nothing was certified of it, and the file was refused.
TEST_P(StillPath, IsCertifiedAndVerified) {
  const std::string file = gantry_.folder().path("path.json");
  const Outcome run =
      gantry_.run("plan", {"left", "left", "--planner", GetParam(), "--time", "0.5", "-o", file});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("proven free\n"));
  EXPECT_THAT(run.out, HasSubstr("m, nearest cube - post (world)"));
  const json path = json::parse(gantry_.folder().read("path.json"));
  ASSERT_GE(path["segments"].size(), 1u);
  ASSERT_EQ(path["states"].size(), path["segments"].size() + 1);
  for (const json& state : path["states"]) EXPECT_EQ(state, (json{0.0, 0.0}));
  for (const json& segment : path["segments"]) {
    EXPECT_EQ(segment["verdict"], "free");
    EXPECT_NEAR(segment["clearance"], kClearance, 1e-2);
  }
  const Outcome verified = runSwept({"verify", file});
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, testing::StartsWith("verified: "));
}

INSTANTIATE_TEST_SUITE_P(Planners, StillPath,
                         testing::Values("FMT", "BFMT", "RRTConnect", "PRM", "BITstar"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace swept::test
