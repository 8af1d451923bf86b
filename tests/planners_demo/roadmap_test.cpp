// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class RoadmapProgram : public testing::Test {
 protected:
  /// A ball that slides along x and y, beside posts.
  std::string scene(const std::string& name, double x, double y) const {
    return folder_.write(name, R"(world:
  collision_objects:
    - id: post
      primitives:
        - {type: box, dimensions: [0.1, 1.0, 1.0]}
      primitive_poses:
        - {position: [)" + std::to_string(x) +
                                   ", " + std::to_string(y) +
                                   R"(, 0], orientation: [0, 0, 0, 1]}
    - id: far
      primitives:
        - {type: sphere, dimensions: [0.1]}
      primitive_poses:
        - {position: [0.7, -0.7, 0], orientation: [0, 0, 0, 1]}
)");
  }
  Outcome roadmap(const std::string& kind, std::vector<std::string> options) const {
    options.insert(options.begin(), {"roadmap", kind, urdf_});
    return runSwept(options);
  }
  void SetUp() override {
    const Outcome built = roadmap("build", {"--scene", world_, "--states", "150", "--neighbours",
                                            "6", "-o", file_, "--json"});
    ASSERT_EQ(built.exitCode, 0) << built.err;
    built_ = jsonOf(built);
  }

  TemporaryFolder folder_;
  std::string urdf_ = folder_.write("gantry.urdf", R"(<?xml version="1.0"?>
<robot name="gantry">
  <link name="base"/><link name="beam"/>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="base"/><child link="beam"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="y" type="prismatic"><parent link="beam"/><child link="ball"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)");
  std::string world_ = scene("world.yaml", 0.0, 0.0);
  std::string moved_ = scene("moved.yaml", 0.3, 0.4);
  std::string file_ = folder_.path("roadmap.json");
  nlohmann::json built_;
};

TEST_F(RoadmapProgram, FindsPathsWithProofs) {
  EXPECT_EQ(built_["states"], 150);
  EXPECT_GT(built_["motions"], built_["free"]);
  EXPECT_EQ(built_["components"], 1);
  EXPECT_EQ(built_["roadmap_file"], file_);
  const std::string path = folder_.path("path.json");
  const Outcome found =
      roadmap("query", {"-0.8,0", "0.8,0", "--scene", world_, "--roadmap", file_, "-o", path});
  ASSERT_EQ(found.exitCode, 0) << found.err << found.out;
  EXPECT_THAT(found.out, HasSubstr("motions, proven free, found in "));
  EXPECT_THAT(found.out, HasSubstr("path written to " + path));
  EXPECT_EQ(runSwept({"verify", path}).exitCode, 0);
  EXPECT_EQ(runSwept({"certify", urdf_, path, "--scene", world_}).exitCode, 0);
  const nlohmann::json json = jsonOf(
      roadmap("query", {"-0.8,0", "0.8,0", "--scene", world_, "--roadmap", file_, "--json"}));
  EXPECT_EQ(json["found"], true);
  EXPECT_EQ(json["proven"], true);
  EXPECT_EQ(json["states"].front(), (std::vector<double>{-0.8, 0.0}));
  EXPECT_EQ(json["states"].back(), (std::vector<double>{0.8, 0.0}));
  EXPECT_GT(json["states"].size(), 2U);
  EXPECT_TRUE(json["path_file"].is_null());
  const Outcome inside =
      roadmap("query", {"-0.8,0", "0,0", "--scene", world_, "--roadmap", file_, "-o", path});
  EXPECT_EQ(inside.exitCode, 1);
  EXPECT_THAT(inside.out, HasSubstr("no path found: the goal is not free"));
}

