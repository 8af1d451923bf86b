// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "simd/compile/simd_model.hpp"

namespace swept::detail {

/// Number of arms of all references together, 4 bytes each, plus as many 0s or 1s: that of a chain
/// of 140 bodies.
inline constexpr std::size_t kMostArms = std::size_t{1} << 20;

/// SimdModel::references for these bodies; the first one is 0, the model frame. With more than
/// `mostArms`, SimdModel::carried instead of their arms. Needs the bodies and covers of the SIMD
/// tier.
void compileReferences(const PairModel& model, const std::vector<int>& bodies, SimdModel& simd,
                       std::size_t mostArms = kMostArms);

}  // namespace swept::detail
