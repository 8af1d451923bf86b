// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <string>
#include <vector>

#include "page_data.hpp"
#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A slab of 1 m by 0.2 m by 0.1 m, and a ball that turns on it.
class CoverProgram : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string urdf_ = folder_.write("arm.urdf", R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="slab">
    <visual><geometry><box size="0.1 0.1 0.1"/></geometry><material name="red"><color rgba="1 0 0 1"/></material></visual>
    <collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.2 0.1"/></geometry></collision>
  </link>
  <link name="frame"/>
  <link name="ball"><collision><origin xyz="0 0 0.3"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="slab"/><child link="frame"/><axis xyz="0 0 1"/></joint>
  <joint name="on" type="fixed"><parent link="frame"/><child link="ball"/></joint>
</robot>
)");

  std::string curobo(const std::string& slab) const {
    return folder_.write("spheres.yaml", "collision_spheres:\n  slab:\n" + slab +
                                             "  ball:\n    - center: [0, 0, 0.3]\n      radius: "
                                             "0.0501\n");
  }
  Outcome check(const std::string& file) const {
    return runSwept({"cover", urdf_, "--check", file, "--json"});
  }
};

TEST_F(CoverProgram, WritesEachFormatAndFindsItContained) {
  const std::string srdf = folder_.write(
      "arm.srdf",
      "<robot name=\"arm\"><group name=\"all\"><joint name=\"turn\"/></group>"
      "<link_sphere_approximation link=\"slab\"><sphere center=\"9 9 9\" radius=\"1\"/>"
      "</link_sphere_approximation></robot>\n");
  nlohmann::json first;
  for (const std::string ending : {".json", ".urdf", ".yaml", ".srdf"}) {
    const std::string out = folder_.path("out" + ending);
    const Outcome run = runSwept({"cover", urdf_, "--spheres", "7", "-o", out, "--json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const nlohmann::json links = jsonOf(run)["links"];
    ASSERT_EQ(links.size(), 2u);
    EXPECT_EQ(links[1]["spheres"], 1);
    EXPECT_LT(links[1]["largest_excess"], 1e-4);
    EXPECT_LT(links[0]["largest_excess"], 0.1);
    EXPECT_GT(links[0]["volume_ratio"], 1.0);
    if (first.is_null()) first = links;
    EXPECT_EQ(links, first);
    const Outcome judged = check(out);
    EXPECT_EQ(judged.exitCode, 0) << judged.out << judged.err;
    EXPECT_EQ(jsonOf(judged)["links"], first) << ending;
  }
  EXPECT_THAT(folder_.read("out.srdf"), HasSubstr("<group name=\"all\">"));
  EXPECT_THAT(folder_.read("out.srdf"), Not(HasSubstr("9 9 9")));
  EXPECT_THAT(folder_.read("out.urdf"), HasSubstr("<visual>"));
  EXPECT_THAT(folder_.read("out.urdf"), HasSubstr("type=\"continuous\""));
}

TEST_F(CoverProgram, TakesAsManySpheresAsAnExcessNeeds) {
  std::size_t before = 0;
  for (const std::string excess : {"0.15", "0.08", "0.04"}) {
    const Outcome run = runSwept({"cover", urdf_, "--excess", excess, "--json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const nlohmann::json slab = jsonOf(run)["links"][0];
    EXPECT_LE(slab["largest_excess"], std::stod(excess));
    EXPECT_GT(slab["spheres"].get<std::size_t>(), before);
    before = slab["spheres"];
  }
}

/// Its far corners are sqrt(0.0125) from its axis.
TEST_F(CoverProgram, SaysWhatOthersLeaveOutside) {
  const Outcome run =
      check(curobo("    - {center: [0.5, 0, 0], radius: 0.4}\n"
                   "    - {center: [5, 5, 5], radius: -10}\n"));
  EXPECT_EQ(run.exitCode, 1);
  const nlohmann::json slab = jsonOf(run)["links"][0];
  const double outside = std::sqrt(0.25 + 0.0125) - 0.4;
  EXPECT_EQ(slab["spheres"], 1);
  EXPECT_NEAR(slab["outside_lower"], outside, 1e-6);
  EXPECT_GE(slab["outside_upper"], outside);
  EXPECT_NEAR(slab["outside_upper"], outside, 2e-5);
  EXPECT_GT(slab["surface_share_outside"], 0.05);
  EXPECT_NEAR(std::abs(slab["farthest_point"][0].get<double>() - 0.5), 0.5, 1e-6);
  // With just that much more it is contained.
  const double grown = 0.4 + slab["outside_upper"].get<double>();
  EXPECT_EQ(check(curobo("    - center: [0.5, 0, 0]\n      radius: " +
                         std::to_string(grown + 1e-5) + "\n"))
                .exitCode,
            0);
  const Outcome text = runSwept({"cover", urdf_, "--check", folder_.path("spheres.yaml")});
  EXPECT_THAT(text.out, HasSubstr("the spheres contain all links: proven"));
}

TEST_F(CoverProgram, FindsALinkWithoutSpheresOutside) {
  const std::string file = folder_.write(
      "half.json", R"({"links": [{"link": "ball", "spheres": [[0, 0, 0.3, 0.06]]}]})");
  const Outcome run = runSwept({"cover", urdf_, "--check", file});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, HasSubstr("all of it"));
  EXPECT_THAT(run.out, HasSubstr("no inflation encloses links without spheres"));
}

TEST_F(CoverProgram, CoversVisualGeometryAndMeshes) {
  const Outcome visual = runSwept({"cover", urdf_, "--spheres", "1", "--visual", "--json"});
  ASSERT_EQ(visual.exitCode, 0) << visual.err;
  ASSERT_EQ(jsonOf(visual)["links"].size(), 1u);
  const std::string mesh = folder_.write(
      "wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Outcome wedge = runSwept({"cover", mesh, "--spheres", "3", "--json"});
  ASSERT_EQ(wedge.exitCode, 0) << wedge.err;
  EXPECT_EQ(jsonOf(wedge)["links"][0]["link"], "wedge");
  EXPECT_LE(jsonOf(wedge)["links"][0]["spheres"], 3);
}

TEST_F(CoverProgram, SaysWhatIsWrongWithItsInput) {
  const auto error = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"cover", urdf_};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome run = runSwept(all);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    return run.err;
  };
  const auto read = [&](const std::string& name, const std::string& text) {
    return error({"--check", folder_.write(name, text)});
  };
  EXPECT_THAT(error({}), HasSubstr("needs --spheres N, --excess M or --check FILE"));
  EXPECT_THAT(error({"--spheres", "1"}),
              HasSubstr("1 spheres are too few for robot 'arm': 2 links have collision geometry"));
  EXPECT_THAT(
      error({"--spheres", "5", "-o", folder_.path("a.txt")}),
      HasSubstr("ends in '.txt'; allowed: .urdf, .yaml, .yml (cuRobo), .xrdf, .srdf, .json, or "
                "any with --format"));
  EXPECT_THAT(read("a.txt", ""),
              HasSubstr("allowed: .json, .yaml, .yml (cuRobo), .xrdf, .srdf, .urdf"));
  EXPECT_THAT(read("a.yaml", "collision_spheres:\n  slap: []\n"),
              HasSubstr("a.yaml:2: error: collision_spheres has 'slap', which is no link of robot "
                        "'arm'; did you mean 'slab'?"));
  EXPECT_THAT(read("b.yaml", "collision_spheres: spheres.yml\n"), HasSubstr("give that file"));
  EXPECT_THAT(read("c.yaml", "collision_spheres:\n  slab:\n    - center: [0, 0]\n"),
              HasSubstr("c.yaml:3: error: "));
  EXPECT_THAT(read("a.json", R"({"links": [{"link": "slab", "spheres": [[0, 0, 0, -1]]}]})"),
              HasSubstr("links[0].spheres[0][3] is -1"));
  EXPECT_THAT(read("a.srdf", "<robot name=\"arm\"/>"),
              HasSubstr("has no <link_sphere_approximation>"));
  EXPECT_THAT(read("b.srdf",
                   "<robot name=\"arm\">\n<link_sphere_approximation link=\"slab\">\n"
                   "<sphere center=\"0 0 0\"/></link_sphere_approximation></robot>"),
              HasSubstr("b.srdf:3: error: "));
  EXPECT_THAT(read("a.xrdf", "format: urdf\n"), HasSubstr("a.xrdf:1: error: format must be xrdf"));
  EXPECT_THAT(
      read("b.xrdf", "format: xrdf\ncollision:\n  geometry: some\ngeometry:\n  other: {}\n"),
      HasSubstr("b.xrdf:3: error: collision.geometry is 'some', which geometry lacks"));
  EXPECT_THAT(read("c.xrdf",
                   "format: xrdf\ncollision: {geometry: g}\ngeometry:\n  g:\n    spheres:\n"
                   "      slab:\n        - center: [0, 0, 0]\n"),
              HasSubstr("c.xrdf:7: error: "));
  EXPECT_THAT(read("v.json", R"({"name": "arm", "urdf": "none.urdf"})"), HasSubstr("none.urdf"));
  const auto shape = [&](const std::string& text) {
    return read("s.json", R"({"links": [{"link": "slab", "shapes": [)" + text + "]}]}");
  };
  EXPECT_THAT(shape(R"({"type": "cone"})"),
              HasSubstr("links[0].shapes[0].type is \"cone\"; it must be sphere, box, cylinder, "
                        "capsule or convex"));
  EXPECT_THAT(shape(R"({"type": "sphere", "radius": -1})"),
              HasSubstr("links[0].shapes[0].radius is -1"));
  EXPECT_THAT(shape(R"({"type": "convex", "vertices": []})"), HasSubstr("vertices is empty"));
  EXPECT_THAT(shape(R"({"type": "sphere", "radius": 1, "pose": [0, 0, 0, 0, 0, 0, 2]})"),
              HasSubstr("links[0].shapes[0].pose has a quaternion that is no rotation"));
  EXPECT_THAT(error({"--spheres", "5", "--format", "json"}), HasSubstr("--format needs -o FILE"));
  EXPECT_THAT(error({"--spheres", "5", "--shape", "box", "-o", folder_.path("a.yaml")}),
              HasSubstr("the format curobo has spheres alone; --shape box goes to urdf or json"));
  EXPECT_THAT(error({"--spheres", "1", "--shape", "box"}),
              HasSubstr("1 shapes are too few for robot 'arm': 2 links have collision geometry"));
}

TEST_F(CoverProgram, WritesOtherShapesAndFindsThemContained) {
  for (const std::string shape : {"capsule", "box", "convex"})
    for (const std::string ending : {".json", ".urdf"}) {
      const std::string out = folder_.path(shape + ending);
      const Outcome run =
          runSwept({"cover", urdf_, "--spheres", "4", "--shape", shape, "-o", out, "--json"});
      ASSERT_EQ(run.exitCode, 0) << run.err;
      const nlohmann::json links = jsonOf(run)["links"];
      ASSERT_EQ(links.size(), 2u);
      EXPECT_GE(links[0]["spheres"], 1);
      EXPECT_LE(links[0]["outside_lower"], 0.0);
      if (shape != "capsule") {
        EXPECT_LT(links[0]["largest_excess_seen"], 1e-3);
      }
      const Outcome judged = check(out);
      ASSERT_EQ(jsonOf(judged)["links"].size(), 2u) << judged.err;
      EXPECT_EQ(jsonOf(judged)["links"][0]["spheres"], links[0]["spheres"]) << out;
      EXPECT_EQ(judged.exitCode, 0) << out << judged.out;
    }
  EXPECT_THAT(folder_.read("convex.urdf"), HasSubstr("convex_meshes/0.obj"));
}

TEST_F(CoverProgram, WritesTheFormatThatIsAskedFor) {
  for (const std::string format : {"vamp", "xrdf", "curobo", "srdf", "json", "urdf"}) {
    const std::string ending = format == "vamp"     ? ".json"
                               : format == "curobo" ? ".yaml"
                                                    : "." + format;
    const std::string out = folder_.path("as_" + format + ending);
    const Outcome run = runSwept({"cover", urdf_, "--spheres", "5", "--format", format, "-o", out});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Outcome judged = check(out);
    EXPECT_EQ(judged.exitCode, 0) << format << judged.out << judged.err;
    EXPECT_EQ(jsonOf(judged)["links"][1]["spheres"], 1);
  }
  const auto vamp = nlohmann::json::parse(folder_.read("as_vamp.json"));
  EXPECT_EQ(vamp["name"], "arm");
  EXPECT_EQ(vamp["urdf"], "as_vamp_spherized.urdf");
  EXPECT_EQ(vamp["end_effectors"], nlohmann::json::array({vamp["end_effector"]}));
  EXPECT_THAT(folder_.read("as_vamp_spherized.urdf"), HasSubstr("<sphere radius="));
  EXPECT_THAT(folder_.read("as_xrdf.xrdf"), HasSubstr("format: xrdf\nformat_version: 1.0\n"));
  // Whatever it ends in.
  const std::string odd = folder_.path("spheres.txt");
  EXPECT_EQ(runSwept({"cover", urdf_, "--spheres", "5", "--format", "xrdf", "-o", odd}).exitCode,
            0);
  EXPECT_EQ(folder_.read("spheres.txt"), folder_.read("as_xrdf.xrdf"));
}

/// Boxes, cylinders and spheres of somebody else's URDF.
TEST_F(CoverProgram, JudgesShapesOfAnyUrdf) {
  const std::string other = folder_.write("other.urdf", R"(<robot name="arm">
  <link name="slab"><collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.3 0.06"/></geometry></collision></link>
  <link name="frame"/>
  <link name="ball"><collision><origin xyz="0 0 0.3"/><geometry><cylinder radius="0.06" length="0.2"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="slab"/><child link="frame"/></joint>
  <joint name="on" type="fixed"><parent link="frame"/><child link="ball"/></joint>
</robot>
)");
  const Outcome run = check(other);
  EXPECT_EQ(run.exitCode, 1) << run.err;
  const nlohmann::json links = jsonOf(run)["links"];
  EXPECT_NEAR(links[0]["outside_lower"], 0.02, 1e-9);
  EXPECT_NEAR(links[0]["outside_upper"], 0.02, 2e-5);
  EXPECT_LE(links[1]["outside_upper"], 0.0);
  EXPECT_THAT(runSwept({"cover", urdf_, "--check", other}).out,
              HasSubstr("the least inflation that encloses all links: 20"));
}

/// By the code that shares nothing with what made the model. A little less is refused.
TEST_F(CoverProgram, IsVerifiedByOtherMeans) {
  folder_.write(
      "wedge.obj",
      "v 0 0 0\nv 0.4 0 0\nv 0 0.3 0\nv 0.1 0.1 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string robot = folder_.write("parts.urdf", R"(<robot name="parts">
  <link name="wedge"><collision><origin xyz="0 0 1" rpy="0 2 1"/><geometry><mesh filename="wedge.obj"/></geometry></collision></link>
  <link name="round">
    <collision><origin xyz="0.1 0 0" rpy="1 0 0"/><geometry><cylinder radius="0.1" length="0.4"/></geometry></collision>
    <collision><geometry><box size="0.3 0.1 0.1"/></geometry></collision>
    <collision><origin xyz="0 0.2 0"/><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <joint name="turn" type="continuous"><parent link="wedge"/><child link="round"/></joint>
</robot>
)");
  for (const std::string shape : {"sphere", "capsule", "box", "convex"}) {
    const std::string file = folder_.path(shape + ".json");
    // The seam of two boxes that overlap by a micrometre takes too many cells.
    const std::string count = shape == "box" ? "2" : "9";
    ASSERT_EQ(runSwept({"cover", robot, "--spheres", count, "--shape", shape, "-o", file}).exitCode,
              0);
    const Outcome run = runSwept({"verify", file, "--robot", robot});
    EXPECT_EQ(run.exitCode, 0) << shape << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("verified: 2 links contained in "));
    // Each shape is needed, as large as it is.
    auto less = nlohmann::json::parse(folder_.read(shape + ".json"));
    for (nlohmann::json& link : less["links"]) {
      if (shape == "sphere")
        for (nlohmann::json& ball : link["spheres"]) ball[3] = 0.99 * ball[3].get<double>();
      else
        for (nlohmann::json& part : link["shapes"]) {
          if (shape == "box")
            part["size"][0] = 0.99 * part["size"][0].get<double>();
          else if (shape == "convex")
            for (nlohmann::json& vertex : part["vertices"])
              vertex[2] = 0.99 * vertex[2].get<double>();
          else
            part["radius"] = 0.99 * part["radius"].get<double>();
        }
    }
    const std::string forged = folder_.write("less_" + shape + ".json", less.dump());
    const Outcome refused = runSwept({"verify", forged, "--robot", robot, "--json"});
    EXPECT_EQ(refused.exitCode, 1) << shape;
    EXPECT_THAT(jsonOf(refused)["refusal"].get<std::string>(),
                HasSubstr("link 'wedge': it is not shown to be contained at ["));
  }
  const std::string file = folder_.path("sphere.json");
  EXPECT_THAT(runSwept({"verify", file}).err, HasSubstr("--robot ROBOT.urdf"));
  EXPECT_THAT(runSwept({"verify", file, "--robot", urdf_}).out,
              HasSubstr("refused: link 'slab': the model has nothing for it"));
}

/// Of a hull its vertices and faces are all that counts: a face less is an opening, one that is
/// turned round leaves nothing behind all of them, and vertices alone say nothing.
TEST_F(CoverProgram, VerifiesHullsByTheirFaces) {
  const std::string robot = folder_.write(
      "box.urdf",
      "<robot name=\"box\"><link name=\"box\"><collision><geometry><box size=\"0.2 0.3 0.4\"/>"
      "</geometry></collision></link></robot>");
  const std::string hull = R"("type": "convex", "pose": [0, 0, 0, 0, 0, 0, 1],
    "vertices": [[-1, -1, -1], [5, -1, -1], [-1, 5, -1], [-1, -1, 5]])";
  const auto verified = [&](const std::string& shape) {
    const std::string file =
        folder_.write("hull.json", R"({"links": [{"link": "box", "shapes": [{)" + shape + "}]}]}");
    return runSwept({"verify", file, "--robot", robot}).out;
  };
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])"),
              HasSubstr("verified: 1 link contained in 1 shape"));
  EXPECT_THAT(verified(hull), HasSubstr("refused: link 'box': a hull without faces"));
  EXPECT_THAT(verified(hull + R"(, "faces": [])"), HasSubstr("a hull without faces"));
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3]])"),
              HasSubstr("the faces of a hull leave an opening"));
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 3, 2]])"),
              HasSubstr("the faces of a hull leave an opening"));
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]])"),
              HasSubstr("it is not shown to be contained at ["));
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 2, 4]])"),
              HasSubstr("a face has a corner that is not there"));
  EXPECT_THAT(verified(hull + R"(, "faces": [[0, 2, 0.5]])"),
              HasSubstr("a face has a corner that is not there"));
}