TEST_F(RoadmapProgram, IsTakenToAnotherWorld) {
  const std::string updated = folder_.path("updated.json");
  const Outcome text = roadmap("update", {"--scene", moved_, "--roadmap", file_, "-o", updated});
  ASSERT_EQ(text.exitCode, 0) << text.err;
  EXPECT_THAT(text.out, StartsWith("bodies: 1 gone or changed, 1 new or changed\n"));
  EXPECT_THAT(text.out, HasSubstr(" looked at again, "));
  const nlohmann::json json =
      jsonOf(roadmap("update", {"--scene", moved_, "--roadmap", file_, "-o", updated, "--json"}));
  EXPECT_EQ(json["motions"], built_["motions"]);
  EXPECT_GT(json["freed"], 0);
  EXPECT_GT(json["blocked"], 0);
  EXPECT_LT(json["motions_asked"], json["motions"]);
  EXPECT_EQ(json["pairs_asked"].get<int>() + json["pairs_by_arithmetic"].get<int>(),
            json["motions"].get<int>());
  EXPECT_EQ(roadmap("query", {"-0.8,0", "0.8,0", "--scene", moved_, "--roadmap", updated}).exitCode,
            0);
  // And back: the verdicts are the first ones.
  const nlohmann::json back =
      jsonOf(roadmap("update", {"--scene", world_, "--roadmap", updated, "-o", updated, "--json"}));
  EXPECT_EQ(back["free"], built_["free"]);
}

TEST_F(RoadmapProgram, KeepsConstraints) {
  // Past the post, on a line beside it.
  const std::string high = folder_.path("high.json"), path = folder_.path("path.json");
  const std::vector<std::string> kept{"--stay-on", "ball:line:0,0.8,0,1,0,0:0.002"};
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), kept.begin(), kept.end());
    return options;
  };
  const nlohmann::json built = jsonOf(roadmap(
      "build",
      with({"--scene", world_, "--states", "60", "--neighbours", "6", "-o", high, "--json"})));
  EXPECT_EQ(built["states"], 60);
  EXPECT_EQ(built["components"], 1);
  const Outcome found = roadmap(
      "query", with({"-0.8,0.8", "0.8,0.8", "--scene", world_, "--roadmap", high, "-o", path}));
  ASSERT_EQ(found.exitCode, 0) << found.err << found.out;
  const Outcome verified = runSwept({"verify", path});
  EXPECT_EQ(verified.exitCode, 0) << verified.err << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("at every instant: "));
  // Off the line there is no path, and without the constraint it is another roadmap.
  EXPECT_EQ(roadmap("query", with({"-0.8,0.7", "0.8,0.8", "--scene", world_, "--roadmap", high}))
                .exitCode,
            1);
  const Outcome other =
      roadmap("query", {"-0.8,0.8", "0.8,0.8", "--scene", world_, "--roadmap", high});
  EXPECT_EQ(other.exitCode, 3);
  EXPECT_THAT(other.err, HasSubstr("constraints"));
  EXPECT_EQ(roadmap("update", with({"--scene", moved_, "--roadmap", high, "-o", high})).exitCode,
            0);
  // A roadmap has no first state.
  EXPECT_THAT(roadmap("build", {"--keep-level", "ball", "-o", high}).err,
              HasSubstr("--keep-level"));
}

TEST_F(RoadmapProgram, SaysWhatDiffers) {
  const std::string error = "swept: error: ";
  const auto refusal = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"-0.8,0", "0.8,0", "--roadmap", file_});
    const Outcome outcome = roadmap("query", options);
    EXPECT_EQ(outcome.exitCode, 3);
    return outcome.err;
  };
  EXPECT_EQ(refusal({"--scene", moved_}),
            file_ +
                ": error: the roadmap is of another world: body 'post' is not what it was; "
                "'swept roadmap update' takes it to this world\n");
  EXPECT_THAT(refusal({"--scene", world_, "--margin", "0.01"}),
              HasSubstr("the roadmap was made with other options: margins, "));
  const Outcome none = roadmap("build", {"--scene", world_});
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_THAT(none.err, HasSubstr("--output is required"));
  const Outcome one = roadmap("query", {"0,0", "--scene", world_, "--roadmap", file_});
  EXPECT_EQ(one.err, error + "roadmap query: two states are needed, start and goal\n");
  EXPECT_EQ(roadmap("build", {"--states", "0", "-o", file_}).exitCode, 3);
  EXPECT_EQ(runSwept({"roadmap"}).err,
            error +
                "roadmap: a subcommand is required; there are build, update, query (try "
                "--help)\n");
  const Outcome broken = roadmap(
      "query", {"-0.8,0", "0.8,0", "--roadmap", folder_.write("broken.json", "{\"states\": []}")});
  EXPECT_THAT(broken.err, HasSubstr("swept_roadmap is missing; roadmaps are made by"));
}

}  // namespace
}  // namespace swept::test
