// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A board of 1 m by 0.2 m by 0.1 m about (2, 0, 0), a tetrahedron and a can.
class CoverScenes : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string scene_ = folder_.write("room.yaml", R"(name: room
world:
  collision_objects:
    - id: board
      header: {frame_id: world}
      pose: {position: [2, 0, 0], orientation: [0, 0, 0, 1]}
      primitives: [{type: box, dimensions: [1, 0.2, 0.1]}]
      primitive_poses: [{position: [0, 0, 0], orientation: [0, 0, 0, 1]}]
      operation: add
    - id: "the wedge"
      header: {frame_id: world}
      meshes:
        - vertices: [[0, 0, 0], [0.4, 0, 0], [0, 0.3, 0], [0.1, 0.1, 0.5]]
          triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
      mesh_poses: [{position: [0, 1, 0], orientation: [0, 0, 0.6, 0.8]}]
      operation: add
    - id: can
      header: {frame_id: world}
      primitives: [{type: cylinder, dimensions: [0.3, 0.05]}]
      primitive_poses: [{position: [0, -1, 0.2], orientation: [0, 0, 0, 1]}]
      operation: add
)");

  nlohmann::json judged(const std::string& file, int exitCode = 0) const {
    const Outcome run = runSwept({"cover", scene_, "--check", file, "--json"});
    EXPECT_EQ(run.exitCode, exitCode) << file << run.out << run.err;
    return jsonOf(run)["bodies"];
  }
  std::string error(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"cover", scene_};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome run = runSwept(all);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    return run.err;
  }
};

TEST_F(CoverScenes, WritesEachFormatAndFindsItContained) {
  const std::map<std::string, std::vector<std::string>> endings{
      {"sphere", {".json", ".yaml", ".scene"}},
      {"capsule", {".json", ".scene"}},
      {"box", {".json", ".yaml"}},
      {"convex", {".json", ".yaml"}}};
  for (const auto& [shape, ofShape] : endings) {
    nlohmann::json first;
    for (const std::string& ending : ofShape) {
      const std::string out = folder_.path("out_" + shape + ending);
      const Outcome run =
          runSwept({"cover", scene_, "--spheres", "8", "--shape", shape, "-o", out, "--json"});
      ASSERT_EQ(run.exitCode, 0) << run.err;
      const nlohmann::json json = jsonOf(run);
      EXPECT_EQ(json["scene"], "room");
      const nlohmann::json bodies = json["bodies"];
      ASSERT_EQ(bodies.size(), 3u);
      EXPECT_EQ(bodies[1]["body"], "the wedge");
      std::size_t count = 0;
      for (const nlohmann::json& body : bodies) {
        count += body["spheres"].get<std::size_t>();
        EXPECT_LE(body["outside_upper"], 0.0) << shape << body;
        EXPECT_GE(body["volume_ratio"], 1.0);
      }
      EXPECT_LE(count, 8u);
      if (first.is_null()) first = bodies;
      EXPECT_EQ(bodies, first);
      const nlohmann::json again = judged(out);
      ASSERT_EQ(again.size(), 3u);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(again[i]["spheres"], first[i]["spheres"]) << out;
        EXPECT_LE(again[i]["outside_upper"], 0.0) << out;
      }
    }
    const Outcome shown =
        runSwept({"verify", folder_.path("out_" + shape + ".json"), "--scene", scene_});
    EXPECT_EQ(shown.exitCode, 0) << shape << shown.out << shown.err;
    EXPECT_THAT(shown.out, HasSubstr("verified: 3 bodies contained in "));
  }
  // Whatever reads a scene reads the model.
  const Outcome info = runSwept({"info", "models/robots/rook6/rook6.urdf", "--scene",
                                 folder_.path("out_convex.yaml"), "--json"});
  EXPECT_EQ(info.exitCode, 0) << info.err;
  EXPECT_THAT(info.err, Not(HasSubstr("open")));
}

/// By hand: the board's far corners are sqrt(0.25 + 0.01 + 0.0025) from its middle.
TEST_F(CoverScenes, SaysWhatOthersLeaveOutside) {
  const std::string file =
      folder_.write("other.json", R"({"bodies": [{"body": "board", "spheres": [[2, 0, 0, 0.4]]},
        {"body": "can", "shapes": [{"type": "cylinder", "radius": 0.051, "length": 0.302,
                                    "pose": [0, -1, 0.2, 0, 0, 0, 1]}]}]})");
  const nlohmann::json bodies = judged(file, 1);
  const double outside = std::sqrt(0.25 + 0.0125) - 0.4;
  EXPECT_NEAR(bodies[0]["outside_lower"], outside, 1e-6);
  EXPECT_GE(bodies[0]["outside_upper"], outside);
  EXPECT_NEAR(bodies[0]["outside_upper"], outside, 2e-5);
  EXPECT_EQ(bodies[1]["spheres"], 0);
  EXPECT_LE(bodies[2]["outside_upper"], 0.0);
  const Outcome text = runSwept({"cover", scene_, "--check", file});
  EXPECT_THAT(text.out, HasSubstr("no inflation encloses bodies without shapes"));
  const Outcome refused = runSwept({"verify", file, "--scene", scene_});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.out,
              HasSubstr("refused: body 'board': it is not shown to be contained at ["));
}

