// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd/compile/simd_model.hpp"

namespace swept::detail {

/// The moving bodies, in the lanes' frames, and their covers: what depends on neither pairs nor the
/// world. False where the lanes' bounds on motions do not hold; nothing is compiled then.
bool compileSimdBodies(const PairModel& model, SimdModel& simd);

/// The same as another model has.
void shareSimdBodies(const SimdModel& like, SimdModel& simd);

}  // namespace swept::detail
