// SPDX-License-Identifier: BSD-3-Clause
// Rules given once for the worlds of many problems. One that named a body of one world was gone
// when a world without that body had come between, and motions through a padded body were free; and
// unless the first world had the body, the rule was refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using Words = std::vector<std::string>;

/// Problems 1 and 3 have a post, whose top the cube passes 0.05 m above; problem 2 has a ball there
/// in its place.
constexpr const char* kProblems = R"({"over": [
  {"index": 1, "world": {"box": [{"name": "post", "position": [1, 0, 0], "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 0.1]}]},
   "start": [0.25, 0.9], "goals": [[0.25, 1.1]], "joint_names": ["lift", "slide"]},
  {"index": 2, "world": {"sphere": [{"name": "ball", "position": [1, 0, 0], "radius": 0.1}]},
   "start": [0.25, 0.9], "goals": [[0.25, 1.1]], "joint_names": ["lift", "slide"]},
  {"index": 3, "world": {"box": [{"name": "post", "position": [1, 0, 0], "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 0.1]}]},
   "start": [0.25, 0.9], "goals": [[0.25, 1.1]], "joint_names": ["lift", "slide"]}]}
)";

constexpr const char* kEdges =
    "set,index,from0,from1,to0,to1,length\n"
    "over,1,0.25,0,0.25,2,2\nover,2,0.25,0,0.25,2,2\nover,3,0.25,0,0.25,2,2\n";

/// In the worlds of all three problems.
class ProblemRules : public testing::Test {
 protected:
  Outcome run(Words words, const Words& rules) const {
    words.insert(words.end(), {gantry_.urdf, "--group", "both", "--problems", problems_});
    words.insert(words.end(), rules.begin(), rules.end());
    return runSwept(words);
  }
  nlohmann::json edges(Words rules) const {
    rules.insert(rules.end(), {"--edges", edges_, "--json", "--passes", "1"});
    return jsonOf(run({"bench", "edges"}, rules));
  }
  /// Of the runs, those without a path.
  int unsolved(Words rules) const {
    rules.insert(rules.end(), {"--time", "20", "-q", "--json"});
    const auto json = jsonOf(run({"plan"}, rules));
    int count = 0;
    for (const auto& problem : json["problems"]) count += problem["solved"].get<bool>() ? 0 : 1;
    return count;
  }

  Gantry gantry_;
  std::string problems_ = gantry_.folder().write("three.json", kProblems);
  std::string edges_ = gantry_.folder().write("edges.csv", kEdges);
};

TEST_F(ProblemRules, PadEveryBodyOfTheirName) {
  EXPECT_EQ(edges({})["free"], 3);
  EXPECT_EQ(edges({"--pad", "post=0.1"})["collision"], 2);
  EXPECT_EQ(edges({"--pad", "ball=0.1"})["collision"], 1);
  EXPECT_EQ(edges({"--pad", "*=0.1"})["collision"], 3);
  EXPECT_EQ(unsolved({}), 0);
  EXPECT_EQ(unsolved({"--pad", "post=0.1"}), 2);
  EXPECT_EQ(unsolved({"--pad", "ball=0.1"}), 1);
}

TEST_F(ProblemRules, ScaleAndAllowEveryBodyOfTheirName) {
  EXPECT_EQ(edges({"--scale", "post=2"})["collision"], 2);
  EXPECT_EQ(edges({"--pad", "*=0.1", "--allow", "cube,post"})["free"], 2);
}

TEST_F(ProblemRules, TheOneThatNamesTheBodyCountsAndOfEqualsTheLast) {
  EXPECT_EQ(edges({"--pad", "post=0.1", "--pad", "*=0"})["collision"], 2);
  EXPECT_EQ(edges({"--pad", "*=0", "--pad", "post=0.1"})["collision"], 2);
  EXPECT_EQ(edges({"--pad", "post=0.1", "--pad", "post=0"})["collision"], 0);
}

TEST_F(ProblemRules, HoldInBatchesAndReports) {
  const Outcome batch =
      run({"bench", "planners"}, {"--pad", "post=0.1", "--time", "20", "-q", "--json"});
  EXPECT_EQ(batch.exitCode, 0) << batch.err;
  EXPECT_EQ(jsonOf(batch)["rows"][0]["solved"], 1) << batch.out;
  const Words few{"--motions", "6", "--passes", "1", "-q", "--json"};
  Words padded = few;
  padded.insert(padded.end(), {"--pad", "post=0.1"});
  EXPECT_EQ(run({"report"}, padded).exitCode, 0) << run({"report"}, padded).err;
  EXPECT_EQ(gantry_.run("report", {"--motions", "2", "--passes", "1", "-q", "--pad", "post=0.1"})
                .exitCode,
            0);
}

TEST_F(ProblemRules, NameSomebody) {
  const std::string error =
      "swept: error: a rule names 'pole', which is no link, attached body or body of the world of "
      "any chosen problem\n";
  const Words pole{"--pad", "pole=0.1"};
  EXPECT_EQ(run({"plan"}, pole).err, error);
  EXPECT_EQ(run({"report"}, {"--allow", "cube,pole"}).err, error);
  EXPECT_EQ(run({"bench", "planners"}, pole).err, error);
  EXPECT_EQ(run({"bench", "edges"}, {"--edges", edges_, "--scale", "pole=2"}).err, error);
  // The first problem alone has no ball.
  EXPECT_EQ(run({"plan"}, {"--set", "over", "--index", "1", "--pad", "ball=0.1"}).err,
            "swept: error: Checker: a rule names 'ball', which is no link, attached body or body "
            "of the world\n");
}

TEST_F(ProblemRules, AreAskedAgainWithADumpedQuery) {
  const std::string folder = gantry_.folder().path("dumps");
  run({"plan"}, {"--pad", "post=0.1", "--pad", "ball=0.1", "--time", "1", "-q", "--dump", folder});
  Words replay{"replay"};
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    replay.push_back(entry.path().string());
  EXPECT_THAT(runSwept(replay).out, EndsWith("6 passed, 0 failed, 0 skipped\n"));
}

}  // namespace
}  // namespace swept::test
