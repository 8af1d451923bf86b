// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "data_folder.hpp"
#include "program.hpp"

/// The program on the robots and scenes of `models`.
namespace swept::test {
namespace {

using testing::HasSubstr;

TEST(Models, TheTopHelpNamesTheSubcommandsAndTheExitCodes) {
  const Outcome help = runSwept({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  for (const std::string command : {"info", "check", "motion", "plan"})
    EXPECT_THAT(help.out, HasSubstr("\n  " + command + " "));
  EXPECT_THAT(help.out, HasSubstr("Exit codes: 0 free or solved"));
  EXPECT_EQ(runSwept({"--version"}).out, "swept " SWEPT_VERSION "\n");
}

TEST(Models, ArmsHaveMeshesAndGroups) {
  for (const std::string robot : {"rook7", "rook6"}) {
    const Outcome run =
        runSwept({"info", "models/robots/" + robot + "/" + robot + ".urdf", "--json"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    const auto json = jsonOf(run);
    EXPECT_EQ(json["robot"], robot);
    EXPECT_EQ(json["srdf_found_beside_urdf"], true);
    const auto meshes = std::ranges::count_if(json["links"], [](const auto& link) {
      return std::ranges::any_of(link["collision"],
                                 [](const auto& shape) { return shape["kind"] == "mesh"; });
    });
    EXPECT_GE(meshes, 3) << robot;
    const auto arm = std::ranges::find_if(json["groups"],
                                          [](const auto& group) { return group["name"] == "arm"; });
    ASSERT_NE(arm, json["groups"].end());
    EXPECT_TRUE((*arm)["named_states"].contains("home"));
    EXPECT_TRUE((*arm)["named_states"].contains("ready"));
  }
}

TEST(Models, ProblemsPlanAndEverySegmentIsFree) {
  for (const auto& [robot, problems] : {std::pair{"rook7", "models/problems.json"},
                                        std::pair{"rook6", "models/problems_rook6.json"}}) {
    const std::string urdf = std::string("models/robots/") + robot + "/" + robot + ".urdf";
    const auto json = jsonOf(runSwept({"plan", urdf, "--group", "arm", "--problems", problems,
                                       "--json", "--quiet", "--time", "20"}));
    EXPECT_GE(json["problems"].size(), 10u);
    for (const auto& problem : json["problems"])
      EXPECT_EQ(problem["proven"], true) << robot << " " << problem["set"] << " "
                                         << problem["index"] << ": " << problem["failure"];
  }
}

TEST(Models, APandaFromOutsidePlans) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const std::string folder = data->string();
  const Outcome run =
      runSwept({"plan", folder + "/robots/panda/panda.urdf", "--group", "panda_arm", "--problems",
                folder + "/mbm/panda.json", "--set", "table_pick", "--index", "1", "--json"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(jsonOf(run)["proven"], true);
}

}  // namespace
}  // namespace swept::test
