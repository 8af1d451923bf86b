// SPDX-License-Identifier: BSD-3-Clause
// Queries that are not free are written as cases, and `swept replay` asks them again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "batch.hpp"
#include "gantry.hpp"

namespace swept::test {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::StartsWith;

class Dump : public testing::Test {
 protected:
  std::vector<std::string> files() const {
    std::vector<std::string> paths;
    if (!std::filesystem::exists(folder())) return paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
  }
  static json caseOf(const std::string& file) {
    std::ifstream stream(file);
    return json::parse(stream)["cases"].at(0);
  }
  std::string folder() const { return gantry_.folder().path("dumps"); }
  Outcome replay(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"replay"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    for (const std::string& file : files()) arguments.push_back(file);
    return runSwept(arguments);
  }
  /// The first file (which this one comes after), with one of its values changed.
  std::string changed(const std::string& pointer, const json& value) const {
    std::ifstream stream(files().at(0));
    json file = json::parse(stream);
    file["cases"][0][json::json_pointer(pointer)] = value;
    std::string path = folder() + "/other.json";
    std::ofstream(path) << file;
    return path;
  }

  Gantry gantry_;
};

TEST_F(Dump, StatesThatAreNotFreeAndNoOthers) {
  const Outcome run =
      gantry_.run("check", {"left", "inside", "1.1,0.05", "right", "--dump", folder()});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "swept: wrote 2 queries that are not free to '" + folder() +
                         "'; 'swept replay' asks them again\n");
  ASSERT_EQ(files().size(), 2u);
  std::vector<std::vector<double>> states;
  for (const std::string& file : files()) {
    EXPECT_THAT(std::filesystem::path(file).filename().string(),
                testing::MatchesRegex("state-[0-9a-f]{12}\\.json"));
    const json item = caseOf(file);
    EXPECT_EQ(item["query"], "state");
    EXPECT_EQ(item["inputs"]["robot"], "../gantry.urdf");
    EXPECT_EQ(item["inputs"]["scene"], "../post.yaml");
    EXPECT_EQ(item["inputs"]["srdf"], "../gantry.srdf");
    EXPECT_EQ(item["inputs"]["group"], "both");
    EXPECT_EQ(item["joint_names"], json({"slide", "lift"}));
    EXPECT_EQ(item["expected"], json({{"verdict", "collision"}}));
    states.push_back(item["state"]);
  }
  EXPECT_THAT(states, testing::UnorderedElementsAre(ElementsAre(1.0, 0.1), ElementsAre(1.1, 0.05)));
  const Outcome again = replay();
  EXPECT_EQ(again.exitCode, 0) << again.out;
  EXPECT_THAT(again.out, ContainsRegex("state 2 \\(inside\\) +state +collision +collision +- +ok"));
  EXPECT_THAT(again.out, EndsWith("2 passed, 0 failed, 0 skipped\n"));
}

