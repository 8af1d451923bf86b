// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "continuous/meeting_pairs.hpp"

namespace swept::detail {

/// Features of two triangles, a bit each: edge i of the first (from corner i to the next) against
/// edge j of the second, a corner of the first against the second, a corner of the second against
/// the first.
struct FeatureBits {
  static constexpr std::uint16_t kAll = 0x7FFF;
  static constexpr int edges(int i, int j) { return 3 * i + j; }
  static constexpr int firstCorner(int i) { return 9 + i; }
  static constexpr int secondCorner(int j) { return 12 + j; }
};

/// Sets features[p], for every pair p, to the features that may come within `margin` (m) of each
/// other during the step; the others are proven not to. `margin` as for findMeetingPairs().
void findMeetingFeatures(const MovingTree& a, const MovingTree& b, float margin,
                         std::span<const MeetingPair> pairs, std::vector<std::uint16_t>& features);

}  // namespace swept::detail
