// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "gantry.hpp"
#include "models_dir.hpp"

namespace swept::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// Each time in ms becomes `# ms`.
std::string withoutTimes(const std::string& text) {
  return std::regex_replace(text, std::regex(" +[0-9.]+ ms"), " # ms");
}

TEST(Info, SaysWhatIsThere) {
  const Gantry gantry;
  const Outcome run = gantry.run("info", {});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  const std::string balls = jsonOf(gantry.run("info", {"--json"}))["covers"]["balls"].dump();
  EXPECT_EQ(withoutTimes(run.out),
            "robot gantry from " + gantry.urdf + "\nSRDF " + gantry.srdf +
                " (found beside the URDF)\n"
                "3 links, 1 with collision geometry; 2 joints, 2 variables; "
                "0 pairs disabled by the SRDF\n"
                "\n"
                "link  collision geometry     balls  overhang  inner  built in  file\n"
                "cube  box 0.2 x 0.2 x 0.2 m    " +
                balls +
                "    5.4 mm     64 # ms\n"
                "covers: " +
                balls +
                " balls, 64 inner balls, built in # ms\n"
                "\n"
                "joint  type       lower  upper  unit\n"
                "slide  prismatic   -0.5    2.5  m\n"
                "lift   prismatic      0      1  m\n"
                "\n"
                "group   tip   named states         variables\n"
                "both    cube  left, right, inside  slide,lift\n"
                "slider  beam                       slide\n"
                "\n"
                "scene " +
                gantry.scene +
                ": 1 body\n"
                "world body  geometry\n"
                "post        box 0.2 x 0.2 x 0.2 m\n"
                "\n"
                "group both checks 1 pair: 1 of a link with a world body, "
                "0 of two links\n"
                "checked, more than 0 m apart (1): cube - post\n");
}

TEST(Info, JsonHoldsTheSame) {
  const Gantry gantry;
  const Outcome run = gantry.run("info", {"--json"});
  EXPECT_EQ(run.exitCode, 0);
  const auto json = jsonOf(run);
  EXPECT_EQ(json["robot"], "gantry");
  EXPECT_EQ(json["srdf"], gantry.srdf);
  EXPECT_EQ(json["srdf_found_beside_urdf"], true);
  ASSERT_EQ(json["links"].size(), 3u);
  EXPECT_EQ(json["links"][2]["collision"][0]["kind"], "box");
  const auto& cover = json["links"][2]["collision"][0]["cover"];
  EXPECT_EQ(cover["inner_balls"], 64);
  EXPECT_GT(cover["balls"], 100);
  EXPECT_GT(cover["overhang"], 0.003);
  EXPECT_LE(cover["overhang"], 0.0055);
  EXPECT_GT(cover["seconds"], 0.0);
  EXPECT_EQ(json["covers"],
            (nlohmann::json{
                {"balls", cover["balls"]}, {"inner_balls", 64}, {"seconds", cover["seconds"]}}));
  ASSERT_EQ(json["joints"].size(), 2u);
  EXPECT_EQ(json["joints"][0]["variables"][0]["upper"], 2.5);
  EXPECT_EQ(json["groups"][0]["named_states"]["right"]["slide"], 2.0);
  ASSERT_EQ(json["group"]["checked_pairs"].size(), 1u);
  EXPECT_EQ(json["group"]["checked_pairs"][0]["body_b"], "post");
}

TEST(Info, TheSrdfBesideTheUrdfCanBeLeftOutOrReplaced) {
  const Gantry gantry;
  const auto without = jsonOf(runSwept({"info", gantry.urdf, "--srdf", "none", "--json"}));
  EXPECT_TRUE(without["srdf"].is_null());
  ASSERT_EQ(without["groups"].size(), 1u);
  EXPECT_EQ(without["groups"][0]["name"], "all");

  const std::string other = gantry.folder().write(
      "other.srdf", R"(<robot name="gantry"><group name="x"><joint name="lift"/></group></robot>)");
  const auto replaced = jsonOf(runSwept({"info", gantry.urdf, "--srdf", other, "--json"}));
  EXPECT_EQ(replaced["srdf"], other);
  EXPECT_EQ(replaced["srdf_found_beside_urdf"], false);
  EXPECT_EQ(replaced["groups"][0]["name"], "x");
}

