// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "batch.hpp"
#include "folder_watch.hpp"
#include "gantry.hpp"

/// What `swept report` refuses, and what a signal leaves behind.
namespace swept::test {
namespace {

std::string errorOf(const Words& more) {
  Words all{"report", "models/robots/rook7/rook7.urdf", "--group", "arm"};
  all.insert(all.end(), more.begin(), more.end());
  const Outcome run = runSwept(all);
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.out, "");
  return run.err;
}

TEST(ReportInput, OptionsOutOfRangeAreNamed) {
  EXPECT_EQ(errorOf({"--resolutions", "0.1,0.7"}),
            "swept: error: --resolutions: must be between 1e-6 and 0.5, not 0.7 (try --help)\n");
  EXPECT_EQ(errorOf({"--resolutions", "fine"}),
            "swept: error: --resolutions: must be between 1e-6 and 0.5, not fine (try --help)\n");
  EXPECT_EQ(errorOf({"--tolerances", "0"}),
            "swept: error: --tolerances: must be between 1e-6 and 1 m, not 0 (try --help)\n");
  EXPECT_EQ(errorOf({"--motions", "0"}),
            "swept: error: --motions: must be between 1 and 1e7, not 0 (try --help)\n");
  EXPECT_EQ(errorOf({"--problems", "models/problems.json", "--every", "0"}),
            "swept: error: --every: must be 1 or more, not 0 (try --help)\n");
  EXPECT_EQ(errorOf({"--against", "bullet"}),
            "swept: error: --against: must be fcl, not bullet (try --help)\n");
  EXPECT_EQ(errorOf({"--every", "2"}), "swept: error: --every requires --problems (try --help)\n");
}

TEST(ReportInput, WorldsThatCannotBeUsedAreNamed) {
  const std::string problems = "models/problems.json";
  EXPECT_EQ(
      errorOf({"--problems", problems, "--scene", "models/scenes/shelf.yaml"}),
      "swept: error: --scene and --problems cannot be combined: the problem has its own world\n");
  EXPECT_EQ(
      errorOf({"--problems", problems, "--cloud", "models/clouds/shelf.bt"}),
      "swept: error: --cloud and --problems cannot be combined: the problem has its own world\n");
  EXPECT_THAT(errorOf({"--problems", problems, "--set", "attic"}),
              testing::HasSubstr("error: there is no set 'attic'; there are bin, "));
  EXPECT_EQ(errorOf({"--problems", problems, "--motions", "12"}),
            "swept: error: --motions 12 is less than one for each of 13 worlds\n");
}

TEST(ReportInput, FilesThatCannotBeWrittenAreNamedBeforeTheWork) {
  EXPECT_EQ(errorOf({"--csv", "nowhere/r.csv"}),
            "swept: error: cannot write 'nowhere/r.csv': No such file or directory\n");
  EXPECT_EQ(errorOf({"-o", "models"}), "swept: error: cannot write 'models': Is a directory\n");
  EXPECT_EQ(errorOf({"--svg", "nowhere/r"}),
            "swept: error: cannot write 'nowhere/r-missed.svg': No such file or directory\n");
  EXPECT_EQ(errorOf({"--html", "page.pdf"}),
            "swept: error: 'page.pdf': a page ends in .html or .htm\n");
}

TEST(ReportInput, AWorldWithoutAFreeStateIsNamed) {
  const Gantry gantry;
  const std::string wall = gantry.folder().write("wall.yaml", R"(name: all
world:
  collision_objects:
    - id: everywhere
      operation: add
      header: {frame_id: world}
      primitives:
        - {type: box, dimensions: [20, 20, 20]}
      primitive_poses:
        - {position: [1, 0, 0], orientation: [0, 0, 0, 1]}
)");
  const Outcome run =
      runSwept({"report", gantry.urdf, "--group", "both", "--scene", wall, "--motions", "1"});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err, "swept: error: wall: of 100000 random states none is proven free\n");
}

/// Whether a process has a handler of its own for SIGINT.
bool catchesInterrupt(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("SigCgt:")) continue;
    return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  return false;
}

