// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "refuter.hpp"

/// As on a command line, to the last bit.
std::string commas(const std::vector<double>& values);

/// Holds the checker's answers about motions against the oracle; what does not fit goes into the
/// report. Motions are pairs of full states of the oracle.
class Judge {
 public:
  using State = std::vector<double>;
  Judge(const Scenario& scenario, const RefuterOptions& options, RefuterReport& report)
      : scenario_(scenario),
        judge_(*scenario.oracle),
        options_(options),
        report_(report),
        margin_(scenario.checker->options().margin),
        tolerance_(scenario.checker->options().tolerance) {}

  /// `query` is what was asked: where a proven prefix ends is held against FirstContact only.
  void motion(const State& from, const State& to, const swept::MotionCertificate& certificate,
              swept::MotionQuery query = swept::MotionQuery::FirstContact);

  /// No answer depends on what the workspace was used for, nor on how much was asked. `a` and `b`
  /// are the ends of the last motion as configurations of the group.
  void sameAgain(const State& a, const State& b, const swept::MotionCertificate& known);

 private:
  State at(double t) const { return judge_.arm().between(*from_, *to_, t); }

  void fail(const std::string& what);

  /// m; what the margin leaves, if that is less than `enough`. Below zero refutes.
  double room(double t, double enough);

  bool refuted(double t);

  /// Samples [0, end] (without the end for a prefix), then looks hard at the narrowest place.
  void provenPrefix(double end, bool whole);

  /// Least room found over [0, end): coarse samples, then a pattern search around the best, and
  /// where that is tight many samples beside it. Only what beats the best so far has to be
  /// measured.
  double narrowest(double end, int n);

  /// A prefix may end only where the tolerance is nearly used up.
  void stop(double t);

  /// Undecided is for motions that come within the tolerance.
  void grazes(double undecidedAt);

  void witness(const swept::MotionCertificate& certificate);

  const Scenario& scenario_;
  const oracle::Oracle& judge_;
  const RefuterOptions& options_;
  RefuterReport& report_;
  double margin_, tolerance_;
  const State* from_ = nullptr;
  const State* to_ = nullptr;
};
