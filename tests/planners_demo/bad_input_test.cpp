// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gantry.hpp"
#include "page_data.hpp"

namespace swept::test {
namespace {

using Words = std::vector<std::string>;

struct Case {
  std::string name;
  Words arguments;
  std::string message;  ///< all of stderr but the newline
};

/// GoogleTest would print its bytes.
void PrintTo(const Case& test, std::ostream* out) {
  *out << test.name;
}

/// `%` stands for the folder of the gantry's files.
std::string filled(std::string text, const Gantry& gantry) {
  for (std::size_t at; (at = text.find('%')) != std::string::npos;)
    text.replace(at, 1, gantry.folder().path());
  return text;
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, ExitsWith3AndOneMessage) {
  const Gantry gantry;
  Words arguments;
  for (const std::string& word : GetParam().arguments) arguments.push_back(filled(word, gantry));
  const Outcome run = runSwept(arguments);
  EXPECT_EQ(run.exitCode, 3) << "signal " << run.signal;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, filled(GetParam().message, gantry) + "\n");
}

Words both(const std::string& command, const Words& more) {
  Words all{command, "%gantry.urdf", "--group", "both"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

const std::string kError = "swept: error: ";

const Case kStates[] = {
    {"TooFewValues", both("check", {"1"}), kError + "state 1: 1 values, expected 2: slide,lift"},
    {"TooManyValues", both("check", {"0,0", "1,2,3"}),
     kError + "state 2: 3 values, expected 2: slide,lift"},
    {"NotANumber", both("check", {"1,x"}), kError + "state 1: lift is 'x', which is not a number"},
    {"NumberWithATail", both("check", {"1,0.5m"}),
     kError + "state 1: lift is '0.5m', which is not a number"},
    {"EmptyValue", both("check", {"1,"}), kError + "state 1: lift is '', which is not a number"},
    {"Nan", both("check", {"nan,0"}),
     kError + "state 1: slide is 'nan', which is not a finite number"},
    {"Infinity", both("motion", {"0,0", "-inf,0"}),
     kError + "state 2: slide is '-inf', which is not a finite number"},
    {"Overflow", both("check", {"1e999,0"}),
     kError + "state 1: slide is '1e999', which is not a finite number"},
    {"AboveTheLimit", both("check", {"2.6,0"}),
     kError + "state 1: slide is 2.6, allowed is -0.5 to 2.5 m"},
    {"BelowTheLimit", both("motion", {"0,0", "0,-0.25"}),
     kError + "state 2: lift is -0.25, allowed is 0 to 1 m"},
    {"StartOutsideTheLimits", both("plan", {"-9,0", "0,0"}),
     kError + "start: slide is -9, allowed is -0.5 to 2.5 m"},
    {"UnknownName", both("check", {"lefft"}),
     kError +
         "state 1: no named state 'lefft' in group 'both' (it has left, right, inside, default) "
         "and not a list of values: slide,lift; did you mean 'left'?"},
    {"NameOfAnotherGroup",
     {"check", "%gantry.urdf", "left", "--group", "slider"},
     kError + "state 1: no named state 'left' in group 'slider' (it has default) and not a list of "
              "values: slide"},
    {"EmptyState", both("check", {""}),
     kError + "state 1: no named state '' in group 'both' (it has left, right, inside, default) "
              "and not a "
              "list of values: slide,lift"},
    {"NoState", both("check", {}), kError + "check: no state given"},
    {"OneStateToPlan", both("plan", {"left"}), kError + "plan: a start and a goal are needed"},
};

const Case kOptions[] = {
    {"NoSubcommand",
     {},
     kError +
         "a subcommand is required; there are info, check, motion, certify, plan, line, roadmap, "
         "verify, trajectory, schedule, acm, cover, "
         "replay, " +
         (programHasPages() ? "view, " : "") + "bench, report, completion (try --help)"},
    {"UnknownSubcommand",
     {"verfy"},
     kError +
         "no subcommand 'verfy'; there are info, check, motion, certify, plan, line, roadmap, "
         "verify, trajectory, schedule, "
         "acm, cover, "
         "replay, " +
         (programHasPages() ? "view, " : "") +
         "bench, report, completion; did you mean 'verify'? (try --help)"},
    {"NoRobot", {"check"}, kError + "robot is required (try --help)"},
    {"UnknownOption", both("check", {"left", "--frobnicate"}),
     kError + "The following argument was not expected: --frobnicate (try --help)"},
    {"GroupMissing",
     {"check", "%gantry.urdf", "0"},
     kError + "robot 'gantry' has several groups; choose one with --group: both, slider"},
    {"GroupNearlyKnown",
     {"check", "%gantry.urdf", "left", "--group", "Slidre"},
     kError + "robot 'gantry' has no group 'Slidre'; it has both, slider; did you mean 'slider'?"},
    {"OptionNearlyKnown", both("motion", {"left", "right", "--tolerence=1e-3"}),
     kError + "The following argument was not expected: --tolerence=1e-3; did you mean "
              "'--tolerance'? (try --help)"},
    {"JointNearlyKnown",
     {"check", "%gantry.urdf", "0", "--joints", "slide,lifft"},
     kError + "--joints 'slide,lifft': robot 'gantry' has no joint 'lifft'; did you mean 'lift'?"},
    {"ChainOfOneLink",
     {"check", "%gantry.urdf", "0", "--chain", "cube"},
     kError + "--chain 'cube': expected two names, A,B"},
    {"JointsOfAGroup", both("check", {"left", "--joints", "slide"}),
     kError + "--group excludes --joints (try --help)"},
    {"LinkNearlyKnown", both("check", {"left", "--allow", "cubo,*"}),
     kError + "Checker: a rule names 'cubo', which is no link, attached body or body of the "
              "world; did you mean 'cube'?"},
    {"GroupUnknown",
     {"check", "%gantry.urdf", "left", "--group", "arm"},
     kError + "robot 'gantry' has no group 'arm'; it has both, slider"},
    {"NegativeMargin", both("check", {"left", "--margin", "-0.1"}),
     kError + "--margin: must be between 0 and 10 m, not -0.1 (try --help)"},
    {"MarginNotANumber", both("check", {"left", "--margin", "thick"}),
     kError + "--margin: must be between 0 and 10 m, not thick (try --help)"},
    {"MarginNan", both("check", {"left", "--margin", "nan"}),
     kError + "--margin: must be between 0 and 10 m, not nan (try --help)"},
    {"ToleranceZero", both("motion", {"left", "right", "--tolerance", "0"}),
     kError + "--tolerance: must be between 1e-6 and 1 m, not 0 (try --help)"},
    {"TimeZero", both("plan", {"left", "right", "--time", "0"}),
     kError + "--time: must be between 0.001 and 1e6 s, not 0 (try --help)"},
    {"SeedZero", both("plan", {"left", "right", "--seed", "0"}),
     kError + "--seed: must be between 1 and 4294967295, not 0 (try --help)"},
    {"SeedTooLarge", both("plan", {"left", "right", "--seed", "4294967296"}),
     kError + "--seed: must be between 1 and 4294967295, not 4294967296 (try --help)"},
    {"PackageWithoutFolder", both("check", {"left", "--package", "parts"}),
     kError + "--package 'parts': expected NAME=DIR"},
    {"PackageFolderMissing", both("check", {"left", "--package", "parts=%nowhere"}),
     kError + "--package parts: no folder '%nowhere'"},
    {"SetWithoutProblems", both("check", {"left", "--set", "over"}),
     kError + "--set requires --problems (try --help)"},
};

const Case kFiles[] = {
    {"RobotMissing", {"info", "%nowhere.urdf"}, "%nowhere.urdf: error: file not found"},
    {"SrdfMissing", both("check", {"left", "--srdf", "%nowhere.srdf"}),
     "%nowhere.srdf: error: file not found"},
    {"SceneMissing", both("check", {"left", "--scene", "%nowhere.yaml"}),
     "%nowhere.yaml: error: file not found"},
    {"ProblemsMissing", both("plan", {"--problems", "%nowhere.json"}),
     "%nowhere.json: error: file not found"},
    {"StatesAndProblems", both("check", {"left", "--problems", "%problems.json"}),
     kError + "states and --problems cannot be combined: the problem has its own"},
    {"SceneAndProblems", both("plan", {"--problems", "%problems.json", "--scene", "%post.yaml"}),
     kError + "--scene and --problems cannot be combined: the problem has its own world"},
    {"ProblemsWithoutIndex", both("motion", {"--problems", "%problems.json", "--set", "over"}),
     kError + "motion: --problems needs --set and --index"},
    {"IndexWithoutSet", both("plan", {"--problems", "%problems.json", "--index", "1"}),
     kError + "--index needs --set"},
    {"OnePathOfMany", both("plan", {"--problems", "%problems.json", "-o", "path.csv"}),
     kError + "-o writes one path; choose one problem with --set and --index"},
    {"ForeignJoints",
     both("check", {"--problems", "%problems.json", "--set", "foreign", "--index", "1"}),
     kError + "problem foreign 1: its joints are lift,swing, those of group 'both' are slide,lift"},
    {"ProblemOutsideTheLimits",
     both("check", {"--problems", "%problems.json", "--set", "blocked", "--index", "9"}),
     kError + "problem blocked 9, start: slide is 3, allowed is -0.5 to 2.5 m"},
};

std::string nameOf(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(States, BadInput, testing::ValuesIn(kStates), nameOf);
INSTANTIATE_TEST_SUITE_P(Options, BadInput, testing::ValuesIn(kOptions), nameOf);
INSTANTIATE_TEST_SUITE_P(Files, BadInput, testing::ValuesIn(kFiles), nameOf);

/// An empty `--scene` was none: the proof was of an empty world.
TEST(BadOptions, EmptyTextsAreRefused) {
  const Gantry gantry;
  for (const std::string option : {"--scene", "--srdf", "--cloud", "--dump", "--problems",
                                   "--request", "--goal-pose", "--output"}) {
    const Outcome run =
        runSwept({"plan", gantry.urdf, "left", "right", "--group", "both", option, ""});
    EXPECT_EQ(run.exitCode, 3) << option;
    EXPECT_EQ(run.out, "") << option;
    EXPECT_EQ(run.err, kError + option + ": must not be empty (try --help)\n");
  }
  EXPECT_EQ(runSwept({"check", "", "left"}).err,
            kError + "robot: must not be empty (try --help)\n");
}

TEST(BadFiles, BrokenContentsAreNamedWithTheirFile) {
  const Gantry gantry;
  const std::string urdf = gantry.folder().write("broken.urdf", "<robot name='x'>\n  <link\n");
  const std::string scene = gantry.folder().write("broken.yaml", "world: [\n");
  const std::string problems = gantry.folder().write("broken.json", "{\n");
  for (const auto& [arguments, file] : {
           std::pair{Words{"info", urdf}, urdf},
           std::pair{Words{"info", gantry.urdf, "--scene", scene}, scene},
           std::pair{Words{"plan", gantry.urdf, "--group", "both", "--problems", problems},
                     problems},
       }) {
    const Outcome run = runSwept(arguments);
    EXPECT_EQ(run.exitCode, 3) << "signal " << run.signal;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, testing::StartsWith(file + ":"));
    EXPECT_THAT(run.err, testing::HasSubstr(": error: "));
  }
}

TEST(BadFiles, AQuaternionMustBeOfUnitLength) {
  const TemporaryFolder folder;
  const std::string urdf =
      folder.write("float.urdf",
                   "<robot name='float'><link name='ground'/><link name='body'/><joint name='free' "
                   "type='floating'><parent link='ground'/><child link='body'/></joint></robot>");
  EXPECT_EQ(runSwept({"check", urdf, "0,0,1,0,0,0.7071,0.7071"}).exitCode, 0);
  const Outcome run = runSwept({"check", urdf, "0,0,1,0,0,0,0.5"});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err,
            "swept: error: state 1: the quaternion of joint free has norm 0.5, allowed is 1\n");
}

/// Of names that come with a long list of others.
TEST(BadNames, TheNearestIsSuggested) {
  const Gantry gantry;
  const auto suggests = [&](const Words& words, const std::string& name) {
    const Outcome run = gantry.run(words.front(), {words.begin() + 1, words.end()});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_THAT(run.err, testing::EndsWith("; did you mean '" + name + "'?\n"));
  };
  suggests({"plan", "left", "right", "--planner", "RRTConect"}, "RRTConnect");
  suggests({"plan", "left", "--goal-pose", "0,0,0,0,0,0,1", "--link", "cubee"}, "cube");
  suggests({"check", "left", "--attach", "box:0.1,0.1,0.1@cubee"}, "cube");
  const Outcome set = runSwept({"plan", gantry.urdf, "--group", "both", "--problems",
                                gantry.problems, "--set", "blockd", "--index", "7"});
  EXPECT_THAT(set.err, testing::EndsWith("; did you mean 'blocked'?\n"));
  const Outcome sets = runSwept(
      {"plan", gantry.urdf, "--group", "both", "--problems", gantry.problems, "--set", "blockd"});
  EXPECT_THAT(sets.err, testing::EndsWith("; did you mean 'blocked'?\n"));
}

TEST(BadFiles, AFullDiskIsNoResult) {
  const Gantry gantry;
  const Outcome run = runShell("swept check '" + gantry.urdf + "' left --group both --scene '" +
                               gantry.scene + "' > /dev/full");
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err, "swept: error: cannot write to standard output\n");
}

}  // namespace
}  // namespace swept::test
