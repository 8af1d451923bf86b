// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "program.hpp"

namespace swept::test {
namespace {

/// The words of a line as fish reads it: between single quotes `\'` and `\\` stand for the second
/// character. None: a quote is not closed.
std::optional<std::vector<std::string>> fishWords(const std::string& line) {
  std::vector<std::string> words{""};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escape = line[i] == '\\' && i + 1 < line.size();
    if (quoted && escape && (line[i + 1] == '\'' || line[i + 1] == '\\'))
      words.back() += line[++i];
    else if (line[i] == '\'')
      quoted = !quoted;
    else if (line[i] == ' ' && !quoted)
      words.emplace_back();
    else
      words.back() += line[i];
  }
  if (quoted) return std::nullopt;
  return words;
}

/// The summary of `acm` has an apostrophe, which ended the text there.
TEST(Completion, FishReadsEachSummaryAsHelpHasIt) {
  std::istringstream lines(runSwept({"completion", "fish"}).out);
  int summaries = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto words = fishWords(line);
    ASSERT_TRUE(words) << line;
    const auto summary = std::ranges::find(*words, "-d");
    if (summary == words->end()) continue;
    ++summaries;
    ASSERT_EQ(words->end() - summary, 2) << line;
    std::vector<std::string> help{*(summary - 1), "--help"};
    const std::string condition = words->at(4), behind = "__fish_seen_subcommand_from ";
    if (condition.starts_with(behind)) help.insert(help.begin(), condition.substr(behind.size()));
    const std::string text = runSwept(help).out;
    EXPECT_EQ(text.substr(0, text.find('\n')), *(summary + 1)) << line;
  }
  EXPECT_GE(summaries, 11);
}

/// What may come at the end of a line, in the order of the program.
std::vector<std::string> wordsFor(const std::string& line) {
  const Outcome run = runSwept({"completion", "words", line});
  EXPECT_EQ(run.exitCode, 0) << line;
  EXPECT_EQ(run.err, "") << line;
  std::istringstream lines(run.out);
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) words.push_back(word);
  return words;
}

/// A robot whose meshes are missing: names are there without them.
class Names : public testing::Test {
 protected:
  Names() {
    const auto link = [](const std::string& name) {
      return "<link name='" + name +
             "'><collision><geometry><mesh filename='missing.stl'/></geometry></collision></link>";
    };
    folder_.write("r.urdf", "<robot name='r'>" + link("base") + link("arm") + link("hand") +
                                link("odd $(touch x)") +
                                "<joint name='turn' type='revolute'/><joint name='tilt' "
                                "type='continuous'/><joint name='glue' type='fixed'/></robot>");
    folder_.write("r.srdf",
                  "<robot name='r'><group name='left'/><group name='right'/>"
                  "<group_state name='up' group='left'/><group_state name='down' group='right'/>"
                  "</robot>");
  }
  /// `@R` stands for the robot's file.
  std::vector<std::string> of(std::string line) const {
    for (std::size_t at; (at = line.find("@R")) != std::string::npos;)
      line.replace(at, 2, folder_.path("r.urdf"));
    return wordsFor(line);
  }
  TemporaryFolder folder_;
};

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

TEST_F(Names, OfSubcommandsOptionsAndPlanners) {
  EXPECT_THAT(of("swept ch"), ElementsAre("check"));
  EXPECT_THAT(of("swept bench "), UnorderedElementsAre("edges", "planners", "summary"));
  EXPECT_THAT(of("swept --v"), ElementsAre("--version"));
  EXPECT_THAT(of("swept plan @R --goal"), ElementsAre("--goal-pose"));
  EXPECT_THAT(of("swept bench planners @R --planners RRT,PR"),
              ElementsAre("RRT,PRM", "RRT,PRMstar"));
  EXPECT_THAT(of("swept plan --planner=LazyR"), ElementsAre("--planner=LazyRRT"));
  EXPECT_THAT(of("swept completion "), ElementsAre("bash", "zsh", "fish"));
}

TEST_F(Names, OfGroupsAndTheirStates) {
  EXPECT_THAT(of("swept plan @R --group "), ElementsAre("left", "right"));
  EXPECT_THAT(of("swept plan @R --group=r"), ElementsAre("--group=right"));
  EXPECT_THAT(of("swept check @R "), UnorderedElementsAre("up", "down", "default"));
  EXPECT_THAT(of("swept check @R up "), UnorderedElementsAre("up", "down", "default"));
  EXPECT_THAT(of("swept check @R --margin 0.1 --group right "),
              UnorderedElementsAre("down", "default"));
  EXPECT_THAT(of("swept motion --group left @R u"), ElementsAre("up"));
  EXPECT_THAT(of("swept check @R --joints turn "), ElementsAre("default"));
  EXPECT_THAT(of("swept check @R --srdf none --group "), ElementsAre("all"));
  EXPECT_THAT(of("swept info @R "), IsEmpty()) << "info has no states";
}

TEST_F(Names, OfLinksAndJoints) {
  EXPECT_THAT(of("swept plan @R up --link "), ElementsAre("base", "arm", "hand"));
  EXPECT_THAT(of("swept check @R --allow ha"), ElementsAre("hand,"));
  EXPECT_THAT(of("swept check @R --allow hand,"), ElementsAre("hand,base", "hand,arm"));
  EXPECT_THAT(of("swept check @R --allow hand,base,"), IsEmpty());
  EXPECT_THAT(of("swept info @R --explain base,a"), ElementsAre("base,arm"));
  EXPECT_THAT(of("swept check @R --chain base,"), ElementsAre("base,arm", "base,hand"));
  EXPECT_THAT(of("swept check @R --pad b"), ElementsAre("base="));
  EXPECT_THAT(of("swept check @R --attach box:0.1,0.1,0.1@h"), ElementsAre("box:0.1,0.1,0.1@hand"));
  EXPECT_THAT(of("swept check @R --joints "), ElementsAre("turn", "tilt"));
  EXPECT_THAT(of("swept check @R --joints turn,"), ElementsAre("turn,tilt"));
  EXPECT_THAT(of("swept check @R --scene "), IsEmpty()) << "files are the shell's";
}

