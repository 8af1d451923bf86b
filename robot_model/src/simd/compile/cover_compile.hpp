// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct PairModel;
struct SimdModel;

/// The links' covers, the balls inside them and their hulls, in the frames of SimdModel::bodies.
void compileCovers(const PairModel& model, SimdModel& simd);

}  // namespace swept::detail
