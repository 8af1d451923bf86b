// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Number of pairs of balls that are split per pair of links: if this does not prove two links
/// apart, they are so close that an exact comparison is cheaper.
inline constexpr int kMostLooks = 16;

/// Whether the first of two balls that are not apart is the one to be split: balls with several
/// pieces of geometry first, then the larger one that has children.
inline bool splitsFirst(const SimdNode& a, const SimdNode& b) {
  return a.geometry < 0 ||
         (b.geometry >= 0 && a.childCount > 0 && (b.childCount == 0 || a.radius >= b.radius));
}

/// Proves links apart from each other on all sub-intervals of a block, and adds the other pairs to
/// its open ones. Returns true if it stopped at a contact.
///
/// Lemma: distances are the same in the frame of a body that carries both, with angular velocity w.
/// There the difference d of two ball centres has the velocity v_B - v_A - w x d (along the model
/// frame's axes at m) and a second derivative of at most A_A + A_B, relative to that frame. As in
/// world_walk.hpp it stays within h^2 (A_A + A_B) / 2 of its segment at constant velocity, whose
/// distance from the origin bounds that of the centres.
///
/// All pairs.
bool walkSelf(const SimdModel& model, SimdScratch& scratch);
/// Only this pair, in these lanes.
bool walkPair(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
              SimdScratch& scratch);

}  // namespace swept::detail
