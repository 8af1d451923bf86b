// SPDX-License-Identifier: BSD-3-Clause
// `swept view FILE.json`: files that hold robot and world with a proof, shown without any other
// file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "page_data.hpp"
#include "robot_model/carried_box.hpp"

namespace swept {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kRook = "models/robots/rook7/rook7.urdf";

class ViewProofs : public testing::Test, protected test::CarriedBox {
 protected:
  void SetUp() override {
    if (!test::programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  }
  std::string task() const {
    EXPECT_TRUE(writeTask(folder_.path("task.json"), phases()).isWritten());
    return folder_.path("task.json");
  }
  /// A path with its robot, and with a hand that stays level.
  std::string path() const {
    const test::Outcome run = test::runSwept(
        {"plan", kRook, "--group", "arm", "--scene", "models/scenes/shelf.yaml", "--seed", "1",
         "--margin", "0.001", "--embed", "-o", folder_.path("path.json"), "--",
         "0.23,0.53,0.12,1.44,0.35,-0.73,0.11", "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    return folder_.path("path.json");
  }
  json shown(const std::string& file) const {
    const test::Outcome run = test::runSwept({"view", file, "-o", folder_.path("page.html")});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("page written to "));
    return test::pageData(folder_.read("page.html"));
  }
  std::string refusal(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"view"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"-o", folder_.path("none.html")});
    const test::Outcome run = test::runSwept(all);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("none.html")));
    return run.err;
  }
  std::string changed(const std::string& name, const std::string& place,
                      const nlohmann::ordered_json& value) const {
    // Digests are of texts, whose order counts.
    auto file = nlohmann::ordered_json::parse(folder_.read(name));
    file[nlohmann::ordered_json::json_pointer(place)] = value;
    return folder_.write("changed.json", file.dump());
  }
  test::TemporaryFolder folder_;
};

/// The box is in the world, then in the hand, then in the world again.
TEST_F(ViewProofs, PlaysATaskOnOneClock) {
  const std::vector<TaskPhase> all = phases();
  const json data = shown(task());
  EXPECT_EQ(data["headline"], "5 phases: all free");
  EXPECT_EQ(data["tone"], "good");
  EXPECT_EQ(data["title"], "swept view, task.json");
  ASSERT_EQ(data["phases"].size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const json& phase = data["phases"][i];
    const json& own = phase["data"];
    EXPECT_EQ(phase["label"], all[i].name);
    EXPECT_EQ(phase["begin"], all[i].trajectory.points.front().time);
    EXPECT_EQ(phase["end"], endOf(all[i]));
    EXPECT_EQ(own["motions"][0]["from"], json(all[i].trajectory.points.front().positions));
    EXPECT_EQ(own["motions"][0]["verdict"], "free");
    std::string kind;
    for (const json& body : own["bodies"])
      if (body["name"] == "box") kind = body["kind"];
    EXPECT_EQ(kind, i == 0 || i == 4 ? "world" : "attached");
    // The cube is where the task has it, also in the phases whose group does not move it.
    const std::vector<float> poses = test::floats(own["frames"]["poses"]);
    const Eigen::Vector3d first = test::linkPose(own, 0, "cube").translation();
    const Checker& checker = *all[i].checker;
    const bool along = checker.group().name == "along";
    const double moved = all[i].trajectory.points.front().positions[0];
    const Eigen::VectorXd& still = *checker.options().reference;
    EXPECT_NEAR(first.x(), along ? moved : still[0], 1e-6);
    EXPECT_NEAR(first.z(), along ? still[1] : moved, 1e-6);
  }
  EXPECT_EQ(data["phases"][4]["changes"], json({"box placed", "map sensed"}));
  EXPECT_EQ(data["phases"][0]["data"]["facts"][0], json({"proof", "verified: task of 5 phases"}));
}

