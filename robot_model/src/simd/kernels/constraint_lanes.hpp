// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "rounding/error_model.hpp"
#include "simd/compile/lane_constraints.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Writes, for each constraint, a bit for each of the block's sub-intervals in which it is proven
/// to hold. All of these are as wide, their bodies are placed with velocities, and boundMotion()
/// has been called. `extent`: of the motion. The lemma is with the kernel.
void findKeptLanes(const LaneConstraints& constraints, const SimdModel& model,
                   const MotionExtent& extent, const SimdScratch& scratch,
                   std::span<std::uint8_t> kept);

}  // namespace swept::detail
