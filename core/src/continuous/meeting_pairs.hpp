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

/// A pair of blocks that has yet to be tested.
struct OpenBlocks {
  std::uint32_t first, second;
  std::uint8_t firstLevel, secondLevel;
};

struct MovingTree {
  const TreeOrder* order;
  const DeformingFrame* start;  ///< null: only the end matters
  const DeformingFrame* end;
};

/// Appends all pairs of triangles that come within `margin` (m) of each other, and others without a
/// proof that they do not. `same`: the two trees are one; of pairs with a common vertex only those
/// of two marked triangles are appended. `open` is scratch.
///
/// `margin` must include kMeetingRounding times the largest coordinate.
void findMeetingPairs(const MovingTree& a, const MovingTree& b, bool same, float margin,
                      std::vector<OpenBlocks>& open, std::vector<MeetingPair>& pairs);

/// m. From this margin on, where coordinates may exceed 5e17, only boxes are compared: products
/// could leave single precision. Below it, no relevant product does.
inline constexpr float kMostMargin = 1e12F;

}  // namespace swept::detail
