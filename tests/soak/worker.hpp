// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "drawer.hpp"
#include "failures.hpp"
#include "progress.hpp"
#include "sample.hpp"
#include "tally.hpp"

namespace soak {

/// What all workers have in common.
struct Shared {
  std::vector<std::unique_ptr<WorldLine>> lines;
  SampleQueue samples;
  Failures& failures;
  Progress progress;
  std::uint64_t seed;
  int sampleOneIn;  ///< answers, on average, of states and of motions
};

/// One thread's share of the checks, in all stages in turn, each time of the version of that moment
/// and with one workspace for all.
class Worker {
 public:
  /// `index` is the thread's among all.
  Worker(Shared& shared, int index, std::int64_t states, std::int64_t motions);
  ~Worker();
  Worker(Worker&&) = delete;

  void run();
  /// By stage.
  const std::vector<StageTally>& tallies() const { return tallies_; }

 private:
  using Query = swept::MotionQuery;
  struct Seat;  ///< what the worker has of its own for a stage

  void round(std::size_t stage, int states, int motions);
  void statesOneByOne(Seat& seat, int count);
  void statesInBatch(Seat& seat, int count, bool threads);
  void statesThroughBridge(Seat& seat, int count);
  void noteState(Seat& seat, Way way, std::span<const double> q, swept::Verdict verdict);
  void motionsOneByOne(Seat& seat, int count);
  void motionsOnThreads(Seat& seat, int count);
  void motionsThroughBridge(Seat& seat, int count);
  void noteMotion(Seat& seat, Way way, std::span<const double> from, std::span<const double> to,
                  Query query, const swept::MotionCertificate& answer);
  void differs(const Sample& sample, bool valid);
  /// Whether this answer is one to be judged.
  bool sampled(std::int64_t& left);
  Query anyQuery() { return random_() % 2 == 0 ? Query::FirstContact : Query::VerdictOnly; }

  Shared& shared_;
  std::int64_t states_, motions_;
  std::mt19937_64 random_;
  std::vector<std::unique_ptr<Seat>> seats_;
  std::vector<StageTally> tallies_;
  swept::Workspace workspace_;
  std::shared_ptr<const Version> version_;  ///< of the round
  std::vector<double> from_, to_;
  std::vector<swept::Verdict> verdicts_;
  std::vector<swept::MotionCertificate> certificates_;
  std::int64_t untilState_ = 0, untilMotion_ = 0;  ///< the next sample
};

}  // namespace soak