/// As soon as it may be asked to stop, and among its motions: it writes no file before the last.
TEST(ReportInput, ASignalLeavesNothingBehind) {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const auto delay : {std::chrono::milliseconds(0), std::chrono::milliseconds(400)}) {
      RunningProgram program({"report", "models/robots/rook7/rook7.urdf", "--group", "arm",
                              "--scene", "models/scenes/shelf.yaml", "--motions", "1000000",
                              "--csv", folder.path("r.csv"), "--svg", folder.path("r"), "--html",
                              folder.path("r.html"), "-o", folder.path("m.csv")});
      ASSERT_TRUE(waitFor([&] { return catchesInterrupt(program.pid()); }));
      std::this_thread::sleep_for(delay);
      kill(program.pid(), signal);
      EXPECT_EQ(program.wait(), 130);
      EXPECT_THAT(folder.names(), testing::IsEmpty());
    }
  }
}

/// The work is done by then, and some of the files are there: it writes the others too.
TEST(ReportInput, ASignalAmongTheFilesLeavesAllOfThem) {
  const Gantry gantry;
  const auto report = [&](const TemporaryFolder& folder) {
    return gantry.arguments(
        "report", {"--motions", "4", "--passes", "1", "--resolutions", "0.1", "--tolerances",
                   "0.01", "--csv", folder.path("r.csv"), "--svg", folder.path("r"), "--html",
                   folder.path("r.html"), "-o", folder.path("m.csv")});
  };
  const TemporaryFolder whole;
  ASSERT_EQ(runSwept(report(whole)).exitCode, 0);
  ASSERT_THAT(whole.names(), testing::IsSupersetOf({"m.csv", "r.csv", "r.html"}));
  constexpr int kMany = 100;
  for (const int signal : {SIGINT, SIGTERM}) {
    int met = 0;
    for (int i = 0; i < kMany && met < 2; ++i) {
      const TemporaryFolder folder;
      FolderWatch watch(folder.path());
      RunningProgram program(report(folder));
      ASSERT_TRUE(watch.waitFor(program, [&] { return !folder.names().empty(); }));
      // The page is the last.
      const bool early = !std::filesystem::exists(folder.path("r.html"));
      kill(program.pid(), signal);
      const int code = program.wait();
      // Who comes after the last file ends the program in the usual way.
      EXPECT_THAT(code, testing::AnyOf(0, -signal));
      met += early && code == 0 ? 1 : 0;
      EXPECT_EQ(folder.names(), whole.names());
      for (const std::string& name : folder.names()) EXPECT_NE(folder.read(name), "") << name;
      EXPECT_THAT(folder.read("r.html"), testing::EndsWith("</html>\n"));
    }
    EXPECT_EQ(met, 2);
  }
}

TEST(ReportInput, ProgressIsForTerminals) {
  const Words words{"report",        "models/robots/rook7/rook7.urdf",
                    "--group",       "arm",
                    "--scene",       "models/scenes/shelf.yaml",
                    "--motions",     "300",
                    "--passes",      "60",
                    "--tolerances",  "0.01",
                    "--resolutions", "0.01"};
  EXPECT_THAT(runSwept(words, Stderr::Terminal).err, testing::HasSubstr(" of 36000 answers, "));
  EXPECT_EQ(runSwept(words).err, "");
}

/// Few motions, asked about often: the pairs of shapes take longer, and draw the bar at its end.
TEST(ReportInput, ProgressEndsWithTheMotions) {
  const Outcome run = runSwept({"report", "models/robots/rook7/rook7.urdf", "--group", "arm",
                                "--scene", "models/scenes/shelf.yaml", "--motions", "30",
                                "--passes", "60", "--tolerances", "0.01", "--resolutions", "0.01"},
                               Stderr::Terminal);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.err, testing::HasSubstr(" of 3600 answers, "));
}

/// FCL's states are other code's: what they miss is what our states miss.
TEST(ReportAgainstFcl, MissesTheSame) {
  const Outcome run =
      runSwept({"report", "models/robots/rook7/rook7.urdf", "--group", "arm", "--scene",
                "models/scenes/tunnel_trap.yaml", "--motions", "400", "--passes", "1",
                "--resolutions", "0.1,0.02", "--tolerances", "0.01", "--against", "fcl", "--json"});
  if (run.err.find("has no FCL") != std::string::npos) GTEST_SKIP() << run.err;
  const auto json = jsonOf(run);
  std::map<double, std::map<std::string, int>> missed;
  for (const auto& row : json["rows"])
    if (row["part"] == "motions") missed[row["setting"]][row["method"]] = row["missed"];
  for (const double resolution : {0.1, 0.02}) {
    EXPECT_GE(missed[resolution]["discrete"], 3);
    EXPECT_NEAR(missed[resolution]["fcl"], missed[resolution]["discrete"], 1);
  }
  EXPECT_TRUE(json["machine"].contains("FCL"));
}

}  // namespace
}  // namespace swept::test
