// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Frames and root balls of `bodies` (parents first) in all lanes, with velocities under
/// SimdMode::Motion. Values and rates that the block does not give are those of `motion`.
void placeBodies(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                 std::span<const int> bodies, SimdBlock& block);

/// Bounds on the acceleration of every ball centre relative to each of the model's references.
///
/// Lemma: with |w_k| <= W_k for the angular velocity of body k relative to the reference, |p''| <=
/// sum_k rho_k (b_k + s_k (2 W_{k-1} + s_k)) + a_k + 2 l_k W_{k-1} for spins s_k and slides l_k,
/// their accelerations b_k and a_k, and rho_k a bound on p's distance from joint k's axis. As for
/// W: the angular velocities add, and those of two consecutive joints whose axes keep an angle
/// alpha add to at most sqrt(s^2 + s'^2 + 2 s s' |cos alpha|). (Proof in lever_arms.cpp.)
void boundMotion(const SimdModel& model, SimdScratch& scratch);

}  // namespace swept::detail