/// A room inside a solid is not left out, though the surface is contained.
TEST_F(CoverProgram, VerifiesTheInsideOfSolids) {
  folder_.write("cube.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const std::string robot =
      folder_.write("cube.urdf",
                    "<robot name=\"cube\"><link name=\"cube\"><collision><geometry>"
                    "<mesh filename=\"cube.obj\"/></geometry></collision></link></robot>");
  const auto walls = [&](const std::string& thickness) {
    std::string shapes;
    for (const int axis : {0, 1, 2})
      for (const std::string place : {"0", "1"}) {
        std::string size, pose;
        for (int k = 0; k < 3; ++k) {
          size += (k > 0 ? "," : "") + (k == axis ? thickness : std::string("1.01"));
          pose += (k > 0 ? "," : "") + (k == axis ? place : std::string("0.5"));
        }
        shapes += std::string(shapes.empty() ? "" : ",") + R"({"type": "box", "size": [)" + size +
                  R"(], "pose": [)" + pose + ", 0, 0, 0, 1]}";
      }
    return folder_.write("walls.json",
                         R"({"links": [{"link": "cube", "shapes": [)" + shapes + "]}]}");
  };
  EXPECT_EQ(runSwept({"verify", walls("1.1"), "--robot", robot}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", walls("0.9"), "--robot", robot}).exitCode, 1);
  EXPECT_EQ(runSwept({"cover", robot, "--check", walls("1.1")}).exitCode, 0);
  EXPECT_EQ(runSwept({"cover", robot, "--check", walls("0.9")}).exitCode, 1);
}

TEST_F(CoverProgram, ShowsWhatIsOutsideOnAPage) {
  if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  const std::string file = curobo("    - {center: [0.5, 0, 0], radius: 0.4}\n");
  const std::string page = folder_.path("page.html");
  const Outcome run = runSwept({"cover", urdf_, "--check", file, "--html", page});
  EXPECT_EQ(run.exitCode, 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("page written to "));
  const std::string text = folder_.read("page.html");
  EXPECT_THAT(text, HasSubstr("slab: outside"));
  EXPECT_THAT(text, HasSubstr("slab: model"));
  EXPECT_THAT(text, Not(HasSubstr("ball: outside")));
  EXPECT_THAT(text, HasSubstr("1 of 2 links partly outside"));
}

}  // namespace
}  // namespace swept::test
