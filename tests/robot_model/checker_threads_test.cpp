// SPDX-License-Identifier: BSD-3-Clause
// One checker, asked by many threads while others make new versions of it.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <stop_token>
#include <thread>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::armUrdf;
using test::at;
using test::parseArm;
using test::shared;

constexpr int kAsking = 8;
constexpr int kBuilding = 2;
constexpr int kMotions = 200;
constexpr int kVersions = 30;

struct Motions {
  explicit Motions(const Checker& checker) {
    std::mt19937 random(3);
    for (int i = 0; i < kMotions; ++i) {
      for (std::vector<double>* ends : {&from, &to}) {
        const std::vector<double> q = test::randomConfiguration(checker, random);
        ends->insert(ends->end(), q.begin(), q.end());
      }
    }
  }
  std::span<const double> begin(int i) const { return of(from, i); }
  std::span<const double> end(int i) const { return of(to, i); }
  static std::span<const double> of(std::span<const double> ends, int i) {
    return ends.subspan(2 * static_cast<std::size_t>(i), 2);
  }
  std::vector<double> from, to;
};

struct Answer {
  Verdict motion;
  double freeUntil;
  Verdict state;
  double clearance;
  bool operator==(const Answer&) const = default;
};

Answer ask(const Checker& checker, const Motions& motions, int i, Workspace& workspace) {
  const MotionCertificate certificate =
      checker.certifyMotion(motions.begin(i), motions.end(i), workspace);
  return {certificate.verdict, certificate.freeUntil, checker.checkState(motions.end(i), workspace),
          checker.clearance(motions.begin(i), workspace)};
}

TEST(CheckerThreads, NewVersionsDisturbNobody) {
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(41)),
                        {.rules = CollisionRules().pad("hand", 0.01)});
  const Motions motions(checker);
  std::vector<Answer> alone;
  Workspace first(checker);
  for (int i = 0; i < kMotions; ++i) alone.push_back(ask(checker, motions, i, first));
  for (const Verdict verdict : {Verdict::Free, Verdict::Collision})
    EXPECT_GT(std::ranges::count(alone, verdict, &Answer::motion), kMotions / 10);

  std::atomic<int> different{0};
  std::atomic<int> building{kBuilding};
  std::barrier start(kAsking + kBuilding);
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kAsking; ++thread) {
    threads.emplace_back([&, thread] {
      Workspace workspace(checker);
      start.arrive_and_wait();
      // The lists of pairs are made when somebody first asks for them.
      different +=
          checker.checkedPairs().empty() || checker.explain("hand", "base").empty() ? 1 : 0;
      for (int k = 0; k < 2 * kMotions || building > 0; ++k) {
        const int i = (37 * thread + k) % kMotions;
        different += ask(checker, motions, i, workspace) == alone[i] ? 0 : 1;
      }
    });
  }
  for (int thread = 0; thread < kBuilding; ++thread) {
    threads.emplace_back([&, thread] {
      start.arrive_and_wait();
      const std::string name = "ball" + std::to_string(thread);
      Checker version = checker;
      for (int i = 0; i < kVersions; ++i) {
        const WorldBody ball{.name = name, .parts = {{Sphere{0.1}, at(0.3, 0.2, 0.5)}}};
        version = checker.withBody(ball).withRules(CollisionRules().allow("*", name));
        version = version.withAttached(
            {.name = "tool", .link = "hand", .parts = {{Sphere{0.02}, at(0, 0, 0.05)}}});
        Workspace workspace(version);
        different += version.checkedPairs().size() > checker.checkedPairs().size() ? 0 : 1;
        ask(version, motions, i, workspace);
      }
      --building;
    });
  }
  threads.clear();
  EXPECT_EQ(different, 0);
}

TEST(CheckerThreads, BatchesAreTheSameOnAnyNumber) {
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(42)));
  const Motions motions(checker);
  Workspace workspace(checker);
  std::vector<Verdict> alone(kMotions);
  checker.checkStates(motions.to, alone, workspace);
  std::vector<MotionCertificate> one(kMotions);
  checker.certifyMotions(motions.from, motions.to, one, MotionQuery::FirstContact, 1);
  EXPECT_GT(std::ranges::count(alone, Verdict::Collision), 10);
  EXPECT_GT(std::ranges::count(alone, Verdict::Free), 20);
  for (const unsigned threads : {0U, 1U, 2U, 3U, 8U}) {
    std::vector<Verdict> verdicts(kMotions);
    checker.checkStates(motions.to, verdicts, threads);
    EXPECT_EQ(verdicts, alone) << threads << " threads";
    std::vector<MotionCertificate> certificates(kMotions);
    checker.certifyMotions(motions.from, motions.to, certificates, MotionQuery::FirstContact,
                           threads);
    for (int i = 0; i < kMotions; ++i) {
      const MotionCertificate own =
          checker.certifyMotion(motions.begin(i), motions.end(i), workspace);
      for (const MotionCertificate* other : {&one[i], &certificates[i]}) {
        EXPECT_EQ(other->verdict, own.verdict);
        EXPECT_EQ(other->freeUntil, own.freeUntil);
        EXPECT_EQ(other->undecidedAt, own.undecidedAt);
        EXPECT_EQ(other->effort.distances, own.effort.distances);
        ASSERT_EQ(other->witness.has_value(), own.witness.has_value());
        if (own.witness) {
          EXPECT_EQ(other->witness->t, own.witness->t);
          EXPECT_EQ(other->witness->pointA, own.witness->pointA);
          EXPECT_EQ(other->witness->bodyB, own.witness->bodyB);
        }
      }
    }
  }
}