/// Meshes of a robot are as those of its own files.
TEST_F(ViewProofs, ShowsAPathAsItsFilesDo) {
  const std::string file = path();
  const json own = shown(file);
  const test::Outcome run = test::runSwept({"view", kRook, file, "-o", folder_.path("files.html")});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json files = test::pageData(folder_.read("files.html"));
  EXPECT_EQ(own["headline"], "path: free");
  EXPECT_THAT(own["facts"][0][1].get<std::string>(), HasSubstr("verified: every pair keeps more"));
  ASSERT_EQ(own["motions"].size(), files["motions"].size());
  double most = 0.0;
  for (std::size_t i = 0; i < own["motions"].size(); ++i) {
    EXPECT_EQ(own["motions"][i]["from"], files["motions"][i]["from"]);
    EXPECT_EQ(own["motions"][i]["verdict"], "free");
    const json& a = own["motions"][i]["pieces"]["lower"];
    const json& b = files["motions"][i]["pieces"]["lower"];
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_NEAR(a[k].get<double>(), b[k].get<double>(), 2e-4);
      most = std::max(most, a[k].get<double>());
    }
  }
  EXPECT_GT(most, 0.001);
  EXPECT_EQ(own["bodies"].size(), files["bodies"].size());
}

TEST_F(ViewProofs, NamesTheLineOfATool) {
  const std::string file = folder_.path("line.json");
  ASSERT_EQ(test::runSwept({"line", kRook, "ready", "--group", "arm", "--by", "0,0,-0.05",
                            "--keep-level", "hand:20", "--embed", "-o", file})
                .exitCode,
            0);
  const json data = shown(file);
  EXPECT_EQ(data["constraints"].size(), 1U);
  EXPECT_EQ(data["facts"][2][0], "at every instant");
  EXPECT_THAT(data["facts"][2][1].get<std::string>(),
              HasSubstr(" of link7 within 0.001 m of the line"));
  EXPECT_EQ(data["facts"][3][0], "robot");
}

TEST_F(ViewProofs, ShowsATrajectory) {
  const TaskPhase phase = phases().front();
  EXPECT_TRUE(writeTrajectoryProof(folder_.path("reach.json"), *phase.checker, phase.trajectory,
                                   phase.certificate)
                  .isWritten());
  const json data = shown(folder_.path("reach.json"));
  EXPECT_EQ(data["headline"], "trajectory: free");
  EXPECT_EQ(data["motions"][0]["label"], "reach.json");
  EXPECT_FALSE(data["motions"][0]["curve"].is_null());
}

TEST_F(ViewProofs, RefusesWhatDoesNotHold) {
  const std::string file = task();
  const std::string moved = changed("task.json", "/phases/1/changes/0/change", "placed");
  EXPECT_EQ(
      refusal({moved}),
      moved +
          ": error: its proof does not hold: phase 2 (lift), body box: it is carried by cube, and "
          "was in the world in phase 1; it is said to be placed\n");
  const std::string near =
      changed("task.json", "/phases/0/path/model/bodies/1/shapes/0/pose/9", -1.1);
  EXPECT_THAT(refusal({near}), HasSubstr(": its proof does not hold: phase 1 (reach)"));
  path();
  const std::string state = changed("path.json", "/states/0/0", 0.24);
  EXPECT_THAT(refusal({state}), HasSubstr(": its proof does not hold: state 1: is not as it was"));
}

TEST_F(ViewProofs, RefusesWhatTheFileSaysItself) {
  const std::string file = task();
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--scene", "a.yaml"},
                                             {"--margin", "0.5"},
                                             {"--group", "along"},
                                             {"--attach", "box:1,1,1@cube"}})
    EXPECT_THAT(refusal({file, option[0], option[1]}),
                HasSubstr(option[0] + ": '" + file + "' is shown with what it says"));
  EXPECT_THAT(refusal({file, "home"}),
              HasSubstr("home: '" + file + "' is shown with what it says"));
  const std::string none = folder_.write("none.json", "{\"states\": []}");
  EXPECT_THAT(refusal({none}), HasSubstr(none + ": error: there is no proof in it"));
  path();
  json bare = json::parse(folder_.read("path.json"));
  bare.erase("model");
  const std::string named = folder_.write("named.json", bare.dump());
  EXPECT_THAT(refusal({named}), HasSubstr("it does not hold its robot and world; swept view "
                                          "ROBOT.urdf " +
                                          named + " reads them"));
}

}  // namespace
}  // namespace swept
