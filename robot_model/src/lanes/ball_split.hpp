// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes/lane_model.hpp"

namespace swept::detail {

/// Pairs of balls that are split per pair of links: two links so close that this does not prove
/// them apart are cheaper to compare exactly.
inline constexpr int kMostLooks = 16;

/// Whether of two balls that are not apart the first is the one to be split: the larger one that
/// has children, but first of all those that hold several pieces of geometry.
inline bool splitsFirst(const LaneNode& a, const LaneNode& b) {
  return a.geometry < 0 ||
         (b.geometry >= 0 && a.childCount > 0 && (b.childCount == 0 || a.radius >= b.radius));
}

}  // namespace swept::detail
