// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Points of the link that seem to lie in the obstacle in that lane, at its middle: indices of
/// SimdHulls::inBody. At most eight; none for obstacles without a reliable inside here.
struct PointsInside {
  std::int32_t count = 0;
  std::int32_t index[kLanes] = {};
};
PointsInside pointsInside(const SimdModel& model, const LikelyContact& likelyContact,
                          SimdScratch& scratch);

}  // namespace swept::detail
