// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/length_tally.hpp"
#include "report/random_motions.hpp"
#include "report/stopwatch.hpp"
#include "report/turns.hpp"

namespace swept {

/// Asks for the signed distance of two shapes, at all tolerances, in `states` random states of a
/// world: of the nearest shapes of the nearest pair where the state is free, of the deepest ones of
/// a pair in contact where it is not. Both tallies have the certified methods only. Shapes are as
/// the files have them, without scale and padding; states whose pair has an attached body are left
/// out.
void addShapePairs(LengthTally& distances, LengthTally& penetrations, const Checker& truth,
                   RandomMotions& random, std::size_t states, int passes,
                   const Stopwatch& stopwatch, const ReportTick& tick);

}  // namespace swept
