// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "kinematics/motion_model.hpp"
#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"

namespace swept::detail {

/// Compiles a motion in single precision, with the bounds on its error and on its accelerations.
/// False: a value is not finite or outside what it may be, or the motion turns so far that single
/// precision is not enough; compileMotion tells.
bool compileLaneMotion(const LaneModel& model, const KinematicModel& kinematics,
                       std::span<const double> from, std::span<const double> to,
                       LaneScratch& scratch);

/// A single state, without bounds on accelerations. False as above.
bool compileLaneState(const LaneModel& model, const KinematicModel& kinematics,
                      std::span<const double> q, LaneScratch& scratch);

/// Up to eight states, one after the other in `states`, a lane each; lanes left over repeat the
/// first. False as above, if for any of them, and for robots with floating joints.
bool compileLaneStates(const LaneModel& model, const KinematicModel& kinematics,
                       std::span<const double> states, LaneScratch& scratch);

}  // namespace swept::detail
