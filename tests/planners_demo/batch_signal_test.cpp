// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "batch.hpp"
#include "folder_watch.hpp"
#include "gantry.hpp"

namespace swept::test {
namespace {

using nlohmann::json;

/// 3 problems, 40 seeds: a second or two.
Words manyRuns(const Words& more) {
  Words all{"--set", "shelf", "--runs", "40", "--no-times", "--no-clearance", "-q"};
  all.insert(all.end(), more.begin(), more.end());
  return rook7Batch(all);
}

std::size_t linesIn(const TemporaryFolder& folder, const std::string& name) {
  const std::string text = folder.read(name);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// A program while it writes results, which are told by their lines.
class RunningBatch {
 public:
  RunningBatch(const TemporaryFolder& folder, const Words& arguments)
      : folder_(folder), watch_(folder.path()), program(arguments) {}

  bool waitForLines(std::size_t count) {
    return watch_.waitFor(program, [&] { return linesIn(folder_, "r") >= count; });
  }

 private:
  const TemporaryFolder& folder_;
  FolderWatch watch_;  // before the program: it sees its first line

 public:
  RunningProgram program;
};

const std::vector<std::string>& uninterrupted() {
  static const std::vector<std::string> lines = [] {
    const TemporaryFolder folder;
    EXPECT_EQ(runSwept(manyRuns({"-o", folder.path("whole")})).exitCode, 0);
    return sortedLines(folder.read("whole"));
  }();
  return lines;
}

/// Starts it again and again, ending it each time at a random number of results and within the two
/// runs that follow, whatever a run takes on this machine; and at last not.
void endAndResume(int signal, int exitCode, const std::string& jobs, unsigned seed) {
  using Clock = std::chrono::steady_clock;
  const TemporaryFolder folder;
  const Words arguments = manyRuns({"-o", folder.path("r"), "--jobs", jobs});
  std::mt19937 random(seed);
  std::size_t lines = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t more = std::uniform_int_distribution<std::size_t>(3, 14)(random);
    RunningBatch batch(folder, arguments);
    RunningProgram& program = batch.program;
    ASSERT_TRUE(batch.waitForLines(lines + 2));
    const auto second = Clock::now();
    ASSERT_TRUE(batch.waitForLines(lines + more));
    const auto oneRun = (Clock::now() - second) / (more - 2);
    std::this_thread::sleep_for(std::uniform_real_distribution(0.0, 2.0)(random) * oneRun);
    const std::vector<pid_t> workers = program.workers();
    EXPECT_FALSE(workers.empty());
    kill(program.pid(), signal);
    EXPECT_EQ(program.wait(), exitCode);
    for (const pid_t worker : workers)
      EXPECT_TRUE(waitFor([&] { return kill(worker, 0) != 0; })) << "a worker outlives the program";
    lines = linesIn(folder, "r");
    EXPECT_LT(lines, uninterrupted().size()) << "it was done before it was ended";
  }
  EXPECT_EQ(runSwept(arguments).exitCode, 0);
  EXPECT_EQ(sortedLines(folder.read("r")), uninterrupted());
  // There is nothing left to do.
  const std::string before = folder.read("r");
  EXPECT_EQ(runSwept(arguments).exitCode, 0);
  EXPECT_EQ(folder.read("r"), before);
}

TEST(BatchSignals, ResumedAfterSigintIsTheWholeBatch) {
  ASSERT_EQ(uninterrupted().size(), 121u);
  endAndResume(SIGINT, 130, "2", 1);
}

TEST(BatchSignals, ResumedAfterSigtermIsTheWholeBatch) {
  endAndResume(SIGTERM, 130, "1", 2);
}

TEST(BatchSignals, ResumedAfterSigkillIsTheWholeBatch) {
  endAndResume(SIGKILL, -SIGKILL, "2", 3);
}

TEST(BatchSignals, TheTableOfWhatIsDoneIsPrinted) {
  const TemporaryFolder folder;
  const std::string file = folder.path("r");
  // The shell waits for four lines, the program's own output being the only one.
  const Outcome run = runShell(
      "swept bench planners models/robots/rook7/rook7.urdf --group arm --problems "
      "models/problems.json --set shelf --runs 10000 --no-clearance -q -o '" +
      file + "' --csv '" + folder.path("csv") + "' & p=$!; " +
      "while kill -0 $p && ! sed -n '4{p;q}' '" + file +
      "' 2>/dev/null | grep -q solved; do sleep 0.02; done; " + "kill -TERM $p; wait $p");
  EXPECT_EQ(run.exitCode, 130);
  EXPECT_EQ(run.err, "");
  const std::string done = std::to_string(linesIn(folder, "r") - 1);
  EXPECT_THAT(run.out,
              testing::ContainsRegex("\nshelf +RRTConnect +certified +" + done + "/" + done + " "));
  EXPECT_THAT(folder.names(), testing::ElementsAre("r")) << "half a CSV looks like a whole one";
}

TEST(BatchSignals, WorkersAreForkedFromOneThread) {
  const TemporaryFolder folder;
  RunningBatch batch(folder, manyRuns({"-o", folder.path("r"), "--jobs", "2"}));
  RunningProgram& program = batch.program;
  ASSERT_TRUE(waitFor([&] { return program.workers().size() == 2; }));
  EXPECT_EQ(program.threads(), 1);
  ASSERT_TRUE(batch.waitForLines(5));
  EXPECT_EQ(program.threads(), 1);
}

TEST(BatchSignals, AWorkerThatHangsDoesNotOutliveTheProgram) {
  const TemporaryFolder folder;
  RunningBatch batch(folder, manyRuns({"-o", folder.path("r")}));
  RunningProgram& program = batch.program;
  ASSERT_TRUE(batch.waitForLines(5));
  const pid_t worker = program.workers().at(0);
  kill(worker, SIGSTOP);
  kill(program.pid(), SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  const bool gone = waitFor([&] { return kill(worker, 0) != 0; });
  EXPECT_TRUE(gone);
  if (!gone) kill(worker, SIGKILL);
}

/// What is in `some` and not in `all`, both sorted.
std::vector<std::string> differing(const std::vector<std::string>& some,
                                   const std::vector<std::string>& all) {
  std::vector<std::string> lines;
  std::ranges::set_difference(some, all, std::back_inserter(lines));
  return lines;
}

/// Clock ticks of processor time, of a process that is there.
std::uint64_t ticksOf(pid_t process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  std::string skipped;
  std::getline(stream, skipped, ')');  // its name
  for (int i = 0; i < 11; ++i) stream >> skipped;
  std::uint64_t user = 0, system = 0;
  stream >> user >> system;
  return user + system;
}

/// One that has had runs. On a busy machine another may not even have begun to read its robot, and
/// without that worker the program ends.
pid_t busiest(const std::vector<pid_t>& workers) {
  return *std::ranges::max_element(workers, {}, ticksOf);
}

TEST(BatchSignals, AWorkerThatDiesLosesItsRunOnly) {
  const TemporaryFolder folder;
  RunningBatch batch(folder, manyRuns({"-o", folder.path("r"), "--jobs", "2"}));
  RunningProgram& program = batch.program;
  ASSERT_TRUE(batch.waitForLines(8));
  const std::vector<pid_t> workers = program.workers();
  ASSERT_EQ(workers.size(), 2u);
  kill(busiest(workers), SIGKILL);
  EXPECT_EQ(program.wait(), 0);
  const std::vector<std::string> lines = sortedLines(folder.read("r"));
  ASSERT_EQ(lines.size(), uninterrupted().size());
  const std::vector<std::string> lost = differing(lines, uninterrupted());
  // Between two runs it has none to lose.
  ASSERT_LE(lost.size(), 1u);
  for (const std::string& line : lost) {
    const json run = json::parse(line);
    EXPECT_EQ(run["failure"], "stopped by signal 9");
    EXPECT_EQ(run["status"], "Crash");
    EXPECT_EQ(run["solved"], false);
    EXPECT_EQ(run["states_checked"], nullptr);
  }
}

TEST(BatchSignals, AWorkerThatHangsIsStoppedAtTheHardLimit) {
  const TemporaryFolder folder;
  RunningBatch batch(folder, manyRuns({"-o", folder.path("r"), "--hard-limit", "1.5"}));
  RunningProgram& program = batch.program;
  ASSERT_TRUE(batch.waitForLines(8));
  // Until it hangs in a run: a worker between two is given one, and hangs in that.
  const pid_t worker = program.workers().at(0);
  kill(worker, SIGSTOP);
  ASSERT_TRUE(waitFor([&] { return kill(worker, 0) != 0; })) << "it still hangs";
  EXPECT_EQ(program.wait(), 0);
  std::vector<json> lost;
  for (const json& run : jsonLines(folder.read("r")))
    if (run.contains("solved") && run["solved"] == false) lost.push_back(run);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0]["failure"], "stopped after 1.5 s");
  EXPECT_EQ(linesIn(folder, "r"), uninterrupted().size());
}

/// With seed 6 an assertion of OMPL's own ends LazyLBTRRT's process in the first problem, within a
/// millisecond; otherwise it optimizes for as long as it may.
TEST(BatchSignals, APlannerThatCrashesDoesNotHurtTheOthers) {
  const Gantry gantry;
  const TemporaryFolder folder;
  const Words batch{"bench",
                    "planners",
                    gantry.urdf,
                    "--group",
                    "both",
                    "--problems",
                    gantry.problems,
                    "--set",
                    "over",
                    "--time",
                    "1",
                    "--seed",
                    "6",
                    "--runs",
                    "2",
                    "--no-times",
                    "-o",
                    folder.path("r"),
                    "--planners",
                    "LazyLBTRRT,RRTConnect"};
  ASSERT_EQ(runSwept(batch).exitCode, 0);
  int certified = 0, crashed = 0;
  for (const json& run : jsonLines(folder.read("r"))) {
    if (run.contains("format")) continue;
    certified += run["certified"] == true ? 1 : 0;
    if (run["solved"] == true) continue;
    ++crashed;
    EXPECT_EQ(run["planner"], "LazyLBTRRT");
    EXPECT_EQ(run["seed"], 6);
    EXPECT_EQ(run["failure"], "stopped by signal 6");
  }
  EXPECT_EQ(certified, 7);
  EXPECT_EQ(crashed, 1);
}

}  // namespace
}  // namespace swept::test
