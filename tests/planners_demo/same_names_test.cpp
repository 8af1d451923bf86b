// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "gantry.hpp"
#include "page_data.hpp"

/// A body of the world may have the name of a link. Proofs and reports tell the two apart; rules
/// are about the name, and so about both.
namespace swept::test {
namespace {

using nlohmann::json;

/// The gantry, whose link is `cube`, and a post of that name.
class SameNames : public testing::Test {
 protected:
  SameNames() {
    std::string text = gantry_.folder().read("post.yaml");
    text.replace(text.find("id: post"), 8, "id: cube");
    scene_ = gantry_.folder().write("cube.yaml", text);
  }

  std::vector<std::string> words(const std::string& command,
                                 const std::vector<std::string>& more) const {
    std::vector<std::string> all{command, gantry_.urdf, "--group", "both", "--scene", scene_};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// What the proof of a path over the post is about.
  json model(const std::vector<std::string>& rules) const {
    std::vector<std::string> more{"left", "right", "--embed", "-o",
                                  gantry_.folder().path("path.json")};
    more.insert(more.end(), rules.begin(), rules.end());
    const Outcome run = runSwept(words("plan", more));
    EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
    EXPECT_EQ(runSwept({"verify", gantry_.folder().path("path.json")}).exitCode, 0);
    return json::parse(gantry_.folder().read("path.json"))["model"];
  }

  Gantry gantry_;
  std::string scene_;
};

/// The padding was looked up by the name that the proof gives the body, `cube (world)`: what was
/// verified kept 0.05 m less than what was planned.
TEST_F(SameNames, PaddingIsInTheProof) {
  const std::vector<std::string> rules{"--pad", "cube=0.05", "--margin", "0.01"};
  const json paddings = model(rules)["paddings"];
  ASSERT_EQ(paddings, (json{{"cube", 0.05}, {"cube (world)", 0.05}}));
  std::vector<std::string> more{"--json"};
  more.insert(more.end(), rules.begin(), rules.end());
  const auto pairs = jsonOf(runSwept(words("info", more)))["group"]["checked_pairs"];
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0]["margin"].get<double>(),
              0.01 + paddings["cube"].get<double>() + paddings["cube (world)"].get<double>(),
              1e-12);
}

TEST_F(SameNames, ScaleAndAllowedPairsAreInTheProof) {
  const json bodies = model({"--scale", "cube=0.5"})["bodies"];
  ASSERT_EQ(bodies.size(), 2u);
  for (const json& body : bodies)
    EXPECT_EQ(body["shapes"][0]["half_extents"], json({0.05, 0.05, 0.05})) << body["name"];
  const json allowed = model({"--allow", "cube,cube"})["allowed"];
  ASSERT_EQ(allowed.size(), 1u);
  EXPECT_EQ(allowed[0][0], "cube");
  EXPECT_EQ(allowed[0][1], "cube (world)");
}

/// `cube (world)` was the name of both bodies, and no proof was written once the path was found.
TEST_F(SameNames, AreToldApartWhereTheNameOfTheProofIsTaken) {
  const std::string far = gantry_.folder().read("cube.yaml");
  std::string second = far.substr(far.find("    - id:"));
  second.replace(second.find("id: cube"), 8, "id: cube (world)");
  second.replace(second.find("[1, 0, 0]"), 9, "[1, 0, 5]");
  gantry_.folder().write("cube.yaml", far + second);
  const json bodies = model({"--allow", "cube,cube (world)"})["bodies"];
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies[0]["name"], "cube");
  EXPECT_EQ(bodies[1]["name"], "cube (world) (world)") << "that of the link's name";
  EXPECT_EQ(bodies[1]["shapes"][0]["pose"][9], 1.0);
  EXPECT_EQ(bodies[2]["name"], "cube (world)");
  EXPECT_EQ(bodies[2]["shapes"][0]["pose"][11], 5.0);
}

/// Here `cube (world)` is a link, below the rail.
TEST_F(SameNames, AreToldApartWhereALinkHasTheNameOfTheProof) {
  std::string urdf = gantry_.folder().read("gantry.urdf");
  urdf.replace(urdf.find("</robot>"), 8,
               R"x(<link name="cube (world)"><collision><origin xyz="0 0 -5"/>
<geometry><sphere radius="0.1"/></geometry></collision></link><joint name="fixed" type="fixed">
<parent link="rail"/><child link="cube (world)"/></joint></robot>)x");
  gantry_.folder().write("gantry.urdf", urdf);
  std::set<std::string> names;
  const json proven = model({});
  for (const json& body : proven["bodies"]) names.insert(body["name"]);
  EXPECT_EQ(names, (std::set<std::string>{"cube", "cube (world)", "cube (world) (world)"}));
}

/// The depth was that of the link in itself, 0.2 m.
TEST_F(SameNames, TheDepthOfABadEndIsThatOfTheBodyInTheWorld) {
  const Outcome run = runSwept(words("plan", {"inside", "right", "--json"}));
  EXPECT_EQ(run.exitCode, 1) << run.err;
  const json contacts = jsonOf(run)["bad_ends"][0]["contacts"];
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0]["a"], "cube");
  EXPECT_EQ(contacts[0]["b"], "cube");
  EXPECT_NEAR(contacts[0]["depth"].get<double>(), 0.1, 1e-4);  // at lift 0.1 m, of 0.2 m
}

/// The post was not found among the bodies of the page: the pair was the link with itself.
TEST_F(SameNames, ThePageMeasuresTheOneInTheWorld) {
  if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  const std::string page = gantry_.folder().path("page.html");
  const Outcome run = runSwept(words("plan", {"left", "right", "--html", page}));
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json table = pageData(gantry_.folder().read("page.html"))["clearances"];
  const std::vector<float> distance = floats(table["distance"]);
  const std::vector<std::int32_t> partner = integers(table["partner"]);
  ASSERT_GE(distance.size(), 2U);
  EXPECT_NEAR(distance[0], 0.8, 1e-4);  // from x = 0 to x = 1 m, less twice 0.1 m
  EXPECT_NEAR(distance[1], 0.8, 1e-4);
  EXPECT_EQ(partner[0], 1);
  EXPECT_EQ(partner[1], 0);
}

}  // namespace
}  // namespace swept::test
