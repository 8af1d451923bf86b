// SPDX-License-Identifier: BSD-3-Clause
#include "report/random_motion_part.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "output/quantile.hpp"

namespace swept {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDepthStates = 100;  // along a motion, to see how deep it goes

/// m. Two bodies are at least this deep in each other somewhere on a motion that collides; 0 where
/// no state that was looked at shows more than a touch.
double depthOf(const Checker& checker, const ReportMotion& motion) {
  Workspace workspace(checker);
  double depth = 0.0;
  std::vector<double> q(motion.from.size());
  const auto look = [&](double t) {
    checker.interpolate(motion.from, motion.to, t, q);
    depth = std::max(depth, -checker.signedClearance(q, workspace).upper);
  };
  look(motion.truth.witness->t);
  for (int i = 1; i < kDepthStates; ++i) look(static_cast<double>(i) / kDepthStates);
  return depth;
}

}  // namespace

RandomMotionPart::RandomMotionPart(std::vector<ReportMethod> methods, int passes)
    : methods_(std::move(methods)), passes_(passes), tallies_(methods_.size()) {}

void RandomMotionPart::count(const std::string& world, const std::vector<ReportMotion>& motions) {
  for (const ReportMotion& motion : motions) {
    ++counts_.motions;
    const Verdict truth = motion.truth.verdict;
    ++(truth == Verdict::Free        ? counts_.free
       : truth == Verdict::Collision ? counts_.collision
                                     : counts_.undecided);
    judged_.push_back({.world = world, .motion = motion, .missedBy = {}, .refusedBy = {}});
  }
}

void RandomMotionPart::add(const std::string& world, std::vector<AskedMethod>& asked,
                           const Checker& truth, const std::vector<ReportMotion>& motions,
                           const Stopwatch& stopwatch, const ReportTick& tick) {
  count(world, motions);
  std::vector<ReportMotion> known;
  std::vector<JudgedMotion*> judged;
  for (std::size_t i = judged_.size() - motions.size(); i < judged_.size(); ++i) {
    if (judged_[i].motion.truth.verdict == Verdict::Undecided) continue;
    known.push_back(judged_[i].motion);
    judged.push_back(&judged_[i]);
  }
  const OmplMotions states(truth, known);
  const Answers none{.valid = std::vector<bool>(known.size()),
                     .times = std::vector<double>(known.size(), kInfinity)};
  std::vector<Answers> answers(asked.size(), none);
  const auto ask = [&](std::size_t method, std::size_t i) {
    bool valid = false;
    const double taken = stopwatch.time([&] {
      valid = asked[method].validator().checkMotion(states.from[i].get(), states.to[i].get());
    });
    answers[method].valid[i] = valid;
    answers[method].times[i] = std::min(answers[method].times[i], taken);
  };
  inTurns(asked.size(), known.size(), passes_, ask, tick);

  std::vector<double> depths(known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const bool collides = known[i].truth.verdict == Verdict::Collision;
    const auto misses = [i](const Answers& method) { return method.valid[i]; };
    if (collides && std::ranges::any_of(answers, misses)) depths[i] = depthOf(truth, known[i]);
    tick(0);
  }
  for (std::size_t i = 0; i < methods_.size(); ++i) score(i, answers[i], judged, depths);
}

/// `depths` (m) are of motions that some method misses.
void RandomMotionPart::score(std::size_t method, const Answers& answers,
                             std::span<JudgedMotion* const> motions,
                             const std::vector<double>& depths) {
  RateErrors& rates = tallies_[method].rates;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const bool free = motions[i]->motion.truth.verdict == Verdict::Free;
    ++(free ? rates.free : rates.collisions);
    if (free == answers.valid[i]) continue;
    (free ? motions[i]->refusedBy : motions[i]->missedBy).push_back(methods_[method]);
    ++(free ? rates.falseAlarms : rates.missed);
    if (!free) rates.deepestMissed = std::max(rates.deepestMissed.value_or(0.0), depths[i]);
  }
  std::ranges::copy(answers.times, std::back_inserter(tallies_[method].times));
}

MotionCounts RandomMotionPart::counts() const {
  MotionCounts counts = counts_;
  std::vector<double> ascending;
  for (const JudgedMotion& motion : judged_) ascending.push_back(motion.motion.length);
  std::ranges::sort(ascending);
  counts.shortest = quantile(ascending, 0.0);
  counts.median = quantile(ascending, 0.5);
  counts.longest = quantile(ascending, 1.0);
  return counts;
}

std::vector<ReportRow> RandomMotionPart::rows() const {
  std::vector<ReportRow> rows;
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    std::vector<double> times = tallies_[i].times;
    std::ranges::sort(times);
    rows.push_back({.part = ReportPart::Motions,
                    .method = methods_[i],
                    .queries = times.size(),
                    .mean = mean(times),
                    .median = quantile(times, 0.5),
                    .rates = tallies_[i].rates,
                    .error = {}});
  }
  return rows;
}

}  // namespace swept
