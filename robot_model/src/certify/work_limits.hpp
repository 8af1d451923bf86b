// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "certify/checker_model.hpp"

namespace swept::detail {

/// Pairs that are looked at for each interval of CheckerOptions::maxIntervals, and sub-intervals in
/// single precision, at most: where many pairs stay open, these are the work, not the intervals.
inline constexpr std::int64_t kWorkPerInterval = 64;

/// Pair queries of one motion at most; each pair is looked at once whatever the cap.
inline std::int64_t mostQueries(const CheckerModel& model) {
  return kWorkPerInterval * model.options.maxIntervals +
         static_cast<std::int64_t>(model.pairs.size());
}

/// The same of distances, where a clearance is asked for.
inline std::int64_t mostMeasures(const CheckerModel& model) {
  return kWorkPerInterval * model.options.maxIntervals + model.measuredPairs;
}

/// Sub-intervals of the SIMD tier that are left of those of one motion. It begins with a block of
/// eight.
inline int subIntervalsLeft(const CheckerModel& model, const Effort& effort) {
  if (model.options.maxIntervals < kLanes) return 0;
  const std::int64_t left = kWorkPerInterval * model.options.maxIntervals - effort.lanes;
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, kMost));
}

/// Of the exact tier.
inline bool workLeft(const CheckerModel& model, const Effort& effort) {
  return effort.intervals < model.options.maxIntervals &&
         effort.distances + effort.culled < mostQueries(model);
}

}  // namespace swept::detail
