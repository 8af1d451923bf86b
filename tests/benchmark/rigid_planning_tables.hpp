// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "output/quantile.hpp"
#include "rigid_planning_attempt.hpp"
#include "timing.hpp"

/// What came of planning for rigid bodies, as Markdown.
namespace swept::benchmark {

/// A problem, a method, and what came of each run.
struct RigidRuns {
  std::string problem;
  RigidMethod method;
  std::vector<RigidAttempt> attempts = {};
};

inline std::string nameOf(RigidMethod method) {
  return method == RigidMethod::Certified ? "swept" : "FCL, 1 %";
}

inline std::string ofMany(std::size_t some, std::size_t many) {
  return std::to_string(some) + " of " + std::to_string(many);
}

/// Sums over the runs; times of those that were solved.
struct RigidSummary {
  std::size_t solved = 0, free = 0, colliding = 0, undecided = 0;
  std::size_t segments = 0, collidingSegments = 0;
  std::vector<double> seconds;         ///< s, CPU, ascending
  double all = 0.0, validity = 0.0;    ///< s, CPU, of all runs, solved or not
  double motions = 0.0, states = 0.0;  ///< of all runs

  explicit RigidSummary(const RigidRuns& runs) {
    for (const RigidAttempt& attempt : runs.attempts) {
      all += attempt.seconds;
      validity += attempt.share * attempt.seconds;
      motions += static_cast<double>(attempt.motions);
      states += static_cast<double>(attempt.states);
      if (attempt.solved) addPath(attempt);
    }
    std::ranges::sort(seconds);
  }

 private:
  void addPath(const RigidAttempt& attempt) {
    ++solved;
    seconds.push_back(attempt.seconds);
    free += attempt.path.free();
    colliding += attempt.path.colliding > 0;
    undecided += attempt.path.colliding == 0 && attempt.path.undecided > 0;
    segments += attempt.path.segments;
    collidingSegments += attempt.path.colliding;
  }
};

inline void printRigidTimes(const std::vector<RigidRuns>& all) {
  const MarkdownTable table({"problem", "method", "solved", "median s", "mean s", "p95 s",
                             "in validity", "motions", "states", "validity, us per motion"});
  for (const RigidRuns& runs : all) {
    const RigidSummary sum(runs);
    const auto count = static_cast<double>(runs.attempts.size());
    const auto seconds = [&](double value) { return sum.solved == 0 ? "-" : number(value); };
    table.row({runs.problem, nameOf(runs.method), ofMany(sum.solved, runs.attempts.size()),
               seconds(quantile(sum.seconds, 0.5)), seconds(mean(sum.seconds)),
               seconds(quantile(sum.seconds, 0.95)), number(100.0 * sum.validity / sum.all) + " %",
               std::to_string(std::lround(sum.motions / count)),
               std::to_string(std::lround(sum.states / count)),
               number(1e6 * sum.validity / sum.motions)});
  }
}

inline void printRigidPaths(const std::vector<RigidRuns>& all) {
  const MarkdownTable table({"problem", "method", "paths", "free, proven", "in collision",
                             "undecided", "segments in collision"});
  for (const RigidRuns& runs : all) {
    const RigidSummary sum(runs);
    table.row({runs.problem, nameOf(runs.method), std::to_string(sum.solved),
               std::to_string(sum.free), std::to_string(sum.colliding),
               std::to_string(sum.undecided), ofMany(sum.collidingSegments, sum.segments)});
  }
}

/// The first contact of each colliding path.
inline void printRigidWitnesses(const std::vector<RigidRuns>& all) {
  for (const RigidRuns& runs : all) {
    for (std::size_t run = 0; run < runs.attempts.size(); ++run) {
      const RigidPath& path = runs.attempts[run].path;
      if (!path.witness) continue;
      const Eigen::Vector3d& p = path.witness->pointA;
      std::printf("collides: %s, %s, run %zu, segment %zu of %zu, t = %s, at [%s %s %s]\n",
                  runs.problem.c_str(), nameOf(runs.method).c_str(), run + 1,
                  path.firstColliding + 1, path.segments, number(path.witness->t, 6).c_str(),
                  number(p.x(), 6).c_str(), number(p.y(), 6).c_str(), number(p.z(), 6).c_str());
    }
  }
}

}  // namespace swept::benchmark