TEST(Info, TellsWhatMeshesAre) {
  const TemporaryFolder folder;
  // A tetrahedron, closed; and one without its last face, open.
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  folder.write("closed.obj", vertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.write("open.obj", vertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const auto link = [](const std::string& name) {
    return "<link name='" + name + "'><collision><geometry><mesh filename='" + name +
           ".obj'/></geometry></collision></link>";
  };
  const std::string urdf =
      folder.write("two.urdf", "<robot name='two'>" + link("closed") + link("open") +
                                   "<joint name='turn' type='continuous'><parent link='closed'/>"
                                   "<child link='open'/><axis xyz='0 0 1'/></joint></robot>");
  const Outcome run = runSwept({"info", urdf});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out, HasSubstr("no SRDF\n"));
  EXPECT_THAT(run.out, HasSubstr("mesh of 4 triangles, closed, hull of 4 points"));
  EXPECT_THAT(run.out, HasSubstr("mesh of 3 triangles, open, hull of 4 points"));
  EXPECT_THAT(run.out, HasSubstr("turn   continuous"));
  EXPECT_THAT(run.out, HasSubstr("rad, cyclic"));
  // The open mesh is a surface, which is worth a warning: on stderr, once, and not when quiet.
  EXPECT_THAT(run.err, HasSubstr("warning: "));
  EXPECT_EQ(run.err.find("warning: "), run.err.rfind("warning: ")) << run.err;
  EXPECT_EQ(runSwept({"info", urdf, "--quiet"}).err, "");
}

TEST(Info, NamesStandingContacts) {
  const Gantry gantry;
  // The foot stands still: what it touches, it touches whatever the group does.
  const TemporaryFolder folder;
  const std::string urdf = folder.write(
      "base.urdf",
      "<robot name='base'><link name='foot'><collision><geometry><box size='1 1 1'/></geometry>"
      "</collision></link><link name='arm'/><joint name='j' type='continuous'>"
      "<parent link='foot'/><child link='arm'/><axis xyz='0 0 1'/></joint></robot>");
  const Outcome run = runSwept({"info", urdf, "--group", "all", "--scene", gantry.scene});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out, Not(HasSubstr("standing contact")));  // 0.4 m apart

  const std::string floor = folder.write(
      "floor.yaml",
      "world: {collision_objects: [{id: floor, operation: add, primitives: [{type: box, "
      "dimensions: [4, 4, 1]}], primitive_poses: [{position: [0, 0, -0.9], orientation: "
      "[0, 0, 0, 1]}]}]}\n");
  const Outcome standing = runSwept({"info", urdf, "--group", "all", "--scene", floor});
  EXPECT_EQ(standing.exitCode, 0);
  EXPECT_THAT(standing.out, HasSubstr("standing contact: foot - floor\n"));
  EXPECT_THAT(standing.err,
              EndsWith("swept: warning: in contact whatever group 'all' does, and left out of the "
                       "verdicts: foot - floor\n"));
}

TEST(Info, SaysWhyPairsAreCheckedAndHowFarApart) {
  const std::string rook = modelsDir() + "/robots/rook7/rook7.urdf";
  const std::string shelf = modelsDir() + "/scenes/shelf.yaml";
  const Outcome plain = runSwept({"info", rook, "--group", "arm", "--scene", shelf});
  EXPECT_EQ(plain.exitCode, 0);
  EXPECT_THAT(plain.out, HasSubstr("checked, more than 0 m apart ("));
  EXPECT_THAT(plain.out, HasSubstr("not checked, adjacent ("));

  const Outcome changed = runSwept({"info", rook, "--group", "arm", "--scene", shelf, "--margin",
                                    "0.01", "--pad", "hand=0.02", "--allow", "*,board_1",
                                    "--explain", "hand,board_2", "--explain", "board_1,hand"});
  EXPECT_EQ(changed.exitCode, 0) << changed.err;
  EXPECT_THAT(changed.out, HasSubstr("checked, more than 0.01 m apart ("));
  EXPECT_THAT(changed.out, HasSubstr("checked, more than 0.03 m apart ("));
  EXPECT_THAT(changed.out, HasSubstr("not checked, allowed: --allow ("));
  EXPECT_THAT(changed.out, HasSubstr("hand - board_2: checked, keeps more than 0.03 m (margin 0.01 "
                                     "m, padding of hand 0.02 m)\n"));
  EXPECT_THAT(changed.out, HasSubstr("board_1 - hand: not checked, allowed: --allow\n"));
}

TEST(Info, RulesThatMakeNoSenseAreUsageErrors) {
  const std::string rook = modelsDir() + "/robots/rook7/rook7.urdf";
  const auto error = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"info", rook, "--group", "arm", "--quiet"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome run = runSwept(command);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_THAT(error({"--pad", "hand"}), HasSubstr("--pad 'hand': expected NAME=NUMBER"));
  EXPECT_THAT(error({"--pad", "hand=much"}), HasSubstr("--pad 'hand=much': expected NAME=NUMBER"));
  for (const std::string pad : {"hand=-1", "hand=-1e-9", "hand=inf", "hand=nan"})
    EXPECT_EQ(error({"--pad", pad}),
              "swept: error: --pad '" + pad + "': a padding must be 0 m or more, and finite\n");
  for (const std::string scale : {"hand=0", "hand=-1e-9", "hand=inf", "hand=nan"})
    EXPECT_EQ(error({"--scale", scale}),
              "swept: error: --scale '" + scale + "': a factor must be above 0, and finite\n");
  EXPECT_THAT(error({"--allow", "hand"}), HasSubstr("--allow 'hand': expected two names, A,B"));
  EXPECT_THAT(error({"--pad", "paw=1"}), HasSubstr("a rule names 'paw', which is no link"));
  EXPECT_THAT(error({"--explain", "hand,sun"}), HasSubstr("'sun' is no link, attached body"));
  const Outcome noGroup = runSwept({"info", rook, "--explain", "hand,board_1", "--quiet"});
  EXPECT_EQ(noGroup.exitCode, 3);
  EXPECT_THAT(noGroup.err, HasSubstr("--explain needs --group"));
}

}  // namespace
}  // namespace swept::test
