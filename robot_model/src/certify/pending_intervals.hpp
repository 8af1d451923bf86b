// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/pair_query.hpp"

namespace swept::detail {

/// What the lane tier left open of a motion, arranged for the exact tier. All of it works in a
/// workspace: `pending` with `pendingArena` is what is open, `generation` with `arena` what the
/// exact tier works through.
///
/// Intervals come from bisections of [0, 1], so two of them are disjoint or one contains the other.

/// Every pair whose boxes, swept over the whole motion that the query holds, come near each other.
void takeAll(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace);

/// What the lane search could not settle.
void takeRest(WorkspaceData& workspace);

/// For a search of all that is open: pairs with the same interval share its kinematics.
void groupByInterval(WorkspaceData& workspace);

/// For a search in order of time: a stack of disjoint intervals, the first on top, so that whatever
/// lies before an interval's begin is settled once it is on top. Each has the pairs of all
/// intervals in it.
void stackByTime(WorkspaceData& workspace);

/// Of the pairs of an interval of that stack, those that are open on all of it and those that are
/// open on a part of it come first and second in the arena's range; the others leave.
/// Returns how many there are of either.
struct OpenPairs {
  std::size_t onAll = 0;
  std::size_t onPart = 0;
};
OpenPairs sortOpenPairs(const PendingInterval& interval, WorkspaceData& workspace);

}  // namespace swept::detail
