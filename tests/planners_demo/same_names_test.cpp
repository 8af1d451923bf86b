// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "gantry.hpp"

/// A body of the world may have the name of a link. Proofs tell the two apart; rules are about the
/// name, and so about both.
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

}  // namespace
}  // namespace swept::test
