// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Pairs of balls that are split per pair of links: two links so close that this does not prove
/// them apart are cheaper to compare exactly.
inline constexpr int kMostLooks = 16;

/// Whether of two balls that are not apart the first is the one to be split: the larger one that
/// has children, but first of all those that hold several pieces of geometry.
inline bool splitsFirst(const SimdNode& a, const SimdNode& b) {
  return a.geometry < 0 ||
         (b.geometry >= 0 && a.childCount > 0 && (b.childCount == 0 || a.radius >= b.radius));
}

/// Proves links apart from each other on all sub-intervals of a block, and puts pairs that are not
/// into its open ones. Returns true if it stopped at a contact.
///
/// Lemma: in the frame of a body that carries both, with angular velocity w, distances are the
/// same. There the difference d of two ball centres has the velocity v_B - v_A - w x d (written
/// along the model frame's axes at m) and a second derivative of at most A_A + A_B, relative to
/// that frame; as in world_walk.hpp it stays within h^2 (A_A + A_B) / 2 of the segment of what it
/// does at constant velocity, whose distance from the origin bounds theirs.
///
/// All pairs.
bool walkSelf(const SimdModel& model, SimdScratch& scratch);
/// Only this pair, in these lanes.
bool walkPair(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
              SimdScratch& scratch);

}  // namespace swept::detail
