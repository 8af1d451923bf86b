// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <string>
#include <vector>

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
  EXPECT_THAT(error({"--spheres", "5", "-o", folder_.path("a.txt")}),
              HasSubstr("ends in '.txt'; allowed: .urdf, .yaml, .yml (cuRobo), .srdf, .json"));
  EXPECT_THAT(read("a.txt", ""), HasSubstr("allowed: .json, .yaml, .yml (cuRobo), .srdf, .urdf"));
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
  EXPECT_THAT(error({"--check", urdf_}),
              HasSubstr("the <collision> of link 'slab' has 'box'; allowed in a model of spheres: "
                        "sphere"));
}

}  // namespace
}  // namespace swept::test
