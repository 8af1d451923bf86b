// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"
#include "lanes/lane_search.hpp"

namespace swept::detail {

/// Takes from scratch.rest what planes between the hulls of two bodies prove. Their directions come
/// from exact geometry at one time; each serves for all sub-intervals around it. True: the judge
/// found a contact that decides.
bool dividePairs(const LaneModel& model, LaneJudge& judge, LaneGoal goal, LaneScratch& scratch,
                 LaneAnswer& answer);

}  // namespace swept::detail
