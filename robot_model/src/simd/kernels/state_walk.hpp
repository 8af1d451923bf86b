// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// walkSelf for one state (SimdMode::State), of which it reads the first lane: the lanes of its own
/// operations are pairs of balls. Pairs are left open, and contacts noted, in the first lane.
///
/// Lemma: what walkSelf proves of a lane at rest this proves by the same operations on the same
/// numbers. A centre is placed by the body's frame in the same order of products and sums, only
/// with the frame's entries in all lanes and the centres in one each; the distance of a centre in
/// motion from the segment of one at rest is their distance (with h = 0 the share s is 0). So the
/// bounds on the roundings there hold here: scratch.rounding for either centre, and those of the
/// squared distance and of the sum of radii within the factor 1 + 4e-6.
bool walkState(const SimdModel& model, SimdScratch& scratch);

}  // namespace swept::detail
