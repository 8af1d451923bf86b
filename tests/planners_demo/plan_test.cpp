// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <regex>
#include <sstream>
#include <utility>

#include "gantry.hpp"
#include "models_dir.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;

std::array<double, 2> stateOf(const nlohmann::json& json) {
  return {json[0], json[1]};
}

TEST(Plan, PrintsATable) {
  const Gantry gantry;
  const Outcome run = gantry.run("plan", {"left", "right"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  std::string normal =
      std::regex_replace(run.out, std::regex("[0-9]+(\\.[0-9]+)?(e-[0-9]+)?"), "N");
  normal = std::regex_replace(normal, std::regex(" +"), " ");
  EXPECT_THAT(normal,
              testing::StartsWith(
                  "planner planning time simplification path length segments motions certified "
                  "refused\n"
                  "CertifiedConnect N s N s N N N N\n"
                  "solved: N segments, all proven free\n"
                  "clearance N m, nearest cube - post (world); self: no pair to check\n"
                  "path of N states, m\n"));
}

/// The lines below the titles of the path.
std::vector<std::string> pathLines(const std::string& out) {
  std::istringstream lines(out.substr(out.find("\nstate ") + 1));
  std::vector<std::string> rows;
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(std::regex_replace(line, std::regex(" +"), " "), "state slide lift");
  while (std::getline(lines, line)) rows.push_back(line);
  EXPECT_EQ(rows.back(), "not kept: -o FILE.json writes it with its proof, .csv or .yaml without");
  rows.pop_back();
  return rows;
}

TEST(Plan, WithoutAFileThePathIsPrinted) {
  const Gantry gantry;
  const auto states = jsonOf(gantry.run("plan", {"left", "right", "--json"}))["states"];
  const std::vector<std::string> rows = pathLines(gantry.run("plan", {"left", "right"}).out);
  ASSERT_EQ(rows.size(), states.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::istringstream row(rows[i]);
    std::size_t number = 0;
    double slide = 0.0, lift = 0.0;
    row >> number >> slide >> lift;
    EXPECT_EQ(number, i + 1);
    EXPECT_NEAR(slide, states[i][0].get<double>(), 1e-5);
    EXPECT_NEAR(lift, states[i][1].get<double>(), 1e-5);
  }
  const std::string kept =
      gantry.run("plan", {"left", "right", "-o", gantry.folder().path("p.csv")}).out;
  EXPECT_THAT(kept, testing::Not(HasSubstr("path of")));
  const std::string unsolved = gantry.run("plan", {"left", "1,0"}).out;
  EXPECT_THAT(unsolved, testing::Not(HasSubstr("path of")));
}

TEST(Plan, OfALongPathTheEndsArePrinted) {
  const Gantry gantry;
  const std::vector<std::string> words{"left", "right", "--range", "0.04", "--no-simplify"};
  std::vector<std::string> asJson = words;
  asJson.emplace_back("--json");
  const std::size_t states = jsonOf(gantry.run("plan", asJson))["states"].size();
  ASSERT_GT(states, 25u);
  const std::string out = gantry.run("plan", words).out;
  EXPECT_THAT(out,
              HasSubstr("path of " + std::to_string(states) + " states, 20 of them shown, m\n"));
  const std::vector<std::string> rows = pathLines(out);
  ASSERT_EQ(rows.size(), 21u);
  const auto numberOf = [&](std::size_t row) { return std::stoul(rows[row]); };
  EXPECT_EQ(numberOf(9), 10u);
  EXPECT_THAT(rows[10], testing::EndsWith("..."));
  EXPECT_EQ(numberOf(11), states - 9);
  EXPECT_EQ(numberOf(20), states);
}

TEST(Plan, ThePathLeadsFromStartToGoalAndKeepsTheClearanceItClaims) {
  const Gantry gantry;
  const auto json = jsonOf(gantry.run("plan", {"left", "right", "--json"}));
  EXPECT_EQ(json["solved"], true);
  EXPECT_EQ(json["proven"], true);
  EXPECT_TRUE(json["failure"].is_null());
  EXPECT_GE(json["motions_certified"], 1);
  EXPECT_GE(json["motions_refused"], 1) << "the straight way is blocked";
  const auto& states = json["states"];
  ASSERT_GE(states.size(), 3u);
  EXPECT_EQ(stateOf(states.front()), (std::array<double, 2>{0, 0}));
  EXPECT_EQ(stateOf(states.back()), (std::array<double, 2>{2, 0}));
  double length = 0.0, least = INFINITY;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const auto from = stateOf(states[i - 1]), to = stateOf(states[i]);
    length += std::hypot(to[0] - from[0], to[1] - from[1]);
    least = std::min(least, Gantry::leastDistance(from, to));
  }
  EXPECT_NEAR(json["path_length"], length, 1e-9);
  EXPECT_GT(json["minimum_certified_clearance"], 0.0);
  EXPECT_LE(json["minimum_certified_clearance"], least);
  EXPECT_GE(json["minimum_certified_clearance"], least - 2e-4);
}

/// A base without limits: what it plans within holds both ends, wherever they are.
TEST(Plan, ABaseMayBeginAndEndFarAway) {
  const std::string urdf = modelsDir() + "/robots/drifter/drifter.urdf";
  const std::string far = "15,0,1,0,0,0,1", farther = "-40,3,1,0,0,0,1", home = "0,0,1,0,0,0,1";
  for (const auto& [start, goal] : {std::pair(far, farther), std::pair(home, far)}) {
    const Outcome run = runSwept({"plan", urdf, "--", start, goal});
    EXPECT_EQ(run.exitCode, 0) << run.out;
    EXPECT_THAT(run.out, HasSubstr("solved: ")) << start << " to " << goal;
  }
  const Outcome pose = runSwept({"plan", urdf, home, "--goal-pose", far});
  EXPECT_EQ(pose.exitCode, 0) << pose.out;
}

TEST(Plan, TakesStatesBehindADoubleDash) {
  const Gantry gantry;
  const Outcome run = gantry.run("plan", {"--", "-0.1,0.2", "right"});
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.exitCode, 0);
}

