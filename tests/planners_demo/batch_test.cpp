// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "batch.hpp"
#include "gantry.hpp"
#include "models_dir.hpp"

namespace swept::test {
namespace {

using nlohmann::json;

const Words kShelf{"--set", "shelf", "--no-times", "-q"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// 3 problems, 2 planners, 2 validators, 2 seeds.
Words shelfBatch(const Words& more) {
  return rook7Batch(with(with(kShelf, {"--planners", "RRTConnect,BiEST", "--validators",
                                       "certified,discrete:0.05", "--runs", "2"}),
                         more));
}

TEST(Batch, ARunIsWhatPlanFinds) {
  const TemporaryFolder folder;
  ASSERT_EQ(runSwept(shelfBatch({"--states", "--limit", "2", "-o", folder.path("r")})).exitCode, 0);
  int compared = 0;
  for (const json& run : jsonLines(folder.read("r"))) {
    if (run.contains("format") || run["validator"] != "certified") continue;
    const json plan = jsonOf(runSwept({"plan", "models/robots/rook7/rook7.urdf", "--group", "arm",
                                       "--problems", "models/problems.json", "--set", run["set"],
                                       "--index", run["index"].dump(), "--planner", run["planner"],
                                       "--seed", run["seed"].dump(), "--time", "60", "--json"}));
    EXPECT_EQ(run["states"], plan["states"]);
    EXPECT_EQ(run["path_length"], plan["path_length"]);
    EXPECT_EQ(run["certified"], plan["proven"]);
    EXPECT_EQ(run["certified_clearance"], plan["minimum_certified_clearance"]);
    for (const std::string kind : {"world", "self"}) {
      EXPECT_EQ(run["certified_clearance_" + kind], plan["clearance_" + kind]) << kind;
      EXPECT_EQ(run["nearest_" + kind], plan["nearest_" + kind]) << kind;
    }
    EXPECT_EQ(run["motions_checked"],
              plan["motions_certified"].get<int>() + plan["motions_refused"].get<int>());
    EXPECT_EQ(run["segments"].get<std::size_t>() + 1, plan["states"].size());
    ++compared;
  }
  EXPECT_EQ(compared, 2 * 2 * 2);
}

TEST(Batch, ResultsDoNotDependOnJobsOrOrder) {
  const TemporaryFolder folder;
  ASSERT_EQ(runSwept(shelfBatch({"--no-clearance", "-o", folder.path("one")})).exitCode, 0);
  ASSERT_EQ(
      runSwept(shelfBatch({"--no-clearance", "-o", folder.path("two"), "--jobs", "2"})).exitCode,
      0);
  const std::vector<std::string> one = sortedLines(folder.read("one"));
  ASSERT_EQ(one.size(), 1u + 3 * 2 * 2 * 2);
  EXPECT_EQ(one, sortedLines(folder.read("two")));

  const Outcome list = runSwept(shelfBatch({"--list"}));
  std::vector<std::string> keys = sortedLines(list.out);
  ASSERT_EQ(keys.size(), 24u);
  EXPECT_EQ(list.out.substr(0, list.out.find('\n')),
            R"({"set":"shelf","index":1,"planner":"RRTConnect","validator":"certified",)"
            R"("run":1,"seed":1})");
  std::mt19937 random(9);
  std::ranges::shuffle(keys, random);
  std::string text;
  for (const std::string& key : keys) text += key + "\n";
  const std::string file = folder.write("keys", text);
  const Outcome shuffled = runShell(
      "swept bench planners models/robots/rook7/rook7.urdf --group arm --time 60 --problems "
      "models/problems.json --no-times --no-clearance --jobs 2 --stdin < '" +
      file + "'");
  EXPECT_EQ(shuffled.exitCode, 0) << shuffled.err;
  EXPECT_EQ(one, sortedLines(shuffled.out));
}

TEST(Batch, SeedsCountUpFromTheFirstAndGoOnAtOne) {
  std::vector<json> keys = jsonLines(
      runSwept(rook7Batch({"--set", "bin", "--runs", "3", "--seed", "4294967294", "--list"})).out);
  ASSERT_EQ(keys.size(), 6u);
  std::map<int, std::set<std::int64_t>> byRun;
  for (const json& key : keys) byRun[key["run"]].insert(key["seed"].get<std::int64_t>());
  EXPECT_EQ(byRun, (std::map<int, std::set<std::int64_t>>{
                       {1, {4294967294}}, {2, {4294967295}}, {3, {1}}}));
}

TEST(Batch, LimitTakesTheFirstProblemsAndNamesAreOnceEach) {
  const Outcome list =
      runSwept(rook7Batch({"--limit", "3", "--planners", "rrtconnect,prm,RRTConnect",
                           "--validators", "discrete:0.010,certified,discrete:1e-2", "--list"}));
  EXPECT_EQ(list.err, "");
  std::vector<std::string> seen;
  for (const json& key : jsonLines(list.out))
    seen.push_back(key["set"].get<std::string>() + key["index"].dump() + " " +
                   key["planner"].get<std::string>() + " " + key["validator"].get<std::string>());
  EXPECT_THAT(
      seen,
      testing::UnorderedElementsAre(
          "bin1 RRTConnect discrete:0.01", "bin1 RRTConnect certified", "bin1 PRM discrete:0.01",
          "bin1 PRM certified", "bin2 RRTConnect discrete:0.01", "bin2 RRTConnect certified",
          "bin2 PRM discrete:0.01", "bin2 PRM certified", "cage1 RRTConnect discrete:0.01",
          "cage1 RRTConnect certified", "cage1 PRM discrete:0.01", "cage1 PRM certified"));
}

TEST(Batch, WhatCannotBePlannedHasAReasonAndTheOthersArePlanned) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const Outcome run =
      runSwept({"bench", "planners", gantry.urdf, "--group", "both", "--problems", gantry.problems,
                "--time", "0.2", "--no-times", "-o", folder.path("r")});
  EXPECT_EQ(run.exitCode, 0);
  std::map<std::string, json> runs;
  for (const json& line : jsonLines(folder.read("r")))
    if (line.contains("set")) runs[line["set"].get<std::string>() + line["index"].dump()] = line;
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs["over1"]["certified"], true);
  EXPECT_EQ(runs["over2"]["certified"], true);
  EXPECT_EQ(runs["blocked7"]["failure"], "no path (Approximate solution)");
  EXPECT_EQ(runs["blocked7"]["states_checked"], nullptr)
      << "it would tell how fast this machine is";
  EXPECT_EQ(runs["blocked7"]["certified"], nullptr);
  EXPECT_THAT(runs["blocked8"]["failure"].get<std::string>(),
              testing::StartsWith("start is in collision: cube - post (0.2 m deep, at ["));
  EXPECT_THAT(runs["blocked9"]["failure"].get<std::string>(),
              testing::StartsWith("problem blocked 9, start: slide is 3, allowed is "));
  EXPECT_EQ(runs["foreign1"]["failure"],
            "problem foreign 1: its joints are lift,swing, those of group 'both' are slide,lift");
  EXPECT_THAT(run.out, testing::ContainsRegex("\ntotal +RRTConnect +certified +2/6 +2/2 +0/2 +0 "));
}

/// A wall of 2 mm that the 0.2 m cube can get over, and steps of 0.316 m (a tenth of the diagonal
/// of 3 m and 1 m): of the straight way, no sample is within the 0.202 m in which the cube touches
/// it.
const char* const kThinWall = R"({"wall": [{"index": 1, "world": {"box": [
  {"name": "wall", "position": [1, 0, 0], "orientation": [0, 0, 0, 1],
   "half_extents": [0.001, 1, 0.3]}]},
  "start": [0, 0], "goals": [[2, 0]], "joint_names": ["slide", "lift"]}]})";

