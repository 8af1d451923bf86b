// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "kinematics/motion_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Compiles a motion in single precision, with the bounds on its error and on its accelerations.
/// False: a value is not finite or outside what it may be, or the motion turns so far that single
/// precision is not enough; compileMotion tells.
bool compileSimdMotion(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> from, std::span<const double> to,
                       SimdScratch& scratch);

/// A single state, without bounds on accelerations. False as above.
bool compileSimdState(const SimdModel& model, const KinematicModel& kinematics,
                      std::span<const double> q, SimdScratch& scratch);

/// Up to eight states, one after the other in `states`, a lane each; lanes left over repeat the
/// first. False as above, if for any of them, and for robots with floating joints.
bool compileSimdStates(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> states, SimdScratch& scratch);

}  // namespace swept::detail
