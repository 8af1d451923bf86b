// SPDX-License-Identifier: BSD-3-Clause
#include "worker.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>
#include <utility>

#include "refutation.hpp"
#include "swept/ompl_bridge/state_space.hpp"

namespace soak {

using swept::Verdict;

namespace {

constexpr std::int64_t kStatesPerRound = 512;
constexpr std::int64_t kMotionsPerRound = 64;

/// s of processor that this thread has had.
double threadSeconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::int64_t divideUp(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

}  // namespace

struct Worker::Seat {
  Seat(const Stage& stage, StageTally& tallyOf, std::uint64_t seed)
      : tally(tallyOf),
        dimension(stage.empty().dimension()),
        drawer(stage.empty(), seed),
        conversion(stage.empty().robot(), stage.empty().group()),
        space(stage.space()),
        from(space->allocState()),
        to(space->allocState()) {}
  ~Seat() {
    space->freeState(from);
    space->freeState(to);
  }
  Seat(Seat&&) = delete;

  StageTally& tally;
  int dimension;
  Drawer drawer;
  swept::StateConversion conversion;
  ompl::base::StateSpacePtr space;
  ompl::base::State *from, *to;
};

Worker::Worker(Shared& shared, int index, std::int64_t states, std::int64_t motions)
    : shared_(shared),
      states_(states),
      motions_(motions),
      random_(shared.seed * 1000003 + static_cast<unsigned>(index)),
      tallies_(shared.lines.size()),
      workspace_(shared.lines.front()->stage().empty()) {
  for (std::size_t i = 0; i < tallies_.size(); ++i)
    seats_.push_back(std::make_unique<Seat>(shared.lines[i]->stage(), tallies_[i], random_()));
}

Worker::~Worker() = default;

void Worker::run() {
  const std::int64_t rounds =
      std::max(divideUp(states_, kStatesPerRound), divideUp(motions_, kMotionsPerRound));
  for (std::int64_t i = 0; i < rounds && !shared_.progress.stopped(); ++i) {
    while (shared_.progress.updatesLate() && !shared_.progress.stopped())
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    const auto part = [&](std::int64_t all) {
      return static_cast<int>(all * (i + 1) / rounds - all * i / rounds);
    };
    const int states = part(states_), motions = part(motions_);
    round(static_cast<std::size_t>(i) % seats_.size(), states, motions);
    shared_.progress.checked(states + motions);
  }
}

void Worker::round(std::size_t stage, int states, int motions) {
  version_ = shared_.lines[stage]->current();
  Seat& seat = *seats_[stage];
  const auto way = random_() % 16;
  if (way < 7)
    statesOneByOne(seat, states);
  else if (way < 13)
    statesInBatch(seat, states, way == 12);
  else
    statesThroughBridge(seat, states);
  const auto motionWay = random_() % 16;
  if (motionWay < 12)
    motionsOneByOne(seat, motions);
  else if (motionWay < 13)
    motionsOnThreads(seat, motions);
  else
    motionsThroughBridge(seat, motions);
  version_.reset();
}

bool Worker::sampled(std::int64_t& left) {
  if (left == 0) left = 1 + static_cast<std::int64_t>(random_() % (2 * shared_.sampleOneIn - 1));
  return --left == 0;
}

void Worker::noteState(Seat& seat, Way way, std::span<const double> q, Verdict verdict) {
  seat.tally.states.count(verdict, way);
  if (!sampled(untilState_)) return;
  Sample sample{.version = version_, .way = way, .from = {q.begin(), q.end()}};
  sample.answer.verdict = verdict;
  shared_.samples.push(std::move(sample));
}

void Worker::statesOneByOne(Seat& seat, int count) {
  const double before = threadSeconds();
  from_.resize(seat.dimension);
  for (int i = 0; i < count; ++i) {
    seat.drawer.state(from_);
    const Verdict verdict = version_->checker->checkState(from_, workspace_);
    seat.drawer.learn(from_, verdict);
    noteState(seat, Way::One, from_, verdict);
  }
  seat.tally.states.oneSeconds += threadSeconds() - before;
}

void Worker::statesInBatch(Seat& seat, int count, bool threads) {
  const std::size_t each = seat.dimension;
  from_.resize(each * count);
  verdicts_.resize(count);
  const auto state = [&](int i) { return std::span(from_).subspan(i * each, each); };
  for (int i = 0; i < count; ++i) seat.drawer.state(state(i));
  if (threads)
    version_->checker->checkStates(from_, verdicts_, 2);
  else
    version_->checker->checkStates(from_, verdicts_, workspace_);
  for (int i = 0; i < count; ++i) {
    seat.drawer.learn(state(i), verdicts_[i]);
    noteState(seat, threads ? Way::Threads : Way::Batch, state(i), verdicts_[i]);
  }
}

void Worker::differs(const Sample& sample, bool valid) {
  shared_.failures.add(std::string("through OMPL it is ") + (valid ? "valid" : "not valid") + '\n' +
                       reproducer(sample, shared_.seed));
}

/// OMPL's states have angles within [-pi, pi): both are asked about what comes back from there.
void Worker::statesThroughBridge(Seat& seat, int count) {
  from_.resize(seat.dimension);
  for (int i = 0; i < count; ++i) {
    seat.drawer.state(from_);
    seat.conversion.toState(from_, seat.from);
    const bool valid = version_->validity.isValid(seat.from);
    to_.resize(seat.dimension);
    seat.conversion.toConfiguration(seat.from, to_);
    const Verdict verdict = version_->checker->checkState(to_, workspace_);
    seat.drawer.learn(from_, verdict);
    if (valid != (verdict == Verdict::Free)) {
      Sample sample{.version = version_, .way = Way::One, .from = to_};
      sample.answer.verdict = verdict;
      differs(sample, valid);
    }
    noteState(seat, Way::Bridge, to_, verdict);
  }
}

void Worker::noteMotion(Seat& seat, Way way, std::span<const double> from,
                        std::span<const double> to, Query query,
                        const swept::MotionCertificate& answer) {
  seat.tally.motions.count(answer.verdict, way);
  if (!sampled(untilMotion_)) return;
  shared_.samples.push({.version = version_,
                        .way = way,
                        .from = {from.begin(), from.end()},
                        .to = {to.begin(), to.end()},
                        .query = query,
                        .answer = answer});
}

void Worker::motionsOneByOne(Seat& seat, int count) {
  const double before = threadSeconds();
  from_.resize(seat.dimension);
  to_.resize(seat.dimension);
  for (int i = 0; i < count; ++i) {
    seat.drawer.motion(from_, to_);
    const Query query = anyQuery();
    const auto answer = version_->checker->certifyMotion(from_, to_, workspace_, query);
    noteMotion(seat, Way::One, from_, to_, query, answer);
  }
  seat.tally.motions.oneSeconds += threadSeconds() - before;
}

void Worker::motionsOnThreads(Seat& seat, int count) {
  const std::size_t each = seat.dimension;
  from_.resize(each * count);
  to_.resize(each * count);
  certificates_.assign(count, {});
  const auto part = [each](std::vector<double>& all, int i) {
    return std::span(all).subspan(i * each, each);
  };
  for (int i = 0; i < count; ++i) seat.drawer.motion(part(from_, i), part(to_, i));
  const Query query = anyQuery();
  version_->checker->certifyMotions(from_, to_, certificates_, query, 2);
  for (int i = 0; i < count; ++i)
    noteMotion(seat, Way::Threads, part(from_, i), part(to_, i), query, certificates_[i]);
}

void Worker::motionsThroughBridge(Seat& seat, int count) {
  from_.resize(seat.dimension);
  to_.resize(seat.dimension);
  for (int i = 0; i < count; ++i) {
    seat.drawer.motion(from_, to_);
    seat.conversion.toState(from_, seat.from);
    seat.conversion.toState(to_, seat.to);
    const bool valid = version_->motions.checkMotion(seat.from, seat.to);
    seat.conversion.toConfiguration(seat.from, from_);
    seat.conversion.toConfiguration(seat.to, to_);
    const auto answer =
        version_->checker->certifyMotion(from_, to_, workspace_, Query::VerdictOnly);
    if (valid != (answer.verdict == Verdict::Free))
      differs({version_, Way::One, from_, to_, Query::VerdictOnly, answer}, valid);
    noteMotion(seat, Way::Bridge, from_, to_, Query::VerdictOnly, answer);
  }
}

}  // namespace soak
