// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Seeks contacts of the block's middles alone, which balls inside the outermost links show: most
/// of all contacts. Needs nothing but frames. Returns true if it found one.
bool lookAtWorld(const SimdModel& model, SimdScratch& scratch);

/// Proves balls of the covers apart from the world on all sub-intervals of a block, and adds the
/// other pairs to its open ones. Returns true if it stopped at a contact.
///
/// Lemma: a ball centre c with velocity v and |c''| <= A stays, for |t - m| <= h, within h^2 A / 2
/// of the segment c(m) +- h v(m) (Taylor with the remainder as a vector). So a ball of radius r
/// stays within r + h^2 A / 2 of that segment. The balls of a cut of a cover contain the link; if
/// all of them are apart from an obstacle, the link is.
///
/// All bodies, the outermost first. For a motion after lookAtWorld(), whose contacts are not sought
/// again.
bool walkWorld(const SimdModel& model, SimdScratch& scratch);
/// Only these pairs of geometry `geometry` with obstacles, in these lanes. `looked`: after
/// lookAtPairs(), likewise.
bool walkPairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles,
               SimdScratch& scratch, bool looked = false);
/// Seeks contacts of these pairs alone, as lookAtWorld().
bool lookAtPairs(const SimdModel& model, int geometry, std::span<const SimdHit> obstacles,
                 SimdScratch& scratch);

}  // namespace swept::detail
