// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/fcl.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// What is known of one edge after all passes.
struct EdgeResult {
  double length = 0.0;  ///< as the file says
  Verdict verdict = Verdict::Undecided;
  Effort effort;
  double nanoseconds = 0.0;  ///< least of all passes
  std::optional<FclResult> fcl;

  /// FCL and OMPL call it valid, and there is a witness of a collision.
  bool missedByFcl() const { return fcl && fcl->valid() && verdict == Verdict::Collision; }
  /// FCL and OMPL call it invalid, and it is proven free: one of the two is wrong.
  bool onlyByFcl() const { return fcl && !fcl->valid() && verdict == Verdict::Free; }
};

/// Edges of one length and verdict, or of all. Times are ns per motion.
struct EdgeSummary {
  std::optional<double> length;    ///< to 0.1; of all lengths: none
  std::optional<Verdict> verdict;  ///< of all verdicts: none
  std::size_t edges = 0;
  double median = 0.0, mean = 0.0, p95 = 0.0;
  double lanes = 0.0;               ///< mean
  std::size_t singlePrecision = 0;  ///< tier 1: decided without an exact query
  std::size_t exact = 0;            ///< tier 2: decided by exact queries
  std::size_t undecided = 0;
  std::optional<double> fclMean;  ///< without FCL: none
  std::size_t fclMissed = 0, fclOnly = 0;
};

/// By length, and within it by verdict (free, collision, undecided, all; only those there are); the
/// last ones are of all lengths.
std::vector<EdgeSummary> summarise(const std::vector<EdgeResult>& results);

/// Edges of one verdict, of all lengths; of all verdicts without one.
EdgeSummary summariseVerdict(const std::vector<EdgeResult>& results,
                             std::optional<Verdict> verdict);

}  // namespace swept
