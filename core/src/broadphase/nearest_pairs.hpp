// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "broadphase/box_forest.hpp"
#include "swept/core/broadphase/broadphase.hpp"

namespace swept::detail {

/// A box and its handle in a cache line of their own, since boxes are read in any order.
struct alignas(64) PlacedBox {
  Aabb box;  ///< m
  BoxHandle owner;
};

/// The boxes of one manager, by number, and the forest that holds boxes around them.
struct PlacedForest {
  const BoxForest& forest;
  std::span<const PlacedBox> boxes;
};

/// The first pairs after `after` that are nearer than `bound` (m), at most `most` of them, in their
/// order. `b` null: pairs among a's own boxes. Uses memory for the result only. Returns the number
/// of pairs of blocks that were tested.
std::size_t findNearestPairs(const PlacedForest& a, const PlacedForest* b,
                             const BroadphaseScratch::Pair& after, double bound, std::size_t most,
                             std::vector<BroadphaseScratch::Pair>& pairs);

}  // namespace swept::detail
