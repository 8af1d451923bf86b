// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "kinematics/motion_model.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept::detail {

/// Of a tube around a motion: see the lemma of Q in pair_tube.cpp. `tube`: per body; all spans may
/// be shorter than KinematicModel::bodies, which leaves out the rest.

/// Ranges of values, on which lever arms and roundings depend: those of Q, which may pass the
/// limits of a sliding joint on its way between two values within them.
void widenRanges(const KinematicModel& model, std::span<const JointTolerance> tube,
                 std::span<JointMotion> motion);

/// The bounds of Q, over u, around an interval with this half width: into `tubeMotion`. The ranges
/// of `motion` are already wide.
void boundTubeMotion(const KinematicModel& model, std::span<const JointTolerance> tube, double half,
                     std::span<const JointMotion> motion, std::span<JointMotion> tubeMotion);

}  // namespace swept::detail