TEST(Plan, TheSeedDecides) {
  const Gantry gantry;
  const auto path = [&](const std::string& seed) {
    return jsonOf(gantry.run("plan", {"left", "right", "--json", "--seed", seed}))["states"];
  };
  EXPECT_EQ(path("5"), path("5"));
  EXPECT_NE(path("5"), path("6"));
}

TEST(Plan, AWallCannotBePassed) {
  const Gantry gantry;
  const Outcome run = gantry.run(
      "plan", {"--problems", gantry.problems, "--set", "blocked", "--index", "7", "--time", "0.2"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("\nnot solved: no path after 0."));
}

TEST(Plan, EndsMustBeFree) {
  const Gantry gantry;
  const Outcome collision = gantry.run("plan", {"inside", "right"});
  EXPECT_EQ(collision.exitCode, 1);
  EXPECT_THAT(
      collision.out,
      HasSubstr("not solved: start (inside) is in collision: cube - post (0.1 m deep, at ["));
  const Outcome goal = gantry.run("plan", {"left", "inside"});
  EXPECT_EQ(goal.exitCode, 1);
  EXPECT_THAT(goal.out, HasSubstr("not solved: goal (inside) is in collision"));
  const Outcome undecided = gantry.run("plan", {"left", "0.79999999999999,0"});
  EXPECT_EQ(undecided.exitCode, 2);
  EXPECT_THAT(undecided.out, HasSubstr("not solved: goal is undecided\n"));
}

TEST(Plan, WithoutSimplificationThePathStays) {
  const Gantry gantry;
  const auto raw = jsonOf(gantry.run("plan", {"left", "right", "--json", "--no-simplify"}));
  const auto simple = jsonOf(gantry.run("plan", {"left", "right", "--json"}));
  EXPECT_EQ(raw["simplification_time"], 0.0);
  EXPECT_EQ(raw["proven"], true);
  EXPECT_LE(simple["path_length"], raw["path_length"]);
}

class Planners : public testing::TestWithParam<std::string> {};

/// All that the help names; each either finds a proven path or says that it had no time.
TEST_P(Planners, RunWithoutHarm) {
  const Gantry gantry;
  const std::vector<std::string> words{"left", "right", "--planner", GetParam(), "--json"};
  // SST takes controls for granted and is slow without them.
  const bool mayFail = GetParam() == "SST";
  std::vector<std::string> briefly = words;
  briefly.insert(briefly.end(), {"--time", "0.2"});
  const Outcome run = mayFail ? gantry.run("plan", briefly) : gantry.plan(words);
  EXPECT_EQ(run.err, "");
  const auto json = jsonOf(run);
  EXPECT_EQ(json["planner"], GetParam());
  EXPECT_EQ(run.exitCode, json["solved"].get<bool>() ? 0 : 1);
  EXPECT_EQ(json["proven"], json["solved"]);
  if (!mayFail) {
    EXPECT_EQ(json["solved"], true) << json["failure"];
  }
}

std::vector<std::string> namesInTheHelp() {
  const std::string help = runSwept({"plan", "--help"}).out;
  std::istringstream list(help.substr(help.find("\nPlanners:\n") + 11));
  std::vector<std::string> names;
  for (std::string name; list >> name && name != "Example:";) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Ompl, Planners, testing::ValuesIn(namesInTheHelp()));

TEST(Plan, PlannerNamesAreFoundInAnyCase) {
  EXPECT_GE(namesInTheHelp().size(), 35u);
  const Gantry gantry;
  EXPECT_EQ(jsonOf(gantry.run("plan", {"left", "right", "--json", "--planner", "prm"}))["planner"],
            "PRM");
  const Outcome unknown = gantry.run("plan", {"left", "right", "--planner", "RRTConnect2"});
  EXPECT_EQ(unknown.exitCode, 3);
  EXPECT_THAT(unknown.err,
              testing::StartsWith("swept: error: no planner 'RRTConnect2'; there are ABITstar, "));
}

/// A cart that also turns: neither SE(2) nor a vector, of which alone OMPL has informed samples.
TEST(Plan, APlannerThatCannotUseTheSpaceIsBadInput) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write(
      "mixed.urdf",
      "<robot name='mixed'><link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='spin' type='continuous'><parent link='a'/><child link='b'/>"
      "<axis xyz='0 0 1'/></joint><joint name='push' type='prismatic'><parent link='b'/>"
      "<child link='c'/><axis xyz='1 0 0'/><limit lower='0' upper='1' effort='1' velocity='1'/>"
      "</joint></robot>");
  EXPECT_EQ(runSwept({"plan", urdf, "0,0", "1,1"}).exitCode, 0);
  for (const std::string planner : {"InformedRRTstar", "CForest"}) {
    const Outcome run = runSwept({"plan", urdf, "0,0", "1,1", "--planner", planner});
    EXPECT_EQ(run.exitCode, 3) << planner << ", signal " << run.signal;
    EXPECT_THAT(run.err, HasSubstr("swept: error: planner " + planner +
                                   " cannot plan in space 'all': OMPL's informed samples are of"));
  }
}

