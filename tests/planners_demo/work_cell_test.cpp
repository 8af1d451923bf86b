// SPDX-License-Identifier: BSD-3-Clause
// Several robots on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kCell = "models/cells/two_rooks.yaml";

TEST(WorkCellProgram, OneArmIsPlannedForWhileTheOtherStands) {
  const TemporaryFolder folder;
  const std::string path = folder.path("path.json");
  const std::vector<std::string> question{
      kCell, "home", "ready", "--group", "left/arm", "--stand", "right/arm=tucked", "--seed", "1"};
  std::vector<std::string> plan{"plan"};
  plan.insert(plan.end(), question.begin(), question.end());
  plan.insert(plan.end(), {"-o", path});
  const Outcome planned = runSwept(plan);
  ASSERT_EQ(planned.exitCode, 0) << planned.err;
  const Outcome verified = runSwept({"verify", path});
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;

  // Where the other one stands is part of the question: in its way, nothing is free.
  const Outcome clear = runSwept({"check", kCell, "0,1.3,0,0.3,0,0,0", "--group", "left/arm",
                                  "--stand", "right/arm=0,-1.3,0,0.3,0,0,0", "--json"});
  EXPECT_EQ(clear.exitCode, 0) << clear.out << clear.err;
  const Outcome inTheWay = runSwept({"check", kCell, "0,1.3,0,0.3,0,0,0", "--group", "left/arm",
                                     "--stand", "right/arm=0,1.3,0,0.3,0,0,0"});
  EXPECT_EQ(inTheWay.exitCode, 1);
  EXPECT_THAT(inTheWay.out, HasSubstr("right/"));
}

TEST(WorkCellProgram, BothArePlannedForAtOnce) {
  const Outcome both =
      runSwept({"plan", kCell, "home", "tucked", "--group", "both", "--seed", "1", "--json"});
  EXPECT_EQ(both.exitCode, 0) << both.err;
  const Outcome sum =
      runSwept({"motion", kCell, "0,0,0,0,0,0,0,0,0,0,0,0,0,0", "0.1,0,0,0,0,0,0,-0.1,0,0,0,0,0,0",
                "--group", "left/arm+right/arm"});
  EXPECT_EQ(sum.exitCode, 0) << sum.out << sum.err;
}

TEST(WorkCellProgram, TellsWhatIsInIt) {
  const Outcome info = runSwept({"info", kCell});
  EXPECT_EQ(info.exitCode, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("left/arm_with_gripper"));
  EXPECT_THAT(info.out, HasSubstr("both"));
  const Outcome words = runSwept({"completion", "words", "swept check " + kCell + " --group "});
  EXPECT_THAT(words.out, HasSubstr("right/arm"));
}

TEST(WorkCellProgram, TellsOfAStandThatDoesNothing) {
  const std::string text = "--stand 'right/arm=home': group 'right/arm' moves these joints itself";
  const auto said = [](const std::string& group) {
    return runSwept({"check", kCell, "home", "--group", group, "--stand", "right/arm=home"}).err;
  };
  EXPECT_THAT(said("right/arm"), HasSubstr("swept: warning: " + text + "\n"));
  EXPECT_THAT(said("left/arm"), Not(HasSubstr("--stand")));
}

TEST(WorkCellProgram, RefusesWhatIsAboutOneRobot) {
  const TemporaryFolder folder;
  const std::string place = "'" + kCell + "' is a work cell";
  EXPECT_THAT(runSwept({"check", kCell, "home", "--srdf", "a.srdf"}).err,
              HasSubstr("--srdf: " + place + ": it names the SRDF of each of its robots"));
  EXPECT_THAT(runSwept({"check", kCell, "home", "--xacro"}).err,
              HasSubstr("--xacro: " + place + ": it names URDFs, which xacro has made"));
  EXPECT_THAT(runSwept({"acm", kCell}).err, HasSubstr(place));
  EXPECT_THAT(runSwept({"check", kCell, "home", "--group", "left/arm+rihgt/arm"}).err,
              HasSubstr("has no group 'rihgt/arm'"));
  EXPECT_THAT(runSwept({"check", kCell, "home", "--group", "left/arm", "--stand", "right"}).err,
              HasSubstr("--stand 'right': must be GROUP=STATE"));
  EXPECT_THAT(runSwept({"check", kCell, "home", "--group", "left/arm", "--degrees", "--stand",
                        "right/arm=0,0,0,0,0,0,9"})
                  .err,
              HasSubstr("values are in rad and m; name a state, or leave out --degrees"));
  EXPECT_THAT(runSwept({"info", kCell, "--stand", "right/arm=home"}).err,
              HasSubstr("--stand needs --group"));
  EXPECT_THAT(
      runSwept({"check", kCell, "home", "--group", "left/arm", "--stand", "right/arm=up"}).err,
      HasSubstr("--stand 'right/arm=up': "));
  EXPECT_THAT(runSwept({"check", kCell, "home"}).err,
              HasSubstr("several groups; choose one with --group"));
  const std::string bad = folder.write("bad.yaml", "robots:\n  - {name: a, urdf: none.urdf}\n");
  const Outcome missing = runSwept({"check", bad, "home"});
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_THAT(missing.err, HasSubstr("none.urdf: error: "));
}

}  // namespace
}  // namespace swept::test
