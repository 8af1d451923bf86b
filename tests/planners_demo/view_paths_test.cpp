// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "page_data.hpp"

/// `view` of path files: of one robot in one world, as the files say, or not at all.
namespace swept::test {
namespace {

using nlohmann::json;

const std::string kRook = "models/robots/rook7/rook7.urdf";
const std::string kShelf = "models/scenes/shelf.yaml";
const std::string kFrom = "0.23,0.53,0.12,1.44,0.35,-0.73,0.11";
const std::string kTo = "-0.32,0.78,0.2,1.9,0.01,-0.77,-0.14";

class ViewPaths : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    if (!programHasPages()) return;
    plan("one.json", kFrom, kTo, kShelf, {"--seed", "1"});
    plan("two.json", kFrom, kTo, kShelf, {"--seed", "2"});
    plan("slot.json", "home", "0.1,-0.5,0,1.2,0,0.8,0", "models/scenes/narrow_slot.yaml", {});
    plan("padded.json", kFrom, kTo, kShelf, {"--pad", "hand=0.001"});
  }
  static void TearDownTestSuite() { folder.reset(); }
  void SetUp() override {
    if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  }

  static void plan(const std::string& name, const std::string& from, const std::string& to,
                   const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> command{"plan",    kRook, "--group", "arm",
                                     "--scene", scene, "-o",      folder->path(name)};
    command.insert(command.end(), more.begin(), more.end());
    command.insert(command.end(), {"--", from, to});
    const Outcome run = runSwept(command);
    ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  }
  static Outcome view(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"view", kRook, "-o", folder->path("p.html")});
    return runSwept(arguments);
  }
  /// What is refused leaves no page.
  static std::string refusalOf(const std::vector<std::string>& arguments) {
    std::filesystem::remove(folder->path("p.html"));
    const Outcome run = view(arguments);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder->path("p.html")));
    return run.err;
  }
  static std::string path(const std::string& name) { return folder->path(name); }
  /// A path file with something else in one place.
  static std::string changed(const std::string& name, const json::json_pointer& place,
                             const json& value) {
    json data = json::parse(folder->read("one.json"));
    data[place] = value;
    return folder->write(name, data.dump());
  }

  static inline std::unique_ptr<TemporaryFolder> folder;
};

TEST_F(ViewPaths, ShowsEachAsItsFileHasIt) {
  const Outcome run = view({path("one.json"), path("two.json")});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  const json data = pageData(folder->read("p.html"));
  EXPECT_EQ(data["headline"], "2 paths: all free");
  EXPECT_EQ(data["tone"], "good");
  ASSERT_EQ(data["paths"].size(), 2u);
  EXPECT_EQ(data["paths"][1]["label"], "two.json");
  std::size_t motion = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    const json file = json::parse(folder->read(p == 0 ? "one.json" : "two.json"));
    for (std::size_t i = 0; i + 1 < file["states"].size(); ++i, ++motion) {
      EXPECT_EQ(data["motions"][motion]["path"], p);
      EXPECT_EQ(data["motions"][motion]["from"], file["states"][i]);
      EXPECT_EQ(data["motions"][motion]["to"], file["states"][i + 1]);
      EXPECT_EQ(data["motions"][motion]["verdict"], "free");
    }
  }
  EXPECT_EQ(motion, data["motions"].size());
  // The world that the files name, without an option that says so.
  EXPECT_GT(std::ranges::count_if(data["bodies"],
                                  [](const json& body) { return body["kind"] == "world"; }),
            10);
}

TEST_F(ViewPaths, OnePathIsNoneOfSeveral) {
  EXPECT_EQ(view({path("one.json"), "--scene", kShelf}).exitCode, 0);
  EXPECT_EQ(pageData(folder->read("p.html"))["headline"], "path: free");
}

