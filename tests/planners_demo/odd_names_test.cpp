// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "batch.hpp"
#include "gantry.hpp"
#include "printed_text.hpp"

/// Names that are not UTF-8, which JSON has to be, and names that a CSV file has in quotes.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class OddNames : public testing::Test {
 protected:
  /// In URDF, SRDF and problems.
  void rename(const std::string& from, const std::string& to) {
    for (const std::string name : {"gantry.urdf", "gantry.srdf", "problems.json"})
      folder().write(name, replaced(folder().read(name), from, to));
  }
  const TemporaryFolder& folder() const { return gantry_.folder(); }
  Outcome plan(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"left", "right", "-o", folder().path(file)};
    words.insert(words.end(), more.begin(), more.end());
    return gantry_.run("plan", words);
  }
  void expectRefused(const Outcome& run, const std::string& where, const std::string& what) const {
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "") << "before the work";
    EXPECT_EQ(run.err, "swept: error: " + where + ": " + what +
                           " is not UTF-8, which all text in the file has to be\n");
  }

  Gantry gantry_;
};

TEST_F(OddNames, OfJointsAreRefusedForPathFilesThatNeedUtf8) {
  rename("\"slide\"", "\"sl\xffide\"");
  for (const std::string file : {"path.json", "path.yaml"})
    expectRefused(plan(file), "-o '" + folder().path(file) + "'", "the name 'sl\xffide'");
  EXPECT_EQ(plan("path.csv").exitCode, 0);
  EXPECT_THAT(folder().read("path.csv"), testing::StartsWith("sl\xffide,lift\n"));
}

TEST_F(OddNames, OfRobotAndLinksAreRefusedForJson) {
  rename("\"gantry\"", "\"gan\xc3try\"");
  const std::string where = "-o '" + folder().path("path.json") + "'";
  expectRefused(plan("path.json"), where, "the name 'gan\xc3try'");
  EXPECT_EQ(plan("path.yaml").exitCode, 0) << "which does not have it";
  rename("\"gan\xc3try\"", "\"gantry\"");
  rename("\"cube\"",
         "\"cu\xf5"
         "be\"");
  expectRefused(plan("path.json"), where,
                "the name 'cu\xf5"
                "be'");
}

/// They ended the program with an exception of the JSON library, once the path was found.
TEST_F(OddNames, OfOtherJointsAndOfReasonsAreRefusedForJson) {
  const std::string where = "-o '" + folder().path("path.json") + "'";
  rename("<link name=\"beam\"/>", R"(<link name="beam"/><link name="tip"><collision>
<origin xyz="0 0 -5"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="glXue" type="fixed"><parent link="rail"/><child link="tip"/></joint>)");
  rename("glXue", "gl\xffue");
  expectRefused(plan("path.json"), where, "the name 'gl\xffue'");
  rename("gl\xffue", "glue");
  rename("<group name=\"slider\">",
         "<disable_collisions link1=\"tip\" link2=\"cube\" reason=\"Ne\xffver\"/><group "
         "name=\"slider\">");
  expectRefused(plan("path.json"), where, "the name 'SRDF: Ne\xffver'");
}

TEST_F(OddNames, OfFilesThatWereChangedAreRefusedByVerify) {
  const std::string file = folder().path("path.json");
  ASSERT_EQ(plan("path.json").exitCode, 0);
  rename("\"rail\"", "\"ra\xffil\"");
  expectRefused(runSwept({"verify", file}), "the files of '" + file + "'", "the name 'ra\xffil'");
}

TEST_F(OddNames, OfFilesAndOptionsAreRefusedForJson) {
  const std::string scene = folder().path("p\xffst.yaml");
  std::filesystem::copy_file(gantry_.scene, scene);
  const Outcome run = runSwept({"plan", gantry_.urdf, "left", "right", "--group", "both", "--scene",
                                scene, "-o", folder().path("path.json")});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err, "swept: error: -o '" + folder().path("path.json") +
                         "': the name 'p\xffst.yaml'"
                         " is not UTF-8, which all text in the file has to be\n");
  EXPECT_FALSE(std::filesystem::exists(folder().path("path.json")));
}

TEST_F(OddNames, AreRefusedForDumps) {
  const std::string dumps = folder().path("dumps"), where = "--dump '" + dumps + "'";
  expectRefused(gantry_.run("motion", {"left", "right", "--pad", "*\xff=0.1", "--dump", dumps}),
                where, "the name '*\xff=0.1'");
  EXPECT_EQ(runShell("SWEPT_DUMP_DIR='" + dumps + "' swept check '" + gantry_.urdf +
                     "' inside --group both --pad '*\xff=0.1'")
                .err,
            "swept: error: SWEPT_DUMP_DIR '" + dumps +
                "': the name '*\xff=0.1' is not UTF-8, which all text in the file has to be\n");
  rename("\"slide\"", "\"sl\xffide\"");
  expectRefused(gantry_.run("motion", {"left", "right", "--dump", dumps}), where,
                "the name 'sl\xffide'");
  EXPECT_TRUE(std::filesystem::is_empty(dumps));
  const Outcome free = gantry_.run("motion", {"left", "0.1,0", "--json"});
  EXPECT_EQ(free.exitCode, 0) << "without --dump it is no matter";
}