TEST_F(Names, OfSetsOfProblems) {
  EXPECT_THAT(of("swept plan @R --problems models/problems.json --set s"), ElementsAre("shelf"));
  EXPECT_THAT(of("swept plan @R --set "), IsEmpty());
}

TEST_F(Names, WordsAreReadAsAShellReadsThem) {
  folder_.write("a b.urdf", "<robot name='x'><link name='only'/></robot>");
  const std::string file = folder_.path("a b.urdf");
  const std::string escaped = folder_.path("a\\ b.urdf");
  for (const std::string& word : {"'" + file + "'", "\"" + file + "\"", escaped})
    EXPECT_THAT(wordsFor("swept plan " + word + " --link "), ElementsAre("only"));
  EXPECT_THAT(of("swept check @R -0.5,1 d"), UnorderedElementsAre("down", "default"))
      << "a negative value is no option";
}

/// The command itself says what is wrong with its files.
TEST_F(Names, BadFilesHaveNoneAndSayNothing) {
  for (const std::string text : {"", "<robot", "<robot><link/></robot>", "\x01\x02", "[1, 2]"}) {
    folder_.write("bad.urdf", text);
    folder_.write("bad.json", text);
    const std::string robot = "swept plan " + folder_.path("bad.urdf");
    for (const std::string& option : {std::string(" --link "), std::string(" --joints ")})
      EXPECT_THAT(wordsFor(robot + option), testing::Each("")) << text;
    EXPECT_THAT(wordsFor(robot + " --problems " + folder_.path("bad.json") + " --set "), IsEmpty());
  }
  EXPECT_THAT(wordsFor("swept plan /nowhere/r.urdf --group "), IsEmpty());
  EXPECT_THAT(wordsFor("swept plan / --group "), IsEmpty());
  EXPECT_EQ(runShell("mkfifo " + folder_.path("pipe") +
                     "; timeout 5 true; swept completion words "
                     "'swept plan " +
                     folder_.path("pipe") + " --group '")
                .out,
            "");
  for (const std::string line : {"", "swept", "nothing of ours", "swept '", "swept plan --"})
    wordsFor(line);
}

/// What bash puts at the end of the line: it splits words at `=`, `:` and `@` as well.
std::vector<std::string> bashAnswers(const std::string& line,
                                     const std::string& breaks = "\"'@><=;|&(: ") {
  const TemporaryFolder folder;
  folder.write("line", line);
  folder.write("breaks", breaks);
  const Outcome run = runCommands(
      "swept completion bash > script; exec bash -c '. ./script; COMP_WORDBREAKS=$(cat breaks); "
      "COMP_LINE=$(cat line; printf x); COMP_LINE=${COMP_LINE%x}; COMP_POINT=${#COMP_LINE}; "
      "_swept swept; printf \"%s\\n\" \"${COMPREPLY[@]}\"'",
      folder.path());
  EXPECT_EQ(run.err, "");
  std::istringstream lines(run.out);
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) words.push_back(word);
  return words;
}

TEST_F(Names, BashHasThem) {
  const std::string robot = "swept check " + folder_.path("r.urdf");
  EXPECT_THAT(bashAnswers(robot + " --group "), ElementsAre("left", "right"));
  EXPECT_THAT(bashAnswers(robot + " --attach sphere:0.1@h"), ElementsAre("hand"));
  EXPECT_THAT(bashAnswers(robot + " --attach sphere:0.1@h", " =:"), ElementsAre("0.1@hand"));
  EXPECT_THAT(bashAnswers(robot + " --attach sphere:0.1@h", " "), ElementsAre("sphere:0.1@hand"));
  EXPECT_THAT(bashAnswers(robot + " --group=le"), ElementsAre("left"));
  EXPECT_THAT(bashAnswers(robot + " --allow hand,"), ElementsAre("hand,base", "hand,arm"));
  EXPECT_THAT(bashAnswers("swept b"), ElementsAre("bench"));
}

TEST_F(Names, FishHasThem) {
  if (runShell("command -v fish").exitCode != 0) GTEST_SKIP() << "no fish";
  const auto answers = [&](const std::string& line) {
    return runCommands(
               "export HOME=$PWD; exec fish -c 'swept completion fish | source; "
               "complete -C \"" +
                   line + "\"'",
               folder_.path())
        .out;
  };
  EXPECT_EQ(answers("swept check r.urdf --group le"), "left\n");
  EXPECT_THAT(answers("swept check r.urdf --margin 0.1 --group left u"),
              testing::HasSubstr("up\n"));
  EXPECT_THAT(answers("swept ch"), testing::HasSubstr("check\tAre these states free?\n"));
}

TEST(Completion, ShellsReadTheirScripts) {
  EXPECT_EQ(runShell("swept completion bash | bash -n").exitCode, 0);
  for (const std::string shell : {"zsh", "fish"}) {
    if (runShell("command -v " + shell).exitCode != 0) continue;
    EXPECT_EQ(runShell("swept completion " + shell + " | " + shell + " -n").exitCode, 0) << shell;
  }
}

}  // namespace
}  // namespace swept::test