TEST(Plan, AFailedAssertionIsNoCoreDump) {
  const Gantry gantry;
  const Outcome run =
      runShell("swept plan '" + gantry.urdf + "' --group both --problems '" + gantry.problems +
               "' --set blocked --index 7 --time 20 & sleep 0.5; "
               "kill -ABRT $!; wait $!");
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "swept: error: stopped by a failed assertion\n");
}

TEST(Plan, MessagesOfOmplAreSilentUnlessAskedFor) {
  const Gantry gantry;
  EXPECT_EQ(gantry.run("plan", {"left", "right"}).err, "");
  const Outcome verbose = gantry.run("plan", {"left", "right", "--verbose", "--json"});
  EXPECT_THAT(verbose.err, HasSubstr("ompl: CertifiedConnect"));
  EXPECT_EQ(jsonOf(verbose)["solved"], true);
}

/// Short motions take more of them.
TEST(Plan, TheRangeIsTheLongestMotionThatIsTried) {
  const Gantry gantry;
  const auto tried = [&](const std::string& range) {
    const auto json = jsonOf(gantry.plan({"left", "right", "--range", range, "--json"}));
    EXPECT_EQ(json["proven"], true) << json["failure"];
    return json["motions_certified"].get<int>();
  };
  EXPECT_GT(tried("0.02"), 4 * tried("2"));
  const Outcome none = gantry.plan({"left", "right", "--planner", "FMT", "--range", "1"});
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_EQ(none.err, "swept: error: planner FMT has no range; --range is for others\n");
}

}  // namespace
}  // namespace swept::test