TEST_F(OddNames, AreRefusedForTheDumpsOfABatchBeforeItsRuns) {
  rename("name=\"both\"", "name=\"bo\xffth\"");
  rename("group=\"both\"", "group=\"bo\xffth\"");
  const Words batch{"bench",    "planners",   gantry_.urdf,      "--group",
                    "bo\xffth", "--problems", gantry_.problems,  "--set",
                    "over",     "-o",         folder().path("r")};
  Words dumping = batch;
  dumping.insert(dumping.end(), {"--dump", folder().path("dumps")});
  const Outcome refused = runSwept(dumping);
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_THAT(refused.err, HasSubstr("--dump '" + folder().path("dumps") + "': the name 'bo"));
  EXPECT_FALSE(std::filesystem::exists(folder().path("r")));
  const Outcome run = runSwept(batch);
  EXPECT_EQ(run.exitCode, 0) << run.err;
}

/// Replay prints what it asked, and batches print their header.
TEST_F(OddNames, ArePrintedWithAReplacementInJson) {
  rename("\"gantry\"", "\"gan\xfftry\"");
  const json batch = jsonOf(runSwept({"bench", "planners", gantry_.urdf, "--group", "both",
                                      "--problems", gantry_.problems, "--set", "over", "--json"}));
  EXPECT_EQ(batch["header"]["robot"], "gan\xef\xbf\xbdtry");
}

TEST_F(OddNames, WithCommasAndQuotesAreQuotedInCsv) {
  rename("\"slide\"", "'sl,id\"e'");
  const Outcome run = plan("path.csv");
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(folder().read("path.csv"), testing::StartsWith("\"sl,id\"\"e\",lift\n0,0\n"));
}

/// A robot's name, a link's and a file's made up lines of stdout.
TEST_F(OddNames, MakeNoLines) {
  rename("\"gantry\"", "\"gan\nall free\"");
  rename("\"cube\"", "\"cu\nall free\"");
  rename("<link name=\"beam\"/>", R"(<link name="beam"/><link name="tip"><collision>
<origin xyz="0 0 -5"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="glue" type="fixed"><parent link="rail"/><child link="tip"/></joint>)");
  const auto expect = [](const Outcome& run, const std::string& shown) {
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr(shown));
    EXPECT_EQ(run.out.find("\nall free"), std::string::npos) << run.out;
  };
  const std::string path = folder().path("pa\nall free.csv");
  expect(plan("pa\nall free.csv"), "path written to " + replaced(path, "\n", "\\n") + "\n");
  expect(runSwept({"acm", gantry_.urdf, "--srdf", gantry_.srdf}), "  tip - cu\\nall free\n");
  expect(gantry_.run("report", {"--group", "both", "--motions", "2", "--passes", "1", "-q"}),
         "gan\\nall free, group both, ");
  const std::string page = folder().path("pa\nall free.html");
  expect(runSwept({"view", gantry_.urdf, "-o", page}),
         "page written to " + replaced(page, "\n", "\\n") + "\n");
}

/// A file's name made up a second line of stderr, and moved the terminal's cursor.
TEST(ControlCharacters, OfArgumentsAreEscapedInMessages) {
  const std::string odd = "no\x1b[2J\nfree: all\xc2\x9b\x9b\x7f";
  const std::string shown = "no\\u001b[2J\\nfree: all\\u009b\\u009b\\u007f";
  EXPECT_EQ(runSwept({"check", odd, "0"}).err, shown + ": error: file not found\n");
  EXPECT_THAT(runSwept({odd}).err,
              testing::StartsWith("swept: error: no subcommand '" + shown + "'; there are "));
  const Gantry gantry;
  EXPECT_THAT(gantry.run("check", {odd}).err, HasSubstr("no named state '" + shown + "' in group"));
  EXPECT_EQ(gantry.run("check", {"left", "--pad", "\xc3\xa4\xe2\x82\xac=-1"}).err.find("\\u"),
            std::string::npos)
      << "letters are none";
}

TEST(ControlCharacters, OfBodiesAreEscapedInResults) {
  const Gantry gantry;
  const std::string text =
      replaced(gantry.folder().read("post.yaml"), "id: post", R"(id: "po\e[2J\nst\u009b")");
  gantry.folder().write("post.yaml", text);
  const std::string shown = R"(po\u001b[2J\nst\u009b)";
  EXPECT_EQ(gantry.run("check", {"left"}).out,
            "state 1 (left): free, clearance 0.8 m, nearest cube - " + shown +
                " (world); self: no pair to check\n");
  for (const Words& words :
       {Words{"check", "inside"}, Words{"motion", "left", "right"}, Words{"info"}}) {
    const Outcome run = gantry.run(words[0], {words.begin() + 1, words.end()});
    EXPECT_THAT(run.out, HasSubstr(shown));
    EXPECT_EQ(run.out.find_first_of("\x1b\x9b"), std::string::npos) << words[0];
    EXPECT_EQ(run.out.find("\nst"), std::string::npos) << words[0];
  }
  const json report = jsonOf(gantry.run("check", {"inside", "--json"}));
  EXPECT_EQ(report["states"][0]["contacts"][0]["body_b"], "po\x1b[2J\nst\xc2\x9b");
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"left", "right", "-o", file}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 0);
}

}  // namespace
}  // namespace swept::test
