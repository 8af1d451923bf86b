// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "continuous/deforming_tree.hpp"
#include "geometry/error_model.hpp"

namespace swept::detail {

/// Triangles of two trees, or of one, that may meet.
struct MeetingPair {
  std::uint32_t first;   ///< as numbered by the tree
  std::uint32_t second;  ///< likewise; the larger one of two of one tree
};

/// A pair of blocks still to be looked at.
struct OpenBlocks {
  std::uint32_t first, second;
  std::uint8_t firstLevel, secondLevel;
};

struct MovingTree {
  const TreeOrder* order;
  const DeformingFrame* start;  ///< null: only the end is of interest
  const DeformingFrame* end;
};

/// Appends all pairs of triangles that come within `margin` (m) of each other, and others for which
/// no proof to the contrary was found. `same`: the two trees are one; of pairs with a common vertex
/// only those of two marked triangles are appended. `open` is scratch.
///
/// `margin` has to contain kMeetingRounding times the largest coordinate.
void findMeetingPairs(const MovingTree& a, const MovingTree& b, bool same, float margin,
                      std::vector<OpenBlocks>& open, std::vector<MeetingPair>& pairs);

/// m. From this margin on, which is where coordinates may exceed 5e17, boxes alone are compared:
/// products could leave single precision. Below it none does that counts.
inline constexpr float kMostMargin = 1e12F;

}  // namespace swept::detail
