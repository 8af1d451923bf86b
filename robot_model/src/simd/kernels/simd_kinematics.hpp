// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Frames and centres of the root balls of `bodies` (parents first) in all lanes. Values that the
/// block does not give are those of `motion`.
void placeFrames(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                 std::span<const int> bodies, SimdBlock& block);
/// Velocities of the same, after placeFrames(). Rates that the block does not give are those of
/// `motion`.
void placeVelocities(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                     std::span<const int> bodies, SimdBlock& block);
/// Frames, with velocities under SimdMode::Motion.
void placeBodies(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                 std::span<const int> bodies, SimdBlock& block);

/// Bounds on the acceleration of every ball centre relative to the model frame, the first of the
/// model's references, by L3 of ERROR_MODEL.md.
void boundMotion(const SimdModel& model, SimdScratch& scratch);

/// The same relative to all other references, which only pairs of links need. boundMotion() comes
/// first.
void boundMotionOfLinks(const SimdModel& model, SimdScratch& scratch);

}  // namespace swept::detail
