// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "output/quantile.hpp"
#include "planning_attempt.hpp"
#include "timing.hpp"

/// What came of planning, as Markdown.
namespace swept::benchmark {

/// A problem and what each of kMethods made of it.
struct PlannedCase {
  const PlanningCase* problem = nullptr;
  std::vector<Attempt> attempts;
  double building = 0.0;  ///< s, CPU: the checker, which every path is judged by

  bool solvedByAll() const { return std::ranges::all_of(attempts, &Attempt::solved); }
};
using PlannedCases = std::vector<const PlannedCase*>;

inline std::string percent(double share, int digits = 3) {
  return number(100.0 * share, digits) + " %";
}

/// One method on the problems of a set. Times and counts are those of problems that every method
/// solves; paths are all of the method's.
struct MethodSummary {
  std::size_t problems = 0, solved = 0, free = 0, colliding = 0, undecided = 0;
  int segments = 0, collidingSegments = 0;
  std::vector<double> seconds;                         ///< ascending
  std::vector<double> stretches;                       ///< rad, ascending, of colliding paths
  std::vector<double> depths;                          ///< m, ascending, of colliding paths
  double validity = 0.0;                               ///< s
  double motions = 0.0, states = 0.0, building = 0.0;  ///< means, the last in s

  MethodSummary(const PlannedCases& cases, std::size_t method) : problems(cases.size()) {
    for (const PlannedCase* planned : cases) add(*planned, planned->attempts[method]);
    std::ranges::sort(seconds);
    std::ranges::sort(stretches);
    std::ranges::sort(depths);
    const auto compared = static_cast<double>(std::max<std::size_t>(1, seconds.size()));
    motions /= compared;
    states /= compared;
    building /= static_cast<double>(std::max<std::size_t>(1, problems));
  }

  double middle() const { return quantile(seconds, 0.5); }
  double average() const { return mean(seconds); }
  double slow() const { return quantile(seconds, 0.95); }
  /// s, mean: what the planner itself takes.
  double outside() const { return (1.0 - share()) * average(); }
  double share() const { return validity / (average() * static_cast<double>(seconds.size())); }

 private:
  void add(const PlannedCase& planned, const Attempt& attempt) {
    building += attempt.building;
    if (planned.solvedByAll()) {
      seconds.push_back(attempt.seconds);
      validity += attempt.share * attempt.seconds;
      motions += static_cast<double>(attempt.motions);
      states += static_cast<double>(attempt.states);
    }
    if (!attempt.solved) return;
    ++solved;
    const PathJudgement& path = attempt.path;
    free += path.verdict == Verdict::Free ? 1 : 0;
    undecided += path.verdict == Verdict::Undecided ? 1 : 0;
    segments += path.segments;
    collidingSegments += path.colliding;
    if (path.verdict != Verdict::Collision) return;
    ++colliding;
    stretches.push_back(path.stretch);
    depths.push_back(path.depth);
  }
};

inline void printTimes(const std::vector<PlannedCases>& sets,
                       const std::vector<std::string>& names) {
  const MarkdownTable table({"set", "method", "solved", "median ms", "mean ms", "p95 ms",
                             "of FCL, 1 %: median, mean, p95", "in validity", "mean ms outside",
                             "motions", "states", "building ms"});
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const MethodSummary reference(sets[s], kReference);
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      const MethodSummary summary(sets[s], m);
      const auto milliseconds = [](double seconds) { return number(1e3 * seconds); };
      const std::string ratios = number(summary.middle() / reference.middle(), 2) + ", " +
                                 number(summary.average() / reference.average(), 2) + ", " +
                                 number(summary.slow() / reference.slow(), 2);
      table.row({m == 0 ? names[s] : "", kMethods[m].name,
                 std::to_string(summary.solved) + " of " + std::to_string(summary.problems),
                 milliseconds(summary.middle()), milliseconds(summary.average()),
                 milliseconds(summary.slow()), m == kReference ? "1" : ratios,
                 percent(summary.share()), milliseconds(summary.outside()),
                 std::to_string(std::lround(summary.motions)),
                 std::to_string(std::lround(summary.states)), milliseconds(summary.building)});
    }
  }
}

/// "median, worst" of ascending values.
inline std::string middleAndWorst(const std::vector<double>& values, double unit) {
  if (values.empty()) return "-";
  return number(quantile(values, 0.5) / unit, 2) + ", " + number(values.back() / unit, 2);
}

inline void printPaths(const std::vector<PlannedCases>& sets,
                       const std::vector<std::string>& names) {
  const MarkdownTable table({"set", "method", "paths", "free, proven", "in collision", "undecided",
                             "segments in collision", "longest contact, rad: median, worst",
                             "depth of hulls, mm: median, worst"});
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      const MethodSummary summary(sets[s], m);
      const double paths = static_cast<double>(std::max<std::size_t>(1, summary.solved));
      table.row(
          {m == 0 ? names[s] : "", kMethods[m].name, std::to_string(summary.solved),
           std::to_string(summary.free),
           std::to_string(summary.colliding) + " (" +
               percent(static_cast<double>(summary.colliding) / paths) + ")",
           std::to_string(summary.undecided),
           std::to_string(summary.collidingSegments) + " of " + std::to_string(summary.segments),
           middleAndWorst(summary.stretches, 1.0), middleAndWorst(summary.depths, 1e-3)});
    }
  }
}

/// The problems on which ours took longest.
inline void printSlowest(PlannedCases cases, std::size_t count) {
  std::erase_if(cases, [](const PlannedCase* c) { return !c->attempts[kSwept].solved; });
  std::ranges::sort(cases, std::greater(),
                    [](const PlannedCase* c) { return c->attempts[kSwept].seconds; });
  cases.resize(std::min(cases.size(), count));
  const MarkdownTable table({"slowest of swept", "ms", "in validity", "motions", "us per motion",
                             "FCL, 1 %: ms", "its motions"});
  for (const PlannedCase* planned : cases) {
    const Attempt& ours = planned->attempts[kSwept];
    const Attempt& peer = planned->attempts[kReference];
    const double perMotion =
        ours.share * ours.seconds / static_cast<double>(std::max<std::uint64_t>(1, ours.motions));
    table.row({planned->problem->set + " " + std::to_string(planned->problem->index),
               number(1e3 * ours.seconds), percent(ours.share), std::to_string(ours.motions),
               number(1e6 * perMotion), peer.solved ? number(1e3 * peer.seconds) : peer.status,
               std::to_string(peer.motions)});
  }
}

inline void printUnsolved(const std::vector<PlannedCase>& cases) {
  for (const PlannedCase& planned : cases)
    for (std::size_t m = 0; m < kMethods.size(); ++m)
      if (!planned.attempts[m].solved)
        std::printf("not solved: %s %d, %s: %s\n", planned.problem->set.c_str(),
                    planned.problem->index, kMethods[m].name.c_str(),
                    planned.attempts[m].status.c_str());
}

}  // namespace swept::benchmark
