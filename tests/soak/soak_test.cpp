// SPDX-License-Identifier: BSD-3-Clause
// The soak can fail: answers that are wrong, or not the same again, memory that grows, and worlds
// in which nothing happens are noticed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "drawer.hpp"
#include "models_dir.hpp"
#include "run.hpp"
#include "sanitizers.hpp"

namespace soak {
namespace {

using swept::MotionCertificate;
using swept::Verdict;
using testing::HasSubstr;

const Options& smallOptions() {
  static const Options options = [] {
    Options o;
    o.states = 60'000;
    o.motions = 6'000;
    o.threads = 3;
    o.updates = 50;
    o.sampleOneIn = 100;
    o.growth = 100.0;
    const auto folder = std::filesystem::path(modelsDir()) / "robots/rook6";
    o.files.robot = folder / "rook6.urdf";
    o.files.srdf = folder / "rook6.srdf";
    o.files.group = "arm";
    return o;
  }();
  return options;
}

/// Samples with right answers, of random queries with a verdict.
class Judged : public testing::Test {
 protected:
  Judged()
      : stages_(makeStages(smallOptions())),
        line_(*stages_.front(), 1),
        drawer_(stages_.front()->empty(), 5) {}

  Sample sampleOf(Verdict verdict, bool motion) {
    Sample sample{.version = line_.current()};
    sample.from.resize(static_cast<std::size_t>(stages_.front()->empty().dimension()));
    if (motion) sample.to = sample.from;
    do {
      motion ? drawer_.motion(sample.from, sample.to) : drawer_.state(sample.from);
      sample.answer = ask(*sample.version->checker, sample);
      drawer_.learn(sample.from, ask(*sample.version->checker, stateOf(sample)).verdict);
    } while (sample.answer.verdict != verdict);
    return sample;
  }
  static Sample stateOf(const Sample& sample) {
    return {.version = sample.version, .from = sample.from};
  }

  /// What the judge prints; empty: nothing to complain of.
  static std::string complaints(const Sample& sample) {
    std::ostringstream out;
    Failures failures(out);
    Refutation(smallOptions().seed, failures).judge(sample);
    EXPECT_EQ(failures.count() > 0, !out.str().empty());
    return out.str();
  }

