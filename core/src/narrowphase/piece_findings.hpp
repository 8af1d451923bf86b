// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "narrowphase/gjk.hpp"
#include "narrowphase/piece_motions.hpp"
#include "narrowphase/piecewise.hpp"

namespace swept::detail {

/// What a search over pieces has found out so far, and what that leaves to be asked of others.
struct PieceFindings {
  explicit PieceFindings(const PieceGoal& goal) : asked(goal) {}

  bool inContact() const { return result.upper <= asked.contact; }

  /// What a pair of pieces has to exceed to be settled. Once some pair has failed a motion bound,
  /// only contact is still of interest; in a distance query, only what is nearer than the best so
  /// far.
  Goal goal(const PieceApproach& approach) const {
    return approach ? goalOfMotion(*approach) : Goal(settledBeyond(approach));
  }
  /// Refers to `approach`.
  Goal goalOfMotion(const PartApproach& approach) const {
    return failed ? Goal(asked.contact) : Goal(approach);
  }

  /// m. A proven distance beyond this settles a pair whatever the direction: the goal may have come
  /// closer since the pair was measured.
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
  bool failed = false;  ///< some pair of pieces is not apart as the goal asks
};

}  // namespace swept::detail
