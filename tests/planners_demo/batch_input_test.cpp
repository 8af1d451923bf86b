// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "batch.hpp"
#include "gantry.hpp"

/// What `bench planners` and `bench summary` refuse, and what they say.
namespace swept::test {
namespace {

using testing::StartsWith;

const std::string kError = "swept: error: ";

Outcome gantryBatch(const Gantry& gantry, const Words& more) {
  Words all{"bench",      "planners",      gantry.urdf, "--group", "both",
            "--problems", gantry.problems, "--set",     "over",    "--no-times"};
  all.insert(all.end(), more.begin(), more.end());
  return runSwept(all);
}

void expectRefused(const Outcome& run, const std::string& message) {
  EXPECT_EQ(run.exitCode, 3) << message;
  EXPECT_EQ(run.out, "") << message;
  EXPECT_EQ(run.err, message + "\n");
}

TEST(BatchInput, UnknownNamesAreRefusedWithWhatThereIs) {
  const Gantry gantry;
  const std::string validators =
      "'; there are certified, discrete:R and fcl:R, with R between 1e-6 and 0.5, such as "
      "discrete:0.01";
  for (const std::string name :
       {"exact", "certified:0.1", "discrete", "discrete:", "discrete:x", "discrete:0.1m",
        "discrete:0", "discrete:0.6", "fcl:nan", "grid:0.1"})
    expectRefused(gantryBatch(gantry, {"--validators", name}),
                  kError + "no validator '" + name + validators);
  EXPECT_THAT(gantryBatch(gantry, {"--planners", "RRTConnect,RRTQuick"}).err,
              StartsWith(kError + "no planner 'RRTQuick'; there are ABITstar, AITstar, "));
  expectRefused(runSwept({"bench", "planners", gantry.urdf, "--group", "both", "--problems",
                          gantry.problems, "--set", "under"}),
                gantry.problems +
                    ": error: there is no set 'under'; there are blocked, foreign, "
                    "over");
  expectRefused(gantryBatch(gantry, {"--runs", "0"}),
                kError + "--runs: must be between 1 and 1000000, not 0 (try --help)");
}

TEST(BatchInput, FclNeedsAMarginOfZeroOrIsNotThere) {
  const Gantry gantry;
  const Outcome run = gantryBatch(gantry, {"--validators", "fcl:0.01", "--margin", "0.01"});
  if (run.err.find("this build has no FCL") != std::string::npos) {
    expectRefused(run, kError +
                           "validator 'fcl:0.01': this build has no FCL; install it and "
                           "configure again");
    return;
  }
  expectRefused(run, kError +
                         "validator 'fcl:0.01' needs a margin of 0: whether FCL finds a "
                         "collision is not a matter of distance");
}

TEST(BatchInput, WhatNoWorkerCanDoEndsTheBatchAndLeavesNoFile) {
  const Gantry gantry;
  const TemporaryFolder folder;
  expectRefused(gantryBatch(gantry, {"--allow", "cube,shelf", "-o", folder.path("r")}),
                kError +
                    "a rule names 'shelf', which is no link, attached body or body of the world "
                    "of any chosen problem");
  EXPECT_TRUE(folder.names().empty());
}

TEST(BatchInput, OptionsThatDoNotGoTogether) {
  const Gantry gantry;
  expectRefused(gantryBatch(gantry, {"--list", "--stdin"}),
                kError + "--list and --stdin cannot be combined");
  expectRefused(gantryBatch(gantry, {"--stdin", "-o", "r"}),
                kError + "--stdin and -o cannot be combined");
  expectRefused(gantryBatch(gantry, {"--list", "--json"}),
                kError + "--list prints lines; --json, --log and --csv are for `bench summary`");
  expectRefused(gantryBatch(gantry, {"--csv", "/nowhere/x.csv"}),
                kError + "cannot write '/nowhere/x.csv': No such file or directory");
  expectRefused(gantryBatch(gantry, {"--log", "/nowhere/logs"}),
                kError + "cannot make the folder '/nowhere/logs': No such file or directory");
}

TEST(BatchInput, AnotherHeaderIsRefusedByTheNameOfTheField) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string file = folder.path("r");
  ASSERT_EQ(gantryBatch(gantry, {"-o", file}).exitCode, 0);
  const std::string before = folder.read("r");
  const auto refusal = [&](const std::string& text) {
    return file + ":1: error: " + text + " on the command line";
  };
  expectRefused(gantryBatch(gantry, {"-o", file, "--margin", "0.01"}),
                refusal("margin is 0.0; it is 0.01"));
  expectRefused(gantryBatch(gantry, {"-o", file, "--time", "2"}),
                refusal("time_limit is 5.0; it is 2.0"));
  expectRefused(gantryBatch(gantry, {"-o", file, "--no-simplify"}),
                refusal("simplify is true; it is false"));
  expectRefused(gantryBatch(gantry, {"-o", file, "--pad", "cube=0.01"}),
                refusal("pad is []; it is [\"cube=0.01\"]"));
  expectRefused(gantryBatch(gantry, {"-o", file, "--no-clearance"}),
                refusal("clearance is true; it is false"));
  EXPECT_EQ(folder.read("r"), before) << "a file that is refused stays as it is";
}

TEST(BatchInput, ATornLastLineIsDroppedAndDoneAgain) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string file = folder.path("r");
  ASSERT_EQ(gantryBatch(gantry, {"-o", file}).exitCode, 0);
  const std::string whole = folder.read("r");
  // In the last result, between the two, in the first, and in the header.
  const std::size_t header = whole.find('\n') + 1;
  for (const std::size_t size : {whole.size() - 1, whole.size() - 40, header + 5, header - 1,
                                 header - 30, std::size_t{10}}) {
    folder.write("r", whole.substr(0, size));
    const std::string part = whole.substr(0, size);
    const std::size_t torn =
        size - (part.find('\n') == std::string::npos ? 0 : part.rfind('\n') + 1);
    const Outcome run = gantryBatch(gantry, {"-o", file});
    EXPECT_EQ(run.exitCode, 0) << size;
    EXPECT_EQ(run.err, "swept: warning: '" + file +
                           "': the last line has no end, and is dropped (" + std::to_string(torn) +
                           " bytes)\n");
    EXPECT_EQ(folder.read("r"), whole) << size;
  }
  const Outcome summary = runSwept({"bench", "summary", folder.write("t", whole + "{\"set\"")});
  EXPECT_EQ(summary.exitCode, 0);
  EXPECT_EQ(summary.err, "swept: warning: '" + folder.path("t") +
                             "': the last line has no end, and is dropped (6 bytes)\n");
  EXPECT_EQ(folder.read("t"), whole + "{\"set\"") << "a summary changes nothing";
}

