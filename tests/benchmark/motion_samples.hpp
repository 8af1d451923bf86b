// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "bench/clock.hpp"
#include "bench/fcl.hpp"
#include "swept/robot_model/checker.hpp"
#include "timing.hpp"
#include "workloads.hpp"

/// Random motions of a robot, sorted by verdict, and what certifying them costs.
namespace swept::benchmark {

/// Motions between uniform configurations.
class MotionSampler {
 public:
  MotionSampler(const Checker& checker, std::mt19937_64& random)
      : checker_(checker), random_(random) {}

  /// From a configuration towards another one, cut at `length` (rad and m, L2 norm).
  BenchMotion draw(double length) {
    for (;;) {
      BenchMotion motion{configuration(), configuration()};
      const double whole = distance(motion);
      if (!(whole >= length)) continue;
      const Eigen::VectorXd cut = checker_.interpolate(motion.from, motion.to, length / whole);
      motion.to.assign(cut.begin(), cut.end());
      return motion;
    }
  }

 private:
  const Variable& variable(std::size_t i) const {
    return checker_.robot().variables()[static_cast<std::size_t>(checker_.group().variables[i])];
  }

  /// Within the limits; where there are none, a whole turn or 1 m to either side.
  std::vector<double> configuration() {
    std::vector<double> q(static_cast<std::size_t>(checker_.dimension()));
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Variable& v = variable(i);
      const double most = v.cyclic ? std::numbers::pi : 1.0;
      q[i] = std::isfinite(v.lower) && std::isfinite(v.upper) ? uniform(random_, v.lower, v.upper)
                                                              : uniform(random_, -most, most);
    }
    return q;
  }

  double distance(const BenchMotion& motion) const {
    double squared = 0.0;
    for (std::size_t i = 0; i < motion.from.size(); ++i) {
      double difference = motion.to[i] - motion.from[i];
      if (variable(i).cyclic) difference = std::remainder(difference, 2.0 * std::numbers::pi);
      squared += difference * difference;
    }
    return std::sqrt(squared);
  }

  const Checker& checker_;
  std::mt19937_64& random_;
};

struct MotionSamples {
  std::vector<BenchMotion> free, colliding;
  int tried = 0, triedFree = 0, undecided = 0;
};

/// Until there are so many of either kind, or `most` were tried.
inline MotionSamples sampleMotions(const Checker& checker, double length, std::size_t free,
                                   std::size_t colliding, int most, std::mt19937_64& random) {
  Workspace workspace(checker);
  MotionSampler sampler(checker, random);
  MotionSamples samples;
  while (samples.tried < most &&
         (samples.free.size() < free || samples.colliding.size() < colliding)) {
    BenchMotion motion = sampler.draw(length);
    const Verdict verdict =
        checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly).verdict;
    ++samples.tried;
    if (verdict == Verdict::Undecided) ++samples.undecided;
    if (verdict == Verdict::Free) ++samples.triedFree;
    if (verdict == Verdict::Free && samples.free.size() < free)
      samples.free.push_back(std::move(motion));
    else if (verdict == Verdict::Collision && samples.colliding.size() < colliding)
      samples.colliding.push_back(std::move(motion));
  }
  return samples;
}

/// Of motions with one verdict.
struct MotionCosts {
  std::vector<double> nanoseconds;  ///< per motion, the least of all passes
  std::size_t inLanes = 0;          ///< decided in single precision, without an exact query

  double mean() const {
    return std::accumulate(nanoseconds.begin(), nanoseconds.end(), 0.0) /
           static_cast<double>(nanoseconds.size());
  }
  double median() const {
    std::vector<double> sorted = nanoseconds;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
  /// `median / mean (share in lanes)`.
  std::string text() const {
    if (nanoseconds.empty()) return "-";
    const double share = static_cast<double>(inLanes) / static_cast<double>(nanoseconds.size());
    const auto whole = [](double value) { return std::to_string(std::lround(value)); };
    return whole(median()) + " / " + whole(mean()) + " (" + whole(100.0 * share) + " %)";
  }
};

/// s that `work` takes, on however many threads.
template <typename Work>
double secondsOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Adds the motions of one checker. All of them in each pass: no motion finds the caches as its own
/// last pass left them. A few passes at least, and more up to `seconds` in all: what slows a shared
/// machine down may last longer than a pass of a millisecond.
inline void measureMotions(const Checker& checker, const std::vector<BenchMotion>& motions,
                           double seconds, const BenchClock& clock, MotionCosts& costs) {
  constexpr int kFewestPasses = 5;
  Workspace workspace(checker);
  const std::size_t first = costs.nanoseconds.size();
  costs.nanoseconds.resize(first + motions.size(), std::numeric_limits<double>::infinity());
  double spent = 0.0;
  for (int pass = 0; pass < kFewestPasses || spent < seconds; ++pass) {
    spent += secondsOf([&] {
      for (std::size_t i = 0; i < motions.size(); ++i) {
        MotionCertificate certificate;
        const double taken = clock.time([&] {
          certificate = checker.certifyMotion(motions[i].from, motions[i].to, workspace,
                                              MotionQuery::VerdictOnly);
        });
        double& least = costs.nanoseconds[first + i];
        least = std::min(least, taken);
        if (pass == 0 && certificate.effort.intervals == 0) ++costs.inLanes;
      }
    });
    if (motions.empty()) return;
  }
}

/// What the ends of motions cost as states, ns each; and how often each verdict was found.
struct StateCosts {
  MotionCosts costs;
  std::array<int, 3> verdicts{};  ///< by Verdict
};

inline StateCosts measureEnds(const Checker& checker, const std::vector<BenchMotion>& motions,
                              const BenchClock& clock) {
  constexpr int kPasses = 9;
  Workspace workspace(checker);
  StateCosts found;
  found.costs.nanoseconds.resize(motions.size(), std::numeric_limits<double>::infinity());
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      Verdict verdict{};
      const double taken =
          clock.time([&] { verdict = checker.checkState(motions[i].to, workspace); });
      double& least = found.costs.nanoseconds[i];
      least = std::min(least, taken);
      if (pass == 0) ++found.verdicts[static_cast<std::size_t>(verdict)];
    }
  }
  return found;
}

}  // namespace swept::benchmark
