// SPDX-License-Identifier: BSD-3-Clause
// `swept verify` of tasks. What is refused, and why: tests/robot_model/proofs/task_proof_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "robot_model/carried_box.hpp"

namespace swept {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class VerifyTask : public testing::Test, protected test::CarriedBox {
 protected:
  std::string written(std::vector<TaskPhase> phases) const {
    EXPECT_TRUE(writeTask(folder_.path("task.json"), phases).isWritten());
    return folder_.path("task.json");
  }
  static std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  test::TemporaryFolder folder_;
};

TEST_F(VerifyTask, SaysALineForEachPhaseAndThenOfTheWhole) {
  const test::Outcome run = test::runSwept({"verify", written(phases())});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  const std::vector<std::string> lines = linesOf(run.out);
  ASSERT_EQ(lines.size(), 8U) << run.out;
  EXPECT_THAT(lines[0], StartsWith("phase 1 (reach), 0 to 1.3 s, along: "));
  EXPECT_THAT(lines[1], StartsWith("phase 2 (lift), 1.3 to 2.30001 s, up: box attached to cube; "));
  EXPECT_THAT(lines[1], HasSubstr(" pairs of bodies, every pair keeps more than "));
  EXPECT_THAT(lines[1], HasSubstr("; not checked (attached to cube): cube - box"));
  EXPECT_THAT(lines[4], HasSubstr(", up: box placed, map sensed; "));
  EXPECT_THAT(lines[5], StartsWith("verified: task of 5 phases, "));
  EXPECT_EQ(lines[6],
            "each phase begins where the one before ends; what it says has changed, and nothing "
            "else, has");
  EXPECT_THAT(lines[7], StartsWith("every pair keeps more than "));
}

TEST_F(VerifyTask, SaysWhatMovesBesideAPhase) {
  std::vector<TaskPhase> all = phases();
  for (TaskPhase& phase : all) {
    phase.checker = std::make_shared<const Checker>(phase.checker->withObstacle(
        {.name = "cart",
         .parts = {{makeSphere(0.1), Eigen::Isometry3d::Identity()}},
         .waypoints = {{0.0, test::at(-1.0, 3.0, 0.5)}, {6.0, test::at(1.0, 3.0, 0.5)}}}));
    certify(phase);
  }
  const std::string file = written(all);
  const test::Outcome run = test::runSwept({"verify", file});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(linesOf(run.out)[0], HasSubstr("; beside what moves: cart"));
  const nlohmann::json json = test::jsonOf(test::runSwept({"verify", file, "--json"}));
  EXPECT_EQ(json["phases"][1]["moving"], nlohmann::json({"cart"}));
  EXPECT_EQ(json["phases"][1]["clock"][0], json["phases"][1]["begin"]);
}

TEST_F(VerifyTask, AsJson) {
  const nlohmann::json json = test::jsonOf(test::runSwept({"verify", written(phases()), "--json"}));
  EXPECT_EQ(json["verified"], true);
  EXPECT_TRUE(json["refusal"].is_null());
  ASSERT_EQ(json["phases"].size(), 5U);
  const nlohmann::json& lift = json["phases"][1];
  EXPECT_EQ(lift["phase"], "lift");
  EXPECT_EQ(lift["group"], "up");
  EXPECT_EQ(lift["begin"], json["phases"][0]["end"]);
  EXPECT_EQ(lift["changes"], nlohmann::json({"box attached to cube"}));
  EXPECT_EQ(lift["verified"], true);
  EXPECT_GT(lift["pairs"].get<int>(), 0);
}

TEST_F(VerifyTask, ThatDoesNotHold) {
  const std::string file = written(phases());
  std::string text = folder_.read("task.json");
  const std::string before = "\"change\":\"attached\"";
  text.replace(text.find(before), before.size(), "\"change\":\"placed\"");
  folder_.write("task.json", text);
  const std::string refusal =
      "phase 2 (lift), body box: it is carried by cube, and was in the world in phase 1; it is "
      "said to be placed";
  const test::Outcome run = test::runSwept({"verify", file});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.out, "refused: " + refusal + "\n");
  const nlohmann::json json = test::jsonOf(test::runSwept({"verify", file, "--json"}));
  EXPECT_EQ(json["verified"], false);
  EXPECT_EQ(json["refusal"], refusal);
  EXPECT_TRUE(json["phases"].empty());
}

TEST_F(VerifyTask, HasItsRobotAndWorlds) {
  const std::string file = written(phases());
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--robot", "a.urdf"},
                                             {"--scene", "a.yaml"},
                                             {"--files"},
                                             {"--html", folder_.path("page.html")}}) {
    std::vector<std::string> arguments{"verify", file};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const test::Outcome run = test::runSwept(arguments);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_THAT(run.err, HasSubstr(option[0] + ": '" + file +
                                   "' is a task, which has its robot and worlds in it"));
  }
}

}  // namespace
}  // namespace swept
