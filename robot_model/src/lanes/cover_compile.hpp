// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct CheckerModel;
struct LaneModel;

/// The links' covers, the balls inside them and their hulls, in the frames of LaneModel::bodies.
/// `like`: null, or the lanes of a checker for another world; its hulls are shared.
void compileCovers(const CheckerModel& model, const LaneModel* like, LaneModel& lanes);

}  // namespace swept::detail
