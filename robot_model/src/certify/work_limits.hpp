// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "certify/checker_model.hpp"

namespace swept::detail {

/// Most pair queries, and most sub-intervals in single precision, per interval of
/// CheckerOptions::maxIntervals. If many pairs stay open, these are the work, not the intervals.
inline constexpr std::int64_t kWorkPerInterval = 64;

/// Most pair queries of one motion. Each pair is examined once whatever the cap.
inline std::int64_t mostQueries(const CheckerModel& model) {
  return kWorkPerInterval * model.options.maxIntervals +
         static_cast<std::int64_t>(model.pairCount());
}

/// The same for distances, in a query of clearance.
inline std::int64_t mostMeasures(const CheckerModel& model) {
  return kWorkPerInterval * model.options.maxIntervals + model.measuredPairs;
}

/// Sub-intervals that the SIMD tier may still examine in one motion. Its first block takes eight.
inline int subIntervalsLeft(const CheckerModel& model, const Effort& effort) {
  if (model.options.maxIntervals < kLanes) return 0;
  const std::int64_t left = kWorkPerInterval * model.options.maxIntervals - effort.lanes;
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, kMost));
}

/// Whether the exact tier may go on.
inline bool workLeft(const CheckerModel& model, const Effort& effort) {
  return effort.intervals < model.options.maxIntervals &&
         effort.distances + effort.culled < mostQueries(model);
}

/// m. Of the least clearances that are measured beside a certificate of this tolerance, in m.
inline double clearanceAccuracy(double tolerance) { return std::max(0.1 * tolerance, 1e-5); }

}  // namespace swept::detail
