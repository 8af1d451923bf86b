// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gantry.hpp"
#include "page_data.hpp"

/// Rules of `info` are about pairs, and which pairs there are depends on the group.
namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

const Words kRules[] = {{"--pad", "garbage"},           {"--scale", "cube=2"},
                        {"--allow", "cube,post"},       {"--margin", "0.1"},
                        {"--attach", "box:1,1,1@cube"}, {"--explain", "cube,post"}};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(InfoRules, NeedAGroupWhereThereAreSeveral) {
  const Gantry gantry;
  for (const Words& rule : kRules) {
    const Outcome run = runSwept(with({"info", gantry.urdf, "--scene", gantry.scene}, rule));
    EXPECT_EQ(run.exitCode, 3) << run.out;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "swept: error: " + rule.front() +
                           " needs --group: which pairs are checked depends on what moves\n");
  }
}

TEST(InfoRules, AreForTheGroupWhereThereIsOne) {
  const Gantry gantry;
  // Without the SRDF all joints are one group.
  const Words info{"info", gantry.urdf, "--srdf", "none", "--scene", gantry.scene, "--json"};
  for (const Words& rule : {Words{}, {"--pad", "cube=0.05"}, {"--explain", "cube,post"}}) {
    const auto alone = jsonOf(runSwept(with(info, rule)));
    const auto named = jsonOf(runSwept(with(with(info, rule), {"--group", "all"})));
    ASSERT_TRUE(alone.contains("group"));
    EXPECT_EQ(alone["group"], named["group"]);
  }
  const auto padded = jsonOf(runSwept(with(info, {"--pad", "cube=0.05"})));
  EXPECT_EQ(padded["group"]["checked_pairs"][0]["margin"], 0.05);
  EXPECT_EQ(runSwept(with(info, {"--pad", "garbage"})).err,
            "swept: error: --pad 'garbage': expected NAME=NUMBER\n");
}

/// A rule of the library may be for bodies that come later. On a command line all of them are
/// known.
TEST(InfoRules, APatternThatNothingHasIsTold) {
  const Gantry gantry;
  const auto said = [&](const std::string& option, const std::string& value) {
    return runSwept({"check", gantry.urdf, "left", "--group", "both", "--scene", gantry.scene,
                     option, value})
        .err;
  };
  EXPECT_THAT(said("--pad", "cubbe*=0.01"),
              HasSubstr("swept: warning: a rule names 'cubbe*', which is the name of no link, "
                        "attached body or body of the world\n"));
  EXPECT_THAT(said("--allow", "*,cubbe*"), HasSubstr("a rule names 'cubbe*'"));
  EXPECT_THAT(said("--allow", "*,cub*"), Not(HasSubstr("a rule names")));
}

/// There is nothing to check then, and nothing wrong either.
TEST(InfoRules, ARobotThatCannotMoveHasNoPairs) {
  const TemporaryFolder folder;
  const std::string urdf =
      folder.write("one.urdf", "<robot name='one'><link name='base'/></robot>");
  const auto json = jsonOf(runSwept({"info", urdf, "--json"}));
  EXPECT_FALSE(json.contains("group"));
}

std::string refusalOf(const std::string& command, const std::string& option) {
  const Gantry gantry;
  const Outcome run = runSwept({command, gantry.urdf, option});
  EXPECT_EQ(run.exitCode, 3) << command;
  return run.err;
}

/// Verdicts and clearances of states are found without a tolerance; points near the robot are told
/// by a state, which `info` and `report` do not take.
TEST(InfoRules, OptionsOfNoAccountAreNotOffered) {
  const std::string begin = "swept: error: The following argument was not expected: ";
  std::vector<std::string> commands{"info", "check"};
  if (programHasPages()) commands.emplace_back("view");
  for (const std::string& command : commands)
    EXPECT_EQ(refusalOf(command, "--tolerance=0.01"), begin + "--tolerance=0.01 (try --help)\n");
  for (const std::string command : {"info", "report"})
    EXPECT_EQ(refusalOf(command, "--self-filter=0.01"),
              begin + "--self-filter=0.01 (try --help)\n");
}

}  // namespace
}  // namespace swept::test
