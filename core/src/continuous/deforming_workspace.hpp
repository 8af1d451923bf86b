// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "continuous/feature_cache.hpp"
#include "continuous/meeting_pairs.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"

namespace swept {

struct DeformingWorkspace::Data {
  std::vector<detail::OpenBlocks> open;
  std::vector<detail::MeetingPair> pairs;
  std::vector<std::uint16_t> features;
  detail::FeatureCache cache;
};

namespace detail {

/// m. The margin to request from findMeetingPairs(). It is more than everything that underflows.
inline float meetingMargin(double separation, double reach) {
  return static_cast<float>(1.01 * (separation + kMeetingRounding * reach)) +
         std::numeric_limits<float>::min();
}

}  // namespace detail

}  // namespace swept
