// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

/// The numbers as they stand in the file, so that reading them back adds nothing.
using TextStates = std::vector<std::vector<std::string>>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TextStates statesOfCsv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "slide,lift");
  TextStates states;
  while (std::getline(lines, line)) states.push_back(split(line));
  return states;
}

TextStates statesOfJson(const nlohmann::json& json) {
  TextStates states;
  for (const auto& state : json["states"]) states.push_back({state[0].dump(), state[1].dump()});
  return states;
}

TextStates statesOfYaml(const std::string& text) {
  const YAML::Node trajectory = YAML::Load(text)["joint_trajectory"];
  EXPECT_EQ(trajectory["joint_names"].as<std::vector<std::string>>(),
            (std::vector<std::string>{"slide", "lift"}));
  TextStates states;
  for (const YAML::Node& point : trajectory["points"]) {
    EXPECT_EQ(point.size(), 1u) << "positions and nothing else: no invented time stamps";
    states.push_back(point["positions"].as<std::vector<std::string>>());
  }
  return states;
}

std::vector<std::vector<double>> numbers(const TextStates& states) {
  std::vector<std::vector<double>> result;
  for (const auto& state : states) result.push_back({std::stod(state[0]), std::stod(state[1])});
  return result;
}

/// `swept motion` over the states of a file.
Outcome recheck(const Gantry& gantry, const TextStates& states) {
  std::vector<std::string> arguments;
  for (const auto& state : states) arguments.push_back(state[0] + "," + state[1]);
  return gantry.run("motion", arguments);
}

TEST(PathFiles, SayWhatWasTyped) {
  const Gantry gantry;
  gantry.folder().write("far.xyz", "0 9 9\n");
  const std::vector<std::string> typed{"-0.25,0", "-.1,0.5"};
  const Outcome run = gantry.run(
      "plan", {typed[0], typed[1], "--cloud", gantry.folder().path("far.xyz"), "--point-radius",
               "0.01", "--cloud-pose", "-1,0,0,0,0,0,1", "-o", gantry.folder().path("path.json")});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto inputs = nlohmann::json::parse(gantry.folder().read("path.json"))["inputs"];
  EXPECT_EQ(inputs["states"], typed);
  EXPECT_EQ(inputs["cloud_pose"], "-1,0,0,0,0,0,1");
}

TEST(PathFiles, ThreeFormatsHoldTheSamePathAndItChecks) {
  const Gantry gantry;
  for (const std::string name : {"path.json", "path.csv", "path.yaml"}) {
    const Outcome run = gantry.run("plan", {"left", "right", "-o", gantry.folder().path(name)});
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_THAT(run.out, EndsWith("path written to " + gantry.folder().path(name) + "\n"));
  }
  const auto json = nlohmann::json::parse(gantry.folder().read("path.json"));
  const TextStates fromJson = statesOfJson(json);
  const TextStates fromCsv = statesOfCsv(gantry.folder().read("path.csv"));
  const TextStates fromYaml = statesOfYaml(gantry.folder().read("path.yaml"));
  ASSERT_GE(fromJson.size(), 3u);
  EXPECT_EQ(numbers(fromJson), numbers(fromCsv));
  EXPECT_EQ(numbers(fromJson), numbers(fromYaml));
  for (const TextStates& states : {fromJson, fromCsv, fromYaml})
    EXPECT_EQ(recheck(gantry, states).exitCode, 0);
  EXPECT_THAT(gantry.folder().names(),
              ElementsAre("gantry.srdf", "gantry.urdf", "path.csv", "path.json", "path.yaml",
                          "post.yaml", "problems.json"))
      << "no temporary file stays";
}

TEST(PathFiles, JsonHoldsTheCertificates) {
  const Gantry gantry;
  gantry.run("plan", {"left", "right", "-o", gantry.folder().path("path.json")});
  const auto json = nlohmann::json::parse(gantry.folder().read("path.json"));
  EXPECT_EQ(json["robot"], "gantry");
  EXPECT_EQ(json["group"], "both");
  EXPECT_EQ(json["joint_names"], (nlohmann::json{"slide", "lift"}));
  EXPECT_EQ(json["tolerance"], 1e-3);
  ASSERT_EQ(json["segments"].size() + 1, json["states"].size());
  for (std::size_t i = 0; i < json["segments"].size(); ++i) {
    const std::vector<double> from = json["states"][i], to = json["states"][i + 1];
    EXPECT_EQ(json["segments"][i]["verdict"], "free");
    EXPECT_GT(json["segments"][i]["clearance"], 0.0);
    EXPECT_LE(json["segments"][i]["clearance"], Gantry::leastDistance(from, to));
  }
}

TEST(PathFiles, AnOldFileIsReplacedOnSuccessAndKeptOnFailure) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("path.csv", "old\n");
  EXPECT_EQ(gantry.run("plan", {"left", "inside", "-o", file}).exitCode, 1);
  EXPECT_EQ(gantry.folder().read("path.csv"), "old\n");
  EXPECT_EQ(gantry.run("plan", {"left", "right", "-o", file}).exitCode, 0);
  EXPECT_EQ(statesOfCsv(gantry.folder().read("path.csv")).front(),
            (std::vector<std::string>{"0", "0"}));
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  const mode_t mask = umask(0);
  umask(mask);
  EXPECT_EQ(status.st_mode & 0777u, 0666u & ~mask) << "as any program's new file";
}

TEST(PathFiles, WhatCannotBeWrittenIsRefusedBeforePlanning) {
  const Gantry gantry;
  const auto refusal = [&](const std::string& file) {
    const Outcome run = gantry.run("plan", {"left", "right", "-o", file});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  const std::string folder = gantry.folder().path();
  EXPECT_EQ(refusal("path.txt"),
            "swept: error: 'path.txt': a path file ends in .json, .csv or .yaml\n");
  EXPECT_EQ(refusal("path"), "swept: error: 'path': a path file ends in .json, .csv or .yaml\n");
  EXPECT_EQ(refusal(folder + "missing/path.json"), "swept: error: cannot write '" + folder +
                                                       "missing/path.json': No such file or "
                                                       "directory\n");
  EXPECT_EQ(refusal(gantry.urdf + "/path.json"),
            "swept: error: cannot write '" + gantry.urdf + "/path.json': Not a directory\n");
  std::filesystem::create_directory(gantry.folder().path("folder.csv"));
  EXPECT_EQ(refusal(folder + "folder.csv"),
            "swept: error: cannot write '" + folder + "folder.csv': Is a directory\n");
}

TEST(PathFiles, AJointTrajectoryHoldsOneValuePerJointOnly) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write(
      "plane.urdf",
      "<robot name='plane'><link name='ground'/><link name='cart'/><joint name='drive' "
      "type='planar'><parent link='ground'/><child link='cart'/><axis xyz='0 0 1'/></joint>"
      "</robot>");
  const Outcome run = runSwept({"plan", urdf, "0,0,0", "1,1,1", "-o", folder.path("path.yaml")});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_THAT(run.err, testing::EndsWith(
                           "swept: error: '" + folder.path("path.yaml") +
                           "': a joint trajectory has one value per joint, and joint drive has "
                           "several; use .json or .csv\n"));
  EXPECT_EQ(runSwept({"plan", urdf, "0,0,0", "1,1,1", "-o", folder.path("path.csv")}).exitCode, 0);
}

}  // namespace
}  // namespace swept::test