  std::vector<std::unique_ptr<Stage>> stages_;
  WorldLine line_;
  Drawer drawer_;
};

TEST_F(Judged, RightAnswersPass) {
  for (const Verdict verdict : {Verdict::Free, Verdict::Collision}) {
    for (const bool motion : {false, true}) {
      for (int i = 0; i < 5; ++i) EXPECT_EQ(complaints(sampleOf(verdict, motion)), "");
      line_.update();
    }
  }
}

TEST_F(Judged, AWrongVerdictOfAStateIsRefutedAndCanBeAskedAgain) {
  Sample sample = sampleOf(Verdict::Collision, false);
  sample.answer.verdict = Verdict::Free;
  const std::string said = complaints(sample);
  EXPECT_THAT(said, HasSubstr("REFUTED: said to be free, but "));
  EXPECT_THAT(said, HasSubstr("asked again of the same version by one thread: collision"));
  EXPECT_THAT(said, HasSubstr("--world " + toString(sample.version->key) + " --from="));

  sample = sampleOf(Verdict::Free, false);
  for (const Verdict wrong : {Verdict::Collision, Verdict::Undecided}) {
    sample.answer.verdict = wrong;
    EXPECT_THAT(complaints(sample), HasSubstr("but nothing is closer than"));
  }
}

TEST_F(Judged, AWrongVerdictOfAMotionIsRefuted) {
  Sample sample = sampleOf(Verdict::Collision, true);
  const MotionCertificate right = sample.answer;
  sample.answer = {
      .verdict = Verdict::Free, .freeUntil = 1.0, .witness = {}, .violation = {}, .effort = {}};
  EXPECT_THAT(complaints(sample), HasSubstr("REFUTED: said to be free"));

  sample.answer = right;
  sample.answer.witness->pointA.z() += 1e-3;
  EXPECT_THAT(complaints(sample), HasSubstr("the witness does not hold"));

  sample = sampleOf(Verdict::Free, true);
  sample.answer = right;
  EXPECT_THAT(complaints(sample), HasSubstr("the witness does not hold"));
}

TEST_F(Judged, AnAnswerThatDiffersInTheLastBitIsNoticed) {
  Sample sample = sampleOf(Verdict::Collision, true);
  sample.answer.witness->t = std::nextafter(sample.answer.witness->t, 2.0);
  EXPECT_THAT(complaints(sample), HasSubstr("asked again of the same version"));
}

TEST_F(Judged, AWorldThatIsNotTheVersionsIsNoticed) {
  // As if bodies were taken away while the version is in use.
  Sample sample = sampleOf(Verdict::Collision, false);
  while (ask(stages_.front()->empty(), sample).verdict != Verdict::Free)
    sample = sampleOf(Verdict::Collision, false);
  const swept::Checker checker = *sample.version->checker;
  sample.version = std::make_shared<const Version>(*stages_.front(), WorldKey{}, checker);
  const std::string said = complaints(sample);
  EXPECT_THAT(said, HasSubstr("asked again in the same world made anew: free"));
  EXPECT_THAT(said, HasSubstr("said to be collision, but nothing is closer than"));
}

TEST(WorldKeys, AreReadAsWritten) {
  const WorldKey key{{3, 0}, {0, 2}, {12, 1}};
  EXPECT_EQ(toString(key), "3a.0c.12b");
  EXPECT_EQ(parseWorldKey("3a.0c.12b", 20, 4), key);
  EXPECT_EQ(parseWorldKey(toString(WorldKey{}), 20, 4), WorldKey{});
  for (const char* bad : {"", "3", "3e", "20a", "3a.", "3a.3b", "-1a", "3aa", "x"})
    EXPECT_THROW(parseWorldKey(bad, 20, 4), std::invalid_argument) << bad;
}

MemoryReadings series(double slope, double noise) {
  MemoryReadings memory;
  for (std::size_t i = 0; i < MemoryReadings::kReadings; ++i)
    memory.add(50 + slope * static_cast<double>(i) + (i % 3 == 0 ? noise : 0.0));
  return memory;
}

TEST(Memory, GrowthIsTold) {
  EXPECT_EQ(grown("memory", series(0.0, 0.0), 2.0), "");
  EXPECT_EQ(grown("memory", series(0.0, 30.0), 2.0), "") << "versions that come and go";
  EXPECT_EQ(grown("memory", series(-1.0, 0.0), 2.0), "");
  EXPECT_EQ(grown("memory", series(0.19, 0.0), 2.0), "");
  EXPECT_THAT(grown("memory", series(0.21, 0.0), 2.0), HasSubstr("memory grows by 2.1"));
  MemoryReadings few;
  few.add(1.0);
  EXPECT_EQ(few.growth(), std::nullopt);
}

TEST(Memory, ReadingsAreEvenlySpacedAfterATenth) {
  MemoryReadings memory;
  EXPECT_FALSE(memory.due(0.1449));
  EXPECT_TRUE(memory.due(0.1451));
  for (std::size_t i = 1; i < MemoryReadings::kReadings; ++i) memory.add(1.0);
  EXPECT_FALSE(memory.due(0.999));
  EXPECT_TRUE(memory.due(1.0));
  memory.add(1.0);
  EXPECT_FALSE(memory.due(1.0));
}

TEST(Memory, WhatIsTakenIsSeen) {
#if defined(SWEPT_TEST_THREAD_SANITIZER)
  constexpr double kShare = 5.0;  // ThreadSanitizer remembers four bytes of each
#else
  constexpr double kShare = 1.0;
#endif
  const double resident = residentMebibytes(), heap = heapMebibytes();
  const std::vector<double> taken(std::size_t{1} << 22, 1.0);  // 32 MiB
  EXPECT_NEAR(residentMebibytes() - resident, 32.0 * kShare, 8.0);
  // Sanitizers have their own heap.
  if (heap > 0) {
    EXPECT_NEAR(heapMebibytes() - heap, 32.0, 1.0);
  }
}

/// oneTBB 2021.8 kept 7 KB of each arena that two threads had worked in, and there was one a call:
/// in its own heap, so that only the resident memory told of it, 140 MiB in the full soak.
TEST_F(Judged, BatchesOnThreadsGiveTheirMemoryBack) {
  const swept::Checker& checker = *line_.current()->checker;
  std::vector<Verdict> verdicts(512);
  std::vector<double> states(verdicts.size() * static_cast<std::size_t>(checker.dimension()));
  const auto ask = [&](int calls) {
    for (int i = 0; i < calls; ++i) checker.checkStates(states, verdicts, 2);
    return residentMebibytes();
  };
  const double before = ask(200);
  EXPECT_LT(ask(1000) - before, 3.0);
}

TEST(Tallies, WorldsInWhichHardlyAnythingIsFreeAreNoticed) {
  Tally tally;
  EXPECT_EQ(lopsided("states", tally), "");
  for (int i = 0; i < 91; ++i) tally.count(Verdict::Collision, Way::One);
  for (int i = 0; i < 9; ++i) tally.count(Verdict::Free, Way::Batch);
  EXPECT_THAT(lopsided("states", tally), HasSubstr("only 9.000000 % are free"));
  for (int i = 0; i < 2; ++i) tally.count(Verdict::Free, Way::Batch);
  EXPECT_EQ(lopsided("states", tally), "");
}

TEST(WholeSoak, DoesWhatItIsAskedTo) {
  const Options& options = smallOptions();
  std::ostringstream out;
  Result result = run(options, makeStages(options), out, [] { return false; });
  report(result, options, out);
  EXPECT_EQ(exitCode(result), 0) << out.str();
  ASSERT_EQ(result.tallies.size(), 1u);
  EXPECT_EQ(result.tallies[0].states.all(), options.states);
  EXPECT_EQ(result.tallies[0].motions.all(), options.motions);
  for (const auto count : result.tallies[0].states.ways) EXPECT_GT(count, 0);
  EXPECT_GE(result.updates.all(), options.updates - 20);
  EXPECT_GT(result.updates.returned, 0);
  EXPECT_NEAR(static_cast<double>(result.judged.states), 600.0, 100.0);
  EXPECT_NEAR(static_cast<double>(result.judged.motions), 60.0, 30.0);
  EXPECT_GT(result.judged.oracleStates, 100 * result.judged.motions) << "sampled too coarsely";
  EXPECT_TRUE(result.resident.growth().has_value());
}

/// A judge that cannot refute proves nothing: here the oracle's worlds are not quite the checker's.
TEST(WholeSoak, NoticesAMillimetre) {
  const Options& options = smallOptions();
  const auto stages = makeStages(options);
  stages.front()->displaceTwins({0, 0, 1e-3});
  std::ostringstream out;
  Result result = run(options, stages, out, [] { return false; });
  report(result, options, out);
  EXPECT_EQ(exitCode(result), 1);
  EXPECT_THAT(out.str(), HasSubstr("REFUTED"));
}

TEST(WholeSoak, EndsEarlyWhenInterrupted) {
  Options options = smallOptions();
  options.states = 1'000'000'000'000;
  int asked = 0;
  std::ostringstream out;
  Result result = run(options, makeStages(options), out, [&] { return ++asked > 20; });
  report(result, options, out);
  EXPECT_EQ(exitCode(result), 130) << out.str();
  EXPECT_GT(result.tallies[0].states.all(), 0);
  EXPECT_THAT(out.str(), HasSubstr("ended early"));
}

}  // namespace
}  // namespace soak