TEST_F(ViewPaths, RefusesOthersThanOfOneWorld) {
  EXPECT_EQ(refusalOf({path("one.json"), path("slot.json")}),
            path("slot.json") + ": error: not for the same robot, world and rules as '" +
                path("one.json") + "': bodies differ\n");
  EXPECT_THAT(refusalOf({path("one.json"), path("padded.json")}),
              testing::HasSubstr("padded.json: error: not for the same robot, world and rules"));
}

/// A path in an empty world would be free more often than it is.
TEST_F(ViewPaths, RefusesAnotherSceneThanTheOneOfThePath) {
  EXPECT_THAT(
      refusalOf({path("one.json"), "--scene", "models/scenes/narrow_slot.yaml"}),
      testing::StartsWith(path("one.json") +
                          ": error: not the robot and world that it was planned for: body "));
  const Outcome run = runSwept({"view", "tests/planners_demo/planar_arm.urdf", path("one.json"),
                                "-o", folder->path("p.html")});
  EXPECT_EQ(run.exitCode, 3) << run.out;
}

TEST_F(ViewPaths, RefusesRulesThatTheFilesHave) {
  const std::vector<std::vector<std::string>> options{
      {"--pad", "hand=0.1"},   {"--allow", "hand,board_1"}, {"--margin", "0.01"},
      {"--group", "arm"},      {"--joints", "joint1"},      {"--chain", "link0,link7"},
      {"--scale", "hand=0.5"}, {"--srdf", "none"}};
  for (const std::vector<std::string>& option : options)
    EXPECT_EQ(refusalOf({path("one.json"), option[0], option[1]}),
              "swept: error: " + option[0] +
                  ": a path is shown with what its file says; only --scene may be another file of "
                  "the same scene\n");
}

TEST_F(ViewPaths, RefusesWhatIsNoPath) {
  EXPECT_EQ(refusalOf({path("one.json"), "home"}),
            "swept: error: paths and states: a page shows either files of paths or states\n");
  EXPECT_EQ(refusalOf({"path.csv"}),
            "swept: error: 'path.csv': a path that is shown is a .json file of swept plan\n");
  EXPECT_EQ(refusalOf({path("absent.json")}), path("absent.json") + ": error: file not found\n");
  EXPECT_EQ(refusalOf({folder->write("list.json", "[1, 2]")}),
            path("list.json") +
                ": error: no path of swept plan: it does not say which files it is for\n");
}

TEST_F(ViewPaths, RefusesStatesThatAreNone) {
  const json::json_pointer third("/states/2"), value("/states/1/0");
  EXPECT_EQ(refusalOf({changed("short.json", third, {1.0, 2.0})}),
            path("short.json") + ": error: states[2] holds 2 values; it must hold 7\n");
  EXPECT_EQ(refusalOf({changed("text.json", value, "much")}),
            path("text.json") + ": error: states[1][0] is \"much\"; it must be a finite number\n");
  EXPECT_EQ(refusalOf({changed("far.json", value, 7.5)}),
            path("far.json") +
                ": error: states[1] holds a value outside its limits: joint1 is "
                "7.5, allowed is -2.9 to 2.9 rad\n");
  EXPECT_EQ(refusalOf({changed("none.json", json::json_pointer("/states"), json::array())}),
            path("none.json") + ": error: states must hold one or more\n");
}

/// Certified anew: a file's own verdicts are not what is shown.
TEST_F(ViewPaths, JudgesWhatIsInTheFile) {
  const std::string file = changed(
      "through.json", json::json_pointer("/states"),
      {{0.23, 0.53, 0.12, 1.44, 0.35, -0.73, 0.11}, {0.9, 1.3, 0.12, 0.6, 0.35, 0.0, 0.11}});
  EXPECT_EQ(view({file, path("two.json")}).exitCode, 0);
  const json data = pageData(folder->read("p.html"));
  EXPECT_EQ(data["headline"], "2 paths: 1 free, 1 in collision");
  EXPECT_EQ(data["paths"][0]["tone"], "bad");
  EXPECT_EQ(data["tone"], "bad");
}

}  // namespace
}  // namespace swept::test
