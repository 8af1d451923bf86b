// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "constraints/constraint_model.hpp"
#include "kinematics/joint_path.hpp"
#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept::detail {

/// Bounds over a motion, of a SeenVector.
struct VectorBound {
  PointMotionBound carried;       ///< of the vector, relative to the ancestor
  PointMotionBound observed;      ///< of the observer's origin, likewise
  double toolTurn = 0.0;          ///< rad per unit t, of the tool
  double referenceTurn = 0.0;     ///< likewise
  double observerTurn = 0.0;      ///< the observer's of the two
  double observerTurnRate = 0.0;  ///< rad per unit t squared: its angular acceleration
};

/// Room for one query.
struct ConstraintScratch {
  /// Per link, by path, relative to the last common ancestor.
  struct States {
    std::vector<BodyState> tool, reference;
  };
  std::vector<States> states;
  std::vector<JointMotion> tubeMotion;
  std::vector<Eigen::Vector3d> errors;  ///< what the tube does to the current vector
  std::vector<Eigen::Vector3d> turned;  ///< the same in a region's frame
  std::vector<double> arms;
  std::vector<VectorBound> bounds;  ///< by slot
  std::vector<char> known;          ///< whether they are those of the current motion
  std::vector<char> walked;         ///< by link: whether its states are those at t
  struct Interval {
    double begin, end;
    std::uint64_t open;  ///< a bit for each constraint
  };
  std::vector<Interval> stack;
  std::vector<std::uint8_t> kept;  ///< see ConstraintQuestion::kept
};

/// What is known about the constraints over a path, t in [0, 1].
struct ConstraintProof {
  /// Free: all hold at every instant. Violation: one does not at an instant of the path itself.
  Verdict verdict = Verdict::Free;
  double holdsUntil = 1.0;   ///< [0, holdsUntil] is proven
  double undecidedAt = 0.0;  ///< where the first interval begins that could not be proven
  int intervals = 0;         ///< examined
  std::optional<ConstraintViolation> violation = {};
};

/// What is asked about, and the work allowed.
struct ConstraintQuestion {
  const ConstraintModel& constraints;
  const KinematicModel& kinematics;
  std::span<const JointTolerance> tube;  ///< per body; empty: none
  double tolerance = 0.0;                ///< m, CheckerOptions::tolerance
  int maxIntervals = 0;
  /// Per constraint, a bit for each eighth of the path in which it is known to hold; empty: nothing
  /// is known.
  std::span<const std::uint8_t> kept = {};
  ///@{
  /// Room, whose content does not matter.
  ConstraintScratch& scratch;
  std::span<JointMotion> motion;  ///< per body
  ///@}
};

ConstraintProof proveConstraints(const ConstraintQuestion& task, const JointPath& path,
                                 MotionQuery wanted);
/// Of one state. `all`: if not null, every violation is put there.
ConstraintProof proveConstraints(const ConstraintQuestion& task, std::span<const double> q,
                                 std::vector<ConstraintViolation>* all = nullptr);

}  // namespace swept::detail
