// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "gantry.hpp"
#include "program.hpp"

/// Which joints are a group, and which pairs are checked, where no SRDF says so, or does not say
/// all.
namespace swept::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

/// The arm is in the base whatever it does, the tip never is; a second joint turns the tip.
class Bare {
  TemporaryFolder folder_;

 public:
  Bare()
      : urdf(folder_.write("bare.urdf", R"(<?xml version="1.0"?>
<robot name="bare">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="flange"/>
  <link name="arm"><collision><geometry><box size="0.2 0.1 0.1"/></geometry></collision></link>
  <link name="tip"><collision><geometry><box size="0.02 0.02 0.02"/></geometry></collision></link>
  <joint name="f" type="fixed"><parent link="base"/><child link="flange"/><origin xyz="0 0 0.1"/></joint>
  <joint name="a" type="revolute"><parent link="flange"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="b" type="revolute"><parent link="arm"/><child link="tip"/><origin xyz="0.3 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)")) {}
  Outcome run(const std::string& command, const Words& more) const {
    Words words{command, urdf};
    words.insert(words.end(), more.begin(), more.end());
    return runSwept(words);
  }
  std::string path(const std::string& name) const { return folder_.path(name); }
  const TemporaryFolder& folder() const { return folder_; }

  std::string urdf;
};

TEST(Groups, WithoutAnSrdfDefaultContactsAreLeftOutAndNamed) {
  const Bare bare;
  const Outcome plain = bare.run("check", {"default", "0.5,0", "--json"});
  EXPECT_EQ(plain.exitCode, 0) << plain.err;
  EXPECT_EQ(jsonOf(plain)["states"][0]["label"], "state 1 (default)");
  EXPECT_THAT(plain.err, HasSubstr("in contact at the default state and at all others that "
                                   "were looked at: base - arm; "
                                   "--keep-default-contacts checks them, and `swept acm "));
  const Outcome kept = bare.run("check", {"default", "--keep-default-contacts"});
  EXPECT_EQ(kept.exitCode, 1);
  EXPECT_EQ(kept.err, "");
  const auto info = jsonOf(bare.run("info", {"--json", "-q"}));
  nlohmann::json skipped;
  for (const auto& pair : info["group"]["skipped_pairs"])
    skipped[pair["reason"].get<std::string>()] = true;
  EXPECT_TRUE(skipped.contains(
      "allowed: in contact at the default state and at all others that were looked at"))
      << info;
}

TEST(Groups, AnSrdfThatAcmMakesSaysTheSame) {
  const Bare bare;
  EXPECT_EQ(bare.run("acm", {"-o", bare.path("made.srdf"), "-q"}).exitCode, 0);
  const Outcome run = bare.run("check", {"0,0", "--srdf", bare.path("made.srdf")});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.err, Not(HasSubstr("default state")));
  // One that names no pair has them checked: somebody has decided.
  const std::string none = bare.folder().write("none.srdf", "<robot name='bare'/>");
  EXPECT_EQ(bare.run("check", {"0,0", "--srdf", none}).exitCode, 1);
}

TEST(Groups, AFlagThatChangesNothingSaysWhatDecides) {
  const Bare bare;
  const auto idle = [](const std::string& file) {
    return "swept: warning: --keep-default-contacts changes nothing: '" + file +
           "' says which pairs are not checked\n";
  };
  const std::string none = bare.folder().write("none.srdf", "<robot name='bare'/>");
  EXPECT_THAT(bare.run("check", {"0,0", "--srdf", none, "--keep-default-contacts"}).err,
              HasSubstr(idle(none)));
  const std::string scene = bare.folder().write(
      "scene.yaml",
      "allowed_collision_matrix: {entry_names: [base, arm], entry_values: [[0, 1], [1, 0]]}\n"
      "collision_objects: []\n");
  const Outcome matrix =
      bare.run("check", {"0,0", "--scene", scene, "--srdf", "none", "--keep-default-contacts"});
  EXPECT_EQ(matrix.exitCode, 0) << matrix.err;
  EXPECT_THAT(matrix.err, HasSubstr(idle(scene)));
  const std::string cell = "models/cells/two_rooks.yaml";
  EXPECT_EQ(runSwept({"check", cell, "home", "--group", "left/arm", "--keep-default-contacts"}).err,
            idle(cell));
  EXPECT_EQ(bare.run("check", {"0,0", "--keep-default-contacts"}).err, "");
}

TEST(Groups, AProofSaysWhatItLeavesOutAndIsAboutTheSamePairs) {
  const Bare bare;
  const Outcome plan =
      bare.run("plan", {"default", "0.5,-0.5", "-o", bare.path("path.json"), "-q"});
  ASSERT_EQ(plan.exitCode, 0) << plan.err;
  const auto json = nlohmann::json::parse(bare.folder().read("path.json"));
  EXPECT_EQ(json["inputs"]["without_default_contacts"], true);
  const Outcome verify = runSwept({"verify", bare.path("path.json"), "--files"});
  EXPECT_EQ(verify.exitCode, 0) << verify.err;
  EXPECT_THAT(verify.out,
              HasSubstr("not checked (allowed: in contact at the default state and at all "
                        "others that were looked at): "));
  // A file that does not say so was made when all pairs were checked.
  auto older = json;
  older["inputs"].erase("without_default_contacts");
  const Outcome other =
      runSwept({"verify", bare.folder().write("older.json", older.dump()), "--files"});
  EXPECT_NE(other.exitCode, 0);
}

