// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd/compile/simd_model.hpp"

namespace swept::detail {

/// The moving bodies, in the SIMD tier's frames, and their covers: the data that depends on neither
/// pairs nor the world. False if the SIMD tier's bounds on motions do not hold; then nothing is
/// compiled.
bool compileSimdBodies(const PairModel& model, SimdModel& simd);

/// Copies the same data from another model.
void shareSimdBodies(const SimdModel& like, SimdModel& simd);

}  // namespace swept::detail