/// While a batch runs, the program's own work gets as many threads of oneTBB's as before.
TEST(CheckerThreads, BatchesLeaveTheProgramItsThreads) {
  using oneapi::tbb::global_control;
  const auto allowed = [] {
    return global_control::active_value(global_control::max_allowed_parallelism);
  };
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(42)));
  const Motions motions(checker);
  const auto processors = std::max(2U, std::thread::hardware_concurrency());
  const global_control own(global_control::max_allowed_parallelism, processors);
  const std::size_t before = allowed();
  for (const unsigned threads : {1U, 2U, 4 * processors}) {
    std::atomic<bool> ended{false};
    std::atomic<int> calls{0};
    std::jthread asking([&] {
      std::vector<Verdict> verdicts(kMotions);
      std::vector<MotionCertificate> certificates(kMotions);
      for (; !ended; ++calls) {
        checker.checkStates(motions.to, verdicts, threads);
        checker.certifyMotions(motions.from, motions.to, certificates, MotionQuery::FirstContact,
                               threads);
      }
    });
    std::size_t least = before;
    std::size_t most = before;
    while (calls < 20) {
      least = std::min(least, allowed());
      most = std::max(most, allowed());
    }
    ended = true;
    asking.join();
    EXPECT_EQ(least, before) << threads << " threads";
    EXPECT_EQ(most, before) << threads << " threads";
  }
}

/// What is asked after the stop is Undecided, what was asked before is answered.
TEST(CheckerThreads, BatchesStop) {
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(42)));
  const Motions motions(checker);
  std::vector<Verdict> alone(kMotions);
  checker.checkStates(motions.to, alone);
  for (const unsigned threads : {1U, 2U}) {
    std::stop_source source;
    std::vector<Verdict> verdicts(kMotions, Verdict::Collision);
    EXPECT_TRUE(checker.checkStates(motions.to, verdicts, threads, source.get_token()));
    EXPECT_EQ(verdicts, alone);
    std::vector<MotionCertificate> certificates(kMotions);
    const auto certify = [&] {
      return checker.certifyMotions(motions.from, motions.to, certificates,
                                    MotionQuery::FirstContact, threads, source.get_token());
    };
    EXPECT_TRUE(certify());
    EXPECT_GT(std::ranges::count(certificates, Verdict::Free, &MotionCertificate::verdict), 0);
    source.request_stop();
    EXPECT_FALSE(checker.checkStates(motions.to, verdicts, threads, source.get_token()));
    EXPECT_EQ(std::ranges::count(verdicts, Verdict::Undecided), kMotions);
    EXPECT_FALSE(certify());
    for (const MotionCertificate& certificate : certificates) {
      EXPECT_EQ(certificate.verdict, Verdict::Undecided);
      EXPECT_FALSE(certificate.witness);
    }
  }
}

/// Another thread ends a batch of many more states than are checked before it gets to that. Each
/// verdict is that of a whole batch, or Undecided.
TEST(CheckerThreads, BatchesStopWhileTheyRun) {
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(42)));
  const Motions motions(checker);
  constexpr std::size_t kTimes = 20'000;
  std::vector<double> many;
  many.reserve(kTimes * motions.to.size());
  for (std::size_t i = 0; i < kTimes; ++i)
    many.insert(many.end(), motions.to.begin(), motions.to.end());
  std::vector<Verdict> alone(kMotions);
  checker.checkStates(motions.to, alone);
  for (const unsigned threads : {1U, 2U}) {
    std::stop_source source;
    std::vector<Verdict> verdicts(kTimes * kMotions, Verdict::Collision);
    std::jthread stopping([&source] { source.request_stop(); });
    EXPECT_FALSE(checker.checkStates(many, verdicts, threads, source.get_token()));
    std::size_t left = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      const Verdict whole = alone[i % kMotions];
      if (verdicts[i] == whole) continue;
      ASSERT_EQ(verdicts[i], Verdict::Undecided) << i;
      ++left;
    }
    EXPECT_GT(left, 0U);
  }
}

TEST(CheckerThreads, BatchesOfTheWrongSizeAreErrors) {
  const Checker checker(parseArm(armUrdf({})), "all", shared({}));
  const std::vector<double> states(6);
  std::vector<Verdict> two(2);
  EXPECT_EQ(test::messageOf([&] { checker.checkStates(states, two); }),
            "Checker: 2 states of group 'all' have 4 values, not 6");
  std::vector<MotionCertificate> three(3);
  const std::vector<double> few(4);
  EXPECT_EQ(test::messageOf([&] { checker.certifyMotions(states, few, three); }),
            "Checker: 3 states of group 'all' have 6 values, not 4");
  std::vector<Verdict> none;
  checker.checkStates(std::span<const double>(), none);
}

}  // namespace
}  // namespace swept
