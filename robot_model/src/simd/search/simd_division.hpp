// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

/// Takes from scratch.rest what planes between the hulls of two bodies prove. Their directions come
/// from exact geometry at one time; each serves for all sub-intervals around it. True: the oracle
/// found a contact that decides.
bool dividePairs(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal, SimdScratch& scratch,
                 SimdAnswer& answer);

}  // namespace swept::detail
