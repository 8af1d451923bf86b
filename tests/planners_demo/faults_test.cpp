// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>
#include <thread>
#include <utility>

#include "batch.hpp"
#include "folder_watch.hpp"
#include "gantry.hpp"
#include "sanitizers.hpp"

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
#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
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

/// Plans over an old file, of which a new one differs, and is killed meanwhile. A cloud out of the
/// arm's reach is embedded, so that there is much to write.
class KilledWriter {
  using Clock = std::chrono::steady_clock;

 public:
  KilledWriter() {
    std::string points;
    for (int i = 0; i < 20'000; ++i)
      points += std::to_string(5 + i % 97) + " 3 " + std::to_string(i % 89) + "\n";
    const std::string cloud = gantry_.folder().write("far.xyz", points);
    arguments_ = gantry_.arguments("plan", {"left", "right", "-q", "--embed", "--cloud", cloud,
                                            "--point-radius", "0.01", "-o", path()});
  }

  int old = 0;    ///< runs that left the old file
  int whole = 0;  ///< runs that left a new one
  int met = 0;    ///< runs that were killed while they wrote
  Clock::duration run{}, writing{};

  /// Not killed: how long a run takes, and how long its writing.
  void measure() {
    output_.write(kFile, kOld);
    FolderWatch watch(output_.path());
    const auto start = Clock::now();
    RunningProgram program(arguments_);
    EXPECT_TRUE(watch.waitFor(program, [this] { return writes(); }));
    const auto written = Clock::now();
    EXPECT_EQ(program.wait(), 0);
    run = Clock::now() - start;
    writing = Clock::now() - written;
    judge();
    EXPECT_EQ(whole, 1);
  }

  void killAfterStart(Clock::duration delay) {
    output_.write(kFile, kOld);
    RunningProgram program(arguments_);
    end(program, delay);
  }

  void killAsItWrites(Clock::duration delay) {
    output_.write(kFile, kOld);
    FolderWatch watch(output_.path());
    RunningProgram program(arguments_);
    watch.waitFor(program, [this] { return writes(); });
    end(program, delay);
  }

 private:
  static constexpr const char* kFile = "path.json";
  static constexpr const char* kOld = "old";

  std::string path() const { return output_.path(kFile); }

  /// A file beside the old one, or another size of that: a program that does it wrong is met too.
  bool writes() const {
    std::error_code gone;
    return !others(output_, kFile).empty() ||
           std::filesystem::file_size(path(), gone) != std::string_view(kOld).size();
  }

  void end(RunningProgram& program, Clock::duration delay) {
    if (delay > Clock::duration::zero()) std::this_thread::sleep_for(delay);
    kill(program.pid(), SIGKILL);
    program.wait();
    judge();
  }

  void judge() {
    const std::string text = output_.read(kFile);
    if (text == kOld) {
      ++old;
    } else {
      const json file = json::parse(text, nullptr, false);
      EXPECT_TRUE(file.is_object() && file.contains("proof")) << text.size() << " bytes";
      ++whole;
    }
    const std::vector<std::string> left = others(output_, kFile);
    if (left.empty()) return;
    EXPECT_EQ(text, kOld);
    EXPECT_THAT(left, testing::ElementsAre(testing::StartsWith(".path.json.")));
    std::filesystem::remove(output_.path(left.front()));
    ++met;
  }

  Gantry gantry_;
  TemporaryFolder output_;
  Words arguments_;
};

/// Killed at any moment, also of writing, what is there is the whole old file or the whole new one.
TEST(Faults, AFileIsThereWholeOrNotAtAllWhenTheProgramIsKilled) {
  KilledWriter writer;
  writer.measure();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.2);
  const auto part = [&](std::chrono::steady_clock::duration all) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(share(random) * all);
  };
  for (int i = 0; i < 12 && !testing::Test::HasFailure(); ++i)
    writer.killAfterStart(part(writer.run));
  // Who is told late of the writing comes too late; so often it happens to nobody.
  constexpr int kMany = 300;
  const auto enough = [&] { return writer.met >= 5 && writer.old >= 5 && writer.whole >= 5; };
  for (int i = 0; i < kMany && (i < 24 || !enough()) && !testing::Test::HasFailure(); ++i)
    writer.killAsItWrites(i % 2 == 0 ? std::chrono::steady_clock::duration::zero()
                                     : part(writer.writing));
  EXPECT_GE(writer.met, 5);
  EXPECT_GE(writer.old, 5);
  EXPECT_GE(writer.whole, 5);
  RecordProperty("met", writer.met);
  RecordProperty("old", writer.old);
  RecordProperty("whole", writer.whole);
}

/// None of these writes before its end, so that there is nothing yet for a signal to leave behind.
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

/// Writes a file again and again: at once, and with pauses while it is empty and half.
class RestlessWriter {
 public:
  RestlessWriter(std::string file, std::string text, std::size_t half,
                 std::chrono::steady_clock::duration pause)
      : file_(std::move(file)), text_(std::move(text)), half_(half), pause_(pause) {}
  ~RestlessWriter() {
    done_ = true;
    thread_.join();
  }
  RestlessWriter(const RestlessWriter&) = delete;
  RestlessWriter& operator=(const RestlessWriter&) = delete;

 private:
  void run() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const auto rest = [&] { std::this_thread::sleep_for(share(random) * pause_); };
    for (std::size_t i = 0; !done_; ++i) {
      const bool slowly = i % 4 == 0;
      std::ofstream stream(file_, std::ios::binary | std::ios::trunc);
      if (slowly) rest();
      stream << text_.substr(0, half_) << std::flush;
      if (slowly) rest();
      stream << text_.substr(half_);
      stream.close();
      if (slowly) rest();
    }
  }

  std::string file_, text_;
  std::size_t half_;
  std::chrono::steady_clock::duration pause_;
  std::atomic<bool> done_ = false;
  std::thread thread_{[this] { run(); }};  // last: it uses the others
};

/// Each run sees a whole file, an empty one, or half of it.
TEST(Faults, ASceneThatChangesWhileItIsReadIsReadOrRefused) {
  const Gantry gantry;
  const std::string text = gantry.folder().read("post.yaml");
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(gantry.run("check", {"inside"}).exitCode, 1);
  const RestlessWriter writer(gantry.scene, text, text.find("dimensions") + 14,
                              std::chrono::steady_clock::now() - start);
  int whole = 0, empty = 0, half = 0;
  constexpr int kMany = 2000;
  const auto enough = [&] { return whole >= 3 && empty >= 3 && half >= 3; };
  for (int i = 0; i < kMany && (i < 60 || !enough()); ++i) {
    const Outcome run = gantry.run("check", {"inside"});
    ASSERT_EQ(run.signal, 0);
    ASSERT_THAT(run.exitCode, testing::AnyOf(1, 3)) << run.err;
    if (run.exitCode == 1) {
      ++whole;
    } else if (run.err.ends_with("post.yaml:1: error: a planning scene must be a mapping\n")) {
      ++empty;
    } else {
      ASSERT_THAT(run.err, HasSubstr("post.yaml:8: error: malformed YAML: "));
      ++half;
    }
  }
  EXPECT_GE(whole, 3);
  EXPECT_GE(empty, 3);
  EXPECT_GE(half, 3);
}

}  // namespace
}  // namespace swept::test
