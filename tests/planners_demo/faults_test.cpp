// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "batch.hpp"
#include "gantry.hpp"

/// Full disks, no memory, signals, closed streams, files that change: an error that says so, and no
/// half of a result.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kRook = "models/robots/rook7/rook7.urdf";
const std::string kPlan = "swept plan " + kRook + " home ready --group arm -q ";

/// What is in a folder but for the files that are expected.
std::vector<std::string> others(const TemporaryFolder& folder, const std::string& expected) {
  std::vector<std::string> names = folder.names();
  std::erase(names, expected);
  return names;
}

TEST(Faults, AFullDiskLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  const std::string file = folder.write("path.json", "old");
  // Blocks of 512 or 1024 bytes; a path file has more.
  const Outcome run = runShell("ulimit -f 1; " + kPlan + "-o '" + file + "'");
  EXPECT_EQ(run.exitCode, 3) << "signal " << run.signal;
  EXPECT_EQ(run.err, "swept: error: cannot write '" + file + "': File too large\n");
  EXPECT_EQ(folder.read("path.json"), "old");
  EXPECT_THAT(others(folder, "path.json"), testing::IsEmpty());
}

TEST(Faults, StandardOutputThatCannotBeWrittenIsNoSuccess) {
  for (const std::string& command : std::vector<std::string>{
           "check " + kRook + " home --group arm", "info " + kRook, "replay models/cases.json",
           "acm models/robots/drifter/drifter.urdf", "completion bash",
           "bench planners " + kRook +
               " --group arm --problems models/problems.json --set empty --stdin < /dev/null"}) {
    const Outcome run = runShell("swept " + command + " > /dev/full");
    EXPECT_EQ(run.exitCode, 3) << command;
    EXPECT_THAT(run.err, HasSubstr("swept: error: cannot write to standard output\n")) << command;
  }
}

TEST(Faults, ClosedStreamsAreNoCrash) {
  const std::string check = "swept check " + kRook + " home --group arm ";
  EXPECT_EQ(runShell(check + "<&-").exitCode, 0);
  EXPECT_EQ(runShell(check + ">&-").exitCode, 3);
  EXPECT_EQ(runShell(check + "2>&-").exitCode, 0);
  EXPECT_EQ(runShell("swept check no.urdf home 2>&-").exitCode, 3);
}

/// From no memory for the robot to enough for all: an answer or a clear error, at each limit.
TEST(Faults, NoMemoryIsAnErrorThatSaysSo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes all addresses there are";
#endif
  int answers = 0, refusals = 0;
  for (int kilobytes = 60'000; kilobytes <= 180'000; kilobytes += 20'000) {
    const Outcome run = runShell("ulimit -v " + std::to_string(kilobytes) + "; swept check " +
                                 kRook + " home --group arm --scene models/scenes/shelf.yaml");
    if (run.exitCode == 0) {
      ++answers;
      EXPECT_THAT(run.out, testing::StartsWith("state 1 (home): free, clearance 0.05"));
    } else if (run.exitCode == 127) {
      EXPECT_THAT(run.err, HasSubstr("shared libraries")) << "not even the program's libraries fit";
    } else {
      ++refusals;
      EXPECT_EQ(run.exitCode, 3) << "signal " << run.signal << " at " << kilobytes << " kB";
      EXPECT_EQ(run.out, "");
      EXPECT_THAT(run.err, HasSubstr("out of memory")) << kilobytes;
    }
  }
  EXPECT_GT(answers, 0);
  EXPECT_GT(refusals, 0);
}

/// Killed at any moment of writing, what is there is the whole old file or the whole new one.
TEST(Faults, AFileIsThereWholeOrNotAtAllWhenTheProgramIsKilled) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"left", "right", "-q", "-o", file}).exitCode, 0);
  int killed = 0;
  for (int delay = 0; delay < 60; ++delay) {
    RunningProgram program(
        gantry.arguments("plan", {"left", "right", "-q", "--embed", "-o", file}));
    std::this_thread::sleep_for(std::chrono::microseconds(500 * delay));
    kill(program.pid(), SIGKILL);
    killed += program.wait() == -SIGKILL ? 1 : 0;
    const json path = json::parse(gantry.folder().read("path.json"), nullptr, false);
    ASSERT_TRUE(path.is_object());
    ASSERT_TRUE(path.contains("proof"));
  }
  EXPECT_GT(killed, 20) << "not too late";
}

TEST(Faults, AnInterruptEndsEachLongCommand) {
  const TemporaryFolder folder;
  const std::vector<Words> commands{
      {"plan", kRook, "home", "-2.8,0,0,0,0,0,0", "--group", "arm", "--scene",
       "models/scenes/cage.yaml", "--planner", "RRTstar", "--time", "60", "-o",
       folder.path("p.json")},
      {"plan", kRook, "--group", "arm", "--problems", "models/problems.json", "--set",
       "narrow_slot", "--time", "60", "--planner", "RRTstar"},
      {"acm", kRook, "--samples", "100000000", "-o", folder.path("o.srdf")},
      {"bench", "edges", kRook, "--group", "arm", "--problems", "models/problems.json", "--edges",
       "models/edges.csv", "--passes", "10000"}};
  for (const Words& command : commands) {
    RunningProgram program(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    kill(program.pid(), SIGINT);
    EXPECT_EQ(program.wait(), -SIGINT) << testing::PrintToString(command);
  }
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

/// Each run sees a whole file, an empty one, or half of it.
TEST(Faults, ASceneThatChangesWhileItIsReadIsReadOrRefused) {
  const Gantry gantry;
  const std::string whole = gantry.folder().read("post.yaml");
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (std::size_t i = 0; !done; ++i) {
      std::ofstream stream(gantry.scene, std::ios::binary | std::ios::trunc);
      stream << whole.substr(0, whole.size() / 2) << std::flush << whole.substr(whole.size() / 2);
      stream.close();
      if (i % 2 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  int read = 0;
  for (int i = 0; i < 60; ++i) {
    const Outcome run = gantry.run("check", {"inside"});
    EXPECT_EQ(run.signal, 0);
    EXPECT_THAT(run.exitCode, testing::AnyOf(0, 1, 3)) << run.err;
    // Free: the scene was empty at that moment, which is a scene.
    if (run.exitCode == 3) {
      EXPECT_THAT(run.err, HasSubstr("post.yaml"));
    }
    read += run.exitCode != 3 ? 1 : 0;
  }
  done = true;
  writer.join();
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace swept::test