TEST(BatchInput, OtherFilesAreRefusedAndStayAsTheyAre) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string file = folder.path("r");
  ASSERT_EQ(gantryBatch(gantry, {"-o", file}).exitCode, 0);
  const std::string whole = folder.read("r");
  const std::string notResults =
      ":1: error: not a results file: the first line must be a header with the format \"swept "
      "bench "
      "planners\"";
  std::string version = whole;
  version.replace(version.find("\"version\":1"), 11, "\"version\":2");
  std::string solved = whole;
  solved.replace(solved.find("\"solved\":true"), 13, "\"solved\":\"y\"");
  const std::string second = whole.substr(whole.find('\n') + 1);
  std::string twice = whole + second.substr(0, second.find('\n') + 1);
  twice.replace(twice.rfind("\"segments\":"), 11, "\"segments\":9");
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"a note\n", notResults},
           {"a note", notResults},
           {"{}\n", notResults},
           {version, ":1: error: version is 2; this program reads 1"},
           {solved, ":2: error: solved is \"y\"; it must be true or false"},
           {whole + "x\n", ":4: error: the line is not a JSON object"},
           {whole + "{}\n", ":4: error: set is missing"},
           {twice,
            ":4: error: another result of the run over 1 RRTConnect certified, run 1, seed "
            "1"}}) {
    folder.write("r", text);
    expectRefused(gantryBatch(gantry, {"-o", file}), file + message);
    EXPECT_EQ(folder.read("r"), text);
    expectRefused(runSwept({"bench", "summary", file}), file + message);
  }
  expectRefused(runSwept({"bench", "summary", folder.path("none")}),
                folder.path("none") + ": error: file not found");
}

TEST(BatchInput, WhatHasNoEndIsNotReadToIt) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string notResults =
      ":1: error: not a results file: the first line must be a header with the format \"swept "
      "bench planners\"";
  expectRefused(runSwept({"bench", "summary", "/dev/zero"}), "/dev/zero" + notResults);
  expectRefused(runShell("yes | swept bench summary /dev/stdin"), "/dev/stdin" + notResults);
  const std::string file = folder.path("r");
  ASSERT_EQ(gantryBatch(gantry, {"-o", file}).exitCode, 0);
  for (const std::string& before : {std::string(), "'" + file + "'"})
    expectRefused(runShell("cat '" + file + "' /dev/zero | swept bench summary " + before +
                           " /dev/stdin"),
                  "/dev/stdin:4: error: the line has more than 67108864 bytes, which are the most "
                  "that are read of one");
  expectRefused(runShell("(echo; cat /dev/zero) | swept bench planners '" + gantry.urdf +
                         "' --group both --problems '" + gantry.problems + "' --stdin"),
                "<stdin>:2: error: the line has more than 1048576 bytes, which are the most that "
                "name a run");
}