TEST_F(Dump, TheSameQueryIsThereOnceAndAFreeOneNever) {
  const std::vector<std::string> inside{"inside", "--dump", folder()};
  EXPECT_THAT(gantry_.run("check", inside).err,
              StartsWith("swept: wrote 1 query that is not free"));
  gantry_.run("check", inside);
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EQ(gantry_.run("check", {"left", "--dump", folder()}).err, "");
  EXPECT_EQ(gantry_.run("check", {"inside", "-q", "--dump", folder()}).err, "");
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(Dump, MotionsWithTheTimesAroundTheirFirstContact) {
  ASSERT_EQ(gantry_.run("motion", {"left", "right", "--dump", folder()}).exitCode, 1);
  ASSERT_EQ(files().size(), 1u);
  const json item = caseOf(files()[0]);
  EXPECT_EQ(item["query"], "motion");
  EXPECT_EQ(item["from"], json({0.0, 0.0}));
  EXPECT_EQ(item["to"], json({2.0, 0.0}));
  const double contact = 0.8 / 2.0;
  const auto times = item["expected"]["first_contact"].get<std::vector<double>>();
  EXPECT_LE(times.at(0), contact);
  EXPECT_GE(times.at(1), contact);
  EXPECT_LT(times.at(1) - times.at(0), 2e-3);
  const json again = jsonOf(replay({"--json"}));
  EXPECT_EQ(again["passed"], 1);
  EXPECT_EQ(again["cases"][0]["answer"], "collision");
  EXPECT_LE(again["cases"][0]["lower"], contact);
  EXPECT_GE(again["cases"][0]["upper"], contact);
}

TEST_F(Dump, AnotherAnswerThanExpectedFails) {
  ASSERT_EQ(gantry_.run("motion", {"left", "right", "--dump", folder()}).exitCode, 1);
  const auto result = [&](const std::string& pointer, const json& value) {
    const Outcome run = runSwept({"replay", "--json", changed(pointer, value)});
    const json item = jsonOf(run)["cases"][0];
    EXPECT_EQ(run.exitCode, item["result"] == "ok" ? 0 : 1);
    return item["result"].get<std::string>() + " " + item["reason"].get<std::string>();
  };
  EXPECT_EQ(result("/expected/verdict", "free"), "failed wrong");
  EXPECT_EQ(result("/expected/verdict", "undecided"), "ok ");
  EXPECT_EQ(result("/to", {0.5, 0.0}), "failed wrong");
  EXPECT_EQ(result("/expected/first_contact", {0.0, 1.0}), "ok ");
  EXPECT_THAT(result("/expected/first_contact", {0.5, 0.6}),
              ContainsRegex("failed first contact between t = 0\\.39[0-9]* and 0\\.4"));
  EXPECT_THAT(result("/expected/first_contact", {0.1, 0.2}), StartsWith("failed first contact"));
  EXPECT_THAT(result("/inputs/robot", "../no.urdf"),
              ContainsRegex("failed threw: .*no\\.urdf: error: file not found"));
  EXPECT_EQ(result("/joint_names", {"lift", "slide"}),
            "failed threw: the values are of joints lift, slide; group 'both' has slide, lift");
  EXPECT_THAT(result("/from", {9.0, 0.0}), StartsWith("failed threw: its values: slide"));
}

TEST_F(Dump, WhatDecidesTheAnswerIsReplayed) {
  const std::vector<std::string> rules{"--pad", "cube=0.05", "--margin",
                                       "0.01",  "--attach",  "sphere:0.1@cube:0,0,0.3"};
  // Free without them: 0.05 m apart.
  EXPECT_EQ(gantry_.run("check", {"0.75,0"}).exitCode, 0);
  std::vector<std::string> arguments{"0.75,0", "--dump", folder()};
  arguments.insert(arguments.end(), rules.begin(), rules.end());
  ASSERT_EQ(gantry_.run("check", arguments).exitCode, 1);
  const json item = caseOf(files().at(0));
  EXPECT_EQ(item["inputs"]["pad"], json({"cube=0.05"}));
  EXPECT_EQ(item["inputs"]["attach"], json({"sphere:0.1@cube:0,0,0.3"}));
  EXPECT_EQ(replay().exitCode, 0);
  EXPECT_EQ(runSwept({"replay", changed("/inputs/pad", json::array())}).exitCode, 1);
}

TEST_F(Dump, TheFolderMayComeFromTheEnvironment) {
  const std::string swept =
      "swept check '" + gantry_.urdf + "' inside --group both --scene '" + gantry_.scene + "' ";
  runShell("SWEPT_DUMP_DIR='" + folder() + "' " + swept);
  EXPECT_EQ(files().size(), 1u);
  const std::string other = gantry_.folder().path("other");
  runShell("SWEPT_DUMP_DIR='" + other + "' " + swept + "--dump '" + folder() + "'");
  EXPECT_FALSE(std::filesystem::exists(other)) << "the option counts";
  EXPECT_EQ(runShell("SWEPT_DUMP_DIR= " + swept).err, "") << "empty: none";
  const std::string file = gantry_.folder().write("file", "");
  EXPECT_EQ(gantry_.run("check", {"inside", "--dump", file + "/dumps"}).err,
            "swept: error: cannot make the folder '" + file + "/dumps': Not a directory\n");
}

TEST_F(Dump, EndsThatPlanCannotUse) {
  const Outcome run = gantry_.run("plan", {"left", "inside", "--dump", folder()});
  EXPECT_EQ(run.exitCode, 1);
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(caseOf(files()[0])["state"], json({1.0, 0.1}));
  EXPECT_EQ(replay().exitCode, 0);
}

TEST_F(Dump, EndsOfManyProblems) {
  const Outcome run = gantry_.run("plan", {"--problems", gantry_.problems, "--set", "blocked",
                                           "--time", "0.2", "--dump", folder()});
  EXPECT_EQ(run.exitCode, 3) << "a problem has values outside the limits";
  ASSERT_EQ(files().size(), 1u) << "that of problem 8; 7 has no path";
  const json item = caseOf(files()[0]);
  EXPECT_EQ(item["inputs"]["problems"], "../problems.json");
  EXPECT_EQ(item["inputs"]["set"], "blocked");
  EXPECT_EQ(item["inputs"]["index"], 8);
  EXPECT_EQ(item["id"], "blocked 8, start");
  EXPECT_EQ(replay().exitCode, 0);
}

/// What a discrete check at a coarse step calls a path.
TEST_F(Dump, MissedCollisionsOfABatch) {
  const Outcome run = runSwept(
      rook7Batch({"--set", "shelf", "--validators", "discrete:0.2", "--runs", "3", "--no-simplify",
                  "-q", "-o", gantry_.folder().path("results"), "--dump", folder()}));
  ASSERT_EQ(run.exitCode, 0) << run.err;
  int missed = 0;
  for (const json& line : jsonLines(gantry_.folder().read("results")))
    if (line.contains("missed_collisions") && line["missed_collisions"].is_number())
      missed += line["missed_collisions"].get<int>();
  EXPECT_GT(missed, 0);
  EXPECT_EQ(files().size(), static_cast<std::size_t>(missed));
  const Outcome again = replay();
  EXPECT_EQ(again.exitCode, 0) << again.out;
  EXPECT_THAT(again.out, EndsWith(std::to_string(missed) + " passed, 0 failed, 0 skipped\n"));
}

struct BadCase {
  std::string pointer;
  json value;
  std::string message;
};

TEST_F(Dump, BadCasesAreNamed) {
  ASSERT_EQ(gantry_.run("motion", {"left", "right", "--dump", folder()}).exitCode, 1);
  const std::vector<BadCase> bad{
      {"/inputs", 3, "inputs is 3; it must be an object"},
      {"/inputs/robot", 3, "inputs.robot is 3; it must be text"},
      {"/inputs/robot", "", "inputs.robot is \"\"; it must be a URDF file"},
      {"/inputs/margin", -1, "inputs.margin is -1; it must be 0 or more"},
      {"/inputs/pad", "a", "inputs.pad must be a list"},
      {"/inputs/states", {1}, "inputs.states[0] is 1; it must be text"},
      {"/joint_names", "slide", "joint_names must be a list"},
      {"/from", {0.0}, "from holds 1 values; it must hold 2"},
      {"/to", {0.0, "up"}, "to[1] is \"up\"; it must be a finite number"},
      {"/expected/verdict", "safe",
       "expected.verdict is \"safe\"; it must be free, collision or undecided"},
      {"/expected/first_contact",
       {0.5, 0.4},
       "expected.first_contact is [0.5,0.4]; it must be two times between 0 and 1, the earlier one "
       "first"},
      {"/expected/first_contact", {0.5}, "expected.first_contact holds 1 values; it must hold 2"},
  };
  for (const BadCase& item : bad) {
    const std::string file = changed(item.pointer, item.value);
    const Outcome run = runSwept({"replay", file});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, file + ": error: case '" + caseOf(file)["id"].get<std::string>() +
                           "': " + item.message + "\n");
  }
}

}  // namespace
}  // namespace swept::test