TEST_F(CoverScenes, KeepsWhatMoves) {
  const std::string scene = folder_.write("belt.yaml", R"(world:
  collision_objects:
    - id: crate
      header: {frame_id: world}
      primitives: [{type: box, dimensions: [0.2, 0.2, 0.3]}]
      primitive_poses: [{position: [0, 0, 0.15], orientation: [0, 0, 0, 1]}]
      motion:
        - {time: 0, position: [0, 0, 0]}
        - {time: 2.5, position: [1, 0, 0], orientation: [0, 0, 0.6, 0.8]}
)");
  const std::string out = folder_.path("belt_model.yaml");
  ASSERT_EQ(runSwept({"cover", scene, "--spheres", "4", "-o", out}).exitCode, 0);
  EXPECT_THAT(folder_.read("belt_model.yaml"), HasSubstr("- time: 2.5\n"));
  EXPECT_EQ(runSwept({"cover", scene, "--check", out}).exitCode, 0);
  const auto refused = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"cover", scene};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome run = runSwept(all);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    return run.err;
  };
  EXPECT_THAT(refused({"--spheres", "4", "-o", folder_.path("belt.scene")}),
              HasSubstr("object 'crate' moves, which MoveIt's text cannot say; write .yaml"));
  std::string other = folder_.read("belt_model.yaml");
  other.replace(other.find("time: 2.5"), 9, "time: 2.6");
  EXPECT_THAT(refused({"--check", folder_.write("later.yaml", other)}),
              HasSubstr("object 'crate' has another motion than in the scene"));
  other.resize(other.find("      motion:"));
  EXPECT_THAT(refused({"--check", folder_.write("still.yaml", other)}),
              HasSubstr("object 'crate' moves in one of the two scenes alone"));
}

TEST_F(CoverScenes, SaysWhatIsWrongWithItsInput) {
  EXPECT_THAT(error({"--spheres", "2"}), HasSubstr("2 spheres are too few for 3 bodies"));
  EXPECT_THAT(error({"--spheres", "2", "--shape", "box"}),
              HasSubstr("2 shapes are too few for 3 bodies"));
  EXPECT_THAT(error({"--spheres", "5", "-o", folder_.path("a.urdf")}),
              HasSubstr("ends in '.urdf'; allowed for a scene: .yaml, .yml, .scene, .json, or any "
                        "with --format"));
  for (const std::string format : {"urdf", "vamp", "curobo", "xrdf", "srdf"})
    EXPECT_THAT(error({"--spheres", "5", "--format", format, "-o", folder_.path("a.json")}),
                HasSubstr("the format " + format + " is for a robot; '" + scene_ +
                          "' is a scene, which goes to scene or json"));
  EXPECT_THAT(error({"--spheres", "5", "--visual"}),
              HasSubstr("--visual is for a robot; '" + scene_ + "' is a scene"));
  EXPECT_THAT(error({"--spheres", "5", "--srdf", "a.srdf"}),
              HasSubstr("--srdf is for a robot; '" + scene_ + "' is a scene"));
  const auto read = [&](const std::string& name, const std::string& text) {
    return error({"--check", folder_.write(name, text)});
  };
  EXPECT_THAT(read("a.json", R"({"bodies": [{"body": "bord", "spheres": []}]})"),
              HasSubstr("bodies[0].body is 'bord', which is no body of the scene; did you mean "
                        "'board'?"));
  EXPECT_THAT(read("b.json", R"({"bodies": [{"body": "can", "spheres": []},
                                           {"body": "can", "spheres": []}]})"),
              HasSubstr("bodies[1].body is 'can' a second time"));
  EXPECT_THAT(read("c.json", R"({"links": []})"), HasSubstr("bodies"));
  EXPECT_THAT(read("a.scene",
                   "room\n* jar\n0 0 0\n0 0 0 1\n1\nsphere\n1\n0 0 0\n0 0 0 1\n"
                   "0 0 0 0\n0\n.\n"),
              HasSubstr("it has object 'jar', which is no body of the scene"));
  const std::string floor =
      folder_.write("floor.scene",
                    "floor\n* floor\n0 0 0\n0 0 0 1\n1\nplane\n0 0 1 0\n0 0 0\n0 0 0 1\n"
                    "0 0 0 0\n0\n.\n");
  const Outcome plane = runSwept({"cover", floor, "--spheres", "5"});
  EXPECT_EQ(plane.exitCode, 3);
  EXPECT_THAT(plane.err,
              HasSubstr("body 'floor' has a plane or a half-space, which no shapes contain"));
  // Of a robot, and of a scene.
  const std::string model = folder_.write("m.json", R"({"bodies": []})");
  EXPECT_THAT(runSwept({"verify", model}).err, HasSubstr("say of which scene: --scene SCENE.yaml"));
  EXPECT_THAT(runSwept({"verify", model, "--scene", scene_, "--robot", "a.urdf"}).err,
              HasSubstr("--robot is for the model of a robot"));
  const std::string links = folder_.write("l.json", R"({"links": []})");
  EXPECT_THAT(runSwept({"verify", links, "--robot", "a.urdf", "--scene", scene_}).err,
              HasSubstr("--scene is for the model of a scene"));
  EXPECT_THAT(runSwept({"verify", model, "--scene", scene_}).out,
              HasSubstr("refused: body 'board': the model has nothing for it"));
}

TEST_F(CoverScenes, VerifiesTheModelOfAMesh) {
  const std::string mesh = folder_.write(
      "wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string out = folder_.path("mesh.json");
  ASSERT_EQ(runSwept({"cover", mesh, "--spheres", "5", "-o", out}).exitCode, 0);
  EXPECT_THAT(runSwept({"verify", out, "--robot", mesh}).out,
              HasSubstr("verified: 1 link contained in "));
}

}  // namespace
}  // namespace swept::test