/// They were read for earlier results, and as they never end, this never did.
TEST(BatchInput, PipesAndDevicesTakeResultsAndAreNotRead) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string file = folder.path("r"), pipe = folder.path("pipe");
  ASSERT_EQ(gantryBatch(gantry, {"-o", file}).exitCode, 0);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // Open for both, so that neither end waits for the other; what is written fits into the pipe.
  const int end = open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(end, 0);
  const Outcome run = gantryBatch(gantry, {"-o", pipe});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  std::string text(65536, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(end, text.data(), text.size()))));
  close(end);
  EXPECT_EQ(sortedLines(text), sortedLines(folder.read("r")));
  expectRefused(gantryBatch(gantry, {"-o", "/dev/full"}),
                kError + "cannot write '/dev/full': No space left on device");
  expectRefused(gantryBatch(gantry, {"-o", folder.path()}),
                kError + "cannot write '" + folder.path() + "': Is a directory");
}

TEST(BatchInput, SummariesAreOfOneBatch) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string a = folder.path("a"), b = folder.path("b"), c = folder.path("c");
  ASSERT_EQ(gantryBatch(gantry, {"-o", a}).exitCode, 0);
  ASSERT_EQ(gantryBatch(gantry, {"-o", b, "--margin", "0.01"}).exitCode, 0);
  expectRefused(runSwept({"bench", "summary", a, b}),
                b + ":1: error: margin is 0.01; it is 0.0 in '" + a + "'");
  std::string other = folder.read("a");
  other.replace(other.find("\"segments\":"), 11, "\"segments\":9");
  folder.write("c", other);
  expectRefused(runSwept({"bench", "summary", a, c}),
                c + ": error: another result than in '" + a +
                    "' of the run over 1 RRTConnect certified, run 1, seed 1");
}

TEST(BatchInput, LinesOfStdinAreRefusedByLineAndField) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const std::string good =
      R"({"set":"over","index":1,"planner":"RRTConnect","validator":"certified","run":1,"seed":1})";
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [line, message] : std::vector<std::pair<std::string, std::string>>{
           {"over 1", "the line is not a JSON object"},
           {replaced("\"seed\":1", "\"sead\":1"), "seed is missing"},
           {replaced("\"seed\":1", "\"seed\":0"),
            "seed is 0; it must be a whole number between 1 and 4294967295"},
           {replaced("\"run\":1", "\"run\":1.5"),
            "run is 1.5; it must be a whole number between 1 and 2147483647"},
           {replaced("\"set\":\"over\"", "\"set\":7"), "set is 7; it must be text"},
           {replaced("\"index\":1", "\"index\":3"), "set 'over' has no problem 3; it has 1, 2"},
           {replaced("RRTConnect", "rrtconnect"),
            "planner is \"rrtconnect\"; it must be \"RRTConnect\""},
           {replaced("certified", "discrete:0.10"),
            "validator is \"discrete:0.10\"; it must be \"discrete:0.1\""},
           {good, "the run over 1 RRTConnect certified, run 1, seed 1 comes twice"}}) {
    const std::string keys = folder.write("keys", good + "\n\n" + line + "\n");
    const Outcome run =
        runShell("swept bench planners '" + gantry.urdf + "' --group both --problems '" +
                 gantry.problems + "' --stdin < '" + keys + "'");
    expectRefused(run, "<stdin>:3: error: " + message);
  }
}

TEST(BatchInput, OneProcessAtATimeWritesToAFile) {
  const TemporaryFolder folder;
  const Words batch = rook7Batch(
      {"--set", "shelf", "--runs", "10000", "--no-clearance", "-o", folder.path("r"), "-q"});
  RunningProgram program(batch);
  ASSERT_TRUE(waitFor([&] { return !folder.read("r").empty(); }));
  expectRefused(runSwept(batch), kError + "cannot write '" + folder.path("r") +
                                     "': another process is writing to it");
}

}  // namespace
}  // namespace swept::test