TEST(Groups, JointsAndChainsAreGroupsThatPathFilesRecord) {
  const Bare bare;
  for (const Words& group : {Words{"--joints", "b"}, {"--chain", "arm,tip"}}) {
    Words words{"0", "0.5", "-o", bare.path("path.json"), "-q"};
    words.insert(words.end(), group.begin(), group.end());
    const Outcome plan = bare.run("plan", words);
    ASSERT_EQ(plan.exitCode, 0) << plan.err;
    const Outcome verify = runSwept({"verify", bare.path("path.json"), "--files"});
    EXPECT_EQ(verify.exitCode, 0) << verify.err;
  }
  EXPECT_EQ(bare.run("check", {"0.1,0.2", "--joints", "b,a", "-q"}).exitCode, 0);
  const auto info = jsonOf(bare.run("info", {"--joints", "b,a", "--json", "-q"}));
  EXPECT_EQ(info["group"]["name"], "joints b,a");
}

TEST(Groups, TheOnlyOneWithTheNamedStatesIsChosen) {
  const Gantry gantry;
  const Outcome run = runSwept({"check", gantry.urdf, "left", "right", "--json"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(jsonOf(run)["group"], "both");
  EXPECT_EQ(runSwept({"check", gantry.urdf, "default"}).exitCode, 3);
}

TEST(Groups, WhatIsLeftOutSaysWhyOnlyToWhomAsksForIt) {
  const Bare bare;
  const std::string srdf =
      bare.folder().write("half.srdf",
                          "<robot name='bare'>\n<group name='arm'><joint name='a'/></group>\n"
                          "<group name='tail'><joint name='wag'/></group>\n"
                          "<disable_collisions link1='base' link2='arm'/>\n</robot>\n");
  const Outcome run = bare.run("check", {"0", "--srdf", srdf});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("half.srdf:3: warning: group 'tail' is left out: joint 'wag' "));
  const Outcome asked = bare.run("check", {"0", "--srdf", srdf, "--group", "tail", "-q"});
  EXPECT_EQ(asked.exitCode, 3);
  EXPECT_EQ(asked.err, "swept: error: group 'tail' of robot 'bare' is left out: " + srdf +
                           ":3: joint 'wag' does not exist\n");
}

TEST(Groups, WarningsOfAKindAreOneUnlessAllAreAskedFor) {
  const Bare bare;
  std::string text = "<robot name='bare'>\n<disable_collisions link1='base' link2='arm'/>\n";
  for (int i = 0; i < 30; ++i) text += "<disable_collisions link1='gone' link2='base'/>\n";
  const std::string srdf = bare.folder().write("many.srdf", text + "</robot>\n");
  const Outcome few = bare.run("check", {"0,0", "--srdf", srdf});
  EXPECT_EQ(few.err, srdf +
                         ":3: warning: <disable_collisions>: 30 pairs name link 'gone', which "
                         "does not exist (first at line 3)\n");
  const Outcome all = bare.run("check", {"0,0", "--srdf", srdf, "--verbose"});
  EXPECT_EQ(std::ranges::count(all.err, '\n'), 30);
}

/// Two balls on a rail, which a joint connects: the SRDF has them checked.
TEST(Groups, AProofHoldsNeighboursApartThatTheSrdfEnables) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write("n.urdf", R"(<?xml version="1.0"?>
<robot name="n"><link name="base"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="arm"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="j" type="prismatic"><parent link="base"/><child link="arm"/><axis xyz="1 0 0"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>)");
  folder.write("n.srdf", "<robot name='n'><enable_collisions link1='base' link2='arm'/></robot>");
  EXPECT_EQ(runSwept({"check", urdf, "-1"}).exitCode, 1);
  EXPECT_EQ(runSwept({"motion", urdf, "0", "-2"}).exitCode, 1);
  const std::string path = folder.path("path.json");
  ASSERT_EQ(runSwept({"plan", urdf, "0", "1", "-o", path, "--embed", "-q"}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", path, "--files"}).exitCode, 0);
  const auto json = nlohmann::json::parse(folder.read("path.json"));
  EXPECT_EQ(json["model"]["asked"], nlohmann::json::parse(R"([["base", "arm"]])"));
  // Without the proof of that pair the rest proves nothing.
  auto forged = json;
  for (auto& segment : forged["proof"]["segments"]) segment["pairs"] = nlohmann::json::array();
  const Outcome run = runSwept({"verify", folder.write("forged.json", forged.dump())});
  EXPECT_EQ(run.exitCode, 1) << run.out << run.err;
}

}  // namespace
}  // namespace swept::test
