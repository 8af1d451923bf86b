// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct CheckerModel;
struct LaneModel;

/// The links' covers, the balls inside them and their hulls, in the frames of LaneModel::bodies.
void compileCovers(const CheckerModel& model, LaneModel& lanes);

}  // namespace swept::detail
