// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "narrowphase/gjk.hpp"
#include "narrowphase/piece_motions.hpp"
#include "narrowphase/piecewise.hpp"

namespace swept::detail {

/// The result of a search over pieces so far, and the goal that it leaves for other pairs.
struct PieceFindings {
  explicit PieceFindings(const PieceGoal& goal) : asked(goal) {}

  bool inContact() const { return result.upper <= asked.contact; }

  /// The separation that settles a pair of pieces. Once some pair has failed a motion bound, only
  /// contact still matters; in a distance query, only pairs nearer than the best so far.
  Goal goal(const PieceApproach& approach) const {
    return approach ? goalOfMotion(*approach) : Goal(settledBeyond(approach));
  }
  /// Refers to `approach`.
  Goal goalOfMotion(const PartApproach& approach) const {
    return failed ? Goal(asked.contact) : Goal(approach);
  }

  /// m. A proven distance beyond this settles a pair in any direction: the goal may have become
  /// smaller since the pair was measured.
  double settledBeyond(const PieceApproach& approach) const {
    if (approach) return failed ? asked.contact : approach->most();
    return std::min(asked.enough, std::max(0.0, result.upper - asked.tolerance));
  }

  GjkMode mode() const { return asked.approach != nullptr ? GjkMode::GoalOnly : GjkMode::Exact; }

  void settle(double lower) { result.lower = std::min(result.lower, lower); }

  void note(const GjkResult& leaves, const PieceApproach& approach) {
    result.iterations += leaves.iterations;
    settle(leaves.lower);
    if (leaves.upper < result.upper) {
      result.upper = leaves.upper;
      result.pointA = leaves.pointA;
      result.pointB = leaves.pointB;
    }
    if (leaves.satisfied || inContact() || leaves.lower > settledBeyond(approach)) return;
    failed = true;
    if (!leaves.normal.isZero()) result.hint = leaves.normal;
  }

  void noteContact(const Eigen::Vector3d& pointInA) {
    result.upper = 0.0;
    result.lower = 0.0;
    result.pointA = pointInA;
    result.pointB = pointInA;
  }

  const PieceGoal& asked;
  PieceResult result;
  bool failed = false;  ///< some pair of pieces is not as far apart as the goal requires
};

}  // namespace swept::detail
