// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/asked_method.hpp"
#include "report/stopwatch.hpp"
#include "report/turns.hpp"

namespace swept {

/// Collects, world by world, what the methods say of random motions and what is true.
class RandomMotionPart {
 public:
  /// A time is the least of so many passes.
  RandomMotionPart(std::vector<ReportMethod> methods, int passes);

  /// Asks all methods as a planner does, through OMPL's motion validators. Motions whose truth is
  /// not known are counted and not asked about.
  void add(const std::string& world, std::vector<AskedMethod>& asked, const Checker& truth,
           const std::vector<ReportMotion>& motions, const Stopwatch& stopwatch,
           const ReportTick& tick);

  MotionCounts counts() const;
  const std::vector<JudgedMotion>& judged() const { return judged_; }
  std::vector<ReportRow> rows() const;

 private:
  /// What one method says of the motions of a world.
  struct Answers {
    std::vector<bool> valid;
    std::vector<double> times;  ///< ns, the least of all passes
  };
  struct Tally {
    RateErrors rates;
    std::vector<double> times;  ///< ns
  };
  void count(const std::string& world, const std::vector<ReportMotion>& motions);
  void score(std::size_t method, const Answers& answers, std::span<JudgedMotion* const> motions,
             const std::vector<double>& depths);

  std::vector<ReportMethod> methods_;
  int passes_;
  MotionCounts counts_;
  std::vector<JudgedMotion> judged_;
  std::vector<Tally> tallies_;  ///< by method
};

}  // namespace swept
