// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "check.hpp"
#include "intervals.hpp"
#include "model.hpp"

/// Tasks: several trajectories with proofs, one after the other.
namespace swept::verify {

/// A phase of a task that holds.
struct PhaseSummary {
  std::string name;
  std::string group;              ///< as the file says
  double begin = 0.0, end = 0.0;  ///< s, on the clock of the task
  /// What changed since the phase before, in words: `cup attached to hand`.
  std::vector<std::string> changes;
  Summary proof;
};

/// Checks the proof of each phase of a task file, as checkProof() does, and that the phases join:
///
/// * the robot is the same: links, joints, limits, geometry;
/// * a phase begins when the one before ends, with the same value of every joint (of an angle
///   without limits to within kTurnedBy, whole turns apart), and the same velocity, where both
///   points have velocities;
/// * each body is as it was, but for the changes that the file states: a body that is attached or
///   placed has the same shapes as before and is where it was, to within kMovedBy; one that is
///   sensed is in the world, and may be any other than before.
///
/// Throws Refusal, which begins with the phase, at the first error.
std::vector<PhaseSummary> checkTask(const Json& task, const Pause& pause = {});

/// rad. By how much an angle without limits may differ between two phases, whole turns apart.
constexpr double kTurnedBy = 1e-12;
/// m, and the same of a rotation's entries. How exactly an attached body is where it was.
constexpr double kMovedBy = 1e-9;

/// Digest of a phase, without its own `digest`.
std::string phaseDigest(Json phase);
/// Digest of a task, of the digests of its phases and all else but its own `digest`.
std::string taskDigest(Json task);

}  // namespace swept::verify