/// By sampling a thousand times as densely, with the two boxes' distance along each axis.
bool hitsTheWall(const json& from, const json& to) {
  constexpr int kSteps = 10000;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double x = from[0].get<double>() + t * (to[0].get<double>() - from[0].get<double>());
    const double z = from[1].get<double>() + t * (to[1].get<double>() - from[1].get<double>());
    if (std::abs(x - 1.0) <= 0.101 && std::abs(z) <= 0.4) return true;
  }
  return false;
}

TEST(Batch, CoarseStepsMissAThinWallAndCertifiedNever) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string problems = folder.write("thin.json", kThinWall);
  ASSERT_EQ(runSwept({"bench", "planners", gantry.urdf, "--group", "both", "--problems", problems,
                      "--validators", "certified,discrete:0.1", "--runs", "10", "--states", "-o",
                      folder.path("r")})
                .exitCode,
            0);
  int missed = 0;
  for (const json& run : jsonLines(folder.read("r"))) {
    if (run.contains("format")) continue;
    ASSERT_EQ(run["solved"], true) << run;
    const json& states = run["states"];
    int hits = 0;
    for (std::size_t i = 0; i + 1 < states.size(); ++i)
      hits += hitsTheWall(states[i], states[i + 1]) ? 1 : 0;
    EXPECT_EQ(run["missed_collisions"].get<int>() + run["undecided"].get<int>(), hits) << run;
    if (run["validator"] == "certified") {
      EXPECT_EQ(hits, 0);
      EXPECT_EQ(run["certified"], true);
    } else {
      missed += run["missed_collisions"].get<int>() > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(missed, 5);
}

TEST(Batch, MissedCollisionsAreThoseOfMotion) {
  const TemporaryFolder folder;
  const Outcome batch =
      runSwept(rook7Batch({"--set", "shelf", "--validators", "discrete:0.05", "--limit", "2",
                           "--runs", "2", "--no-clearance", "--states", "-o", folder.path("r")}));
  ASSERT_EQ(batch.exitCode, 0) << batch.err;
  int missed = 0, free = 0;
  for (const json& run : jsonLines(folder.read("r"))) {
    if (run.contains("format")) continue;
    // `motion` takes no states with a problem; the problem of the file has the path's as its own.
    json problem = json::parse(std::ifstream(
        modelsDir() + "/problems.json"))["shelf"][run["index"].get<std::size_t>() - 1];
    std::map<std::string, int> verdicts;
    for (std::size_t i = 0; i + 1 < run["states"].size(); ++i) {
      problem["start"] = run["states"][i];
      problem["goals"] = json::array({run["states"][i + 1]});
      const std::string file = folder.write("one.json", json{{"shelf", {problem}}}.dump());
      const json motion = jsonOf(
          runSwept({"motion", "models/robots/rook7/rook7.urdf", "--group", "arm", "--problems",
                    file, "--set", "shelf", "--index", run["index"].dump(), "--json"}));
      ++verdicts[motion["segments"][0]["verdict"]];
    }
    EXPECT_EQ(run["missed_collisions"], verdicts["collision"]) << run;
    EXPECT_EQ(run["undecided"], verdicts["undecided"]) << run;
    EXPECT_EQ(run["certified"].get<bool>(), verdicts["collision"] + verdicts["undecided"] == 0);
    missed += verdicts["collision"];
    free += verdicts["free"];
  }
  EXPECT_GE(missed, 4);
  EXPECT_GE(free, 4);
}

}  // namespace
}  // namespace swept::test
