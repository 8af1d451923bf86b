// SPDX-License-Identifier: BSD-3-Clause
// Runs example 25 and looks at its file as someone else would: with `swept verify`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "data_folder.hpp"
#include "program.hpp"

namespace swept::test {
namespace {

using nlohmann::json;

class PickAndPlace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    run_ = new Outcome(runShell(std::string(SWEPT_EXAMPLE) + " models " + folder_->path()));
    ASSERT_EQ(run_->exitCode, 0) << run_->out << run_->err;
    task_ = new json(json::parse(folder_->read("pick_and_place.json")));
  }
  static void TearDownTestSuite() {
    delete task_;
    delete run_;
    delete folder_;
  }
  static json& bodyOf(json& phase, const char* name) {
    for (json& body : phase["path"]["model"]["bodies"])
      if (body["name"] == name) return body;
    throw std::runtime_error("no body " + std::string(name));
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline Outcome* run_ = nullptr;
  static inline json* task_ = nullptr;
};

TEST_F(PickAndPlace, IsVerified) {
  const json verified =
      jsonOf(runSwept({"verify", folder_->path("pick_and_place.json"), "--json"}));
  EXPECT_EQ(verified["verified"], true);
  const json& phases = verified["phases"];
  ASSERT_EQ(phases.size(), 26U);
  std::multiset<std::string> changes;
  std::set<std::string> groups, constrained;
  for (const json& phase : phases) {
    groups.insert(phase["group"].get<std::string>());
    for (const json& change : phase["changes"]) changes.insert(change.get<std::string>());
    if (phase.contains("constraints")) constrained.insert(phase["phase"].get<std::string>());
    EXPECT_GT(phase["clearance"].get<double>(), 0.0) << phase["phase"];
  }
  EXPECT_EQ(groups, (std::set<std::string>{"left/arm", "left/gripper", "right/arm"}));
  EXPECT_EQ(constrained, (std::set<std::string>{"carry block", "carry cup", "carry nut"}));
  const std::multiset<std::string> expected{"block attached to left/hand",
                                            "block placed",
                                            "cup attached to left/hand",
                                            "cup placed",
                                            "map sensed",
                                            "map sensed",
                                            "map sensed",
                                            "nut attached to left/hand",
                                            "nut placed"};
  EXPECT_EQ(changes, expected);
}

/// What may touch is said, and is no more than what grasping needs.
TEST_F(PickAndPlace, LeavesOutOnlyWhatHandsHoldAndTablesCarry) {
  const std::set<std::string> things{"cup", "nut", "block"};
  const std::set<std::string> fingers{"left/finger_left", "left/finger_right"};
  int grasps = 0, stands = 0;
  for (const json& phase : (*task_)["phases"]) {
    const std::string name = phase["phase"];
    for (const json& pair : phase["path"]["model"]["allowed"]) {
      const std::string a = pair[0], b = pair[1], reason = pair[2];
      if (!things.contains(a) && !things.contains(b)) {
        EXPECT_TRUE(reason.starts_with("SRDF: ")) << name << ": " << pair;
        continue;
      }
      if (a == "table" || b == "table") {
        EXPECT_THAT(name,
                    testing::AnyOf(testing::StartsWith("lift "), testing::StartsWith("lower ")));
        ++stands;
      } else if (reason == "allowed: held") {
        EXPECT_TRUE(fingers.contains(a) || fingers.contains(b)) << pair;
        EXPECT_THAT(name,
                    testing::AnyOf(testing::StartsWith("grasp "), testing::StartsWith("release ")));
        ++grasps;
      } else {
        EXPECT_TRUE(fingers.contains(a) || fingers.contains(b) || a == "left/hand" ||
                    b == "left/hand")
            << pair;
      }
    }
  }
  EXPECT_EQ(stands, 6);
  EXPECT_EQ(grasps, 12);
}

TEST_F(PickAndPlace, HasMeshesAndMaps) {
  std::set<std::string> maps;
  for (json& phase : (*task_)["phases"]) {
    const json& map = bodyOf(phase, "map");
    ASSERT_EQ(map["shapes"].size(), 1U);
    EXPECT_EQ(map["shapes"][0]["type"], "cloud");
    maps.insert(map["shapes"][0]["points"].get<std::string>());
    for (const char* thing : {"cup", "nut", "block"})
      EXPECT_EQ(bodyOf(phase, thing)["shapes"][0]["type"], "mesh");
  }
  EXPECT_EQ(maps.size(), 4U);
}

TEST_F(PickAndPlace, IsRefusedWithTheCupElsewhere) {
  json task = *task_;
  for (json& phase : task["phases"])
    if (phase["phase"] == "release cup") bodyOf(phase, "cup")["shapes"][0]["pose"][9] = 0.51;
  folder_->write("moved.json", task.dump());
  const Outcome run = runSwept({"verify", folder_->path("moved.json")});
  EXPECT_EQ(run.exitCode, 1);
}

TEST(PickAndPlaceOfAPr2, IsVerified) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "SWEPT_DATA is not set";
  const TemporaryFolder folder;
  const Outcome run = runShell(std::string(SWEPT_EXAMPLE) + " models " + folder.path() + " '" +
                               (*data / "robots/pr2").string() + "'");
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const json verified = jsonOf(runSwept({"verify", folder.path("pick_and_place.json"), "--json"}));
  EXPECT_EQ(verified["verified"], true) << verified["refusal"];
  EXPECT_EQ(verified["phases"].size(), 26U);
}

TEST_F(PickAndPlace, IsOnOnePage) {
  const std::string page = folder_->read("pick_and_place.html");
  EXPECT_THAT(page, testing::HasSubstr("\"headline\":\"26 phases: all free\""));
  EXPECT_THAT(page, testing::HasSubstr("\"label\":\"carry nut\""));
}

}  // namespace
}  // namespace swept::test
