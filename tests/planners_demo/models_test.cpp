// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "program.hpp"

/// The program on the robots and scenes of `models`.
namespace swept::test {
namespace {

using testing::HasSubstr;

const std::string kRook7 = "models/robots/rook7/rook7.urdf";

/// The line below `Example:` in a help text.
std::string exampleIn(const std::string& help) {
  const std::string title = "\nExample:\n  ";
  const auto begin = help.find(title);
  if (begin == std::string::npos) return {};
  const auto line = begin + title.size();
  return help.substr(line, help.find('\n', line) - line);
}

TEST(Models, TheExamplesOfTheHelpRun) {
  for (const std::string command : {"info", "check", "motion", "plan"}) {
    const Outcome help = runSwept({command, "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.err, "");
    std::string example = exampleIn(help.out);
    ASSERT_THAT(example, testing::StartsWith("swept " + command + " models/")) << help.out;
    // Not into the source tree.
    const TemporaryFolder folder;
    if (const auto file = example.find("path.json"); file != std::string::npos)
      example.replace(file, 9, folder.path("path.json"));
    const Outcome run = runShell(example);
    EXPECT_LE(run.exitCode, 1) << example << "\n" << run.err;
    EXPECT_GE(run.exitCode, 0) << example << "\nsignal " << run.signal;
    EXPECT_EQ(run.err, "") << example;
    EXPECT_NE(run.out, "") << example;
    if (command == "plan") {
      EXPECT_EQ(run.exitCode, 0) << run.out;
      const auto path = nlohmann::json::parse(folder.read("path.json"));
      EXPECT_EQ(path["robot"], "rook7");
      for (const auto& segment : path["segments"]) EXPECT_EQ(segment["verdict"], "free");
    }
  }
}

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
  const char* data = std::getenv("SWEPT_DATA");
  if (data == nullptr) GTEST_SKIP() << "SWEPT_DATA is not set";
  const std::string folder = data;
  const Outcome run =
      runSwept({"plan", folder + "/robots/panda/panda.urdf", "--group", "panda_arm", "--problems",
                folder + "/mbm/panda.json", "--set", "table_pick", "--index", "1", "--json"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(jsonOf(run)["proven"], true);
}

}  // namespace
}  // namespace swept::test
