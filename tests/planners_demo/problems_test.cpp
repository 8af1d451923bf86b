// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Outcome onProblem(const Gantry& gantry, const std::string& command, const std::string& set,
                  const std::string& index, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"--problems", gantry.problems, "--set", set, "--index", index});
  return gantry.run(command, more);
}

TEST(Problems, ValuesAreTakenByName) {
  const Gantry gantry;
  // The file lists lift before slide.
  const auto json = jsonOf(onProblem(gantry, "check", "over", "1", {"--json"}));
  EXPECT_EQ(json["states"][0]["values"], (nlohmann::json{0.0, 0.0}));
  EXPECT_EQ(json["states"][1]["values"], (nlohmann::json{2.0, 0.0}));
  EXPECT_EQ(json["states"][1]["nearest"], (nlohmann::json{"cube", "post"}));
}

TEST(Problems, TheWorldIsTheProblems) {
  const Gantry gantry;
  const Outcome check = onProblem(gantry, "check", "blocked", "8");
  EXPECT_EQ(check.exitCode, 1);
  EXPECT_THAT(check.out, StartsWith("start: collision\n  cube - post: distance 0 m, at ["));
  EXPECT_THAT(check.out, HasSubstr("\ngoal: free, clearance 0.8 m, nearest cube - post (world)"));
  EXPECT_EQ(onProblem(gantry, "motion", "over", "1").exitCode, 1);
  EXPECT_EQ(onProblem(gantry, "plan", "over", "1").exitCode, 0);
}

TEST(Problems, GoalsAreAlternatives) {
  const Gantry gantry;
  const Outcome motion = onProblem(gantry, "motion", "over", "2");
  EXPECT_EQ(motion.exitCode, 1);
  EXPECT_THAT(motion.out, HasSubstr("start to goal 1: collision\n"));
  EXPECT_THAT(motion.out, HasSubstr("start to goal 2: collision\n"));
  const auto plan = jsonOf(onProblem(gantry, "plan", "over", "2", {"--json"}));
  EXPECT_EQ(plan["proven"], true);
  const auto end = plan["states"].back();
  EXPECT_TRUE(end == (nlohmann::json{0.0, 0.0}) || end == (nlohmann::json{0.5, 0.0})) << end;
}

TEST(Problems, UnknownOnesAreRefusedWithWhatThereIs) {
  const Gantry gantry;
  const Outcome set = onProblem(gantry, "check", "under", "1");
  EXPECT_EQ(set.exitCode, 3);
  EXPECT_THAT(set.err, StartsWith(gantry.problems + ": error: "));
  EXPECT_THAT(set.err, HasSubstr("over"));
  const Outcome index = onProblem(gantry, "check", "over", "5");
  EXPECT_EQ(index.exitCode, 3);
  EXPECT_THAT(index.err, StartsWith(gantry.problems + ": error: "));
  const Outcome whole = gantry.run("plan", {"--problems", gantry.problems, "--set", "under"});
  EXPECT_EQ(whole.exitCode, 3);
  EXPECT_THAT(whole.err, StartsWith(gantry.problems + ": error: "));
}

TEST(Problems, AWholeSetGivesATable) {
  const Gantry gantry;
  const Outcome run = gantry.run("plan", {"--problems", gantry.problems, "--set", "over"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  const std::string time = "[0-9.e-]+ s";
  EXPECT_TRUE(
      std::regex_match(run.out, std::regex("set +solved +all segments free +median +mean +p95\n"
                                           "over +2/2 +2/2 +" +
                                           time + " +" + time + " +" + time +
                                           "\n"
                                           "total +2/2 +2/2 +" +
                                           time + " +" + time + " +" + time + "\n")))
      << run.out;
}

TEST(Problems, AWholeFileNamesWhatWasNotSolvedAndWhy) {
  const Gantry gantry;
  const Outcome run =
      gantry.run("plan", {"--problems", gantry.problems, "--time", "0.1", "--jobs", "2"});
  EXPECT_EQ(run.exitCode, 3) << "a problem with values outside the limits is bad input";
  EXPECT_THAT(run.out, HasSubstr("blocked 7: no path after 0."));
  EXPECT_THAT(run.out,
              HasSubstr("blocked 8: start is in collision: cube - post (0.2 m deep, at ["));
  EXPECT_THAT(run.out, HasSubstr("blocked 9: problem blocked 9, start: slide is 3, allowed is"));
  EXPECT_THAT(run.out, HasSubstr("foreign 1: problem foreign 1: its joints are lift,swing"));
  EXPECT_TRUE(std::regex_search(run.out, std::regex("\nblocked +0/3 +0/0 ")));
  EXPECT_TRUE(std::regex_search(run.out, std::regex("\ntotal +2/6 +2/2 ")));

  const Outcome blocked = gantry.run(
      "plan", {"--problems", gantry.problems, "--set", "blocked", "--time", "0.1", "--json"});
  const auto json = jsonOf(blocked);
  ASSERT_EQ(json["problems"].size(), 3u);
  EXPECT_EQ(json["problems"][0]["index"], 7);
  EXPECT_EQ(json["problems"][0]["solved"], false);
  EXPECT_EQ(json["sets"].back()["set"], "total");
  EXPECT_EQ(json["sets"].back()["solved"], 0);
}

TEST(Problems, OneProblemOfASetPlansAsItDoesAlone) {
  const Gantry gantry;
  const auto set =
      jsonOf(gantry.run("plan", {"--problems", gantry.problems, "--set", "over", "--json"}));
  const auto alone = jsonOf(onProblem(gantry, "plan", "over", "2", {"--json"}));
  EXPECT_EQ(set["problems"][1]["index"], 2);
  EXPECT_EQ(set["problems"][1]["path_length"], alone["path_length"]);
  EXPECT_EQ(set["problems"][1]["motions_certified"], alone["motions_certified"]);
}

}  // namespace
}  // namespace swept::test
